#include "core/kinematics/drive_path.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkstudy::testing::drive_path_test {
namespace {

DriveCourse course_of(MotionLaw law) {
  DriveCourse course;
  course.from = -0.4;
  course.to = 2.0;
  course.law = law;
  if (law == MotionLaw::table) {
    course.times = {0.0, 0.5, 1.1, 1.6, 2.5};
    course.positions = {0.2, 1.0, 0.7, 0.7, -0.3};
  }
  return course;
}

constexpr MotionLaw kLaws[] = {MotionLaw::linear, MotionLaw::smooth, MotionLaw::polynomial_345,
                               MotionLaw::table};

// Central differences of fourth order.
TEST(DrivePath, Rates_are_the_derivatives_of_positions) {
  const double h = 1e-3;
  for (const MotionLaw law : kLaws) {
    const DrivePath path({course_of(law)}, 2.5);
    for (const double t : {0.1, 0.7, 1.3, 2.2}) {
      const auto at = [&](double time) { return path.position(time)[0]; };
      const auto first = [&](double d) { return (at(t + d) - at(t - d)) / (2 * d); };
      const auto second = [&](double d) { return (at(t + d) + at(t - d) - 2 * at(t)) / (d * d); };
      const DriveMotion motion = path.at(t);
      EXPECT_NEAR(motion.rate[0], (4 * first(h / 2) - first(h)) / 3, 1e-9);
      EXPECT_NEAR(motion.second_rate[0], (4 * second(h / 2) - second(h)) / 3, 1e-6);
    }
  }
}

TEST(DrivePath, Begins_and_ends_where_it_should) {
  for (const MotionLaw law : {MotionLaw::linear, MotionLaw::smooth, MotionLaw::polynomial_345}) {
    const DrivePath path({course_of(law)}, 2.5);
    EXPECT_DOUBLE_EQ(path.position(0.0)[0], -0.4);
    EXPECT_DOUBLE_EQ(path.position(2.5)[0], 2.0);
    EXPECT_NEAR(path.position(1.25)[0], 0.8, 1e-15);  // all laws are symmetric
  }
}

TEST(DrivePath, Is_at_rest_at_both_ends_as_its_law_says) {
  for (const double end : {0.0, 2.5}) {
    EXPECT_DOUBLE_EQ(DrivePath({course_of(MotionLaw::linear)}, 2.5).at(end).rate[0], 2.4 / 2.5);
    EXPECT_NEAR(DrivePath({course_of(MotionLaw::smooth)}, 2.5).at(end).rate[0], 0.0, 1e-15);
    const DriveMotion gentle = DrivePath({course_of(MotionLaw::polynomial_345)}, 2.5).at(end);
    EXPECT_NEAR(gentle.rate[0], 0.0, 1e-15);
    EXPECT_NEAR(gentle.second_rate[0], 0.0, 1e-14);
  }
}

TEST(DrivePath, Goes_on_beyond_its_ends_only_if_linear) {
  EXPECT_NEAR(DrivePath({course_of(MotionLaw::linear)}, 2.5).position(-2.5)[0], -2.8, 1e-14);
  for (const MotionLaw law : {MotionLaw::smooth, MotionLaw::polynomial_345, MotionLaw::table}) {
    const DrivePath path({course_of(law)}, 2.5);
    EXPECT_NEAR(path.position(3.0)[0], path.position(2.5)[0], 1e-15);
    EXPECT_EQ(path.at(3.0).rate[0], 0.0);
    EXPECT_EQ(path.at(-1.0).second_rate[0], 0.0);
  }
}

TEST(DrivePath, Of_a_table_passes_its_points) {
  const DriveCourse table = course_of(MotionLaw::table);
  const DrivePath path({table}, 2.5);
  for (std::size_t i = 0; i < table.times.size(); ++i) {
    EXPECT_NEAR(path.position(table.times[i])[0], table.positions[i], 1e-14);
  }
}

// Points on a cubic whose curvature is zero at both ends.
TEST(DrivePath, Of_a_table_of_a_natural_cubic_is_that_cubic) {
  DriveCourse table;
  table.law = MotionLaw::table;
  const auto curve = [](double t) {
    return t < 1.0 ? t * t * t : 2.0 + t * (-6.0 + t * (6.0 - t));
  };
  for (const double t : {0.0, 0.3, 0.6, 1.0, 1.8, 2.0}) {
    table.times.push_back(t);
    table.positions.push_back(curve(t));
  }
  const DrivePath path({table}, 2.0);
  for (double t = 0.0; t <= 2.0; t += 0.05) EXPECT_NEAR(path.position(t)[0], curve(t), 1e-14);
}

TEST(DrivePath, Of_a_table_has_no_acceleration_at_its_ends) {
  for (const int points : {3, 4, 200}) {
    DriveCourse table;
    table.law = MotionLaw::table;
    for (int i = 0; i < points; ++i) {
      table.times.push_back(i);
      table.positions.push_back(std::cos(i));
    }
    const DrivePath path({table}, points - 1);
    EXPECT_NEAR(path.at(0.0).second_rate[0], 0.0, 1e-14);
    EXPECT_NEAR(path.at(points - 1).second_rate[0], 0.0, 1e-14);
  }
}

// Velocity and acceleration have no jump at a knot.
TEST(DrivePath, Of_a_table_is_smooth_at_its_points) {
  const DrivePath path({course_of(MotionLaw::table)}, 2.5);
  for (const double knot : {0.5, 1.1, 1.6}) {
    const DriveMotion before = path.at(knot - 1e-9), after = path.at(knot + 1e-9);
    EXPECT_NEAR(before.rate[0], after.rate[0], 1e-6);
    EXPECT_NEAR(before.second_rate[0], after.second_rate[0], 1e-6);
  }
}

TEST(DrivePath, Straight_moves_all_drives_together) {
  const DrivePath path = DrivePath::straight(Eigen::Vector2d(1.0, -2.0), Eigen::Vector2d(2.0, 4.0));
  EXPECT_TRUE(path.position(0.5).isApprox(Eigen::Vector2d(1.5, 1.0)));
  EXPECT_TRUE(path.at(0.3).rate.isApprox(Eigen::Vector2d(1.0, 6.0)));
}

}  // namespace
}  // namespace linkstudy::testing::drive_path_test

#include "core/laws/prescribed_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/pack.h"
#include "core/numerics/natural_spline.h"
#include "tests/support/derivatives.h"

namespace linkstudy::testing::prescribed_motion_law_test {
namespace {

struct Law {
  MotionLaw law;
  bool rises = false;
  MotionParameters<double> numbers{0.3, -1.7, 0.8, 0.4};
  std::vector<KnotParameters<double>> knots = {};

  CoordinateMotion<double> at(double t) const {
    return prescribed_motion(law, rises, numbers, knots.data(), static_cast<int>(knots.size()), t);
  }
};

Law table() {
  Law law{MotionLaw::table};
  for (const SplineKnot& k :
       natural_spline({0.0, 0.4, 1.0, 1.3, 2.0}, {0.2, 1.0, 0.7, 0.7, -0.3})) {
    law.knots.push_back({k.begin, k.value, k.first, k.second, k.third});
  }
  return law;
}

std::vector<Law> all_laws() {
  return {{MotionLaw::linear},
          {MotionLaw::smooth},
          {MotionLaw::polynomial_345},
          {MotionLaw::speed, true},
          {MotionLaw::speed},
          {MotionLaw::sine},
          table()};
}

}  // namespace

// Away from the ends and the knots.
TEST(PrescribedMotionLaw, Has_the_derivatives_of_its_position) {
  for (const Law& law : all_laws()) {
    for (const double t : {0.2, 0.55, 0.9, 1.15, 1.6, 2.3}) {
      SCOPED_TRACE(std::string(name_of(law.law)) + " " + std::to_string(t));
      EXPECT_NEAR(law.at(t).v, slope([&](double x) { return law.at(x).q; }, t, 1e-3), 1e-11);
      EXPECT_NEAR(law.at(t).a, slope([&](double x) { return law.at(x).v; }, t, 1e-3), 1e-11);
    }
  }
}

TEST(PrescribedMotionLaw, Begins_and_ends_as_its_name_says) {
  const Law smooth{MotionLaw::smooth}, gentle{MotionLaw::polynomial_345};
  for (const Law& law : {smooth, gentle}) {
    EXPECT_DOUBLE_EQ(law.at(0.0).q, 0.3);
    EXPECT_DOUBLE_EQ(law.at(1.25).q, 0.3 - 1.7);
    EXPECT_DOUBLE_EQ(law.at(9.0).q, 0.3 - 1.7);
    for (const double t : {0.0, 1.25, 9.0}) EXPECT_NEAR(law.at(t).v, 0.0, 1e-15);
    EXPECT_EQ(law.at(1.3).a, 0.0);
  }
  EXPECT_NEAR(gentle.at(0.0).a, 0.0, 1e-15);
  EXPECT_NEAR(gentle.at(1.25).a, 0.0, 1e-14);
  const Law speed{MotionLaw::speed}, rising{MotionLaw::speed, true};
  EXPECT_DOUBLE_EQ(speed.at(3.0).q, 0.3 - 1.7 * 3.0);
  EXPECT_EQ(rising.at(0.0).v, 0.0);
  EXPECT_DOUBLE_EQ(rising.at(5.0).v, -1.7);
  // The rise covers half the way of the full speed.
  EXPECT_NEAR(rising.at(5.0).q, 0.3 - 1.7 * (5.0 - 1.25 / 2), 1e-14);
  EXPECT_DOUBLE_EQ(Law{MotionLaw::sine}.at(0.0).q, 0.3 - 1.7 * std::sin(0.4));
}

TEST(PrescribedMotionLaw, Of_a_table_meets_its_points_and_goes_on_straight) {
  const Law law = table();
  const double t[] = {0.0, 0.4, 1.0, 1.3, 2.0}, p[] = {0.2, 1.0, 0.7, 0.7, -0.3};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(law.at(t[i]).q, p[i], 1e-15);
  for (int i = 1; i < 4; ++i) {  // no jumps
    EXPECT_NEAR(law.at(t[i] - 1e-12).v, law.at(t[i]).v, 1e-10);
    EXPECT_NEAR(law.at(t[i] - 1e-12).a, law.at(t[i]).a, 1e-10);
  }
  EXPECT_NEAR(law.at(0.0).a, 0.0, 1e-15);
  EXPECT_EQ(law.at(2.5).a, 0.0);
  EXPECT_NEAR(law.at(2.5).q, -0.3 + 0.5 * law.at(2.0).v, 1e-15);
  EXPECT_NEAR(law.at(-0.5).q, 0.2 - 0.5 * law.at(0.0).v, 1e-15);
}

TEST(PrescribedMotionLaw, Of_two_points_is_a_straight_line) {
  const std::vector<SplineKnot> line = natural_spline({0.0, 2.0}, {1.0, 4.0});
  EXPECT_EQ(line[0].first, 1.5);
  EXPECT_EQ(line[0].second, 0.0);
  EXPECT_EQ(line[0].third, 0.0);
  EXPECT_EQ(line[1].first, 1.5);
}

}  // namespace linkstudy::testing::prescribed_motion_law_test

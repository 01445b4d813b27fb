// Several drives at once, on courses of their own, against closed forms.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>
#include <complex>

#include "core/kinematics/drive_cycle.h"
#include "core/kinematics/link_poses.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/support/derivatives.h"

namespace linkstudy::testing::several_drives_test {
namespace {

using ::testing::ElementsAre;

constexpr double kExact = 1e-9;

class DrivenTogether {
 public:
  DrivenTogether(const Linkage& linkage, const std::vector<std::string>& drives)
      : linkage_(linkage), closed_(compile_closed(linkage)), start_(closed_.start) {
    assemble_start(closed_, start_);
    mobility_ = analyse_mobility(closed_, start_);
    std::vector<Drive> chosen;
    for (const std::string& name : drives) {
      for (const Drive& one : list_drives(closed_.mechanism)) {
        if (one.name == "joint." + name) chosen.push_back(one);
      }
    }
    driven_.emplace(closed_, start_, mobility_, chosen);
  }

  const DrivenLinkage& linkage() const { return *driven_; }
  DriveCycle follow(const DrivePath& path, int positions) const {
    return follow_drives(*driven_, start_, mobility_, path, {positions});
  }
  // Origin of a link's frame, and the pose.
  ShortenedDualQuaternion link(const DrivenPose& pose, const std::string& name) const {
    const auto& names = closed_.mechanism.link_names;
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    return link_poses(linkage_, closed_, pose.s).at(static_cast<std::size_t>(at));
  }
  std::size_t velocity(const std::string& joint) const {
    const auto& names = closed_.mechanism.joint_names;
    const auto at = std::find(names.begin(), names.end(), joint) - names.begin();
    return static_cast<std::size_t>(closed_.mechanism.bodies[BodyIndex(at)].v_begin.value());
  }

 private:
  Linkage linkage_;
  Model closed_;
  State<double> start_;
  MobilityReport mobility_;
  std::optional<DrivenLinkage> driven_;
};

DriveCourse course(MotionLaw law, double from, double to) {
  DriveCourse one;
  one.law = law;
  one.from = from;
  one.to = to;
  return one;
}

using Point = std::complex<double>;

// five_bar(): joint coordinates of the cranks are turns from their places at the start.
struct FiveBar {
  Point E = {0.45, 0.0}, B0 = {-0.05, 0.25}, C0 = {0.2, 0.5}, D0 = {0.5, 0.28};
  Point B(double a) const { return B0 * std::polar(1.0, a); }
  Point D(double e) const { return E + (D0 - E) * std::polar(1.0, e); }
  double rod() const { return std::abs(C0 - B0); }
  double other_rod() const { return std::abs(C0 - D0); }
  // Turn of the rod: C lies on circles about B and D, above the line from B to D.
  double rod_turn(double a, double e) const {
    const Point way = D(e) - B(a);
    const double length = std::abs(way), r = rod();
    const double along = (r * r - other_rod() * other_rod() + length * length) / (2.0 * length);
    const Point C = B(a) + way / length * Point(along, std::sqrt(r * r - along * along));
    return std::arg((C - B(a)) / (C0 - B0));
  }
};

TEST(SeveralDrives, Of_two_cranks_on_different_laws_follows_the_closed_form) {
  const DrivenTogether bars(five_bar(), {"A", "E"});
  EXPECT_EQ(bars.linkage().undetermined(), 0);
  const DrivePath path(
      {course(MotionLaw::smooth, 0.3, -0.7), course(MotionLaw::polynomial_345, 0.0, -0.5)}, 1.5);
  const DriveCycle cycle = bars.follow(path, 31);
  ASSERT_TRUE(cycle.is_complete);
  EXPECT_TRUE(cycle.singular.empty());
  // Without the clamp of the laws at their ends, so that differences may reach over them.
  const FiveBar g;
  const auto crank = [](double t) {
    const double s = t / 1.5;
    return 0.3 - (3 * s * s - 2 * s * s * s);
  };
  const auto other = [](double t) {
    const double s = t / 1.5;
    return -0.5 * (10 * s * s * s - 15 * s * s * s * s + 6 * s * s * s * s * s);
  };
  const auto rod = [&](double t) { return g.rod_turn(crank(t), other(t)) - crank(t); };
  for (const DrivenPose& pose : cycle.poses) {
    const std::size_t a = bars.velocity("A"), b = bars.velocity("B");
    EXPECT_NEAR(pose.s.q[PositionIndex(a)], crank(pose.time), 1e-14);
    EXPECT_NEAR(pose.s.v[VelocityIndex(a)], slope(crank, pose.time), 1e-9);
    EXPECT_NEAR(pose.s.q[PositionIndex(b)], rod(pose.time), kExact);
    EXPECT_NEAR(pose.s.v[VelocityIndex(b)], slope(rod, pose.time), kExact);
    EXPECT_NEAR(pose.a[b], curvature(rod, pose.time), 1e-7);
  }
}

// Both rods in line: the linkage is stretched, and its cranks cannot go on together.
TEST(SeveralDrives, Of_two_cranks_locks_where_their_rods_are_in_line) {
  const DrivenTogether bars(five_bar(), {"A", "E"});
  const DrivePath path({course(MotionLaw::smooth, 0.0, 1.2), course(MotionLaw::linear, 0.0, -1.0)},
                       2.0);
  const DriveCycle cycle = bars.follow(path, 41);
  EXPECT_FALSE(cycle.is_complete);
  ASSERT_EQ(cycle.singular.size(), 1u);
  const SingularPosition& p = cycle.singular.front();
  EXPECT_EQ(p.kind, SingularKind::lock);
  EXPECT_THAT(p.joints, ElementsAre("joint.B", "joint.D"));
  const FiveBar g;
  EXPECT_NEAR(std::abs(g.B(p.drive[0]) - g.D(p.drive[1])), g.rod() + g.other_rod(), 1e-9);
  EXPECT_NEAR(p.drive[0], path.position(p.time)[0], 1e-6);
  EXPECT_EQ(p.ranks.dependent, 2);
  EXPECT_EQ(p.regular_rank, 2);
  EXPECT_EQ(p.ranks.h, 1);
  EXPECT_EQ(p.ranks.h_r, 2);
}

// A platform brought to a given pose by the lengths that its legs have there.
TEST(SeveralDrives, Brings_a_platform_to_the_pose_that_belongs_to_its_legs) {
  const Linkage linkage = stewart_platform();
  const DrivenTogether platform(linkage, {"P1", "P2", "P3", "P4", "P5", "P6"});
  EXPECT_EQ(platform.linkage().undetermined(), 0);
  const Eigen::Vector3d shift(0.12, -0.08, 0.15);
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.3, Eigen::Vector3d(1, 2, -2) / 3.0).matrix();
  std::vector<DriveCourse> legs;
  for (int i = 0; i < 6; ++i) {
    const double side = i % 2 == 0 ? -1.0 : 1.0;
    const double b = (120.0 * (i / 2) + 15.0 * side) * M_PI / 180.0;
    const double t = (120.0 * (i / 2) + 45.0 * side) * M_PI / 180.0;
    const Eigen::Vector3d base(std::cos(b), std::sin(b), 0.0);
    const Eigen::Vector3d top(0.6 * std::cos(t), 0.6 * std::sin(t), 1.1);
    const double longer = (turn * top + shift - base).norm() - (top - base).norm();
    legs.push_back(course(i % 2 == 0 ? MotionLaw::smooth : MotionLaw::linear, 0.0, longer));
  }
  const DriveCycle cycle = platform.follow(DrivePath(legs, 1.0), 6);
  ASSERT_TRUE(cycle.is_complete);
  const ShortenedDualQuaternion pose = platform.link(cycle.poses.back(), "platform");
  EXPECT_LT((direction_cosines(pose.e) - turn).norm(), 1e-9);
  EXPECT_LT((pose.r - shift).norm(), 1e-9);
}

TEST(SeveralDrives, May_stand_still_and_turn_back) {
  const FourBarGeometry g;
  const DrivenTogether bar(four_bar(g), {"A"});
  DriveCourse table;
  table.law = MotionLaw::table;
  table.times = {0.0, 1.0, 2.0, 2.2, 2.4, 3.0, 4.0};
  table.positions = {1.0, 2.0, 2.5, 2.5, 2.5, 1.5, 1.0};
  const DriveCycle cycle = bar.follow(DrivePath({table}, 4.0), 9);
  ASSERT_TRUE(cycle.is_complete);
  for (const DrivenPose& pose : cycle.poses) {
    const std::size_t d = bar.velocity("D");
    const FourBarPose p =
        four_bar_pose(pose.drive[0], pose.s.v[VelocityIndex(bar.velocity("A"))], g);
    EXPECT_NEAR(std::remainder(pose.s.q[PositionIndex(d)] - p.rocker, 2 * M_PI), 0.0, kExact);
    EXPECT_NEAR(pose.s.v[VelocityIndex(d)], p.rocker_rate, kExact);
  }
}

TEST(SeveralDrives, Holds_a_drive_that_rests_beside_one_that_moves) {
  const DrivenTogether bars(five_bar(), {"A", "E"});
  const DriveCycle cycle = bars.follow(
      DrivePath({course(MotionLaw::linear, 0.0, -0.6), course(MotionLaw::linear, 0, 0)}, 0.6), 7);
  ASSERT_TRUE(cycle.is_complete);
  const FiveBar g;
  for (const DrivenPose& pose : cycle.poses) {
    EXPECT_EQ(pose.s.q[PositionIndex(bars.velocity("E"))], 0.0);
    EXPECT_NEAR(pose.s.q[PositionIndex(bars.velocity("B"))],
                g.rod_turn(pose.drive[0], 0.0) - pose.drive[0], kExact);
  }
}

TEST(SeveralDrives, Says_that_two_drives_of_one_freedom_contradict_each_other) {
  const DrivenTogether bar(four_bar(), {"A", "D"});
  EXPECT_TRUE(bar.linkage().is_overdriven());
  const double crank = 1.0, rocker = four_bar_pose(crank, 1.0).rocker;
  const DrivePath path({course(MotionLaw::linear, crank, crank + 0.3),
                        course(MotionLaw::linear, rocker, rocker + 0.3)},
                       1.0);
  EXPECT_FALSE(bar.follow(path, 4).is_complete);
  EXPECT_FALSE(DrivenTogether(four_bar(), {"A"}).linkage().is_overdriven());
}

}  // namespace
}  // namespace linkstudy::testing::several_drives_test

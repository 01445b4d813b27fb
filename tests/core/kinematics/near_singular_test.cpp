// Courses that begin, end, pass or nearly meet singular positions, against closed forms.
#include <gmock/gmock.h>

#include <cmath>

#include "core/kinematics/drive_cycle.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/placed_linkage.h"

namespace linkstudy::testing::near_singular_test {
namespace {

using ::testing::Each;
using ::testing::Field;

class Followed {
 public:
  explicit Followed(const Linkage& linkage, const std::string& drive = "A")
      : closed_(compile_closed(linkage)), start_(closed_.start) {
    assemble_start(closed_, start_);
    mobility_ = analyse_mobility(closed_, start_);
    for (const Drive& one : list_drives(closed_.mechanism)) {
      if (one.joint == drive) driven_.emplace(closed_, start_, mobility_, std::vector{one});
    }
  }

  DriveCycle follow(double from, double to, int positions = 73, bool both_ways = false) const {
    DriveCourse course;
    course.from = from;
    course.to = to;
    const DrivePath path({course}, std::abs(to - from));
    return follow_drives(*driven_, start_, mobility_, path, {positions, both_ways});
  }
  const DrivenLinkage& linkage() const { return *driven_; }
  const MobilityReport& mobility() const { return mobility_; }
  double q(const DrivenPose& pose, const std::string& joint) const {
    const auto& names = closed_.mechanism.joint_names;
    const auto at = std::find(names.begin(), names.end(), joint) - names.begin();
    const Body& body = closed_.mechanism.bodies.at(static_cast<std::size_t>(at));
    return pose.s.q[body.q_begin];
  }

 private:
  Model closed_;
  State<double> start_;
  MobilityReport mobility_;
  std::optional<DrivenLinkage> driven_;
};

// Crank angle where coupler and rocker are in line.
double lock_angle(const FourBarGeometry& g) {
  const double reach = g.coupler + g.rocker;
  const double cosine =
      (g.crank * g.crank + g.ground * g.ground - reach * reach) / (2 * g.crank * g.ground);
  return std::acos(cosine);
}

// A parallelogram of wrong lengths: its branches only nearly meet, where the sine between coupler
// and rocker is about the root of the error.
TEST(NearSingular, Branches_that_nearly_meet_are_told_apart) {
  for (const double error : {1e-3, 1e-5, 1e-6, 1e-7, 1e-8}) {
    for (const int positions : {5, 73, 721}) {
      SCOPED_TRACE(::testing::Message() << error << ", " << positions << " positions");
      const FourBarGeometry g{0.1, 0.4, 0.1 + error, 0.4};  // the crank turns fully
      const Followed bar(four_bar(g));
      const DriveCycle cycle = bar.follow(1.0, 1.0 + 2 * M_PI, positions);
      ASSERT_TRUE(cycle.is_complete);
      EXPECT_TRUE(cycle.singular.empty());
      for (const DrivenPose& pose : cycle.poses) {
        const FourBarPose p = four_bar_pose(pose.drive[0], 1.0, g);
        EXPECT_NEAR(std::remainder(bar.q(pose, "D") - p.rocker, 2 * M_PI), 0.0, 1e-9);
      }
    }
  }
}

TEST(NearSingular, A_lock_beside_a_change_point_is_not_leapt_over) {
  for (const double error : {1e-3, 1e-5, 1e-6, 1e-7}) {
    for (const int positions : {5, 73, 721}) {
      SCOPED_TRACE(::testing::Message() << error << ", " << positions << " positions");
      const FourBarGeometry g{0.1, 0.4 - error, 0.1, 0.4};
      const Followed bar(four_bar(g));
      const DriveCycle cycle = bar.follow(1.0, 1.0 + 2 * M_PI, positions);
      EXPECT_FALSE(cycle.is_complete);
      ASSERT_EQ(cycle.singular.size(), 1u);
      EXPECT_EQ(cycle.singular[0].kind, SingularKind::lock);
      EXPECT_NEAR(cycle.singular[0].drive[0], lock_angle(g), 1e-9);
    }
  }
}

TEST(NearSingular, A_branch_close_to_the_end_of_a_course_is_found) {
  const FourBarGeometry g{0.1, 0.4, 0.1, 0.4};
  for (const double beyond : {1e-5, 1e-4, 1e-3, 3e-3, 1e-2}) {
    SCOPED_TRACE(beyond);
    const Followed bar(four_bar(g));
    for (const bool at_begin : {false, true}) {
      const DriveCycle cycle =
          at_begin ? bar.follow(M_PI - beyond, M_PI + 1.0) : bar.follow(1.0, M_PI + beyond);
      ASSERT_TRUE(cycle.is_complete);
      ASSERT_EQ(cycle.singular.size(), 1u);
      EXPECT_EQ(cycle.singular[0].kind, SingularKind::branch);
      EXPECT_NEAR(cycle.singular[0].drive[0], M_PI, 1e-6);
    }
  }
}

// A slider driven between its dead centres: the crank turns half around.
TEST(NearSingular, A_course_may_begin_and_end_at_locks) {
  const double crank = 0.1, rod = 0.3;
  const Linkage slider = PlacedLinkage("slider_crank")
                             .add("A", JointType::revolute, kGround, "crank", {{0, 0, 0}})
                             .add("B", JointType::revolute, "crank", "rod", {{0, crank, 0}})
                             .add("P", JointType::prismatic, kGround, "slider",
                                  {{std::sqrt(rod * rod - crank * crank), 0, 0}, {1, 0, 0}})
                             .close("C", JointType::revolute, "rod", "slider",
                                    {{std::sqrt(rod * rod - crank * crank), 0, 0}})
                             .linkage();
  const Followed driven(slider, "P");
  const double at_start = std::sqrt(rod * rod - crank * crank);
  const double near = rod - crank - at_start, far = rod + crank - at_start;
  for (const auto& [from, to] : {std::pair{near, far}, {far, near}}) {
    const DriveCycle cycle = driven.follow(from, to, 41);
    EXPECT_TRUE(cycle.is_reached);
    ASSERT_TRUE(cycle.is_complete);
    ASSERT_EQ(cycle.singular.size(), 2u);
    EXPECT_THAT(cycle.singular, Each(Field(&SingularPosition::kind, SingularKind::lock)));
    for (const DrivenPose& pose : cycle.poses) {
      // The crank stays on its side; its angle from the slider's line by the law of cosines.
      const double x = pose.drive[0] + at_start;
      const double cosine = (crank * crank + x * x - rod * rod) / (2 * crank * x);
      const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
      const bool is_dead = &pose == &cycle.poses.front() || &pose == &cycle.poses.back();
      EXPECT_NEAR(driven.q(pose, "A") + M_PI / 2, angle, is_dead ? 1e-6 : 1e-9);
      EXPECT_EQ(pose.is_singular, is_dead);
    }
  }
}

TEST(NearSingular, A_gentle_course_ends_at_a_lock) {
  const FourBarGeometry g{0.30, 0.35, 0.20, 0.40};
  const Followed bar(four_bar(g));
  DriveCourse course;
  course.from = 1.0;
  course.to = lock_angle(g);
  course.law = MotionLaw::smooth;
  const Model closed = compile_closed(four_bar(g));
  State<double> start = closed.start;
  assemble_start(closed, start);
  const MobilityReport mobility = analyse_mobility(closed, start);
  const DrivenLinkage driven(closed, start, mobility, {list_drives(closed.mechanism).front()});
  const DriveCycle cycle = follow_drives(driven, start, mobility, DrivePath({course}, 1.0), {21});
  EXPECT_TRUE(cycle.is_complete);
  ASSERT_EQ(cycle.singular.size(), 1u);
  EXPECT_EQ(cycle.singular[0].kind, SingularKind::lock);
  EXPECT_LT(cycle.singular[0].ranks.h, cycle.singular[0].ranks.h_r);
}

// Dimensions of overconstrained linkages are never exact: a pin off the plane, rounded lengths.
TEST(NearSingular, Rounded_overconstrained_linkages_move_on) {
  for (const double offset : {1e-12, 1e-11, 1e-10}) {
    SCOPED_TRACE(offset);
    Linkage bar = four_bar();
    bar.closures.front().first.frame.position.z() += offset;
    const Followed pin(bar);
    EXPECT_TRUE(pin.follow(1.0, 1.0 + 2 * M_PI).is_complete);
    BennettGeometry rounded;
    rounded.alpha += offset;
    const Followed loop(bennett(rounded));
    EXPECT_TRUE(loop.follow(1.0, 2.5).is_complete);
  }
}

// Least-norm velocities and their derivatives, by central differences of fourth order.
TEST(NearSingular, Accelerations_of_undetermined_freedoms_are_derivatives) {
  const Followed linkage(rssr());
  ASSERT_EQ(linkage.linkage().undetermined(), 1);
  const DriveCycle cycle = linkage.follow(0.0, 0.5, 2001);
  ASSERT_TRUE(cycle.is_complete);
  const double h = cycle.poses[1].time;
  double fastest = 0.0;
  for (std::size_t i = 2; i + 2 < cycle.poses.size(); i += 7) {
    const auto v = [&](std::size_t at, std::size_t k) {
      return cycle.poses[at].s.v[VelocityIndex(k)];
    };
    for (std::size_t k = 0; k < cycle.poses[i].a.size(); ++k) {
      const double slope =
          (8 * (v(i + 1, k) - v(i - 1, k)) - (v(i + 2, k) - v(i - 2, k))) / (12 * h);
      EXPECT_NEAR(cycle.poses[i].a[k], slope, 1e-7) << "coordinate " << k << " at " << i;
      fastest = std::max(fastest, std::abs(slope));
    }
  }
  EXPECT_GT(fastest, 0.1);
}

// The same mechanism from a millimetre to a kilometre.
TEST(NearSingular, Size_does_not_decide) {
  const auto scaled = [](Linkage linkage, double by) {
    for (Joint& joint : linkage.joints) {
      joint.frame.position *= by;
      joint.child_frame.position *= by;
    }
    for (Closure& closure : linkage.closures) {
      closure.first.frame.position *= by;
      closure.second.frame.position *= by;
    }
    for (Link& link : linkage.links) link.center_of_mass *= by;
    return linkage;
  };
  const Linkage dyad = PlacedLinkage("dyad on a turntable")
                           .add("T", JointType::revolute, kGround, "table", {{-0.2, 0.1, 0}})
                           .add("A", JointType::revolute, "table", "arm", {{0, 0, 0}})
                           .add("B", JointType::revolute, "arm", "rod", {{0.4, 0, 0}})
                           .close("C", JointType::revolute, "rod", "table", {{0.9, 0, 0}})
                           .linkage();
  Linkage wrong = bennett();
  wrong.closures.front().first.frame.position *= 1.0 + 1e-6;
  for (const double size : {1e-3, 1e-2, 1.0, 1e3}) {
    SCOPED_TRACE(size);
    const Followed shaky(scaled(dyad, size), "T");
    EXPECT_EQ(shaky.mobility().mobility, 1);
    EXPECT_EQ(shaky.mobility().instantaneous_mobility, 2);
    EXPECT_EQ(shaky.mobility().redundant, 4);
    const DriveCycle cycle = shaky.follow(0.0, 2.0);
    EXPECT_TRUE(cycle.is_complete);
    EXPECT_TRUE(cycle.singular.empty());
    const Followed loop(scaled(bennett(), size));
    EXPECT_EQ(loop.mobility().mobility, 1);
    EXPECT_EQ(loop.mobility().redundant, 3);
    const Model closed = compile_closed(scaled(wrong, size));
    State<double> start = closed.start;
    EXPECT_FALSE(assemble_start(closed, start).closed &&
                 analyse_mobility(closed, start).mobility > 0);
  }
}

TEST(NearSingular, The_branch_stays_along_a_course) {
  const Followed bar(four_bar());
  const DriveCycle cycle = bar.follow(1.0, 1.0 + 2 * M_PI);
  const int branch = bar.linkage().branch(cycle.poses.front().s);
  EXPECT_NE(branch, 0);
  for (const DrivenPose& pose : cycle.poses) EXPECT_EQ(bar.linkage().branch(pose.s), branch);
  const Followed loop(bennett());  // rows depend on each other: no sign means anything
  EXPECT_EQ(loop.linkage().branch(loop.follow(1.0, 2.0).poses.front().s), 0);
}

// Two shafts at an angle, pins of the cross normal to their plane and in it: tan(out) = cos(angle)
// tan(in), with the closure -sin(in) cos(angle) cos(out) + cos(in) sin(out) = 0.
Linkage hooke_joint(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return PlacedLinkage("hooke_joint")
      .add("A", JointType::revolute, kGround, "in", {{0, 0, 0}, {1, 0, 0}})
      .add("B", JointType::revolute, kGround, "out", {{0, 0, 0}, {c, s, 0}})
      .close("C", JointType::universal, "in", "out", {{0, 0, 0}, {0, 0, 1}, {-s, c, 0}})
      .linkage();
}

TEST(NearSingular, Transmission_of_a_hooke_joint_falls_with_its_angle) {
  for (const double degrees : {30.0, 60.0, 89.0, 89.9}) {
    const double c = std::cos(degrees * M_PI / 180.0);
    const Followed joint(hooke_joint(degrees * M_PI / 180.0));
    const DriveCycle cycle = joint.follow(0.0, 2 * M_PI);
    ASSERT_TRUE(cycle.is_complete);
    EXPECT_TRUE(cycle.singular.empty());
    for (const DrivenPose& pose : cycle.poses) {
      const double out = std::atan2(c * std::sin(pose.drive[0]), std::cos(pose.drive[0]));
      EXPECT_NEAR(std::remainder(joint.q(pose, "B") - out, 2 * M_PI), 0.0, 1e-9);
    }
    EXPECT_NEAR(cycle.worst.quality, c / std::sqrt(1.0 + c * c), 0.02 * c);
  }
}

// At right angles both partial derivatives of the closure vanish together.
TEST(NearSingular, A_hooke_joint_at_right_angles_branches) {
  const Followed joint(hooke_joint(M_PI / 2));
  const DriveCycle cycle = joint.follow(0.0, 2.0);
  ASSERT_FALSE(cycle.singular.empty());
  const SingularPosition& p = cycle.singular.front();
  EXPECT_EQ(p.kind, SingularKind::branch);
  EXPECT_NEAR(p.drive[0], M_PI / 2, 1e-6);
  EXPECT_EQ(p.regular_rank, 1);
  EXPECT_EQ(p.ranks.h, 0);
  EXPECT_EQ(p.ranks.h_r, 0);
}

// Between the positions asked for, too: transmission of a four-bar is lowest where the diagonal is
// longest or shortest.
TEST(NearSingular, The_worst_transmission_is_found_between_positions) {
  const Followed bar(four_bar({0.10, 0.30, 0.21, 0.40}));
  const double fine = bar.follow(1.0, 1.0 + 2 * M_PI, 721).worst.quality;
  const double coarse = bar.follow(1.0, 1.0 + 2 * M_PI, 3).worst.quality;
  EXPECT_NEAR(coarse, fine, 0.05 * fine);
}

}  // namespace
}  // namespace linkstudy::testing::near_singular_test

// A linkage along its driven cycle, against closed forms and at its singular positions.
#include "core/kinematics/drive_cycle.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/derivatives.h"

namespace linkstudy::testing::drive_cycle_test {
namespace {

using ::testing::ElementsAre;

// A course of one drive at unit speed.
struct Course {
  double from, to;
  int positions;
  bool both_ways;
};

class Driven {
 public:
  explicit Driven(const Linkage& linkage, const std::string& drive = "joint.A")
      : closed_(compile_closed(linkage)), start_(closed_.start) {
    assemble_start(closed_, start_);
    mobility_ = analyse_mobility(closed_, start_);
    for (const Drive& one : list_drives(closed_.mechanism)) {
      if (one.name == drive) driven_.emplace(closed_, start_, mobility_, std::vector{one});
    }
  }

  const DrivenLinkage& linkage() const { return *driven_; }
  double start() const { return driven_->drive_position(start_)[0]; }
  DriveCycle follow(const Course& course) const {
    DriveCourse drive;
    drive.from = course.from;
    drive.to = course.to;
    const DrivePath path({drive}, std::abs(course.to - course.from));
    return follow_drives(*driven_, start_, mobility_, path, {course.positions, course.both_ways});
  }
  DriveCycle full_turn() const { return follow({start(), start() + 2 * M_PI, 73, true}); }

  // q, v or a of a joint's coordinate at a speed of the drive.
  double q(const DrivenPose& pose, const std::string& joint, int i = 0) const {
    return pose.s.q[body(joint).q_begin + i];
  }
  double v(const DrivenPose& pose, double speed, const std::string& joint, int i = 0) const {
    return speed * pose.s.v[body(joint).v_begin + i];
  }
  double a(const DrivenPose& pose, double speed, const std::string& joint, int i = 0) const {
    return speed * speed * pose.a[body(joint).v_begin.value() + i];
  }

 private:
  const Body& body(const std::string& joint) const {
    const auto& names = closed_.mechanism.joint_names;
    const auto at = std::find(names.begin(), names.end(), joint) - names.begin();
    return closed_.mechanism.bodies.at(static_cast<std::size_t>(at));
  }

  Model closed_;
  State<double> start_;
  MobilityReport mobility_;
  std::optional<DrivenLinkage> driven_;
};

// Angles count up to full turns.
double turned(double a, double b) {
  return std::remainder(a - b, 2 * M_PI);
}

constexpr double kExact = 1e-9;

TEST(DriveCycle, Of_a_four_bar_follows_the_closed_form) {
  const FourBarGeometry g;
  const Driven bar(four_bar(g));
  const double w = 5.0;
  const DriveCycle cycle = bar.full_turn();
  ASSERT_EQ(cycle.poses.size(), 73u);
  EXPECT_TRUE(cycle.singular.empty());
  for (const DrivenPose& pose : cycle.poses) {
    const FourBarPose p = four_bar_pose(bar.q(pose, "A"), w, g);
    EXPECT_NEAR(turned(bar.q(pose, "A") + bar.q(pose, "B"), p.coupler), 0.0, kExact);
    EXPECT_NEAR(turned(bar.q(pose, "D"), p.rocker), 0.0, kExact);
    EXPECT_NEAR(w + bar.v(pose, w, "B"), p.coupler_rate, kExact);
    EXPECT_NEAR(bar.v(pose, w, "D"), p.rocker_rate, kExact);
    // The loop's second derivative, along the rocker and along the coupler.
    const double crossing = std::sin(p.rocker - p.coupler), along = std::cos(p.rocker - p.coupler);
    const double crank = g.crank * w * w;
    const double coupler = g.coupler * p.coupler_rate * p.coupler_rate;
    const double rocker = g.rocker * p.rocker_rate * p.rocker_rate;
    EXPECT_NEAR(
        bar.a(pose, w, "B"),
        (crank * std::cos(p.crank - p.rocker) + coupler * along - rocker) / (g.coupler * crossing),
        kExact * w * w);
    EXPECT_NEAR(
        bar.a(pose, w, "D"),
        (crank * std::cos(p.crank - p.coupler) + coupler - rocker * along) / (g.rocker * crossing),
        kExact * w * w);
    EXPECT_LT(pose.residual, 1e-12);
  }
}

TEST(DriveCycle, Of_a_spatial_slider_crank_follows_the_closed_form) {
  const SpatialSliderCrankGeometry g;
  const Driven slider(spatial_slider_crank());
  const double w = 6.0;
  const DriveCycle cycle = slider.full_turn();
  ASSERT_TRUE(cycle.is_complete);
  for (const DrivenPose& pose : cycle.poses) {
    const SpatialSliderCrankPose p = spatial_slider_crank_pose(slider.q(pose, "A"), w);
    EXPECT_NEAR(slider.q(pose, "P"), p.x, kExact);
    EXPECT_NEAR(slider.q(pose, "U", 0), p.first, kExact);
    EXPECT_NEAR(slider.q(pose, "U", 1), p.second, kExact);
    EXPECT_NEAR(slider.v(pose, w, "P"), p.x_rate, kExact);
    EXPECT_NEAR(slider.v(pose, w, "U", 0), p.first_rate, kExact);
    EXPECT_NEAR(slider.v(pose, w, "U", 1), p.second_rate, kExact);
    const double y = g.pivot_y - g.crank * std::sin(p.psi), yv = -g.crank * std::cos(p.psi) * w;
    const double z = g.pivot_z + g.crank * std::cos(p.psi), zv = -g.crank * std::sin(p.psi) * w;
    const double ya = g.crank * std::sin(p.psi) * w * w, za = -g.crank * std::cos(p.psi) * w * w;
    const double xa = -(y * ya + yv * yv + z * za + zv * zv + p.x_rate * p.x_rate) / p.x;
    const double square = y * y + z * z;
    const double root = std::sqrt(square);
    EXPECT_NEAR(slider.a(pose, w, "P"), xa, kExact);
    EXPECT_NEAR(slider.a(pose, w, "U", 0),
                (y * za - z * ya) / square - 2 * (y * yv + z * zv) * p.first_rate / square,
                kExact * w * w);
    EXPECT_NEAR(slider.a(pose, w, "U", 1), xa / root + p.x * p.x_rate * p.x_rate / (square * root),
                kExact * w * w);
  }
}

TEST(DriveCycle, Of_a_bennett_linkage_follows_the_closed_form) {
  const BennettGeometry g;
  const Driven loop(bennett(g));
  const double product = std::sin((g.beta + g.alpha) / 2) / std::sin((g.beta - g.alpha) / 2);
  const double w = 3.0;
  const DriveCycle cycle = loop.full_turn();
  ASSERT_TRUE(cycle.is_complete);
  for (const DrivenPose& pose : cycle.poses) {
    const double first = loop.q(pose, "A");
    const double second = 2 * std::atan(product / std::tan(first / 2));
    const double rate = -w * std::sin(second) / std::sin(first);
    const double acceleration =
        -w * (std::cos(second) * rate - std::sin(second) * w / std::tan(first)) / std::sin(first);
    for (const char* joint : {"B", "D"}) {
      EXPECT_NEAR(turned(loop.q(pose, joint), second), 0.0, kExact);
      EXPECT_NEAR(loop.v(pose, w, joint), rate, kExact);
      EXPECT_NEAR(loop.a(pose, w, joint), acceleration, kExact * w * w);
    }
  }
}

TEST(DriveCycle, Of_RSRRP_follows_the_closed_form) {
  const auto slide = [](double crank) { return rsrrp_pose(crank).d; };
  const auto swing = [](double crank) { return rsrrp_pose(crank).psi22; };
  for (const bool cut_at_revolute : {false, true}) {
    const Driven linkage(cut_at_revolute ? rsrrp_revolute() : rsrrp());
    const DriveCycle cycle = linkage.full_turn();
    ASSERT_TRUE(cycle.is_complete);
    for (const DrivenPose& pose : cycle.poses) {
      const double crank = linkage.q(pose, "A");
      EXPECT_NEAR(linkage.q(pose, "P"), slide(crank), kExact);
      EXPECT_NEAR(linkage.q(pose, "Q"), swing(crank), kExact);
      EXPECT_NEAR(linkage.v(pose, 1.0, "P"), slope(slide, crank), kExact);
      EXPECT_NEAR(linkage.v(pose, 1.0, "Q"), slope(swing, crank), kExact);
      EXPECT_NEAR(linkage.a(pose, 1.0, "P"), curvature(slide, crank), kExact);
      EXPECT_NEAR(linkage.a(pose, 1.0, "Q"), curvature(swing, crank), kExact);
    }
  }
}

// Free coordinate systems of the cut: the same motion.
TEST(DriveCycle, Does_not_depend_on_where_the_loop_is_cut) {
  const Driven at_ball(spatial_slider_crank());
  const Driven at_universal(spatial_slider_crank_cut_at_universal());
  const Course course{0.0, 1.0, 11, false};
  const DriveCycle a = at_ball.follow(course), b = at_universal.follow(course);
  ASSERT_EQ(a.poses.size(), b.poses.size());
  for (std::size_t i = 0; i < a.poses.size(); ++i) {
    EXPECT_NEAR(at_ball.q(a.poses[i], "P"), at_universal.q(b.poses[i], "P"), kExact);
    EXPECT_NEAR(at_ball.a(a.poses[i], 6, "P"), at_universal.a(b.poses[i], 6, "P"), kExact);
  }
}

// Dead positions of the driven bar: coupler and rocker in line, cosine law.
TEST(DriveCycle, Of_a_rocker_ends_where_it_locks_on_both_sides) {
  const FourBarGeometry g{0.30, 0.35, 0.20, 0.40};
  const auto angle_at = [&](double diagonal) {
    return std::acos((g.ground * g.ground + g.crank * g.crank - diagonal * diagonal) /
                     (2 * g.ground * g.crank));
  };
  const Driven bar(four_bar(g));
  const DriveCycle cycle = bar.full_turn();
  EXPECT_TRUE(cycle.is_reached);
  EXPECT_FALSE(cycle.is_complete);
  ASSERT_EQ(cycle.singular.size(), 2u);
  EXPECT_NEAR(cycle.singular[0].drive[0], angle_at(g.coupler + g.rocker), 1e-6);
  EXPECT_NEAR(cycle.singular[1].drive[0], angle_at(g.coupler - g.rocker), 1e-6);
  for (const SingularPosition& p : cycle.singular) {
    EXPECT_EQ(p.kind, SingularKind::lock);
    EXPECT_THAT(p.joints, ElementsAre("joint.B", "joint.D"));
  }
  for (std::size_t i = 1; i < cycle.poses.size(); ++i) {
    EXPECT_NEAR(cycle.poses[i].drive[0] - cycle.poses[i - 1].drive[0], 2 * M_PI / 72, 1e-12);
  }
  const FourBarPose last = four_bar_pose(cycle.poses.back().drive[0], 1.0, g);
  EXPECT_NEAR(turned(bar.q(cycle.poses.back(), "D"), last.rocker), 0.0, kExact);
}

TEST(DriveCycle, Keeps_the_branch_of_parallel_rods_through_flat_positions) {
  for (const int positions : {73, 50}) {  // flat positions among them or between
    const Driven rods(n_four_bar(2), "joint.A0");
    const DriveCycle cycle = rods.follow({M_PI / 2, 2.5 * M_PI, positions, false});
    ASSERT_TRUE(cycle.is_complete);
    for (const DrivenPose& pose : cycle.poses) {
      for (const char* joint : {"A1", "A2"}) {
        EXPECT_NEAR(rods.q(pose, joint), rods.q(pose, "A0"), kExact);
        if (pose.is_singular) continue;
        EXPECT_NEAR(rods.v(pose, 1.0, joint), 1.0, 1e-6);
      }
    }
    ASSERT_EQ(cycle.singular.size(), 2u);
    EXPECT_NEAR(cycle.singular[0].drive[0], M_PI, 1e-6);
    EXPECT_NEAR(cycle.singular[1].drive[0], 2 * M_PI, 1e-6);
    for (const SingularPosition& p : cycle.singular) EXPECT_EQ(p.kind, SingularKind::branch);
  }
}

TEST(DriveCycle, Can_start_at_a_change_point) {
  const Driven bar(flat_parallelogram());
  const DriveCycle cycle = bar.follow({0.0, 1.0, 11, false});
  ASSERT_TRUE(cycle.is_complete);
  EXPECT_TRUE(cycle.poses.front().is_singular);
  ASSERT_EQ(cycle.singular.size(), 1u);
  EXPECT_NEAR(cycle.singular[0].drive[0], 0.0, 1e-9);
  // Coupler and rocker keep their lengths, whichever of the two branches was taken.
  for (const DrivenPose& pose : cycle.poses) {
    const double crank = bar.q(pose, "A"), coupler = crank + bar.q(pose, "B");
    const double rocker = bar.q(pose, "D");
    EXPECT_NEAR(0.2 * std::cos(crank) + 0.5 * std::cos(coupler), 0.5 + 0.2 * std::cos(rocker),
                1e-9);
    EXPECT_NEAR(0.2 * std::sin(crank) + 0.5 * std::sin(coupler), 0.2 * std::sin(rocker), 1e-9);
  }
}

TEST(DriveCycle, Takes_the_least_motion_where_a_coupler_may_spin) {
  const Driven linkage(rssr());
  EXPECT_EQ(linkage.linkage().undetermined(), 1);
  const DriveCycle cycle = linkage.follow({0.0, 0.5, 6, false});
  ASSERT_TRUE(cycle.is_complete);
  for (const DrivenPose& pose : cycle.poses) EXPECT_LT(pose.residual, 1e-12);
}

TEST(DriveCycle, Moves_one_leg_of_a_platform_while_the_others_are_held) {
  Linkage stewart = stewart_platform();
  for (Joint& joint : stewart.joints) {
    joint.hold = joint.type == JointType::prismatic && joint.name != "P1";
  }
  const Driven platform(stewart, "joint.P1");
  EXPECT_EQ(platform.linkage().undetermined(), 0);
  const DriveCycle cycle = platform.follow({0.0, 0.05, 6, false});
  ASSERT_TRUE(cycle.is_complete);
  EXPECT_NEAR(platform.q(cycle.poses.back(), "P1"), 0.05, 1e-12);
  for (const char* held : {"P2", "P3", "P4", "P5", "P6"}) {
    EXPECT_EQ(platform.q(cycle.poses.back(), held), 0.0);
    EXPECT_EQ(platform.v(cycle.poses.back(), 1.0, held), 0.0);
  }
}

TEST(DriveCycle, Leaves_a_hold_aside_that_would_stop_the_drive) {
  Linkage linkage = four_bar();
  linkage.joints.front().hold = true;
  const Driven rocker(linkage, "joint.D");
  EXPECT_TRUE(rocker.linkage().releases_holds());
  const DriveCycle cycle = rocker.follow({rocker.start(), rocker.start() + 0.1, 3, false});
  EXPECT_TRUE(cycle.is_complete);
  EXPECT_FALSE(Driven(linkage).linkage().releases_holds());
}

TEST(DriveCycle, Says_that_its_begin_cannot_be_reached) {
  const Driven bar(four_bar({0.30, 0.35, 0.20, 0.40}));
  const DriveCycle cycle = bar.follow({3.0, 4.0, 5, false});
  EXPECT_FALSE(cycle.is_reached);
  EXPECT_TRUE(cycle.poses.empty());
  ASSERT_EQ(cycle.singular.size(), 1u);
  EXPECT_EQ(cycle.singular[0].kind, SingularKind::lock);
}

TEST(DriveCycle, Tells_the_ranks_where_branches_cross) {
  const Driven rods(n_four_bar(2), "joint.A0");
  const DriveCycle cycle = rods.follow({M_PI / 2, 2.5 * M_PI, 50, false});
  ASSERT_EQ(cycle.singular.size(), 2u);
  for (const SingularPosition& p : cycle.singular) {
    EXPECT_EQ(p.regular_rank, 4);
    EXPECT_EQ(p.ranks.h, 2);
    EXPECT_EQ(p.ranks.h_r, 2);
  }
}

}  // namespace
}  // namespace linkstudy::testing::drive_cycle_test

// Assembly: from approximate to closed starts.
#include "core/kinematics/assembly.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/trace_formulas.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::assembly_test {
namespace {

std::vector<Linkage> mechanisms() {
  return {rsrrp(),       rsrrp_revolute(),       four_bar(),
          n_four_bar(2), spatial_slider_crank(), spatial_slider_crank_cut_at_universal()};
}

// Those, and overconstrained, idle and multi-loop ones.
std::vector<Linkage> many_mechanisms() {
  std::vector<Linkage> all = mechanisms();
  for (const Linkage& linkage : {bennett(), rssr(), rccc(), stewart_platform()}) {
    all.push_back(linkage);
  }
  return all;
}

// Norm of the closure residual and of J v by the trace formulas.
struct Openness {
  double position, velocity;
};
Openness openness(const Linkage& linkage, const State<double>& s) {
  Linkage closed = linkage;
  for (Closure& c : closed.closures) c.model = ClosureModel::cut;
  const TraceModel trace = make_trace_model(closed);
  const auto map = oracle_coordinates(compile(closed).mechanism, trace);
  Vector q(trace.dof), v(trace.dof);
  for (std::size_t k = 0; k < map.size(); ++k) {
    q[map[k]] = s.q[PositionIndex(k)];
    v[map[k]] = s.v[VelocityIndex(k)];
  }
  const Constraints c = cut_constraints(trace, q, v);
  return {c.value.norm(), (c.jacobian * v).norm()};
}

struct Assembled {
  Model closed;
  State<double> start;
  AssemblyReport report;
};
Assembled assembled(const Linkage& linkage) {
  Assembled a{compile_closed(linkage), {}, {}};
  a.start = a.closed.start;
  a.report = assemble_start(a.closed, a.start);
  return a;
}

// The four-bar with its coupler and rocker mirrored about the diagonal B - D.
Linkage crossed_four_bar() {
  const FourBarGeometry g;
  const FourBarPose open = four_bar_pose(1.0, 5.0, g);
  const double diagonal = std::atan2(-g.crank * std::sin(1.0), g.ground - g.crank * std::cos(1.0));
  Linkage linkage = four_bar(g);
  linkage.joints[1].position = {2 * diagonal - open.coupler - open.crank + 0.05};
  linkage.joints[2].position = {2 * diagonal - open.rocker - 0.05};
  return linkage;
}

// A body on a ball joint, to be closed to ground with its frame along the ground's; the start is
// off by an angle about an axis.
Linkage turned_body(JointType closure, double angle, const Eigen::Vector3d& axis) {
  Linkage linkage;
  linkage.links = {{"body", 1.0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  Joint ball;
  ball.name = "ball";
  ball.type = JointType::spherical;
  ball.coordinates = RotationCoordinates::quaternion;
  ball.parent = kGround;
  ball.child = "body";
  const Eigen::Quaterniond h(Eigen::AngleAxisd(angle, axis.normalized()));
  ball.position = {h.w(), h.x(), h.y(), h.z()};
  linkage.joints = {ball};
  Closure c;
  c.name = "C";
  c.type = closure;
  c.first.link = kGround;
  c.second.link = "body";
  linkage.closures = {c};
  return linkage;
}

}  // namespace

TEST(Assembly, Wrong_starts_close_or_name_the_closure_that_does_not) {
  int closed = 0, total = 0;
  for (const Linkage& exact : many_mechanisms()) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
      Linkage linkage = exact;
      shake(linkage, seed, 0.3, 1.0);
      const double given = openness(linkage, compile(linkage).start).position;
      const Assembled a = assembled(linkage);
      const Openness open = openness(linkage, a.start);
      ++total;
      EXPECT_NEAR(a.report.residual_given, given, 1e-12);
      EXPECT_LE(open.position, given + 1e-15) << exact.name << " " << seed << " was worsened";
      if (a.report.closed) {
        ++closed;
        EXPECT_LE(open.position, kClosedTolerance) << exact.name << " " << seed;
        EXPECT_LE(open.velocity, 1e-7) << exact.name << " " << seed;
        EXPECT_TRUE(a.report.worst_closure.empty());
      } else {
        EXPECT_FALSE(a.report.worst_closure.empty()) << exact.name << " " << seed;
      }
    }
  }
  EXPECT_GT(closed, total * 95 / 100);
}

TEST(Assembly, Random_loops_close_from_nearby_with_velocities_they_allow) {
  for (const JointType type : {JointType::spherical, JointType::revolute, JointType::universal,
                               JointType::prismatic, JointType::cylindrical, JointType::planar}) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      Linkage linkage = random_closed_linkage(seed, type, ClosureModel::sde);
      shake(linkage, seed, 0.1, 1.0);
      const Assembled a = assembled(linkage);
      ASSERT_TRUE(a.report.closed) << linkage.name << static_cast<int>(type);
      const Openness open = openness(linkage, a.start);
      EXPECT_LE(open.position, kClosedTolerance);
      EXPECT_LE(open.velocity, 1e-9);
    }
  }
}

TEST(Assembly, A_closed_start_is_returned_to_the_last_bit) {
  for (const Linkage& linkage : mechanisms()) {
    const Assembled a = assembled(linkage);
    EXPECT_TRUE(a.report.closed) << linkage.name;
    EXPECT_EQ(a.start.q, a.closed.start.q) << linkage.name;
    EXPECT_EQ(a.start.v, a.closed.start.v) << linkage.name;
    EXPECT_EQ(a.report.displacement, 0.0);
    EXPECT_EQ(a.report.iterations, 0);
  }
}

TEST(Assembly, An_assembled_start_assembles_to_itself) {
  Linkage linkage = rsrrp();
  shake(linkage, 4, 0.2, 0.5);
  Assembled a = assembled(linkage);
  const State<double> once = a.start;
  assemble_start(a.closed, a.start);
  EXPECT_EQ(a.start.q, once.q);
}

TEST(Assembly, Held_joints_keep_position_and_velocity) {
  for (const Linkage& exact : mechanisms()) {
    Linkage linkage = exact;
    linkage.joints[0].position[0] += 0.1;
    linkage.joints[0].velocity = {0.7};
    linkage.joints[0].hold = true;
    const Assembled a = assembled(linkage);
    ASSERT_TRUE(a.report.closed) << exact.name;
    const Body& link = a.closed.mechanism.bodies[BodyIndex(1)];
    EXPECT_EQ(a.closed.mechanism.joint_names[BodyIndex(1)], linkage.joints[0].name);
    EXPECT_EQ(a.start.q[link.q_begin], linkage.joints[0].position[0]) << exact.name;
    EXPECT_EQ(a.start.v[link.v_begin], 0.7) << exact.name;
    EXPECT_LE(openness(linkage, a.start).velocity, 1e-9) << exact.name;
  }
}

TEST(Assembly, The_two_assembly_modes_of_a_four_bar_are_two_branches) {
  const Assembled open = assembled(four_bar());
  Linkage crossed = crossed_four_bar();
  crossed.joints[0].hold = true;
  const Assembled other = assembled(crossed);
  ASSERT_TRUE(open.report.closed);
  ASSERT_TRUE(other.report.closed);
  EXPECT_GT(std::abs(other.start.q[PositionIndex(2)] - open.start.q[PositionIndex(2)]), 0.5)
      << "another mode";
  EXPECT_EQ(open.report.mobility, 1);
  EXPECT_EQ(open.report.rank, 2);
  EXPECT_EQ(open.report.rows, 5);
}

TEST(Assembly, The_branch_of_independent_rows_changes_its_sign_with_the_assembly_mode) {
  // Out-of-plane freedoms make the five rows of the planar four-bar independent.
  const auto spatial = [](Linkage linkage) {
    linkage.joints[1].type = JointType::spherical;
    linkage.joints[2].type = JointType::cylindrical;
    linkage.joints[1].position.resize(3, 0.0);
    linkage.joints[1].velocity.resize(3, 0.0);
    linkage.joints[2].position.resize(2, 0.0);
    linkage.joints[2].velocity.resize(2, 0.0);
    linkage.joints[0].hold = true;
    return linkage;
  };
  const Assembled open = assembled(spatial(four_bar()));
  const Assembled other = assembled(spatial(crossed_four_bar()));
  ASSERT_TRUE(open.report.closed && other.report.closed);
  EXPECT_EQ(open.report.rank, 5);
  EXPECT_EQ(open.report.dependent, other.report.dependent);
  EXPECT_NE(open.report.branch, 0);
  EXPECT_EQ(open.report.branch, -other.report.branch);
}

TEST(Assembly, A_start_more_than_a_right_angle_off_closes_with_aligned_axes) {
  using Eigen::Vector3d;
  for (const Vector3d& axis : {Vector3d(0, 1, 0), Vector3d(0, 0, 1), Vector3d(0.3, -1, 0.6)}) {
    for (const double angle : {0.5, 1.4, 1.7, 2.2, 2.8, 3.1}) {
      for (const JointType type : {JointType::fixed, JointType::revolute}) {
        const Assembled a = assembled(turned_body(type, angle, axis));
        ASSERT_TRUE(a.report.closed) << angle;
        EXPECT_TRUE(a.report.flipped.empty()) << angle;
        const Eigen::Quaterniond h(a.start.q[PositionIndex(0)], a.start.q[PositionIndex(1)],
                                   a.start.q[PositionIndex(2)], a.start.q[PositionIndex(3)]);
        const Eigen::Matrix3d r = h.toRotationMatrix();
        EXPECT_NEAR(r(0, 0), 1.0, 1e-12) << angle;
        if (type == JointType::fixed) {
          EXPECT_NEAR(r.trace(), 3.0, 1e-12) << angle;
        }
      }
    }
  }
}

TEST(Assembly, Axes_that_can_only_be_opposite_are_taken_so_with_a_warning) {
  Linkage linkage = four_bar();  // planar: its axes keep their sense wherever it moves
  linkage.joints[1].position[0] += 0.05;
  EXPECT_TRUE(assembled(linkage).report.flipped.empty());
  linkage.closures[0].second.frame.rotation *=
      Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_EQ(p.assembly.flipped, std::vector<std::string>{linkage.closures[0].name});
  const auto named = std::count_if(p.warnings.begin(), p.warnings.end(), [](const auto& text) {
    return text.find("closure 'C': the axes of its two ends point against each other") !=
           std::string::npos;
  });
  EXPECT_EQ(named, 1);
  EXPECT_LE(openness(linkage, p.model.start).position, kClosedTolerance);
}

// All rows of a closure vanish for half turns too; which of these is the same joint still depends
// on what it holds.
TEST(Assembly, Half_a_turn_is_refused_where_a_closure_holds_the_whole_orientation) {
  using Eigen::Vector3d;
  const std::vector<std::string> named = {"C"}, none;
  for (const Vector3d axis : {Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()}) {
    const bool turns_axis = axis != Vector3d::UnitX();  // a closure's axis is x
    for (const JointType type : {JointType::fixed, JointType::prismatic}) {
      const Linkage linkage = turned_body(type, M_PI, axis);
      const Assembled a = assembled(linkage);
      EXPECT_LT(a.report.residual, kClosedTolerance);
      EXPECT_FALSE(a.report.closed);
      EXPECT_EQ(a.report.turned, named);
      const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
      EXPECT_EQ(p.cause, Cause::assembly_failed);
      EXPECT_NE(p.message.find("closure.C: its ends are turned"), std::string::npos) << p.message;
    }
    for (const JointType type : {JointType::revolute, JointType::cylindrical}) {
      const Assembled a = assembled(turned_body(type, M_PI, axis));
      EXPECT_TRUE(a.report.closed);
      EXPECT_EQ(a.report.turned, none);
      EXPECT_EQ(a.report.flipped, turns_axis ? named : none);
      EXPECT_EQ(flipped_texts(a.report).size(), a.report.flipped.size());
    }
    for (const JointType type : {JointType::universal, JointType::spherical}) {
      const Assembled a = assembled(turned_body(type, M_PI, axis));
      EXPECT_EQ(a.report.turned, none);
      EXPECT_EQ(a.report.flipped, none);
    }
  }
}

TEST(Assembly, Tells_the_same_branch_by_angles_and_by_quaternions) {
  int told = 0;
  for (const Linkage& exact : many_mechanisms()) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      Linkage linkage = exact;
      shake(linkage, seed, 0.3, 0.0);
      const Assembled by_angles = assembled(with_zyx(linkage));
      if (!by_angles.report.closed) continue;
      Linkage there = with_zyx(linkage);
      const auto& joints = by_angles.closed.mechanism.joint_names;
      for (Joint& joint : there.joints) {
        const auto body = std::find(joints.begin(), joints.end(), joint.name) - joints.begin();
        const Body& b = by_angles.closed.mechanism.bodies[BodyIndex(body)];
        const auto q = by_angles.start.q.begin() + b.q_begin.value();
        joint.position.assign(q, q + b.q_count);
      }
      const Assembled by_quaternions = assembled(with_quaternions(there));
      ASSERT_TRUE(by_quaternions.report.closed);
      EXPECT_EQ(by_angles.report.branch, by_quaternions.report.branch) << linkage.name << seed;
      told += by_angles.report.branch != 0;
    }
  }
  EXPECT_GT(told, 40);
}

TEST(Assembly, A_closure_out_of_reach_fails_by_its_name) {
  Linkage linkage = n_four_bar(2);
  linkage.closures[1].second.frame.position.x() = 40.0;  // rod 2 is 1 m long
  const SimulationOptions options = steps_of(1e-3, 1.0);
  const Preparation p = prepare(linkage, options);
  EXPECT_EQ(p.cause, Cause::assembly_failed);
  EXPECT_EQ(p.assembly.worst_closure, "C2");
  EXPECT_NE(p.message.find("closure.C2"), std::string::npos) << p.message;
  EXPECT_LE(p.assembly.residual, p.assembly.residual_given);
}

TEST(Assembly, A_closure_between_held_joints_fails_by_its_name) {
  Linkage linkage = four_bar();
  for (Joint& joint : linkage.joints) joint.hold = true;
  linkage.joints[2].position[0] += 0.01;
  const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
  EXPECT_EQ(p.cause, Cause::assembly_failed);
  EXPECT_NE(p.message.find("closure.C"), std::string::npos) << p.message;
}

}  // namespace linkstudy::testing::assembly_test

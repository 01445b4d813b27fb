// Springs, dampers and actuators between two points: motions that are known in closed form, and
// what holds in every linkage.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/dynamics/energy.h"
#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/cantilever.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::point_springs_test {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;

Link ball(const std::string& name, double mass) {
  return {name, mass, Vector3d::Zero(), 1e-3 * Eigen::Matrix3d::Identity(), {}};
}

PointSpring spring_between(const SpringEnd& first, const SpringEnd& second) {
  PointSpring spring;
  spring.name = "S";
  spring.first = first;
  spring.second = second;
  return spring;
}

// A mass on a rail along ground z, `height` above the point of the ground where the spring ends.
Linkage on_rail(double mass, double height, const PointSpring& spring) {
  Linkage linkage;
  linkage.links = {ball("mass", mass)};
  linkage.joints = {joint_at("rail", JointType::prismatic, kGround, "mass", {})};
  linkage.joints[0].position = {height};
  linkage.springs = {spring};
  return linkage;
}

PointSpring of_rail() {
  return spring_between({kGround, Vector3d::Zero()}, {"mass", Vector3d::Zero()});
}

SimulationOptions adaptive(double end_time, double interval, double tolerance = 1e-12) {
  return adaptive_steps_of(interval, end_time, tolerance);
}

// A spring and damper, a rope, a buffer with a table and an actuator across a linkage, between the
// ground and two of its links.
void add_springs(const std::string& a, const std::string& b, Linkage& linkage) {
  PointSpring spring = spring_between({kGround, {0.3, 0.7, 0.2}}, {a, {0.04, 0.01, 0.02}});
  spring.stiffness = 200.0;
  spring.damping = 5.0;
  spring.free_length = 0.5;
  PointSpring rope = spring_between({a, {0.0, 0.02, 0.0}}, {b, {0.1, 0.0, 0.03}});
  rope.name = "rope";
  rope.acts = SpringActs::tension;
  rope.stiffness = 150.0;
  rope.free_length = 0.2;
  PointSpring buffer = spring_between({b, {0.05, 0.0, 0.0}}, {kGround, {0.4, -0.1, 0.1}});
  buffer.name = "buffer";
  buffer.acts = SpringActs::compression;
  buffer.force = ForceCurve{{0.1, 0.3, 0.5}, {-80.0, -20.0, 10.0}};
  PointSpring cylinder = spring_between({kGround, {0.6, 0.4, 0.0}}, {b, {0.0, 0.0, 0.0}});
  cylinder.name = "cylinder";
  cylinder.course = Course{CourseShape::smooth, 12.0, 0.3, {}, {}};
  for (const PointSpring& one : {spring, rope, buffer, cylinder}) linkage.springs.push_back(one);
}

}  // namespace

TEST(PointSprings, Let_a_mass_swing_at_the_root_of_k_over_m) {
  PointSpring spring = of_rail();
  spring.stiffness = 50.0;
  spring.free_length = 1.0;
  const double omega = std::sqrt(50.0 / 2.0), t = 1.7;
  const Samples s = run(compile(on_rail(2.0, 1.2, spring)), steps_of(1e-3, t, t),
                        {"spring.S.length", "spring.S.rate", "spring.S.force"});
  // RK4 with h omega = 5e-3: (h omega)^4 / 120 a radian, 8.5 rad in all.
  EXPECT_NEAR(s.values(1, 0), 1.0 + 0.2 * std::cos(omega * t), 1e-9);
  EXPECT_NEAR(s.values(1, 1), -0.2 * omega * std::sin(omega * t), 1e-9);
  EXPECT_NEAR(s.values(1, 2), 50.0 * 0.2 * std::cos(omega * t), 1e-7);
  EXPECT_LT(open_ledger(s.outcome), 1e-10);
}

TEST(PointSprings, Are_damped_beside_their_spring) {
  PointSpring spring = of_rail();
  spring.stiffness = 50.0;
  spring.damping = 4.0;
  spring.free_length = 1.0;
  const double m = 2.0, decay = 4.0 / (2.0 * m), t = 1.7;
  const double omega = std::sqrt(50.0 / m - decay * decay);
  const Samples s =
      run(compile(on_rail(m, 1.2, spring)), steps_of(1e-3, t, t),
          {"spring.S.length", "energy.dissipated", "energy.kinetic", "energy.potential"});
  const double expected =
      0.2 * std::exp(-decay * t) * (std::cos(omega * t) + decay / omega * std::sin(omega * t));
  EXPECT_NEAR(s.values(1, 0), 1.0 + expected, 1e-9);
  EXPECT_NEAR(s.values(1, 1), 0.5 * 50.0 * 0.04 - s.values(1, 2) - s.values(1, 3), 1e-10);
}

// Of the form of one element along the line of centres the sde has the same law.
TEST(PointSprings, Without_free_length_are_sdes_along_the_line_of_centres) {
  const SpringEnd first{"coupler", {0.1, 0.02, 0.3}}, second{kGround, {-0.2, 0.5, 0.1}};
  Linkage by_spring = four_bar();
  by_spring.springs = {spring_between(first, second)};
  by_spring.springs[0].stiffness = 700.0;
  by_spring.springs[0].damping = 9.0;
  by_spring.springs[0].free_length = 0.0;
  Linkage by_closure = four_bar();
  Closure line;
  line.name = "S";
  line.model = ClosureModel::sde;
  line.first = {first.link, {Eigen::Matrix3d::Identity(), first.position}};
  line.second = {second.link, {Eigen::Matrix3d::Identity(), second.position}};
  line.sde.form = SdeForm::line_of_centres;
  line.sde.stiffness[kX] = 700.0;
  line.sde.damping[kX] = 9.0;
  by_closure.closures.push_back(line);
  EngineProbe a(by_spring), b(by_closure);
  EXPECT_GT(a.qdd().norm(), 1.0);
  EXPECT_LT((a.qdd() - b.qdd()).norm(), 1e-12 * b.qdd().norm());
  EXPECT_NEAR(a.at("spring.S.force"), b.vector("closure.S.force").norm(), 1e-9);
  EXPECT_NEAR(a.at("energy.potential"), b.at("energy.potential"), 1e-10);
  for (const char* joint : {"joint.A.torque", "joint.B.force", "joint.D.force"}) {
    EXPECT_LT((a.vector(joint) - b.vector(joint)).norm(), 1e-9) << joint;
  }
}

// A ball thrown up by a rope that hangs slack: free flight, half a swing about the length where
// the rope bears the weight, free flight back.
TEST(PointSprings, A_rope_pulls_while_taut_and_leaves_free_flight_between) {
  const double m = 0.5, k = 400.0, length = 1.0, drop = 0.3;
  PointSpring rope = spring_between({kGround, Vector3d::Zero()}, {"mass", Vector3d::Zero()});
  rope.acts = SpringActs::tension;
  rope.stiffness = k;
  rope.free_length = length;
  Linkage linkage = on_rail(m, -(length - drop), rope);
  linkage.gravity = {0.0, 0.0, -kGravity};
  const double omega = std::sqrt(k / m), sag = m * kGravity / k;
  const double flight = std::sqrt(2.0 * drop / kGravity), speed = kGravity * flight;
  const double taut = 2.0 * (std::numbers::pi / 2.0 + std::atan(sag * omega / speed)) / omega;
  const double period = 2.0 * flight + taut;
  const Samples s = run(compile(linkage), adaptive(period, period / 200.0),
                        {"joint.rail.q", "joint.rail.v", "joint.rail.a", "spring.S.force"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  EXPECT_NEAR(s.values(200, 0), -(length - drop), 1e-9);
  EXPECT_NEAR(s.values(200, 1), 0.0, 1e-8);
  const double deepest = std::hypot(sag, speed / omega);
  EXPECT_NEAR(s.values(100, 0), -(length + sag + deepest), 1e-9);
  int slack = 0;
  for (Eigen::Index i = 0; i <= 200; ++i) {
    if (s.values(i, 0) < -length) continue;
    ++slack;
    EXPECT_EQ(s.values(i, 2), -kGravity);
    EXPECT_EQ(s.values(i, 3), 0.0);
  }
  EXPECT_GT(slack, 50);
  EXPECT_LT(open_ledger(s.outcome), 1e-9);
}

// Its damper pulls while it is drawn out, and lets go before the rope is slack.
TEST(PointSprings, A_damped_rope_never_pushes_and_takes_energy_all_the_same) {
  PointSpring rope = of_rail();
  rope.acts = SpringActs::tension;
  rope.stiffness = 400.0;
  rope.damping = 30.0;  // more than critical: 2 sqrt(k m) = 28.3
  rope.free_length = 1.0;
  Linkage linkage = on_rail(0.5, 0.9, rope);
  linkage.joints[0].velocity = {2.0};
  const Samples s = run(compile(linkage), adaptive(0.5, 1e-3, 1e-10),
                        {"spring.S.force", "joint.rail.v", "energy.dissipated"});
  EXPECT_EQ(s.values.col(0).minCoeff(), 0.0);
  EXPECT_GT(s.values.col(0).maxCoeff(), 40.0);
  for (Eigen::Index i = 1; i < s.values.rows(); ++i) EXPECT_GE(s.values(i, 2), s.values(i - 1, 2));
  const double left = 0.5 * 0.5 * std::pow(s.values(s.values.rows() - 1, 1), 2);
  EXPECT_LE(s.values(s.values.rows() - 1, 2) + left, 1.0 + 1e-8);  // of 1 J
}

TEST(PointSprings, A_buffer_pushes_back_what_meets_it_and_never_pulls) {
  PointSpring buffer = of_rail();
  buffer.acts = SpringActs::compression;
  buffer.stiffness = 900.0;
  buffer.free_length = 0.4;
  Linkage linkage = on_rail(1.0, 1.0, buffer);
  linkage.joints[0].velocity = {-3.0};
  const double t = 0.2 + std::numbers::pi / 30.0 + 0.1;  // there, half a swing, 0.1 s back
  const Samples s = run(compile(linkage), adaptive(t, t / 400.0),
                        {"joint.rail.q", "joint.rail.v", "spring.S.force"});
  EXPECT_NEAR(s.values(400, 0), 0.7, 1e-9);
  EXPECT_NEAR(s.values(400, 1), 3.0, 1e-9);
  EXPECT_EQ(s.values.col(2).maxCoeff(), 0.0);
  EXPECT_NEAR(s.values.col(2).minCoeff(), -90.0, 0.5);  // k v / omega, between samples
}

TEST(PointSprings, A_table_on_a_straight_line_is_the_linear_spring) {
  PointSpring linear = of_rail();
  linear.stiffness = 50.0;
  linear.free_length = 1.0;
  PointSpring table = of_rail();
  table.force = ForceCurve{{0.5, 0.9, 1.3, 2.0}, {-25.0, -5.0, 15.0, 50.0}};
  const std::vector<std::string> signals = {"joint.rail.q", "energy.potential"};
  const SimulationOptions options = steps_of(1e-3, 3.0, 0.5);
  const Samples a = run(compile(on_rail(2.0, 1.4, linear)), options, signals);
  const Samples b = run(compile(on_rail(2.0, 1.4, table)), options, signals);
  EXPECT_LT((a.values - b.values).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(PointSprings, Store_in_a_table_the_integral_of_its_force) {
  PointSpring spring = of_rail();
  spring.force = ForceCurve{{0.4, 0.7, 1.0, 1.2}, {-30.0, -10.0, 40.0, 45.0}};
  for (const SpringActs acts : {SpringActs::both, SpringActs::tension, SpringActs::compression}) {
    spring.acts = acts;
    const auto at = [&](double height) { return EngineProbe(on_rail(1.0, height, spring)); };
    const auto energy = [&](double height) { return at(height).at("energy.potential"); };
    constexpr double h = 1e-4;  // nowhere near a bend: what is quadratic there is met exactly
    for (const double x : {0.2, 0.55, 0.72, 0.8, 1.1, 1.5}) {
      const double slope = (energy(x + h) - energy(x - h)) / (2.0 * h);
      EXPECT_NEAR(at(x).at("spring.S.force"), slope, 1e-9) << x;
      EXPECT_GE(energy(x), -1e-13) << x;
    }
    EXPECT_NEAR(energy(0.76), 0.0, 1e-13);  // where it neither pulls nor pushes
  }
}

// With one-sided springs the table is what is on that side, at every length.
TEST(PointSprings, Have_of_a_table_the_side_on_which_they_act) {
  PointSpring spring = of_rail();
  spring.force = ForceCurve{{0.4, 0.7, 1.0, 1.2}, {-30.0, -10.0, 40.0, -5.0}};
  const auto force = [&](SpringActs acts, double height) {
    spring.acts = acts;
    return EngineProbe(on_rail(1.0, height, spring)).at("spring.S.force");
  };
  for (double x = 0.1; x < 1.5; x += 0.03) {
    const double both = force(SpringActs::both, x);
    EXPECT_NEAR(force(SpringActs::tension, x), std::max(both, 0.0), 1e-12) << x;
    EXPECT_NEAR(force(SpringActs::compression, x), std::min(both, 0.0), 1e-12) << x;
  }
}

// F constant over the way d: m v^2 / 2 = F d, all of it supplied.
TEST(PointSprings, An_actuator_gives_the_energy_that_it_supplies) {
  PointSpring cylinder = of_rail();
  cylinder.course = Course{CourseShape::constant, -20.0, 0.0, {}, {}};  // pushes apart
  const double m = 4.0, t = 0.8;
  const Samples s = run(compile(on_rail(m, 0.5, cylinder)), steps_of(1e-2, t, t),
                        {"joint.rail.q", "joint.rail.v", "energy.supplied", "energy.kinetic"});
  EXPECT_NEAR(s.values(1, 0), 0.5 + 0.5 * 20.0 / m * t * t, 1e-13);
  EXPECT_NEAR(s.values(1, 1), 20.0 / m * t, 1e-13);
  EXPECT_NEAR(s.values(1, 2), 20.0 * 0.5 * 20.0 / m * t * t, 1e-12);
  EXPECT_NEAR(s.values(1, 3), s.values(1, 2), 1e-12);
}

TEST(PointSprings, An_actuator_that_holds_a_load_has_its_weight) {
  PointSpring cylinder = of_rail();
  cylinder.course = Course{CourseShape::table, 0.0, 0.0, {0.0, 1.0}, {-0.0, -2.0 * kGravity}};
  Linkage linkage = on_rail(2.0, 0.5, cylinder);
  linkage.gravity = {0.0, 0.0, -kGravity};
  EXPECT_NEAR(EngineProbe(linkage, 1.0).qdd()[0], 0.0, 1e-14);
  EXPECT_NEAR(EngineProbe(linkage, 0.5).qdd()[0], -0.5 * kGravity, 1e-14);
}

TEST(PointSprings, Keep_the_momentum_of_two_free_bodies_and_their_angular_momentum) {
  Linkage linkage;
  linkage.links = {ball("a", 2.0), ball("b", 3.0)};
  linkage.links[0].inertia = Vector3d(0.02, 0.03, 0.04).asDiagonal();
  linkage.joints = {joint_at("A", JointType::free, kGround, "a", {}),
                    joint_at("B", JointType::free, kGround, "b", {})};
  linkage.joints[1].position = {0.5, 0.2, -0.1, 0.3, 0.2, 0.1};
  linkage.joints[0].velocity = {0.3, -0.2, 0.5, 0.0, 0.0, 0.0};
  linkage.joints[1].velocity = {-0.3, 0.6, 0.1, 0.0, 0.0, 0.0};
  PointSpring spring = spring_between({"a", {0.1, 0.2, 0.0}}, {"b", {0.0, -0.1, 0.15}});
  spring.stiffness = 80.0;
  spring.damping = 2.0;
  spring.free_length = 0.3;
  linkage.springs = {spring};
  EngineProbe probe(linkage);
  // Force along the line through both points: opposite forces, and no moment together.
  const Vector3d sum = 2.0 * probe.qdd().head<3>() + 3.0 * probe.qdd().segment<3>(6);
  EXPECT_LT(sum.norm(), 1e-13);
  EXPECT_GT(probe.qdd().head<3>().norm(), 0.1);
  const Samples s = run(compile(linkage), adaptive(1.0, 1.0), {"joint.A.v", "joint.B.v"});
  const Vector3d before = 2.0 * Vector3d(0.3, -0.2, 0.5) + 3.0 * Vector3d(-0.3, 0.6, 0.1);
  const Vector3d after = 2.0 * s.values.row(1).head<3>() + 3.0 * s.values.row(1).segment<3>(6);
  EXPECT_LT((after - before).norm(), 1e-12);
  EXPECT_LT(open_ledger(s.outcome), 1e-9);
}

// Springs are no load of the joints: about its axis a free joint bears nothing.
TEST(PointSprings, Leave_the_axes_of_free_joints_without_a_moment) {
  Linkage linkage = four_bar();
  add_springs("crank", "rocker", linkage);
  shake(linkage, 5, 0.0, 2.0);
  EngineProbe probe(linkage);
  double largest = 0.0;
  for (const char* name : {"spring.S.force", "spring.rope.force", "spring.buffer.force"}) {
    largest = std::max(largest, std::abs(probe.at(name)));
  }
  EXPECT_GT(largest, 5.0);
  for (const char* joint : {"joint.A.torque", "joint.B.torque", "joint.D.torque"}) {
    EXPECT_NEAR(probe.vector(joint).z(), 0.0, 1e-10) << joint;
  }
}

TEST(PointSprings, Close_the_ledger_with_every_kind_of_closure_and_with_bending_links) {
  struct Case {
    const char* what;
    Linkage linkage;
    std::array<const char*, 2> links;
    double end;
  };
  Linkage sde = four_bar();
  sde.closures[0].model = ClosureModel::sde;
  sde.closures[0].sde.stiffness = {1e6, 1e6, 1e6, 0.0, 1e3, 1e3};
  sde.closures[0].sde.damping = {200.0, 200.0, 200.0, 0.0, 0.1, 0.1};
  Linkage projected = four_bar();
  projected.closures[0].stabilization = Stabilization::projection;
  std::vector<Case> cases = {
      {"cut", four_bar(), {"crank", "rocker"}, 1.0},
      {"projection", projected, {"coupler", "rocker"}, 1.0},
      {"sde", sde, {"crank", "coupler"}, 0.3},
      {"clearance", rsup({.clearance = ClearanceKind::planar}), {"crank", "coupler"}, 0.3},
      {"flexible", rsup({.segments = 3}), {"crank", "coupler_rfe1"}, 0.05}};
  for (Case& c : cases) {
    SCOPED_TRACE(c.what);
    add_springs(c.links[0], c.links[1], c.linkage);
    const SimulationOptions options = adaptive(c.end, 0.01, 1e-11);
    const Preparation p = prepare(c.linkage, options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    const Samples s = run(p.model, options, {"spring.S.force", "spring.cylinder.force"});
    ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
    EXPECT_GT(s.values.cwiseAbs().maxCoeff(), 1.0);
    EXPECT_LT(open_ledger(s.outcome), 1e-9);
  }
}

// Two arms with balls on a shaft that spins freely, each drawn to the shaft by a spring with its
// real length: at the angle where m w^2 r cos = m g sin + moment of the spring they stay.
TEST(PointSprings, A_flyball_governor_keeps_the_angle_at_which_its_springs_balance) {
  const double m = 1.0, hub = 0.05, arm = 0.4, at = 0.25, below = 0.3, k = 150.0, l0 = 0.15;
  const double theta = 0.9;  // of the arms from the vertical
  // A spring from the shaft, `below` under the hinge, to `at` along the arm, in the arm's plane.
  const Vector3d point(hub + at * std::sin(theta), 0.0, -at * std::cos(theta));
  const Vector3d to_shaft = Vector3d(0.0, 0.0, -below) - point;
  const Vector3d pull = k * (to_shaft.norm() - l0) * to_shaft.normalized();
  const Vector3d lever = point - Vector3d(hub, 0.0, 0.0);
  // Turning outwards (about -y): spring, weight, and the centrifugal force.
  const double moment = lever.z() * pull.x() - lever.x() * pull.z();  // about +y
  const double radius = hub + arm * std::sin(theta);
  const double outward = -moment, weight = m * kGravity * arm * std::sin(theta);
  const double omega = std::sqrt((weight - outward) / (m * radius * arm * std::cos(theta)));
  Linkage linkage;
  linkage.gravity = {0.0, 0.0, -kGravity};
  Link shaft = ball("shaft", 5.0);
  linkage.links = {shaft};
  linkage.joints = {joint_at("axis", JointType::revolute, kGround, "shaft", {})};
  linkage.joints[0].velocity = {omega};
  for (int side = 0; side < 2; ++side) {
    const std::string name = side == 0 ? "left" : "right";
    const Eigen::Matrix3d half_turn =
        Eigen::AngleAxisd(side * std::numbers::pi, Vector3d::UnitZ()).toRotationMatrix();
    // Joint axis z along -y of this side, so that a positive angle lifts the ball; child: x down.
    Frame hinge;
    hinge.rotation.col(2) = half_turn * -Vector3d::UnitY();
    hinge.rotation.col(0) = -Vector3d::UnitZ();
    hinge.rotation.col(1) = hinge.rotation.col(2).cross(hinge.rotation.col(0));
    hinge.position = half_turn * Vector3d(hub, 0.0, 0.0);
    Link rod = ball(name, m);
    rod.center_of_mass = {arm, 0.0, 0.0};
    rod.inertia = 1e-9 * Eigen::Matrix3d::Identity();
    linkage.links.push_back(rod);
    linkage.joints.push_back(pivot_at(name, "shaft", name, hinge, theta, 0.0));
    PointSpring spring = spring_between({"shaft", {0.0, 0.0, -below}}, {name, {at, 0.0, 0.0}});
    spring.name = name;
    spring.stiffness = k;
    spring.free_length = l0;
    linkage.springs.push_back(spring);
  }
  EngineProbe probe(linkage);
  EXPECT_NEAR(probe.at("spring.left.length"), to_shaft.norm(), 1e-14);
  for (const char* name : {"joint.left.a", "joint.right.a", "joint.axis.a"}) {
    EXPECT_NEAR(probe.at(name), 0.0, 1e-6) << name;  // balls of 1e-9 kg m^2 beside 0.16
  }
  const Samples s = run(compile(linkage), steps_of(1e-3, 2.0, 2.0),
                        {"joint.left.q", "joint.right.q", "joint.axis.v"});
  EXPECT_NEAR(s.values(1, 0), theta, 1e-6);
  EXPECT_NEAR(s.values(1, 1), theta, 1e-6);
  EXPECT_NEAR(s.values(1, 2), omega, 1e-6);
}

TEST(PointSprings, Act_at_the_element_of_a_bending_link_that_covers_their_point) {
  const BeamData data;
  const int segments = 6;
  Linkage linkage = cantilever(data, segments);
  const Vector3d tip(data.length, 0.0, 0.0);
  PointSpring spring = spring_between({kGround, tip + Vector3d(0.0, 2.0, 0.0)}, {"beam", tip});
  spring.stiffness = 500.0;
  spring.free_length = 2.0 - 1e-4;  // drawn by 0.1 mm
  linkage.springs = {spring};
  linkage.points = {{"tip", "beam", tip}};
  Model model = compile(expand_flexible_links(linkage));
  const StaticsReport report = solve_statics(model, model.start);
  ASSERT_TRUE(report.converged) << report.reason;
  const double beam =
      3.0 * data.bending_z() / std::pow(data.length, 3) / (1.0 - 1.0 / (4.0 * segments * segments));
  const double expected = 500.0 * 1e-4 / (500.0 + beam);
  const Samples s = run(model, steps_of(1e-6, 1e-6), {"point.tip.position.y", "spring.S.force"});
  EXPECT_NEAR(s.values(0, 0), expected, 1e-8 * expected);  // small angles: (deflection / L)^2
  EXPECT_NEAR(s.values(0, 1), 500.0 * (1e-4 - expected), 1e-7);
}

// A rope that hangs slack where the run begins limits the step all the same.
TEST(PointSprings, Limit_the_step_where_they_are_taut) {
  PointSpring rope = of_rail();
  rope.acts = SpringActs::tension;
  rope.stiffness = 1e6;
  rope.free_length = 1.0;
  Linkage linkage = on_rail(1.0, 0.999, rope);
  linkage.joints[0].velocity = {1.0};
  const double limit = 2.0 * std::numbers::sqrt2 / std::sqrt(1e6 / 1.0);
  const SimulationOptions options = steps_of(1e-4, 0.01);
  const Preparation p = prepare(linkage, options);
  EXPECT_TRUE(std::isinf(p.spectrum.step_limit));
  const SimulationOutcome end = run(p.model, options);
  EXPECT_NEAR(end.step_limit.seconds, limit, 1e-6 * limit);
  EXPECT_GT(end.step_limit.t, 0.0009);
}

TEST(PointSprings, Whose_points_coincide_have_no_direction_and_say_so) {
  PointSpring spring = of_rail();
  spring.stiffness = 10.0;
  spring.free_length = 0.5;
  const Linkage linkage = on_rail(1.0, 0.0, spring);
  EXPECT_EQ(EngineProbe(linkage).qdd()[0], 0.0);
  const Preparation p = prepare(linkage, steps_of(1e-3, 0.1));
  ASSERT_EQ(p.warnings.size(), 1u);
  EXPECT_NE(p.warnings[0].find("spring 'S': its points coincide at the start"), std::string::npos);
}

}  // namespace linkstudy::testing::point_springs_test

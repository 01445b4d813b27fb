// Loads that repeat, and loads over a joint coordinate: impulses and works in closed form, and what
// holds in every linkage.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/dynamics/statics.h"
#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/repeating_loads.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::courses_test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kMass = 2.0;

// A mass on a rail along ground z, or a wheel about it, that one load drives.
Linkage driven(JointType type, const Course& course) {
  Linkage linkage;
  linkage.links = {{"mass", kMass, Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  linkage.joints = {joint_at("J", type, kGround, "mass", {})};
  linkage.joints[0].position = {0.0};
  linkage.joints[0].velocity = {0.0};
  Load load;
  load.name = "drive";
  load.joint = "J";
  load.course = course;
  linkage.loads = {load};
  return linkage;
}

Course table_of(const std::vector<double>& times, const std::vector<double>& values,
                double period) {
  Course course{CourseShape::table, 0.0, 0.0, times, values};
  course.period = period;
  return course;
}

Course over_joint(const std::vector<double>& positions, const std::vector<double>& values) {
  Course course{CourseShape::table, 0.0, 0.0, {}, values};
  course.over = JointCoordinate{"J", 0};
  course.positions = positions;
  return course;
}

double force_at(const Course& course, double t) {
  return kMass * EngineProbe(driven(JointType::prismatic, course), t).qdd()[0];
}

double force_over(const Course& course, double position) {
  Linkage linkage = driven(JointType::prismatic, course);
  linkage.joints[0].position = {position};
  return kMass * EngineProbe(linkage).qdd()[0];
}

SimulationOptions adaptive(double end_time, double interval, double tolerance = 1e-11) {
  return adaptive_steps_of(interval, end_time, tolerance);
}

double rate_after(const Course& course, const SimulationOptions& options) {
  const Samples s = run(compile(driven(JointType::prismatic, course)), options, {"joint.J.v"});
  EXPECT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  return s.values(s.values.rows() - 1, 0);
}

}  // namespace

TEST(Courses, That_repeat_have_in_every_period_the_value_of_the_first) {
  const Course table = table_of({0.1, 0.3, 0.45}, {2.0, 8.0, 5.0}, 0.5);
  const double first[][2] = {{0.1, 2.0},  {0.2, 5.0}, {0.3, 8.0},  {0.375, 6.5},
                             {0.45, 5.0}, {0.5, 5.0}, {0.59, 5.0}, {0.6 - 1e-9, 5.0}};
  for (const auto& [t, value] : first) {
    for (const int period : {-1, 0, 1, 2, 1000}) {
      // 7e4 N/s of t, which has eps * 500 s.
      EXPECT_NEAR(force_at(table, t + 0.5 * period), value, 1e-10) << t << " " << period;
    }
  }
  Course ramp{CourseShape::ramp, 6.0, 0.2, {}, {}};
  ramp.period = 0.3;
  EXPECT_NEAR(force_at(ramp, 0.3 * 7 + 0.05), 1.5, 1e-13);
  EXPECT_NEAR(force_at(ramp, 0.3 * 7 + 0.29), 6.0, 1e-13);
}

// 3 * 0.1 is more than 0.3, 0.3 / 0.1 less than 3.
TEST(Courses, Begin_again_where_rounding_leaves_the_time_just_short_of_a_period) {
  const Course saw = table_of({0.0, 0.1}, {1.0, 9.0}, 0.1);
  double sum = 0.0;
  for (int k = 0; k <= 2000; ++k) {
    EXPECT_NEAR(force_at(saw, 0.1 * k), 1.0, 1e-9) << k;
    EXPECT_NEAR(force_at(saw, k / 10.0), 1.0, 1e-9) << k;
    if (k < 40) {
      EXPECT_NEAR(force_at(saw, sum), 1.0, 1e-9) << k;
    }
    sum += 0.1;
  }
  EXPECT_NEAR(force_at(saw, 0.3 - 1e-9), 9.0, 1e-6);
}

// The area A of a triangle of force about its centroid c, period by period.
TEST(Courses, Give_every_period_its_impulse) {
  const double period = 0.5, area = 0.5 * 0.5 * 6.0, centroid = (0.0 + 0.2 + 0.5) / 3.0;
  const int count = 7;
  const Course triangle = table_of({0.0, 0.2, 0.5}, {0.0, 6.0, 0.0}, period);
  const Samples s = run(compile(driven(JointType::prismatic, triangle)),
                        steps_of(0.01, count * period, count * period),
                        {"joint.J.q", "joint.J.v", "energy.supplied"});
  double way = 0.0;
  for (int k = 0; k < count; ++k) way += area / kMass * (k * period + period - centroid);
  // Every corner is a step: RK4 is exact for such a force.
  EXPECT_NEAR(s.values(1, 0), way, 1e-11);
  EXPECT_NEAR(s.values(1, 1), count * area / kMass, 1e-12);
  EXPECT_NEAR(s.values(1, 2), 0.5 * kMass * std::pow(count * area / kMass, 2), 1e-4);
}

// At a jump one of four stages of one step is on its other side: h / 6 of the jump.
TEST(Courses, That_jump_cost_constant_steps_an_error_of_first_order_and_adaptive_ones_nothing) {
  const Course saw = table_of({0.0, 0.2}, {0.0, 8.0}, 0.25);
  const double impulse = 10 * (0.5 * 0.2 * 8.0 + 0.05 * 8.0);
  for (const double step : {0.01, 0.005}) {
    const double error = kMass * rate_after(saw, steps_of(step, 2.5, 2.5)) - impulse;
    EXPECT_NEAR(error, -10.0 * 8.0 * step / 6.0, 1e-9) << step;
  }
  for (const Integrator method : {Integrator::adaptive, Integrator::stiff}) {
    SimulationOptions options = adaptive(2.5, 0.1);
    options.integrator = method;
    EXPECT_NEAR(kMass * rate_after(saw, options), impulse, 1e-10);
  }
}

TEST(Courses, Show_adaptive_steps_every_pulse_however_short) {
  const Course pulse = table_of({0.0, 0.0005, 0.001}, {0.0, 1000.0, 0.0}, 1.0);
  const Course once = table_of({5.0, 5.0005, 5.001}, {0.0, 1000.0, 0.0}, 100.0);
  EXPECT_NEAR(kMass * rate_after(pulse, adaptive(20.0, 20.0, 1e-6)), 20 * 0.5, 1e-6);
  EXPECT_NEAR(kMass * rate_after(once, adaptive(20.0, 20.0, 1e-6)), 0.5, 1e-6);
  // Over an angle: half a degree a turn, of a wheel that is let go from rest and from a speed.
  Course knock = over_joint({1.0, 1.004, 1.009}, {0.0, 50.0, 0.0});
  knock.period = 2.0 * pi;
  const double work = 0.5 * 0.009 * 50.0;
  Linkage wheel = driven(JointType::revolute, knock);
  for (const double speed : {3.0, -3.0}) {
    wheel.joints[0].velocity = {speed};
    const Samples s = run(compile(wheel), adaptive(14.0, 14.0, 1e-9), {"joint.J.q", "joint.J.v"});
    const double turns =
        std::floor((std::abs(s.values(1, 0)) + (speed > 0.0 ? -1.01 : 1.0)) / (2.0 * pi)) +
        (speed > 0.0 ? 1.0 : 0.0);
    EXPECT_GE(turns, 4.0);
    const double sign = speed > 0.0 ? 1.0 : -1.0;
    // Bends over a coordinate lie inside of steps, which feel them to their tolerance.
    EXPECT_NEAR(0.5 * s.values(1, 1) * s.values(1, 1), 4.5 + sign * turns * work, 1e-6);
  }
}

// A jump over a coordinate: two entries as near as numbers allow.
TEST(Courses, Over_a_coordinate_may_be_steep_as_a_step) {
  for (const double width : {1e-3, 1e-9, 1e-14}) {
    Linkage wheel = driven(JointType::revolute, over_joint({1.0, 1.0 + width}, {0.0, 5.0}));
    wheel.joints[0].velocity = {2.0};
    const Samples s = run(compile(wheel), adaptive(3.0, 3.0, 1e-9), {"joint.J.q", "joint.J.v"});
    ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
    const double q = s.values(1, 0), v = s.values(1, 1);
    // Met with a step of 1e-9 of the run at the most.
    EXPECT_NEAR(0.5 * v * v, 2.0 + 5.0 * (q - 1.0 - 0.5 * width), 1e-6) << width;
  }
}

TEST(Courses, Over_a_coordinate_hold_their_ends_or_repeat) {
  Course held = over_joint({-0.2, 0.1, 0.4}, {-3.0, 3.0, 12.0});
  for (const auto& [x, value] : {std::pair(-5.0, -3.0), {-0.05, 0.0}, {0.2, 6.0}, {7.0, 12.0}}) {
    EXPECT_NEAR(force_over(held, x), value, 1e-13) << x;
  }
  held.period = 1.0;
  for (const int period : {-2, 0, 3}) {
    EXPECT_NEAR(force_over(held, -0.05 + period), 0.0, 1e-12);
    EXPECT_NEAR(force_over(held, 0.6 + period), 12.0, 1e-12);
    EXPECT_NEAR(force_over(held, -0.2 + period), -3.0, 1e-12);
  }
}

// The work of a press over the crank angle is the same in every turn, forwards and backwards.
TEST(Courses, Over_an_angle_do_the_same_work_in_every_turn) {
  Course press = over_joint({-pi, -0.5, 0.5, pi}, {-1.0, 4.0, 2.0, -1.0});
  press.period = 2.0 * pi;
  const double work = 1.5 * (pi - 0.5) + 3.0 + 0.5 * (pi - 0.5);
  for (const double direction : {1.0, -1.0}) {
    Linkage wheel = driven(JointType::revolute, press);
    wheel.joints[0].position = {-pi};
    wheel.joints[0].velocity = {direction * 15.0};
    const Samples s = run(compile(wheel), adaptive(3.0, 0.001, 1e-12),
                          {"joint.J.q", "joint.J.v", "energy.supplied"});
    EXPECT_LT(open_ledger(s.outcome), 1e-9);
    // Energy where the angle has gone through n whole turns, between two samples.
    for (Eigen::Index i = 1; i < s.values.rows(); ++i) {
      const double before = direction * (s.values(i - 1, 0) + pi) / (2.0 * pi);
      const double after = direction * (s.values(i, 0) + pi) / (2.0 * pi);
      if (std::floor(before) == std::floor(after)) continue;
      const double turns = std::floor(after), part = (turns - before) / (after - before);
      // (1 ms)^2 / 8 of 2 N m/rad (20 rad/s)^2
      const double energy = std::lerp(s.values(i - 1, 2), s.values(i, 2), part);
      EXPECT_NEAR(energy, direction * turns * work, 1e-4) << turns;
    }
  }
}

// The same law as a spring in the joint: motion, equilibrium, stiffness and step limit.
TEST(Courses, On_a_straight_line_over_a_coordinate_are_the_spring_of_its_joint) {
  Linkage load = driven(JointType::prismatic, over_joint({-1.0, 0.2, 1.0}, {50.0, -10.0, -50.0}));
  Linkage spring = driven(JointType::prismatic, Course{CourseShape::constant, 0.0, 0.0, {}, {}});
  spring.joints[0].stiffness = {50.0};
  spring.joints[0].rest = {0.0};
  for (Linkage* linkage : {&load, &spring}) {
    linkage->gravity = {0.0, 0.0, -9.81};
    linkage->joints[0].position = {0.1995};  // a bend nearer than the differences
  }
  const SimulationOptions options = steps_of(1e-3, 1.0, 0.1);
  const Samples a = run(compile(load), options, {"joint.J.q", "joint.J.v"});
  const Samples b = run(compile(spring), options, {"joint.J.q", "joint.J.v"});
  EXPECT_LT((a.values - b.values).cwiseAbs().maxCoeff(), 1e-12);
  const double limit = 2.0 * std::numbers::sqrt2 / std::sqrt(50.0 / kMass);
  EXPECT_NEAR(prepare(load, options).spectrum.step_limit, limit, 1e-7 * limit);
  Model model = compile(load);
  const StaticsReport rest = solve_statics(model, model.start);
  ASSERT_TRUE(rest.converged) << rest.reason;
  EXPECT_NEAR(model.start.q[PositionIndex(0)], -kMass * 9.81 / 50.0, 1e-10);
  EXPECT_EQ(rest.stability, Stability::stable);
  EXPECT_NEAR(rest.smallest_stiffness, 50.0, 1e-7);
}

// On either side of a bend the slope of that side, and a slope that drives away is unstable.
TEST(Courses, Over_a_coordinate_give_statics_the_slope_of_their_side) {
  for (const double side : {-1e-4, 1e-4}) {
    const double weight = kMass * 9.81, at = 0.3 + side;
    const double slope = side < 0.0 ? 40.0 : 90.0;
    const double corner = weight + slope * side;  // so that it rests at `at`
    Linkage linkage = driven(JointType::prismatic,
                             over_joint({0.2, 0.3, 0.5}, {corner + 4.0, corner, corner - 18.0}));
    linkage.gravity = {0.0, 0.0, -9.81};
    linkage.joints[0].position = {at + 0.5 * side};
    Model model = compile(linkage);
    const StaticsReport rest = solve_statics(model, model.start);
    ASSERT_TRUE(rest.converged) << rest.reason;
    EXPECT_NEAR(model.start.q[PositionIndex(0)], at, 1e-9);
    EXPECT_NEAR(rest.smallest_stiffness, slope, 1e-6);
  }
  Linkage away = driven(JointType::prismatic, over_joint({-1.0, 1.0}, {-7.0, 7.0}));
  Model model = compile(away);
  const StaticsReport rest = solve_statics(model, model.start);
  EXPECT_EQ(rest.stability, Stability::unstable);
  EXPECT_NEAR(rest.smallest_stiffness, -7.0, 1e-8);
}

// A rope and an actuator on one line: their slopes add where the rope is taut.
TEST(Courses, Of_an_actuator_over_a_coordinate_add_their_slope_to_that_of_its_spring) {
  for (const bool taut : {true, false}) {
    Linkage linkage =
        driven(JointType::prismatic, Course{CourseShape::constant, -30.0, 0.0, {}, {}});
    PointSpring rope;
    rope.name = "rope";
    rope.first = {kGround, Vector3d::Zero()};
    rope.second = {"mass", {0.0, 0.0, -1.0}};  // its length is -q + 1
    rope.acts = SpringActs::tension;
    rope.stiffness = 80.0;
    rope.free_length = taut ? 0.9 : 2.0;
    rope.course = over_joint({-0.5, 0.4}, {40.0, -14.0});
    linkage.springs = {rope};
    linkage.joints[0].position = {0.05};
    Model model = compile(linkage);
    const StaticsReport rest = solve_statics(model, model.start);
    ASSERT_TRUE(rest.converged) << rest.reason;
    // Pull along +q: 10 - 60 q, and 80 (0.1 - q) of the rope, against 30 N.
    const double stiffness = 60.0 + (taut ? 80.0 : 0.0);
    EXPECT_NEAR(model.start.q[PositionIndex(0)], (10.0 + (taut ? 8.0 : 0.0) - 30.0) / stiffness,
                1e-10);
    EXPECT_NEAR(rest.smallest_stiffness, stiffness, 1e-6);
    const Spectrum spectrum = compute_spectrum(model, model.start);
    EXPECT_NEAR(spectrum.omega_max, std::sqrt(stiffness / kMass), 1e-6);
  }
}

// Where it was slack at the start a steep part that is met later counts for the step limit.
TEST(Courses, Over_a_coordinate_limit_the_step_where_they_are_steep) {
  Linkage linkage =
      driven(JointType::prismatic, over_joint({-1.0, 0.0, 0.001}, {0.0, 0.0, -1000.0}));
  linkage.joints[0].position = {-0.001};
  linkage.joints[0].velocity = {0.5};
  const double limit = 2.0 * std::numbers::sqrt2 / std::sqrt(1e6 / kMass);
  const SimulationOptions options = steps_of(1e-4, 0.01);
  const Preparation p = prepare(linkage, options);
  EXPECT_TRUE(std::isinf(p.spectrum.step_limit));
  const SimulationOutcome end = run(p.model, options);
  EXPECT_NEAR(end.step_limit.seconds, limit, 1e-6 * limit);
}

// Every load over a coordinate acts as a constant one of the value that the table has there.
TEST(Courses, Over_a_coordinate_act_with_their_value_there) {
  Linkage table = four_bar();
  shake(table, 7, 0.0, 2.0);
  add_repeating_loads(table.joints[0].name, "coupler", 20.0, table);
  const double q = table.joints[0].position[0];
  const double folded = q - 1.7 * std::floor((q + 0.4) / 1.7);
  const double press = folded < 0.3   ? std::lerp(20.0, -10.0, (folded + 0.4) / 0.7)
                       : folded < 0.9 ? std::lerp(-10.0, 16.0, (folded - 0.3) / 0.6)
                                      : 16.0;
  const double held = std::clamp(q, -0.6, 0.7);
  const double pull = held < 0.1 ? std::lerp(-20.0, 8.0, (held + 0.6) / 0.7)
                                 : std::lerp(8.0, 20.0, (held - 0.1) / 0.6);
  Linkage constant = table;
  for (Load& load : constant.loads) {
    if (load.name == "press") load.course = {CourseShape::constant, press, 0.0, {}, {}};
  }
  constant.springs.back().course = Course{CourseShape::constant, pull, 0.0, {}, {}};
  EngineProbe a(table, 0.0137), b(constant, 0.0137);
  EXPECT_GT(b.qdd().norm(), 1.0);
  EXPECT_LT((a.qdd() - b.qdd()).norm(), 1e-12 * b.qdd().norm());
  EXPECT_NEAR(a.at("spring.cylinder_over.force"), pull, 1e-12);
}

TEST(Courses, Close_the_ledger_with_every_kind_of_closure_and_with_bending_links) {
  struct Case {
    const char* what;
    Linkage linkage;
    const char* link;
    double end;
  };
  Linkage sde = four_bar();
  sde.closures[0].model = ClosureModel::sde;
  sde.closures[0].sde.stiffness = {1e6, 1e6, 1e6, 0.0, 1e3, 1e3};
  sde.closures[0].sde.damping = {200.0, 200.0, 200.0, 0.0, 0.1, 0.1};
  Linkage projected = four_bar();
  projected.closures[0].stabilization = Stabilization::projection;
  std::vector<Case> cases = {
      {"cut", four_bar(), "coupler", 0.3},
      {"projection", projected, "rocker", 0.3},
      {"sde", sde, "coupler", 0.1},
      {"clearance", rsup({.clearance = ClearanceKind::planar}), "coupler", 0.1},
      {"flexible", rsup({.segments = 3}), "coupler_rfe1", 0.03}};
  for (Case& c : cases) {
    SCOPED_TRACE(c.what);
    add_repeating_loads(c.linkage.joints[0].name, c.link, 3.0, c.linkage);
    const SimulationOptions options = adaptive(c.end, 0.01, 1e-11);
    const Preparation p = prepare(c.linkage, options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    const Samples s = run(p.model, options, {"spring.cylinder_over.force"});
    ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
    EXPECT_GT(s.values.cwiseAbs().maxCoeff(), 0.1);
    EXPECT_LT(open_ledger(s.outcome), 1e-9);
  }
}

}  // namespace linkstudy::testing::courses_test

// End stops and nonlinear springs of joints: rebounds, swings and equilibria in closed form.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::end_stops_test {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kMass = 2.0;

Linkage one_joint(JointType type) {
  Linkage linkage;
  linkage.links = {{"body", kMass, Vector3d::Zero(), 0.5 * Eigen::Matrix3d::Identity(), {}}};
  linkage.joints = {joint_at("J", type, kGround, "body", {})};
  return linkage;
}

JointStops stops(double low, double high, double stiffness) {
  JointStops stop;
  stop.low = {low};
  stop.high = {high};
  stop.stiffness = {stiffness};
  return stop;
}

// A mass that flies to the upper stop 1 m away with 1.5 m/s.
Linkage flying_mass(const JointStops& stop) {
  Linkage linkage = one_joint(JointType::prismatic);
  linkage.joints[0].velocity = {1.5};
  linkage.joints[0].stop = stop;
  return linkage;
}

SimulationOptions adaptive(double end_time, double interval, double tolerance = 1e-11) {
  return adaptive_steps_of(interval, end_time, tolerance);
}

}  // namespace

// The law divides by the speed of the crossing, so that its rebound e* follows from D alone:
// D - ln(1 + D) = -D e* - ln(1 - D e*).
TEST(EndStops, Throw_a_mass_back_with_the_rebound_of_their_law) {
  for (const ContactLaw law :
       {ContactLaw::lankarani_nikravesh, ContactLaw::flores, ContactLaw::hunt_crossley}) {
    for (const double exponent : {1.5, 1.0, 2.2}) {
      JointStops stop = stops(-5.0, 1.0, 1e6);
      stop.law = law;
      stop.restitution = 0.7;
      stop.exponent = exponent;
      const double rebound = contact_restitution(contact_damping(law, 0.7));
      const Model model = compile(flying_mass(stop));
      const Samples s = run(model, adaptive(1.0, 0.5), {"joint.J.v", "energy.dissipated"});
      ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
      EXPECT_EQ(s.outcome.contacts, 1);
      EXPECT_NEAR(s.values(2, 0), -1.5 * rebound, 1e-8);
      const double lost = 0.5 * kMass * 1.5 * 1.5 * (1.0 - rebound * rebound);
      EXPECT_NEAR(s.values(2, 1), lost, 1e-8);
      EXPECT_LT(s.outcome.energy_residual_max, 4e-9 * s.outcome.energy_scale);
      // Constant steps find the speed at the crossing from the states on both sides of it.
      const Samples steps = run(model, steps_of(1e-5, 1.0, 0.5), {"joint.J.v"});
      EXPECT_NEAR(steps.values(2, 0), -1.5 * rebound, 1e-4);
    }
  }
}

TEST(EndStops, Without_loss_send_a_mass_to_and_fro_for_ever) {
  const Linkage linkage = flying_mass(stops(-0.5, 1.0, 1e5));
  const Samples s =
      run(compile(linkage), adaptive(20.0, 0.01), {"joint.J.v", "joint.J.q", "joint.J.stop.force"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  // The first after 2/3 s, then one a second of flight and 0.039 s of contact (Hertz, 2 kg).
  EXPECT_EQ(s.outcome.contacts, 19);
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const bool free = s.values(i, 1) > -0.5 && s.values(i, 1) < 1.0;
    const double force = s.values(i, 2), error = std::abs(s.values(i, 0)) - 1.5;
    EXPECT_TRUE(!free || std::abs(error) < 1e-7) << error;
    EXPECT_EQ(free, force == 0.0) << force;
    EXPECT_LE(force * s.values(i, 1), 0.0);  // back from the upper and the lower end
  }
}

// f = K d + b d' until it would pull: a damped swing from d = 0, v = v0 that ends where f = 0.
TEST(EndStops, With_a_damper_throw_back_as_a_damped_swing_does) {
  const double k = 1e5, b = 200.0, v0 = 1.5;
  JointStops stop = stops(-5.0, 1.0, k);
  stop.exponent = 1.0;
  stop.damping = {b};
  const double decay = b / (2.0 * kMass), omega = std::sqrt(k / kMass - decay * decay);
  // a = 0 where tan(omega t) = 2 decay omega / (decay^2 - omega^2).
  const double t =
      (std::numbers::pi - std::atan2(2.0 * decay * omega, omega * omega - decay * decay)) / omega;
  const double v =
      v0 * std::exp(-decay * t) * (std::cos(omega * t) - decay / omega * std::sin(omega * t));
  const Samples s = run(compile(flying_mass(stop)), adaptive(1.0, 0.5), {"joint.J.v"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  EXPECT_LT(v, -0.5);
  EXPECT_NEAR(s.values(2, 0), v, 1e-8);
  EXPECT_LT(s.outcome.energy_residual_max, 1e-9 * s.outcome.energy_scale);
}

TEST(EndStops, Act_on_every_coordinate_that_has_a_stiffness) {
  Linkage linkage = one_joint(JointType::cylindrical);
  linkage.joints[0].velocity = {2.0, -1.0};
  JointStops stop;
  stop.low = {0.0, -0.5};
  stop.high = {1.0, 0.0};
  stop.stiffness = {1e4, 1e6};
  linkage.joints[0].stop = stop;
  linkage.joints[0].position = {0.5, -0.1};
  const Samples s = run(compile(linkage), adaptive(0.6, 0.6), {"joint.J.v"});
  EXPECT_EQ(s.outcome.contacts, 2);
  EXPECT_NEAR(s.values(1, 0), -2.0, 1e-8);
  EXPECT_NEAR(s.values(1, 1), 1.0, 1e-8);
  linkage.joints[0].stop->stiffness[1] = 0.0;
  const Samples free = run(compile(linkage), adaptive(0.6, 0.6), {"joint.J.v", "joint.J.q"});
  EXPECT_EQ(free.outcome.contacts, 1);
  EXPECT_NEAR(free.values(1, 1), -1.0, 1e-12);
  EXPECT_NEAR(free.values(1, 3), -0.7, 1e-12);
}

// A rod that lies on its stop: K d^n = m g L cos(q) / ... in statics, and it stays there in a run.
TEST(EndStops, Bear_in_statics_what_lies_on_them) {
  Linkage linkage = pendulum(2.0, 0.5);
  linkage.joints[0].position = {-0.05};
  linkage.joints[0].stop = stops(-0.1, 4.0, 1e6);
  Model model = compile(linkage);
  const StaticsReport report = solve_statics(model, model.start);
  ASSERT_TRUE(report.converged) << report.reason;
  const double depth = -0.1 - model.start.q[PositionIndex(0)];
  const double moment = 2.0 * 9.81 * 0.5 * std::cos(model.start.q[PositionIndex(0)]);
  EXPECT_NEAR(1e6 * std::pow(depth, 1.5), moment, 1e-6);
  EXPECT_EQ(report.stability, Stability::stable);
  const double weight = 2.0 * 9.81 * 0.5 * std::sin(model.start.q[PositionIndex(0)]);
  EXPECT_NEAR(report.smallest_stiffness, 1.5 * 1e6 * std::sqrt(depth) - weight, 1e-2);
  const Samples s = run(model, adaptive(0.1, 0.1), {"joint.A.q", "joint.A.stop.force"});
  EXPECT_NEAR(s.values(1, 0), model.start.q[PositionIndex(0)], 1e-10);
  EXPECT_NEAR(s.values(1, 1), moment, 1e-6);
}

TEST(EndStops, Limit_the_step_while_they_touch) {
  JointStops stop = stops(-5.0, 1.0, 1e6);
  stop.exponent = 1.0;
  const SimulationOptions options = steps_of(1e-4, 0.9);
  const Preparation p = prepare(flying_mass(stop), options);
  EXPECT_TRUE(std::isinf(p.spectrum.step_limit));
  const SimulationOutcome end = run(p.model, options);
  const double limit = 2.0 * std::numbers::sqrt2 / std::sqrt(1e6 / kMass);
  EXPECT_NEAR(end.step_limit.seconds, limit, 1e-4 * limit);
}

TEST(EndStops, Close_the_ledger_beside_every_kind_of_closure_and_bending_links) {
  Linkage sde = four_bar();
  sde.closures[0].model = ClosureModel::sde;
  sde.closures[0].sde.stiffness = {1e6, 1e6, 1e6, 0.0, 1e3, 1e3};
  sde.closures[0].sde.damping = {200.0, 200.0, 200.0, 0.0, 0.1, 0.1};
  struct Case {
    const char* what;
    Linkage linkage;
    double end;
  };
  for (Case& c : std::vector<Case>{{"cut", four_bar(), 1.0},
                                   {"sde", sde, 0.4},
                                   {"clearance", rsup({.clearance = ClearanceKind::planar}), 0.3},
                                   {"flexible", rsup({.segments = 3}), 0.1}}) {
    SCOPED_TRACE(c.what);
    Joint& crank = c.linkage.joints[0];
    const double start = crank.position.empty() ? 0.0 : crank.position[0];
    crank.stop = stops(start - 0.02, start + 0.02, 1e5);
    crank.stop->restitution = 0.8;
    crank.velocity = {3.0};
    crank.hold = true;
    const SimulationOptions options = adaptive(c.end, 0.005);
    const Preparation p = prepare(c.linkage, options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    const SimulationOutcome end = run(p.model, options);
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    EXPECT_GE(end.contacts, 1);
    EXPECT_LT(end.energy_residual_max, 1e-9 * end.energy_scale);
  }
}

// A table on a straight line is the linear spring; one that bends keeps the energy all the same.
TEST(JointCurves, On_a_straight_line_are_the_linear_spring) {
  Linkage linear = pendulum(2.0, 0.5);
  linear.joints[0].stiffness = {30.0};
  linear.joints[0].rest = {0.2};
  Linkage curve = pendulum(2.0, 0.5);
  curve.joints[0].spring_curve = JointCurve{0, {{-3.0, -1.0, 0.2, 3.0}, {-96.0, -36.0, 0.0, 84.0}}};
  const std::vector<std::string> signals = {"joint.A.q", "energy.potential"};
  const Samples a = run(compile(linear), steps_of(1e-3, 3.0, 0.5), signals);
  const Samples b = run(compile(curve), steps_of(1e-3, 3.0, 0.5), signals);
  EXPECT_LT((a.values - b.values).cwiseAbs().maxCoeff(), 1e-11);
}

// x'' = -(k1 x, and k2 (x - s) more beyond s): a quarter of the swing in two parts.
TEST(JointCurves, That_bend_swing_with_the_period_of_their_parts) {
  const double k1 = 50.0, k2 = 400.0, s = 0.1, amplitude = 0.25;
  Linkage linkage = one_joint(JointType::prismatic);
  linkage.joints[0].spring_curve = JointCurve{
      0,
      {{-1.0, -s, s, 1.0}, {-k1 * s - (k1 + k2) * 0.9, -k1 * s, k1 * s, k1 * s + (k1 + k2) * 0.9}}};
  linkage.joints[0].position = {amplitude};
  // Beyond s: about x0 = k2 s / (k1 + k2) with w2; inside with w1.
  const double w1 = std::sqrt(k1 / kMass), w2 = std::sqrt((k1 + k2) / kMass);
  const double x0 = k2 * s / (k1 + k2);
  const double t2 = std::acos((s - x0) / (amplitude - x0)) / w2;
  const double v = (amplitude - x0) * w2 * std::sin(w2 * t2);
  const double t1 = std::atan(s * w1 / v) / w1;
  const double period = 4.0 * (t1 + t2);
  const Samples run_ = run(compile(linkage), adaptive(period, period / 4.0),
                           {"joint.J.q", "joint.J.v", "energy.residual"});
  EXPECT_NEAR(run_.values(1, 0), 0.0, 1e-9);
  EXPECT_NEAR(run_.values(2, 0), -amplitude, 1e-9);
  EXPECT_NEAR(run_.values(4, 0), amplitude, 1e-9);
  // Of 6 J; steps that pass a bend do not end there.
  EXPECT_LT(run_.values.col(2).cwiseAbs().maxCoeff(), 3e-8);
  EXPECT_NEAR(run_.outcome.end_time, period, 1e-12);
}

TEST(JointCurves, Count_in_statics_with_the_slope_where_they_rest) {
  Linkage linkage = one_joint(JointType::prismatic);
  linkage.gravity = {0.0, 0.0, -kGravity};
  linkage.joints[0].spring_curve =
      JointCurve{0, {{-1.0, -0.1, -0.0999, 0.0}, {-40.0, -25.0, -15.0, 0.0}}};
  linkage.joints[0].position = {-0.09995};
  Model model = compile(linkage);
  const StaticsReport report = solve_statics(model, model.start);
  ASSERT_TRUE(report.converged) << report.reason;
  const double slope = 10.0 / 1e-4;
  EXPECT_NEAR(model.start.q[PositionIndex(0)], -0.0999 - (kMass * kGravity - 15.0) / slope, 1e-12);
  EXPECT_NEAR(report.smallest_stiffness, slope, 1e-6);
}

}  // namespace linkstudy::testing::end_stops_test

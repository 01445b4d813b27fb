// The stability limit of constant steps along a run, and runs that went past it.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/simulation/prepare.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::step_too_coarse_test {
namespace {

constexpr double kGravity = 9.81;
const double kRealAxis = stable_step({-1.0, 0.0});  // 2.785
constexpr Friction kStiffBristles = {
    .mu_s = 0.5, .mu_k = 0.4, .v_s = 0.01, .sigma0 = 1e5, .sigma1 = 300.0};

// A block of 2 kg on a plane inclined by `angle`: rail along z, plane normal along y.
Linkage on_incline(double angle) {
  Linkage linkage;
  linkage.links = {
      {"block", 2.0, Eigen::Vector3d::Zero(), Eigen::Vector3d(0.1, 0.1, 0.1).asDiagonal(), {}}};
  Joint joint;
  joint.name = "P";
  joint.type = JointType::prismatic;
  joint.parent = kGround;
  joint.child = "block";
  joint.friction = JointFriction{kStiffBristles};
  linkage.joints = {joint};
  linkage.gravity = {0.0, -kGravity * std::cos(angle), kGravity * std::sin(angle)};
  return linkage;
}

const double kSteep = 35.0 * std::numbers::pi / 180.0;
const double kFlat = 20.0 * std::numbers::pi / 180.0;  // below the angle of friction

// After 1 s from rest: 2.406 m/s, a little less than Coulomb's, since bristles bend first.
constexpr double kSpeed = 2.406;
const double kSlideLimit = kRealAxis * kStiffBristles.mu_k / (kStiffBristles.sigma0 * kSpeed);

Linkage crank_with_friction() {
  Linkage linkage = rsrrp();
  Joint& crank = linkage.joints[0];
  crank.velocity = {20.0};
  crank.hold = true;
  crank.friction =
      JointFriction{{.mu_s = 0.15, .mu_k = 0.1, .v_s = 0.01, .sigma0 = 1e5, .sigma1 = 100.0},
                    FrictionLoad::reaction,
                    0.01};
  return linkage;
}

}  // namespace

// A sliding bristle relaxes at sigma0 v / mu_k, which grows with the speed: 4.6e-6 s at the end.
TEST(StepTooCoarse, A_sliding_block_is_right_just_below_its_limit_and_refused_just_above) {
  const Model model = compile(on_incline(kSteep));
  const Samples below =
      run(model, steps_of(0.995 * kSlideLimit, 1.0, 0.1), {"joint.P.v", "joint.P.friction"});
  ASSERT_EQ(below.outcome.cause, Cause::ok) << below.outcome.message;
  EXPECT_EQ(below.outcome.warning, "");
  const Eigen::Index last = below.values.rows() - 1;
  EXPECT_NEAR(below.values(last, 0), kSpeed, 5e-4);
  const double friction = kStiffBristles.mu_k * 2.0 * kGravity * std::cos(kSteep);
  EXPECT_NEAR(below.values(last, 1), friction, 1e-6 * friction);
  EXPECT_NEAR(below.outcome.step_limit.seconds / kSlideLimit, 1.0, 1e-3);
  EXPECT_NEAR(below.outcome.step_limit.t, 1.0, 1e-3);
  for (const double factor : {1.1, 1.5, 2.0, 5.0, 21.6}) {
    const SimulationOutcome above = run(model, steps_of(factor * kSlideLimit, 1.0, 0.1));
    EXPECT_EQ(above.cause, Cause::step_too_coarse) << factor;
    EXPECT_NE(above.message.find("past the stability limit"), std::string::npos) << above.message;
    EXPECT_LT(above.end_time, 1.0);
  }
}

// Past the limit for the last 3 ms only, in which nothing has grown yet.
TEST(StepTooCoarse, A_run_that_passes_its_limit_for_a_moment_and_balances_is_only_warned_about) {
  const SimulationOutcome end =
      run(compile(on_incline(kSteep)), steps_of(1.003 * kSlideLimit, 1.0, 0.1));
  EXPECT_EQ(end.cause, Cause::ok) << end.message;
  EXPECT_NEAR(end.final_state.v[VelocityIndex(0)], kSpeed, 5e-4);
  EXPECT_NE(end.warning.find("past the stability limit"), std::string::npos) << end.warning;
}

// At rest the bristle is a spring and damper on the block: s^2 + (sigma1 s + sigma0) N / m = 0.
TEST(StepTooCoarse, A_block_at_rest_has_the_limit_of_its_bristles_and_no_alarm) {
  const Linkage linkage = on_incline(kFlat);
  const SimulationOptions options = steps_of(1e-4, 1.0, 0.1);
  const Preparation p = prepare(linkage, options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_EQ(p.step_warning, "");
  const Samples s = run(p.model, options, {"joint.P.friction"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  EXPECT_EQ(s.outcome.warning, "");
  const double weight = 2.0 * kGravity * std::sin(kFlat);
  EXPECT_NEAR(s.values(s.values.rows() - 1, 0), weight, 1e-9 * weight);
  const double load = kGravity * std::cos(kFlat);  // N / m
  const double b = kStiffBristles.sigma1 * load, c = kStiffBristles.sigma0 * load;
  const double fast = 0.5 * (b + std::sqrt(b * b - 4.0 * c));
  EXPECT_NEAR(s.outcome.step_limit.seconds * fast / kRealAxis, 1.0, 1e-3);
}

// r w sigma0 / g: 1.39e-5 s at the start, where it slides with 0.2 m/s.
TEST(StepTooCoarse, The_limit_knows_friction_in_a_joint_that_slides_at_the_start) {
  const double limit = kRealAxis * 0.1 / (1e5 * 0.2);
  const Linkage linkage = crank_with_friction();
  const SimulationOptions coarse = steps_of(1e-4, 0.05, 1e-2), fine = steps_of(4e-6, 0.05, 1e-2);
  const Preparation p = prepare(linkage, coarse);
  EXPECT_NEAR(p.spectrum.step_limit / limit, 1.0, 1e-2);
  EXPECT_NE(p.step_warning, "");
  EXPECT_EQ(run(p.model, coarse).cause, Cause::step_too_coarse);
  const Preparation q = prepare(linkage, fine);
  EXPECT_EQ(q.step_warning, "");
  const SimulationOutcome end = run(q.model, fine);
  EXPECT_EQ(end.cause, Cause::ok) << end.message;
  EXPECT_LE(end.step_limit.seconds, limit * 1.01);
}

// Elastic impact: omega^2 = 1.5 K sqrt(depth) / m at the deepest point; the state kept has at least
// 1 / 1.02 of its force, hence 0.993 of its omega.
TEST(StepTooCoarse, The_limit_of_a_run_with_impacts_is_that_of_the_deepest_contact) {
  JournalInBearing journal;
  journal.velocity.x() = 0.5;
  Clearance clearance = loose_bearing();
  clearance.restitution = 1.0;
  const SimulationOutcome end =
      run(compile(journal_in_bearing(journal, clearance)), steps_of(1e-6, 6e-3));
  ASSERT_EQ(end.cause, Cause::ok) << end.message;
  ASSERT_EQ(end.contacts, 1);
  const double depth = std::pow(1.25 * 0.25 / 1e10, 0.4);
  const double omega = std::sqrt(1.5 * 1e10 * std::sqrt(depth));
  EXPECT_NEAR(end.step_limit.omega_max / omega, 1.0, 1e-2);
  EXPECT_NEAR(end.step_limit.seconds * omega / stable_step({0.0, 1.0}), 1.0, 1e-2);
  EXPECT_NEAR(end.step_limit.t, 2.17e-3, 5e-5);
  EXPECT_EQ(end.warning, "");
}

// |R|^2 = 1 - y^6 / 72 + y^8 / 576 at y = h omega: 0.7 % of energy more in a step, far from the
// thousandfold that ends a run.
TEST(StepTooCoarse, A_spring_past_its_limit_whose_energy_grows_is_refused) {
  Linkage linkage = on_incline(0.0);
  linkage.gravity.setZero();
  Joint& joint = linkage.joints[0];
  joint.friction.reset();
  joint.stiffness = {2e6};
  joint.position = {0.01};
  const double limit = stable_step({0.0, 1.0}) / 1000.0;
  const double h = 1.0005 * limit;
  const SimulationOutcome end = run(compile(linkage), steps_of(h, 200 * h, 10 * h));
  EXPECT_EQ(end.cause, Cause::step_too_coarse) << end.energy_residual_max;
  EXPECT_NEAR(end.step_limit.seconds / limit, 1.0, 1e-6);
  EXPECT_NE(end.message.find("energy does not balance"), std::string::npos) << end.message;
}

TEST(StepTooCoarse, Lanes_have_the_limits_and_the_ends_they_have_alone) {
  std::vector<Model> models;
  for (const double angle : {kFlat, kSteep, 0.5 * kSteep, 1.5 * kSteep}) {
    models.push_back(compile(on_incline(angle)));
  }
  const SimulationOptions options = steps_of(6e-6, 1.0, 0.1);
  std::vector<Observers> none(models.size());
  std::vector<BatchCase> cases;
  for (std::size_t i = 0; i < models.size(); ++i) {
    cases.push_back({&models[i].parameters, &models[i].start, &none[i], {}});
  }
  simulate_batch(models[0].mechanism, options, cases);
  int refused = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const SimulationOutcome alone = run(models[i], options);
    const SimulationOutcome& packed = cases[i].outcome;
    EXPECT_EQ(packed.cause, alone.cause);
    EXPECT_EQ(packed.message, alone.message);
    EXPECT_EQ(packed.steps, alone.steps);
    EXPECT_EQ(packed.step_limit.seconds, alone.step_limit.seconds);
    EXPECT_EQ(packed.step_limit.omega_max, alone.step_limit.omega_max);
    EXPECT_EQ(packed.step_limit.t, alone.step_limit.t);
    EXPECT_EQ(packed.final_state.v, alone.final_state.v);
    refused += alone.cause == Cause::step_too_coarse ? 1 : 0;
  }
  EXPECT_EQ(refused, 2);
}

}  // namespace linkstudy::testing::step_too_coarse_test

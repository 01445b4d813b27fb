// What must hold along a run, whatever the mechanism: energy ledger, drift of cut joints and its
// stabilisation, order of accuracy, redundant rows.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "core/kinematics/assembly.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/trace_formulas.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::integration_test {
namespace {

Linkage softened(Linkage linkage) {  // stable and accurate at h = 1e-3
  for (Closure& c : linkage.closures) {
    c.model = ClosureModel::sde;
    for (double& x : c.sde.stiffness) x *= 1e-2;
    for (double& x : c.sde.damping) x *= 1e-2;
  }
  return linkage;
}

Vector state_after(const Model& model, double h, double end_time) {
  const SimulationOutcome end = run(model, steps_of(h, end_time));
  EXPECT_EQ(end.cause, Cause::ok) << end.message;
  Vector x(model.mechanism.nq + model.mechanism.nv);
  x << Eigen::Map<const Vector>(end.final_state.q.data(), model.mechanism.nq),
      Eigen::Map<const Vector>(end.final_state.v.data(), model.mechanism.nv);
  return x;
}

// log2 of the ratio of successive differences.
double observed_order(const Model& model, double h, double end_time) {
  const Vector a = state_after(model, h, end_time);
  const Vector b = state_after(model, h / 2, end_time);
  const Vector c = state_after(model, h / 4, end_time);
  return std::log2((a - b).norm() / (b - c).norm());
}

double drift_of(Stabilization stabilization, double h, double end_time) {
  Linkage linkage = spatial_slider_crank();
  linkage.closures[0].stabilization = stabilization;
  const SimulationOutcome end = run(compile(linkage), steps_of(h, end_time));
  EXPECT_EQ(end.cause, Cause::ok) << end.message;
  return end.drift_max;
}

// The planar four-bar with two of its joints freed out of the plane: five independent rows.
Linkage four_bar_without_redundancy() {
  Linkage linkage = four_bar();
  for (Joint& joint : linkage.joints) {
    if (joint.name == "B") joint.type = JointType::spherical;
    if (joint.name == "D") joint.type = JointType::cylindrical;
    const auto n = static_cast<std::size_t>(velocity_count(joint.type));
    joint.position.resize(n, 0.0);
    joint.velocity.resize(n, 0.0);
  }
  return linkage;
}

}  // namespace

TEST(EnergyLedger, It_balances_over_long_runs_of_every_mechanism) {
  const std::vector<Linkage> all = {rsrrp(),
                                    softened(rsrrp()),
                                    softened(rsrrp_revolute()),
                                    four_bar(),
                                    pendulum(),
                                    spatial_slider_crank(),
                                    softened(spatial_slider_crank_cut_at_universal())};
  for (const Linkage& linkage : all) {
    const SimulationOutcome end = run(compile(linkage), steps_of(2e-4, 10.0, 1e-2));
    ASSERT_EQ(end.cause, Cause::ok) << linkage.name << end.message;
    EXPECT_LT(end.energy_residual_max, 1e-6 * end.energy_scale) << linkage.name;
    EXPECT_GT(end.energy_scale, 0.1) << linkage.name;
  }
}

TEST(EnergyLedger, Its_residual_falls_with_the_fourth_power_of_the_step_or_faster) {
  // Steps at which the next power of h is small and rounding (1e-13 J) is far away.
  const std::vector<std::pair<Linkage, double>> all = {{rsrrp(), 4e-3},
                                                       {softened(rsrrp()), 2.5e-4},
                                                       {four_bar(), 2e-3},
                                                       {spatial_slider_crank(), 2e-3},
                                                       {pendulum(), 1e-2}};
  for (const auto& [linkage, h] : all) {
    const Model model = compile(linkage);
    const double coarse = run(model, steps_of(h, 2.0, 4e-2)).energy_residual_max;
    const double fine = run(model, steps_of(h / 2, 2.0, 4e-2)).energy_residual_max;
    EXPECT_GT(std::log2(coarse / fine), 3.8) << linkage.name << " " << coarse << " " << fine;
    EXPECT_LT(std::log2(coarse / fine), 6.0) << linkage.name << " " << coarse << " " << fine;
  }
}

TEST(EnergyLedger, Random_loaded_linkages_balance_too) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    for (const Linkage& linkage :
         {random_tree(seed), random_closed_linkage(seed, JointType::spherical, ClosureModel::sde),
          random_closed_linkage(seed, JointType::universal, ClosureModel::cut)}) {
      const SimulationOutcome end = run(compile(linkage), steps_of(2e-4, 0.2, 1e-2));
      ASSERT_EQ(end.cause, Cause::ok) << linkage.name << end.message;
      EXPECT_LT(end.energy_residual_max, 1e-7 * (1 + end.energy_scale)) << linkage.name;
    }
  }
}

TEST(Drift, Baumgarte_reduces_it_and_projection_removes_it) {
  const double none = drift_of(Stabilization::none, 1e-3, 15.0);
  const double baumgarte = drift_of(Stabilization::baumgarte, 1e-3, 15.0);
  const double projection = drift_of(Stabilization::projection, 1e-3, 15.0);
  EXPECT_GT(none, 1e-6);
  EXPECT_LT(baumgarte, none / 100);
  EXPECT_LT(projection, 1e-12);
}

TEST(Drift, Projection_leaves_velocities_that_the_closures_allow) {
  Linkage linkage = rsrrp();
  linkage.closures[0].stabilization = Stabilization::projection;
  const SimulationOutcome end = run(compile(linkage), steps_of(1e-3, 3.0));
  const Model cut = compile_closed(linkage);
  const ClosureEquations e =
      compute_closure_equations(cut.mechanism, cut.parameters, end.final_state);
  const Vector v = Eigen::Map<const Vector>(end.final_state.v.data(), cut.mechanism.nv);
  EXPECT_LT(e.residual.norm(), 1e-12);
  EXPECT_LT((e.jacobian * v).norm(), 1e-11);
}

TEST(Drift, Projection_changes_the_motion_by_no_more_than_the_drift_it_removes) {
  Linkage projected = rsrrp();
  projected.closures[0].stabilization = Stabilization::projection;
  const Vector a = state_after(compile(rsrrp()), 1e-4, 2.0);
  const Vector b = state_after(compile(projected), 1e-4, 2.0);
  EXPECT_LT((a - b).norm(), 1e-7);
}

TEST(Order, Runge_Kutta_is_of_order_four_in_the_cut_joint_model) {
  EXPECT_NEAR(observed_order(compile(rsrrp()), 2e-3, 1.0), 4.0, 0.1);
  EXPECT_NEAR(observed_order(compile(four_bar()), 1e-3, 0.5), 4.0, 0.1);
  EXPECT_NEAR(observed_order(compile(spatial_slider_crank()), 2e-3, 0.5), 4.0, 0.1);
}

TEST(Order, Runge_Kutta_is_of_order_four_with_projection) {
  Linkage linkage = rsrrp();
  linkage.closures[0].stabilization = Stabilization::projection;
  EXPECT_NEAR(observed_order(compile(linkage), 2e-3, 1.0), 4.0, 0.15);
}

TEST(Order, Runge_Kutta_is_of_order_four_in_the_replaced_linkage) {
  EXPECT_NEAR(observed_order(compile(softened(rsrrp())), 5e-4, 1.0), 4.0, 0.1);
}

TEST(Order, Runge_Kutta_is_of_order_four_in_quaternions) {
  RandomTree options;
  options.links = 3;
  options.types = {JointType::spherical, JointType::free};
  options.loads = false;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    const Model model = compile(with_quaternions(random_tree(seed, options)));
    EXPECT_NEAR(observed_order(model, 2e-3, 0.4), 4.0, 0.1) << "seed " << seed;
  }
}

TEST(Order, Quaternions_and_angles_end_in_the_same_place) {
  RandomTree options;
  options.types = {JointType::spherical, JointType::revolute};
  options.links = 4;
  options.loads = false;
  const Linkage angles = random_tree(11, options);
  const Samples a = run(compile(angles), steps_of(2e-4, 0.3, 0.05), {"energy.kinetic"});
  const Samples b =
      run(compile(with_quaternions(angles)), steps_of(2e-4, 0.3, 0.05), {"energy.kinetic"});
  EXPECT_TRUE(near_relative(b.values, a.values, 1e-8));
}

TEST(RedundantRows, The_multipliers_are_those_of_the_pseudo_inverse) {
  const Linkage linkage = four_bar();
  EngineProbe engine(linkage);
  Linkage open = linkage;
  open.closures.clear();
  const Model cut = compile_closed(linkage);
  const Matrix J =
      compute_closure_equations(cut.mechanism, cut.parameters, engine.state()).jacobian;
  const TraceModel trace = make_trace_model(linkage);
  const Vector bias = cut_constraints(trace, trace.q0, trace.v0).velocity_terms;
  const Matrix A = J * engine.mass_matrix().inverse() * J.transpose();
  Eigen::CompleteOrthogonalDecomposition<Matrix> pseudo(A.rows(), A.cols());
  pseudo.setThreshold(1e-9);
  pseudo.compute(A);
  EXPECT_EQ(pseudo.rank(), 2);
  const Vector lambda = pseudo.solve(J * EngineProbe(open).qdd() + bias);
  const Eigen::Vector3d force = engine.vector("closure.C.force");
  EXPECT_TRUE(near_absolute(force, Eigen::Vector3d(lambda.head(3)), 1e-10 * lambda.norm()));
  EXPECT_TRUE(near_absolute(engine.vector("closure.C.torque"), Eigen::Vector3d::Zero(),
                            1e-10 * lambda.norm()));
  EXPECT_GT(force.norm(), 1.0);
}

TEST(RedundantRows, The_motion_is_that_of_the_linkage_without_redundancy) {
  const std::vector<std::string> signals = {"joint.A.q", "joint.A.v", "closure.C.force"};
  const Samples redundant = run(compile(four_bar()), steps_of(1e-4, 1.0, 0.05), signals);
  const Samples regular =
      run(compile(four_bar_without_redundancy()), steps_of(1e-4, 1.0, 0.05), signals);
  EXPECT_TRUE(redundant.outcome.redundant);
  EXPECT_FALSE(regular.outcome.redundant);
  EXPECT_TRUE(near_relative(redundant.values, regular.values, 1e-8));
}

TEST(RedundantRows, A_repeated_closure_shares_the_force_and_leaves_the_motion_alone) {
  Linkage doubled = rsrrp();
  doubled.closures.push_back(doubled.closures[0]);
  doubled.closures[1].name = "S2";
  EngineProbe one(rsrrp(), 2.0), two(doubled, 2.0);  // driven
  EXPECT_TRUE(near_relative(two.qdd(), one.qdd(), 1e-9));
  for (const char* name : {"closure.S.force", "closure.S2.force"}) {
    EXPECT_TRUE(near_relative(two.vector(name), 0.5 * one.vector("closure.S.force"), 1e-9)) << name;
  }
}

}  // namespace linkstudy::testing::integration_test

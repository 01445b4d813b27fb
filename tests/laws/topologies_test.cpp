// The four topologies of [AugUrb18] fig. 1, each with friction, clearance or flexible links: the
// energy ledger, Newton and Euler link by link, and what symmetry or freedom demand.
#include <gtest/gtest.h>

#include <cmath>

#include "core/topology/check_linkage.h"
#include "tests/mechanisms/rsup.h"
#include "tests/mechanisms/topologies.h"
#include "tests/support/near.h"
#include "tests/support/newton_euler_check.h"

namespace linkstudy::testing::topologies_test {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kInterval = 1e-3;  // s

struct CheckedRun {
  NewtonEulerCheck check;
  Samples samples;
  NewtonEulerCheck::Residual worst{};

  Vector row(Index i) const { return samples.values.row(i); }
};

CheckedRun run_checked(const Linkage& linkage, double end_time,
                       std::vector<std::string> more = {}) {
  EXPECT_TRUE(check(linkage).empty());
  SimulationOptions options = steps_of(kInterval, end_time, kInterval);
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = 1e-8;
  options.absolute_tolerance = 1e-10;
  CheckedRun r{NewtonEulerCheck(linkage), {}};
  std::vector<std::string> signals = r.check.signals();
  signals.insert(signals.end(), more.begin(), more.end());
  r.samples = run(compile(linkage), options, signals);
  EXPECT_EQ(r.samples.outcome.cause, Cause::ok) << r.samples.outcome.message;
  for (Index i = 0; i < r.samples.values.rows(); ++i) {
    const auto at = r.check.at(kInterval * static_cast<double>(i), r.row(i));
    r.worst.generalised = std::max(r.worst.generalised, at.generalised);
    r.worst.load = std::max(r.worst.load, at.load);
    r.worst.reaction = std::max(r.worst.reaction, at.reaction);
  }
  return r;
}

void expect_balance(const CheckedRun& r, double ledger) {
  EXPECT_LT(r.worst.generalised, 1e-9 * r.worst.reaction);
  EXPECT_LT(r.worst.load, 1e-8 * r.worst.reaction);
  EXPECT_GT(r.worst.reaction, 10.0);
  EXPECT_LT(r.samples.outcome.energy_residual_max, ledger * r.samples.outcome.energy_scale);
  EXPECT_GT(r.samples.outcome.final_state.dissipated, 1e-2 * r.samples.outcome.energy_scale);
}

}  // namespace

TEST(Topologies, Open_serial_chain_with_friction_and_a_flexible_link) {
  const CheckedRun r = run_checked(jib(), 1.0);
  expect_balance(r, 1e-7);
}

TEST(Topologies, Closed_serial_chain_with_clearance_friction_and_a_flexible_link) {
  const CheckedRun r = run_checked(
      rsup({.clearance = ClearanceKind::planar, .segments = 2, .at_speed = kFast}), 1.3);
  EXPECT_GT(r.samples.outcome.contacts, 10);
  expect_balance(r, 1e-7);
}

TEST(Topologies, Open_tree_with_friction_and_a_flexible_link_keeps_its_momentum) {
  const Linkage linkage = satellite();
  const CheckedRun r = run_checked(linkage, 1.0);
  expect_balance(r, 1e-7);
  const Momentum start = momentum(linkage, r.check.motions(r.row(0)));
  for (Index i = 1; i < r.samples.values.rows(); ++i) {
    const Momentum now = momentum(linkage, r.check.motions(r.row(i)));
    ASSERT_LT((now.linear - start.linear).norm(), 1e-6 * start.linear.norm()) << i;
    ASSERT_LT((now.angular - start.angular).norm(), 1e-6 * start.angular.norm()) << i;
  }
}

// For as long as what they differ by in rounding has not grown: every impact multiplies it.
TEST(Topologies, Closed_tree_of_twin_loops_moves_alike_and_loads_its_crank_with_a_pure_torque) {
  const CheckedRun r =
      run_checked(twin_rsup(), 1.0,
                  {"joint.P.q", "joint.P2.q", "closure.R.normal_force.0",
                   "closure.R2.normal_force.0", "joint.A.force", "joint.A.torque"});
  EXPECT_GT(r.samples.outcome.contacts, 20);
  expect_balance(r, 1e-7);
  const Matrix first = r.samples.values.rightCols(10).topRows(221);  // three impacts in each loop
  const double impact = first.col(2).maxCoeff();
  EXPECT_GT(impact, 50.0);
  EXPECT_LT((first.col(0) - first.col(1)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((first.col(2) - first.col(3)).cwiseAbs().maxCoeff(), 1e-5 * impact);
  EXPECT_LT(first.middleCols(4, 2).cwiseAbs().maxCoeff(), 1e-5 * impact);
  EXPECT_LT(first.middleCols(7, 2).cwiseAbs().maxCoeff(), 1e-5 * impact);
  EXPECT_GT(first.col(9).cwiseAbs().maxCoeff(), 0.1) << "its drive";
}

}  // namespace linkstudy::testing::topologies_test

// What ends a run: bounds of the ledger and of velocities, against the numbers they are declared
// by.
#include "core/simulation/run_checks.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/simulation/run_state.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::run_checks_test {
namespace {

// A pendulum of 2 kg and 1 m, let go horizontally: kinetic energy v^2, height -19.62 J hanging.
class PendulumChecks : public ::testing::Test {
 protected:
  PendulumChecks() {
    evaluate_with({0.0, 0.0, 0.0, 0.0});
    checks_.start_ledger(now_);
  }

  void evaluate_with(std::vector<double> y) {
    y_ = std::move(y);
    evaluate_state(model_.mechanism, model_.parameters, 0.0, y_.data(), w_);
    now_.move_to(0.0, y_.data());
  }

  bool balances(double q, double v, double supplied = 0.0, double dissipated = 0.0) {
    evaluate_with({q, v, supplied, dissipated});
    return checks_.balances(now_);
  }

  bool moves(double v) {
    evaluate_with({0.0, v, 0.0, 0.0});
    return checks_.moves(model_.mechanism, y_.data(), w_);
  }

  LaneEnd told() const {
    LaneEnd end;
    checks_.store(0, model_.mechanism.cut_row_count(), end);
    return end;
  }

  const Model model_ = compile(pendulum(2.0, 1.0));
  Workspace<double> w_ = make_workspace<double>(model_.mechanism);
  std::vector<double> y_;
  Instant<double> now_{model_.mechanism, model_.parameters, w_};
  RunChecks<double> checks_{model_.mechanism, model_.parameters};
};

constexpr double kHanging = -1.5707963267948966;

TEST_F(PendulumChecks, A_ledger_at_rest_may_be_off_by_a_thousandth_of_a_joule_a_kilogram) {
  EXPECT_TRUE(balances(0.0, 0.0447));  // 1.998 mJ
  EXPECT_FALSE(balances(0.0, 0.0448));
}

TEST_F(PendulumChecks, A_ledger_may_be_off_by_a_thousand_times_what_has_entered) {
  EXPECT_TRUE(balances(kHanging, 140.1));  // 19628 J less the swing of 19.62 J
  EXPECT_FALSE(balances(kHanging, 140.2));
  EXPECT_TRUE(balances(0.0, 100.0, 10.0));  // 10 J supplied
  EXPECT_FALSE(balances(0.0, 101.0, 10.0));
}

TEST_F(PendulumChecks, The_largest_residual_and_the_largest_energy_are_told) {
  balances(0.0, 3.0, 9.0);       // on the ledger
  balances(0.0, 2.0, 9.0, 4.0);  // 1 J is missing; 13 J have passed
  EXPECT_DOUBLE_EQ(told().energy_residual_max, 1.0);
  EXPECT_DOUBLE_EQ(told().energy_scale, 13.0);
}

TEST_F(PendulumChecks, A_velocity_past_all_measure_or_lost_is_no_motion) {
  EXPECT_TRUE(moves(-0.999e9));
  EXPECT_FALSE(moves(-1e9));
  EXPECT_FALSE(moves(std::nan("")));
}

TEST_F(PendulumChecks, A_rank_counts_only_where_the_state_does) {
  checks_.see_rank(true, 3.0);
  checks_.see_rank(true, 5.0);
  checks_.see_rank(false, 1.0);
  checks_.see_rank(false, 7.0);
  EXPECT_EQ(told().least_rank, 3);
  EXPECT_EQ(told().greatest_rank, 5);
}

}  // namespace
}  // namespace linkstudy::testing::run_checks_test

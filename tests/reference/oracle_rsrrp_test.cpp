// The oracle against numbers from outside: the closed form of the slider and the two test vectors
// of performance.md (confirmed there by an independent multibody program).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mechanisms/rsrrp.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing::oracle_rsrrp_test {
namespace {

Vector after_one_second(ClosureModel model) {
  const TraceModel trace = make_trace_model(rsrrp_test_vector(model));
  return rk4(trace, 1e-4, 10000, start_state(trace)).q;
}

// Twelve printed digits, so half a unit of the last one.
void expect_digits(const Vector& q, const Vector& expected) {
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(q[k], expected[k], 6e-13 * std::pow(10, k == 0)) << k;
}

}  // namespace

TEST(OracleRsrrp, The_spring_reaches_its_test_vector_after_one_second) {
  Vector expected(4);
  expected << 1.21258149373, 0.325199964329, 0.249158236958, -0.862682573037;
  expect_digits(after_one_second(ClosureModel::sde), expected);
}

TEST(OracleRsrrp, The_cut_joint_reaches_its_test_vector_after_one_second) {
  Vector expected(4);
  expected << 1.21258334078, 0.325194724846, 0.249153192456, -0.862699299507;
  expect_digits(after_one_second(ClosureModel::cut), expected);
}

TEST(OracleRsrrp, The_closed_form_closes_the_loop_over_a_full_turn) {
  const TraceModel model = make_trace_model(rsrrp());
  for (int k = 0; k < 360; ++k) {
    const RsrrpPose pose = rsrrp_pose(k * M_PI / 180);
    Vector q(4);
    q << pose.psi, pose.d, pose.psi22, pose.psi23;
    EXPECT_LT(cut_constraints(model, q, Vector::Zero(4)).value.norm(), 1e-15) << k;
    EXPECT_NEAR(pose.d * pose.d, 0.0625 + 2 * 0.1 * 0.33301270189 * (1 - std::cos(pose.psi)),
                1e-11);
  }
}

TEST(OracleRsrrp, Both_cuts_of_the_linkage_start_closed_and_move_alike) {
  const TraceModel at_S = make_trace_model(rsrrp());
  const TraceModel at_R = make_trace_model(rsrrp_revolute());
  EXPECT_LT(cut_constraints(at_R, at_R.q0, at_R.v0).value.norm(), 1e-15);
  const OracleState S = rk4(at_S, 1e-3, 500, start_state(at_S));
  const OracleState R = rk4(at_R, 1e-3, 500, start_state(at_R));
  EXPECT_NEAR(S.q[0], R.q[0], 1e-9);  // RK4 errors differ: other coordinates, same motion
  EXPECT_NEAR(S.q[1], R.q[4], 1e-9);
  EXPECT_NEAR(S.q[2], R.q[5], 1e-9);
}

}  // namespace linkstudy::testing::oracle_rsrrp_test

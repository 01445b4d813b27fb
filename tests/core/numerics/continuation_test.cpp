// Curves with closed forms, followed around their folds.
#include "core/numerics/continuation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace linkstudy::testing::continuation_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// One step of `length` along the tangent and back onto the curve.
template <class Residual, class Jacobian>
VectorXd step(const Residual& f, const Jacobian& j, const VectorXd& x, VectorXd& sense,
              double length) {
  sense = unit_tangent(j(x), sense);
  VectorXd next = x + length * sense;
  for (int i = 0; i < 8; ++i) {
    next += least_correction(j(next), f(next), static_cast<int>(x.size()) - 1);
  }
  return next;
}

}  // namespace

TEST(Continuation, A_circle_is_closed_and_its_folds_are_passed) {
  const auto f = [](const VectorXd& x) { return VectorXd::Constant(1, x.squaredNorm() - 4.0); };
  const auto j = [](const VectorXd& x) { return MatrixXd(2.0 * x.transpose()); };
  VectorXd x(2), sense(2);
  x << 2.0, 0.0;
  sense << 0.0, 1.0;
  double turned = 0.0;
  const double chord = 0.05;
  // By the tangent and straight back to the centre: tan(angle) = length / radius.
  const double angle = std::atan(chord / 2.0);
  for (int i = 0; i < 300; ++i) {
    const VectorXd next = step(f, j, x, sense, chord);
    EXPECT_NEAR(next.norm(), 2.0, 1e-14);
    turned += std::atan2(x[0] * next[1] - x[1] * next[0], x.dot(next));
    x = next;
  }
  EXPECT_NEAR(turned, 300 * angle, 1e-9);
  EXPECT_GT(turned, 2.0 * std::numbers::pi);
}

TEST(Continuation, A_helix_of_two_equations_keeps_its_pitch_beside_a_repeated_equation) {
  // x = cos s, y = sin s, z = s / 2: two equations, and the first one again.
  const auto f = [](const VectorXd& x) {
    VectorXd r(3);
    r << x[0] - std::cos(2.0 * x[2]), x[1] - std::sin(2.0 * x[2]), x[0] - std::cos(2.0 * x[2]);
    return r;
  };
  const auto j = [](const VectorXd& x) {
    MatrixXd m(3, 3);
    m << 1.0, 0.0, 2.0 * std::sin(2.0 * x[2]), 0.0, 1.0, -2.0 * std::cos(2.0 * x[2]), 1.0, 0.0,
        2.0 * std::sin(2.0 * x[2]);
    return m;
  };
  VectorXd x(3), sense(3);
  x << 1.0, 0.0, 0.0;
  sense << 0.0, 0.0, 1.0;
  for (int i = 0; i < 200; ++i) x = step(f, j, x, sense, 0.02);
  EXPECT_GT(x[2], 1.0);
  EXPECT_NEAR(x[0], std::cos(2.0 * x[2]), 1e-13);
  EXPECT_NEAR(x[1], std::sin(2.0 * x[2]), 1e-13);
  // The tangent is (-sin, cos, 1/2) over its length.
  const VectorXd t = unit_tangent(j(x), sense);
  EXPECT_NEAR(t[2], 0.5 / std::sqrt(1.25), 1e-13);
}

}  // namespace linkstudy::testing::continuation_test

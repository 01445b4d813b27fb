// Differences against derivatives worked out by hand.
#include "core/numerics/difference_jacobian.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkstudy::testing::difference_jacobian_test {

TEST(DifferenceJacobian, Columns_of_any_size_are_those_of_the_derivatives) {
  int calls = 0;
  const Slopes f = [&calls](double t, const double* y, double* dy) {
    ++calls;
    dy[0] = std::sin(y[0]) * y[1] + t * t;
    dy[1] = 1e3 * y[1] * y[1] + std::exp(y[0]);
    dy[2] = y[0] + y[1] * t;
  };
  DifferenceJacobian j({1e-2, 1e-6, 1.0}, 1);
  const double y[] = {0.7, 3e-5, 8.0};
  j.update(f, 2.0, y);
  EXPECT_EQ(calls, 4);
  EXPECT_NEAR(j.by_unknown(0, 0), std::cos(0.7) * 3e-5, 1e-7);
  EXPECT_NEAR(j.by_unknown(0, 1), std::sin(0.7), 3e-3);  // rounding of t^2 over 4.5e-13
  EXPECT_NEAR(j.by_unknown(1, 0), std::exp(0.7), 1e-6);
  EXPECT_NEAR(j.by_unknown(1, 1), 0.06, 1e-3);
  EXPECT_NEAR(j.by_unknown(2, 0), 1.0, 1e-7);
  EXPECT_NEAR(j.by_unknown(2, 1), 2.0, 1e-3);
  for (const int i : {0, 1, 2}) EXPECT_EQ(j.by_unknown(i, 2), 0.0);
}

TEST(DifferenceJacobian, A_stiffness_that_grows_with_the_root_of_the_depth_is_met) {
  // Contact force K depth^1.5 at a depth of 50 increments, among positions of size 1.
  const double depth = 5e-7;
  const Slopes f = [depth](double, const double* y, double* dy) {
    dy[0] = 1e10 * std::pow(y[0] - (1.0 - depth), 1.5);
  };
  DifferenceJacobian j({1.0}, 0);
  const double y = 1.0;
  j.update(f, 0.0, &y);
  EXPECT_NEAR(j.by_unknown(0, 0) / (1.5e10 * std::sqrt(depth)), 1.0, 1e-4);
}

}  // namespace linkstudy::testing::difference_jacobian_test

// The classical Runge-Kutta method against closed solutions.
#include "core/numerics/runge_kutta.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkstudy::testing::runge_kutta_test {
namespace {

// y' = y cos t, y(0) = 1: y = exp(sin t). Error at t = 2.
double error_after(int steps) {
  RungeKutta<ClassicalRungeKutta, double> rk(1);
  const auto f = [](double t, const double* y, double* dy) { dy[0] = y[0] * std::cos(t); };
  const double h = 2.0 / steps;
  double y = 1.0;
  for (int k = 0; k < steps; ++k) {
    f(k * h, &y, rk.first_slope());
    rk.advance(k * h, h, &y, f);
  }
  return std::fabs(y - std::exp(std::sin(2.0)));
}

}  // namespace

TEST(RungeKutta, Halving_the_step_divides_the_error_by_sixteen) {
  for (const int steps : {80, 160, 320}) {
    // The next power of h is still felt at these steps.
    EXPECT_NEAR(std::log2(error_after(steps) / error_after(2 * steps)), 4.0, 0.1) << steps;
  }
}

TEST(RungeKutta, One_step_of_a_linear_equation_is_the_polynomial_of_the_method) {
  RungeKutta<ClassicalRungeKutta, double> rk(1);
  const double z = -1.3;
  const auto f = [&](double, const double* y, double* dy) { dy[0] = z * y[0]; };
  double y = 1.0;
  f(0.0, &y, rk.first_slope());
  rk.advance(0.0, 1.0, &y, f);
  EXPECT_NEAR(y, 1 + z + z * z / 2 + z * z * z / 6 + z * z * z * z / 24, 1e-15);
}

TEST(RungeKutta, A_cubic_course_is_integrated_exactly) {
  RungeKutta<ClassicalRungeKutta, double> rk(1);
  const auto f = [](double t, const double*, double* dy) { dy[0] = 4 * t * t * t - 1; };
  double y = 0.0;
  f(0.5, &y, rk.first_slope());
  rk.advance(0.5, 2.0, &y, f);
  EXPECT_NEAR(y, std::pow(2.5, 4) - std::pow(0.5, 4) - 2.0, 1e-13);
}

}  // namespace linkstudy::testing::runge_kutta_test

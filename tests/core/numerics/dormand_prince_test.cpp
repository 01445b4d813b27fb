// One step of the method of Dormand and Prince beside that of Boost.odeint: its end, its error, the
// solution inside it, and the step that follows.
#include "core/numerics/dormand_prince.h"

#include <gtest/gtest.h>

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>

#include "core/numerics/adaptive_integrator.h"

namespace linkstudy::testing::dormand_prince_test {
namespace {

namespace odeint = boost::numeric::odeint;
using Values = std::vector<double>;

// Two bodies that attract each other, in the plane.
void orbit(double, const double* y, double* dy) {
  const double cube = std::pow(y[0] * y[0] + y[1] * y[1], 1.5);
  dy[0] = y[2];
  dy[1] = y[3];
  dy[2] = -y[0] / cube;
  dy[3] = -y[1] / cube;
}

const Values kStart = {0.8, 0.1, -0.2, 1.1};
constexpr double kLength = 0.05;

auto system_of_orbit() {
  return [](const Values& y, Values& dy, double t) { orbit(t, y.data(), dy.data()); };
}

struct PeerStep {
  odeint::runge_kutta_dopri5<Values> stepper;
  Values slope = Values(4), end = Values(4), end_slope = Values(4), error = Values(4);

  PeerStep() {
    orbit(0.0, kStart.data(), slope.data());
    stepper.do_step(system_of_orbit(), kStart, slope, 0.0, end, end_slope, kLength, error);
  }
};

DormandPrinceStep<double> own_step() {
  DormandPrinceStep<double> step(4);
  std::copy_n(kStart.data(), 4, step.begin());
  orbit(0.0, kStart.data(), step.first_slope());
  step.advance(0.0, kLength, [](double t, const double* y, double* dy) { return orbit(t, y, dy); });
  return step;
}

}  // namespace

TEST(DormandPrince, A_step_ends_where_that_of_odeint_ends) {
  PeerStep peer;
  DormandPrinceStep<double> step = own_step();
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(step.end()[i], peer.end[i], 4e-16) << i;
    EXPECT_NEAR(step.last_slope()[i], peer.end_slope[i], 1e-15) << i;
  }
}

TEST(DormandPrince, Its_error_is_that_of_odeint) {
  PeerStep peer;
  DormandPrinceStep<double> step = own_step();
  double largest = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    largest = std::max(largest, std::fabs(peer.error[i]) / (1e-6 + 1e-5 * std::fabs(kStart[i])));
  }
  const double error =
      step.error(4, kLength, [](std::size_t, double size) { return 1e-6 + 1e-5 * size; });
  EXPECT_NEAR(error, largest, 1e-9 * largest);
  EXPECT_GT(error, 0.0);
}

TEST(DormandPrince, An_error_that_is_no_number_is_without_bound) {
  DormandPrinceStep<double> step = own_step();
  step.last_slope()[2] = std::nan("");
  const auto allowed = [](std::size_t, double) { return 1.0; };
  EXPECT_TRUE(std::isinf(step.error(4, kLength, allowed)));
  EXPECT_TRUE(std::isfinite(step.error(2, kLength, allowed)));
}

// That of odeint has one power of the part more (Shampine's), which is nothing in the middle.
TEST(DormandPrince, The_solution_inside_a_step_is_that_of_odeint) {
  PeerStep peer;
  const DormandPrinceStep<double> step = own_step();
  Values own(4), other(4);
  for (int k = 0; k <= 16; ++k) {
    const double part = k / 16.0;
    step.write_inside(part, own.data());
    peer.stepper.calc_state(part * kLength, other, kStart, peer.slope, 0.0, peer.end,
                            peer.end_slope, kLength);
    const double allowed = k % 8 == 0 ? 1e-15 : 1e-10;
    for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(own[i], other[i], allowed) << part << ' ' << i;
  }
}

// Where nothing ends them early.
TEST(DormandPrince, Steps_are_as_long_as_those_of_odeint) {
  using Stepper = odeint::runge_kutta_dopri5<Values>;
  using Checker =
      odeint::default_error_checker<double, Stepper::algebra_type, Stepper::operations_type>;
  odeint::controlled_runge_kutta<Stepper, Checker> peer(Checker(1e-9, 0.0));
  AdaptiveProblem problem;
  problem.slopes = orbit;
  problem.relative = 0.0;
  problem.absolute.assign(4, 1e-9);
  const auto run = make_adaptive_integrator(AdaptiveMethod::dormand_prince, problem);
  run->start(0.0, kStart.data(), 0.5);
  Values y = kStart;
  double t = 0.0, h = 0.5;
  for (int k = 0; k < 200; ++k) {
    ASSERT_EQ(run->step(1e9), StepResult::accepted);
    while (peer.try_step(system_of_orbit(), y, t, h) != odeint::success) {
    }
    ASSERT_NEAR(run->t(), t, 1e-6 * t) << k;
    ASSERT_NEAR(run->next_step(), h, 1e-6 * h) << k;
  }
  EXPECT_GT(run->rejected(), 0);
}

}  // namespace linkstudy::testing::dormand_prince_test

#include "study/calibrate/profile.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planted_model.h"

namespace linkstudy::calibration::profile_test {
namespace {

// S = 5 + (x1 - 3)^2 + (x1 - x2 - 1)^2 + 0 x3^2, at S = 9: x1 in [1, 5], x2 in 2 -+ 2 sqrt 2, x3
// unbounded. The crossing is taken at 0.5 % of its distance.
TEST(Profile, has_the_ends_of_the_closed_form) {
  const auto residuals = [](const std::vector<double>& x) {
    return std::vector<double>{std::sqrt(5.0), x[0] - 3.0, x[0] - x[1] - 1.0};
  };
  const FitProblem problem = one_series({{"x1", "", false, -20.0, 20.0},
                                         {"x2", "", false, -20.0, 20.0},
                                         {"x3", "", false, -5.0, 5.0}},
                                        3);
  FitLog log(problem, FitOptions(), evaluate_with(residuals, {0.0, 0.0, 0.0}));
  const Vector best = to_cube(problem, {3.0, 2.0, 1.0});
  const DifferencePlan plan{best, difference_steps(problem, best, 1e-3),
                            std::vector<bool>(3, false)};
  const Matrix jacobian = make_jacobian(plan, log.ask({best}).front()->residuals,
                                        log.ask(list_difference_points(plan)));
  const Curvature curvature = compute_curvature(problem, best, jacobian);
  EXPECT_EQ(std::vector<std::string>{"x3"}, std::vector<std::string>{curvature.flat.front().name});
  const Profiles profiles = trace_profiles(log, {best, 5.0, 4.0}, curvature);
  const auto value = [&](std::size_t i, const ProfileSide& side) {
    EXPECT_EQ(ProfileEnd::crossed, side.end);
    Vector point = best;
    point[static_cast<Eigen::Index>(i)] = side.u;
    return to_values(problem, point)[i];
  };
  const double root = 2.0 * std::sqrt(2.0);
  EXPECT_NEAR(1.0, value(0, profiles.low[0]), 0.01);
  EXPECT_NEAR(5.0, value(0, profiles.high[0]), 0.01);
  EXPECT_NEAR(2.0 - root, value(1, profiles.low[1]), 0.015);
  EXPECT_NEAR(2.0 + root, value(1, profiles.high[1]), 0.015);
  EXPECT_EQ(ProfileEnd::bound, profiles.low[2].end);
  EXPECT_EQ(ProfileEnd::bound, profiles.high[2].end);
  EXPECT_EQ(nullptr, profiles.better);
}

}  // namespace
}  // namespace linkstudy::calibration::profile_test

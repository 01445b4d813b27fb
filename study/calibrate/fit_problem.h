// A least-squares problem as the fit sees it: numbers only. Parameters within bounds, and a
// callback that turns points into weighted residuals
//   r_i = (simulated_i - measured_i) / sigma_i,      S(x) = sum_i r_i^2.
// Inside, a point is u in the unit cube: u = (x - low) / (high - low), or the same of logarithms.
// An evaluation that ends with a cause has no residuals: it shortens a step and ends nothing.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/cause.h"
#include "study/config/fit_options.h"

namespace linkstudy::calibration {

struct FitParameter {
  std::string name;
  std::string unit{};
  bool is_logarithmic = false;
  double low = 0.0;
  double high = 0.0;
  std::optional<double> start{};
};

// Residuals first .. end - 1 are one signal of one experiment, in the order of time: neighbours may
// be correlated.
struct ResidualSeries {
  std::string name;
  std::string unit{};  // of what was measured
  double sigma = 1.0;  // what the residuals were divided by, in that unit
  std::size_t first = 0;
  std::size_t end = 0;
};

struct FitProblem {
  std::vector<FitParameter> parameters;
  std::vector<ResidualSeries> series;
};

struct FitAnswer {
  std::uint64_t id = 0;
  Cause status = Cause::ok;
  std::string message{};
  std::vector<double> residuals{};
};

// Points in the units of the parameters; answers in the same order.
using EvaluateBatch =
    std::function<std::vector<FitAnswer>(const std::vector<std::vector<double>>& points)>;

using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

std::vector<double> to_values(const FitProblem& problem, const Vector& u);
// Clamped to the cube.
Vector to_cube(const FitProblem& problem, const std::vector<double>& values);

// Length of a difference in each coordinate of the cube: `relative` of the value (of a linear
// parameter near zero: of a hundredth of its range).
Vector difference_steps(const FitProblem& problem, const Vector& u, double relative);

// d ln x / du: what a change of a coordinate is relative to the value.
Vector relative_slopes(const FitProblem& problem, const Vector& u);

}  // namespace linkstudy::calibration

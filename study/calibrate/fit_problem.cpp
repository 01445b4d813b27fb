#include "study/calibrate/fit_problem.h"

#include <algorithm>
#include <cmath>

namespace linkstudy::calibration {
namespace {

constexpr double kNearZero = 0.01;  // of the range: a linear value below has differences of its own

double span_of(const FitParameter& one) {
  return one.is_logarithmic ? std::log(one.high / one.low) : one.high - one.low;
}

double value_of(const FitParameter& one, double u) {
  if (u <= 0.0) return one.low;
  if (u >= 1.0) return one.high;
  return one.is_logarithmic ? one.low * std::exp(u * span_of(one)) : one.low + u * span_of(one);
}

// What a relative change of a parameter at u is relative to.
double size_at(const FitParameter& one, double u) {
  if (one.is_logarithmic) return 1.0;
  return std::max(std::abs(value_of(one, u)), kNearZero * span_of(one));
}

}  // namespace

std::vector<double> to_values(const FitProblem& problem, const Vector& u) {
  std::vector<double> values;
  for (std::size_t i = 0; i < problem.parameters.size(); ++i) {
    values.push_back(value_of(problem.parameters[i], u[static_cast<Eigen::Index>(i)]));
  }
  return values;
}

Vector to_cube(const FitProblem& problem, const std::vector<double>& values) {
  Vector u(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    const FitParameter& one = problem.parameters[i];
    const double distance =
        one.is_logarithmic ? std::log(values[i] / one.low) : values[i] - one.low;
    u[static_cast<Eigen::Index>(i)] = std::clamp(distance / span_of(one), 0.0, 1.0);
  }
  return u;
}

Vector difference_steps(const FitProblem& problem, const Vector& u, double relative) {
  Vector steps(u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const FitParameter& one = problem.parameters[static_cast<std::size_t>(i)];
    steps[i] = std::min(relative * size_at(one, u[i]) / span_of(one), 0.1);
  }
  return steps;
}

Vector relative_slopes(const FitProblem& problem, const Vector& u) {
  Vector slopes(u.size());
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    const FitParameter& one = problem.parameters[static_cast<std::size_t>(i)];
    slopes[i] = span_of(one) / size_at(one, u[i]);
  }
  return slopes;
}

}  // namespace linkstudy::calibration

// An error model with ends known in closed form: component i has e_i = A_i / c + B_i c^2 h^4, and
// the run diverges when h exceeds limit_scale / sqrt(c). With D = B h^4 the ends of the window are
// the two positive roots of D c^3 - tol c + A = 0 (Viete's trigonometric formula).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "study/tune/tune.h"

namespace linkstudy::tuning::testing {

struct Term {
  double soft = 0.0;    // A
  double coarse = 0.0;  // B
  double tolerance = 0.02;
};

struct Ends {
  double low = 0.0;
  double high = std::numeric_limits<double>::infinity();
};

inline Ends solve_ends(const Term& term, double step) {
  const double d = term.coarse * std::pow(step, 4.0);
  if (d == 0.0) {
    return {term.soft / term.tolerance};
  }
  const double p = -term.tolerance / d;
  const double q = term.soft / d;
  const double angle = std::acos(1.5 * q / p * std::sqrt(-3.0 / p)) / 3.0;
  const double radius = 2.0 * std::sqrt(-p / 3.0);
  return {radius * std::cos(angle - 2.0 * std::numbers::pi / 3.0), radius * std::cos(angle)};
}

class SyntheticError {
 public:
  std::vector<Term> terms = {{200.0, 1.0}};  // with h = 1e-4: window near [1e4, 1.4e7]
  double step = 1e-4;
  double limit_scale = std::numeric_limits<double>::infinity();  // step limit = scale / sqrt(c)
  // Extra log10 of the error at (c, step), and a cause that overrides the answer.
  std::function<double(double, double)> disturbance = [](double, double) { return 0.0; };
  std::function<Cause(double, double)> cause = [](double, double) { return Cause::ok; };

  std::vector<Request> asked;  // in order
  std::vector<std::size_t> batches;

  Ends ends() const {
    Ends all;
    for (const Term& term : terms) {
      const Ends one = solve_ends(term, step);
      all = {std::max(all.low, one.low), std::min(all.high, one.high)};
    }
    return all;
  }

  TuningProblem problem(double low = 1e3, double high = 1e8) const {
    TuningProblem result;
    result.variables = {{"closure.S.sde.stiffness", "N/m", low, high}};
    for (std::size_t i = 0; i < terms.size(); ++i) {
      result.components.push_back({"force." + std::to_string(i), terms[i].tolerance});
    }
    return result;
  }

  Answer answer(const Request& request, std::uint64_t id) const {
    const double c = request.x.front();
    const double h = step * request.step_factor;
    Answer result{id, cause(c, h), {}, {}, std::sqrt(c) * h, limit_scale / std::sqrt(c), h};
    if (h > result.step_limit) result.status = Cause::diverged;
    const double factor = std::pow(10.0, disturbance(c, h));
    for (const Term& term : terms) {
      result.errors.push_back(factor * (term.soft / c + term.coarse * c * c * std::pow(h, 4.0)));
    }
    return result;
  }

  EvaluateBatch evaluator() {
    return [this](const std::vector<Request>& requests) {
      std::vector<Answer> answers;
      for (const Request& request : requests) {
        answers.push_back(answer(request, asked.size()));
        asked.push_back(request);
      }
      batches.push_back(requests.size());
      return answers;
    };
  }
};

// Reproducible noise in [-amplitude, amplitude] decades, a function of the point and the step.
inline std::function<double(double, double)> make_noise(double amplitude) {
  return [amplitude](double c, double h) {
    const auto seed = std::hash<double>{}(c) ^ (std::hash<double>{}(h)*31);
    std::mt19937_64 generator(seed);
    return std::uniform_real_distribution<double>(-amplitude, amplitude)(generator);
  };
}

inline double decades(double a, double b) {
  return std::log10(a / b);
}

inline std::string sequence_of(const std::vector<Request>& asked) {
  std::string text;
  for (const Request& request : asked) {
    char line[96];
    std::snprintf(line, sizeof line, "%a %g %s\n", request.x.front(), request.step_factor,
                  request.purpose.c_str());
    text += line;
  }
  return text;
}

}  // namespace linkstudy::tuning::testing

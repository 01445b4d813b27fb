// Planted problems of one to three variables with an optimum that is known by construction.
//
// Component i has, in parts of its tolerance, the error
//   r_i(x, h) = sum_j P_ij x*_j / x_j + (x_max / ceiling)^2 (h / h0)^4
// the compliance of every axis with its weight, and what the step adds; the run diverges where h is
// over limit / sqrt(x_max). With rows of P that sum to 1 and weights lambda_i > 0 whose columns
// sum_i lambda_i P_ij are 1, x* is the point of least sum_j log x_j with sum_j P_ij x*_j / x_j <= 1
// for all i: in y = 1 / x that is a concave problem, and these are its conditions of Karush, Kuhn
// and Tucker. P is made so by Sinkhorn's scaling; near the identity its trade-offs are steep, with
// equal entries flat.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "study/tune/tune.h"

namespace linkstudy::tuning::testing {

inline constexpr double kPlantedStep = 1e-4;

struct PlantedProblem {
  std::vector<double> optimum;               // x*, without what the step adds
  std::vector<std::vector<double>> weights;  // P
  double ceiling = 1e12;
  double limit = std::numeric_limits<double>::infinity();
  // Added to log10 of all errors, and causes.
  std::function<double(const std::vector<double>&, double h)> disturbance =
      [](const auto&, double) { return 0.0; };
  std::function<Cause(const std::vector<double>&, double h)> cause = [](const auto&, double) {
    return Cause::ok;
  };
  std::size_t asked = 0;

  TuningProblem problem(double low = 1e3, double high = 1e8) const {
    TuningProblem result;
    for (std::size_t j = 0; j < optimum.size(); ++j) {
      result.variables.push_back({"c" + std::to_string(j), "N/m", low, high});
    }
    for (std::size_t i = 0; i < weights.size(); ++i) {
      result.components.push_back({"e" + std::to_string(i), 0.02});
    }
    return result;
  }

  double coarse(const std::vector<double>& x, double h) const {
    const double most = *std::ranges::max_element(x) / ceiling;
    return most * most * std::pow(h / kPlantedStep, 4.0);
  }

  Answer answer(const Request& request) {
    const double h = kPlantedStep * request.step_factor;
    Answer result{asked++, cause(request.x, h), {}, {}, 0.1, {}, h};
    result.step_limit = limit / std::sqrt(*std::ranges::max_element(request.x));
    if (h > result.step_limit) result.status = Cause::diverged;
    const double factor = std::pow(10.0, disturbance(request.x, h));
    for (const std::vector<double>& row : weights) {
      double ratio = coarse(request.x, h);
      for (std::size_t j = 0; j < row.size(); ++j) ratio += row[j] * optimum[j] / request.x[j];
      result.errors.push_back(0.02 * factor * ratio);
    }
    return result;
  }

  EvaluateBatch evaluator() {
    return [this](const std::vector<Request>& requests) {
      std::vector<Answer> answers;
      for (const Request& request : requests) answers.push_back(answer(request));
      return answers;
    };
  }

  double ratio(const std::vector<double>& x, double factor) {
    const Answer one = answer({x, factor, ""});
    --asked;
    if (one.status != Cause::ok) return std::numeric_limits<double>::infinity();
    double largest = 0.0;
    for (const double error : one.errors) {
      if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, error / 0.02);
    }
    return largest;
  }
  bool matches(const std::vector<double>& x) {
    return ratio(x, 1.0) <= 1.0 && ratio(x, 0.5) <= 1.0;
  }

  double least_objective() const { return compute_objective(optimum); }
  // A point that matches with the step's part too: x* times the least s with 1 / s + coarse(s x*)
  // <= 1. The optimum lies between the two.
  double attained_objective() const {
    double s = 1.0;
    for (int i = 0; i < 100; ++i) {
      std::vector<double> x = optimum;
      for (double& one : x) one *= s;
      s = 1.0 / (1.0 - coarse(x, kPlantedStep));
    }
    return least_objective() + static_cast<double>(optimum.size()) * std::log10(s);
  }
};

// Rows and weighted columns that sum to 1, from entries of (1 - flat) I + flat, at random.
inline std::vector<std::vector<double>> plant_weights(std::size_t n, std::size_t rows, double flat,
                                                      std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.2, 1.0);
  std::vector<std::vector<double>> p(rows, std::vector<double>(n));
  std::vector<double> lambda(rows);
  double sum = 0.0;
  for (double& one : lambda) sum += one = unit(random);
  for (double& one : lambda) one *= static_cast<double>(n) / sum;
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      p[i][j] = unit(random) * (flat + (i % n == j ? 1.0 - flat : 0.0));
    }
  }
  for (int pass = 0; pass < 3000; ++pass) {
    for (std::size_t j = 0; j < n; ++j) {
      double column = 0.0;
      for (std::size_t i = 0; i < rows; ++i) column += lambda[i] * p[i][j];
      for (std::size_t i = 0; i < rows; ++i) p[i][j] /= column;
    }
    for (std::vector<double>& row : p) {
      double total = 0.0;
      for (const double one : row) total += one;
      for (double& one : row) one /= total;
    }
  }
  return p;
}

// A smooth one: the window ends one to three decades above the optimum, by accuracy or stability.
inline PlantedProblem plant(std::size_t n, std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  PlantedProblem planted;
  double most = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    planted.optimum.push_back(std::pow(10.0, 3.8 + 2.4 * unit(random)));
    most = std::max(most, planted.optimum.back());
  }
  const std::size_t rows = n + random() % 3;
  planted.weights = plant_weights(n, rows, 0.02 + 0.9 * unit(random), random);
  planted.ceiling = most * std::pow(10.0, 1.0 + 2.0 * unit(random));
  planted.limit = kPlantedStep * std::sqrt(planted.ceiling) * (0.5 + 3.0 * unit(random));
  return planted;
}

}  // namespace linkstudy::tuning::testing

#include "study/tune/tuning_problem.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

void check_variables(const TuningProblem& problem, std::vector<Problem>& problems) {
  if (problem.variables.empty()) {
    problems.push_back({"tune", "no variable is tuned", "add one [[tune]] entry"});
  }
  for (const TunedVariable& variable : problem.variables) {
    const bool is_possible = !variable.is_logarithmic || variable.low > 0.0;
    const bool is_ordered = variable.low < variable.high;
    if (!is_possible || !is_ordered || !std::isfinite(variable.high - variable.low)) {
      problems.push_back(
          {"tune.range",
           fmt::format("range of '{}' is [{:g}, {:g}]", variable.path, variable.low, variable.high),
           variable.is_logarithmic ? "give 0 < low < high, both finite"
                                   : "give low < high, both finite"});
    }
  }
}

// A sum of values of several units means nothing.
void check_sum(const TuningProblem& problem, std::vector<Problem>& problems) {
  const bool has_linear =
      std::ranges::count(problem.variables, false, &TunedVariable::is_logarithmic) > 0;
  if (!has_linear || problem.variables.size() < 2 || !is_lowest_sum(problem)) return;
  problems.push_back({"objective", "several values, of which some have linear ranges, have no sum",
                      "say by objective which value or response is best"});
}

void check_components(const TuningProblem& problem, std::vector<Problem>& problems) {
  if (problem.components.empty()) {
    problems.push_back({"match", "nothing is matched", "add at least one [[match]] entry"});
  }
  std::set<std::string> names;
  for (const MatchComponent& component : problem.components) {
    if (!(component.tolerance > 0.0) || !std::isfinite(component.tolerance)) {
      problems.push_back(
          {"match.tolerance",
           fmt::format("tolerance of '{}' is {:g}", component.name, component.tolerance),
           "give a positive relative error, for example 0.02"});
    }
    if (!names.insert(component.name).second) {
      problems.push_back({"match.signal", fmt::format("'{}' is matched twice", component.name),
                          "keep one entry for each signal and load case"});
    }
  }
}

void check_counts(const TuningOptions& options, std::vector<Problem>& problems) {
  if (options.scan < 2) {
    problems.push_back({"scan", fmt::format("scan has {} points", options.scan), "use at least 2"});
  }
  if (options.batch < 1) {
    problems.push_back({"batch", "batch is 0", "use at least 1"});
  }
  if (options.max_evaluations && *options.max_evaluations < 1) {
    problems.push_back({"max_evaluations", "max_evaluations is 0", "use at least 1"});
  }
}

void check_decades(const TuningProblem& problem, const TuningOptions& options,
                   std::vector<Problem>& problems) {
  const auto within = [&](const char* path, double value, double low, double high) {
    if (!(value >= low && value <= high)) {
      problems.push_back({path, fmt::format("{} is {:g}", path, value),
                          fmt::format("use {:g} to {:g}", low, high)});
    }
  };
  within("resolution", options.resolution, 1e-8, 0.5);
  within("neighbourhood", options.neighbourhood, 1e-6, 2.0);
  within("delta", options.delta, 1e-8, 0.9);
  within("gap", options.gap, 1e-3, 10.0);
  within("mu", options.mu, 0.0, 1.0);
  for (const TunedVariable& variable : problem.variables) {
    const bool is_log = variable.is_logarithmic;
    const double step = is_log ? -std::log10(1.0 - options.delta) : options.delta;
    if (step >= options.resolution) continue;
    const double least = is_log ? 1.0 - std::pow(10.0, -options.resolution) : options.resolution;
    problems.push_back(
        {"delta",
         fmt::format("delta {:g} is finer than the resolution of {:g} {}", options.delta,
                     options.resolution, is_log ? "decades" : "of the range"),
         fmt::format("use a delta of at least {:.3g}", least)});
    return;
  }
}

}  // namespace

std::vector<Problem> check(const TuningProblem& problem, const TuningOptions& options) {
  std::vector<Problem> problems;
  check_variables(problem, problems);
  check_sum(problem, problems);
  check_components(problem, problems);
  check_counts(options, problems);
  check_decades(problem, options, problems);
  return problems;
}

std::size_t usual_budget(std::size_t variables) {
  return variables < 2 ? 200 : variables == 2 ? 1500 : 4000;
}

double compute_objective(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double value : x) sum += std::log10(value);
  return sum;
}

double compute_objective(const TuningProblem& problem, const std::vector<double>& x,
                         const Answer& answer) {
  if (problem.response) {
    const bool is_known = answer.status == Cause::ok && std::isfinite(answer.objective);
    return is_known ? answer.objective : std::numeric_limits<double>::infinity();
  }
  double sum = 0.0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    const TunedVariable& variable = problem.variables[j];
    sum += variable.weight * position_of(variable, x[j]);
  }
  return sum;
}

bool is_lowest_sum(const TuningProblem& problem) {
  const auto counts = [](const TunedVariable& variable) { return variable.weight == 1.0; };
  return !problem.response && std::ranges::all_of(problem.variables, counts);
}

}  // namespace linkstudy::tuning

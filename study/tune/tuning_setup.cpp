#include "study/tune/tuning_setup.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "study/config/input_error.h"
#include "study/config/precedence.h"
#include "study/metrics/common_grid.h"
#include "study/metrics/response_list.h"

namespace linkstudy {
namespace {

constexpr const char* kStepPath = "simulation.step";
constexpr long kMostMultiple = 128;  // of the step, tried at the answer

// The tuner names its own options and what belongs to lists of the file.
std::string path_in_file(const std::string& path) {
  if (path.starts_with("tune.")) return "tune.0" + path.substr(4);
  return path == "tune" || path.starts_with("match") ? path : "search." + path;
}

std::vector<Override> lows_of(const StudyInput& input) {
  std::vector<Override> lows;
  for (const TuneInput& tune : input.tune) {
    lows.push_back(make_override(tune.parameter.path, tune.low));
  }
  return lows;
}

SimulationOptions options_of(const StudyInput& input, const LoadCaseInput& load_case) {
  Diagnostics diagnostics;
  const std::optional<ModelInput> model =
      input.model->with(case_overrides(input, load_case, lows_of(input)), diagnostics);
  throw_if_any(diagnostics);
  return model->options;
}

std::size_t count_tolerances(const StudyInput& input) {
  std::size_t count = 1;
  for (const MatchInput& match : input.match) count = std::max(count, match.tolerance.size());
  return count;
}

// A list of them has `count`.
tuning::TuningProblem make_problem(const Evaluator& evaluator, std::size_t level) {
  const StudyInput& input = evaluator.input();
  const std::optional<ObjectiveInput>& objective = input.objective;
  const bool is_response = !evaluator.objective_responses().empty();
  tuning::TuningProblem problem;
  for (const TuneInput& tune : input.tune) {
    const double sign = objective && objective->maximizes ? -1.0 : 1.0;
    const bool counts = !objective || is_response || objective->of == tune.parameter.path;
    problem.variables.push_back({tune.parameter.path, tune.parameter.unit, tune.low, tune.high,
                                 counts ? sign : 0.0, tune.is_logarithmic});
  }
  for (const JudgedError& error : evaluator.judged_errors()) {
    const std::size_t own = std::min(level, error.tolerance.size() - 1);
    const std::string bound =
        error.bound ? fmt::format("at {} {:g}{}{}", error.bound->is_upper ? "most" : "least",
                                  error.bound->value, error.bound->unit.empty() ? "" : " ",
                                  error.bound->unit)
                    : std::string();
    problem.components.push_back({error.name, error.tolerance[own], bound});
  }
  if (is_response)
    problem.response = tuning::ResponseObjective{objective->of, objective->maximizes};
  return problem;
}

// Multiples of the step that divide the run of every load case, so that times stay in common with
// the reference.
std::vector<int> find_step_multiples(const StudyInput& input) {
  long count = 0;
  for (const LoadCaseInput& load_case : load_cases_of(input)) {
    const SimulationOptions options = options_of(input, load_case);
    if (options.integrator != Integrator::rk4) return {};
    count = std::gcd(count, make_step_grid(options).count);
  }
  std::vector<int> multiples;
  for (long m = 2; m <= std::min(count, kMostMultiple); ++m) {
    if (count % m == 0) multiples.push_back(static_cast<int>(m));
  }
  return multiples;
}

void check_levels(const StudyInput& input, Diagnostics& diagnostics) {
  const std::size_t count = count_tolerances(input);
  for (std::size_t i = 0; i < input.match.size(); ++i) {
    const std::vector<double>& own = input.match[i].tolerance;
    const Location at = locate(input.resolved, fmt::format("match.{}.tolerance", i));
    if (own.size() != 1 && own.size() != count) {
      diagnostics.add(at,
                      fmt::format("'{}' has {} tolerances and another match {}",
                                  input.match[i].signal, own.size(), count),
                      "give each match one, or as many as the others");
    }
    std::vector<double> sorted = own;
    std::ranges::sort(sorted);
    const auto twice = std::ranges::adjacent_find(sorted);
    if (twice == sorted.end()) continue;
    diagnostics.add(
        at, fmt::format("tolerance {:g} of '{}' stands twice", *twice, input.match[i].signal),
        "give each once");
  }
}

// What acts in the proof of C4 alone.
void check_proof_keys(const StudyInput& input, Diagnostics& diagnostics) {
  const std::size_t n = input.tune.size();
  if (!input.objective && (n == 2 || n == 3)) return;
  const SearchOptions standard;
  const auto refuse = [&](const char* key, double value, double usual) {
    if (value == usual) return;
    diagnostics.add(
        locate(input.resolved, std::string("search.") + key),
        fmt::format("search.{} acts where the least sum of two or three values is sought", key),
        "take it out");
  };
  refuse("gap", input.search.gap, standard.gap);
  refuse("mu", input.search.mu, standard.mu);
}

}  // namespace

double base_step_of(const StudyInput& input) {
  return options_of(input, {}).step;
}

std::vector<tuning::TuningTarget> make_tuning_targets(const Evaluator& evaluator) {
  const StudyInput& input = evaluator.input();
  const double base_step = base_step_of(input);
  std::vector<double> steps = input.search.steps;
  if (steps.empty()) steps = {base_step};
  std::vector<tuning::TuningTarget> targets;
  for (const double step : steps) {
    for (std::size_t level = 0; level < count_tolerances(input); ++level) {
      targets.push_back({make_problem(evaluator, level), step / base_step});
    }
  }
  return targets;
}

std::uint64_t most_tuning_evaluations(const StudyInput& input) {
  const std::size_t steps = std::max<std::size_t>(1, input.search.steps.size());
  const std::size_t budget =
      input.search.max_evaluations.value_or(tuning::usual_budget(input.tune.size()));
  return count_tolerances(input) * steps * budget;
}

tuning::TuningOptions make_tuning_options(const StudyInput& input) {
  tuning::TuningOptions options;
  static_cast<SearchOptions&>(options) = input.search;
  options.seed = input.run.seed;
  if (input.search.steps.empty()) options.step_multiples = find_step_multiples(input);
  return options;
}

void check_tune(const StudyInput& input, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < input.tune.size(); ++i) {
    const TuneInput& tune = input.tune[i];
    const bool has_sum = !input.objective || input.tune.size() == 1;
    if (!tune.is_logarithmic && input.tune.size() > 1 && has_sum) {
      diagnostics.add(locate(input.resolved, fmt::format("tune.{}.range.lin", i)),
                      "values of a linear range have no sum of log10 with others",
                      "say by objective which value or response is best, or give it a log range");
    }
    if (tune.parameter.path == kStepPath) {
      diagnostics.add(tune.at, "simulation.step cannot be tuned: the certificate halves it",
                      "search.steps = [...] finds an answer for each of several steps");
    }
  }
  check_levels(input, diagnostics);
  check_proof_keys(input, diagnostics);
  for (const LoadCaseInput& load_case : input.load_case) {
    const bool sets_step = std::ranges::any_of(
        load_case.set, [](const Override& set) { return set.path == kStepPath; });
    if (!sets_step) continue;
    diagnostics.add(load_case.at,
                    fmt::format("load case '{}' sets simulation.step, which a tune halves for its "
                                "certificate",
                                load_case.name),
                    "set it in the model or in base.set");
  }
}

void check_tuning(const Evaluator& evaluator, Diagnostics& diagnostics) {
  const StudyInput& input = evaluator.input();
  const tuning::TuningProblem problem = make_tuning_targets(evaluator).front().problem;
  for (Problem& found : tuning::check(problem, make_tuning_options(input))) {
    diagnostics.add(locate(input.resolved, path_in_file(found.path)), std::move(found.message),
                    std::move(found.remedy));
  }
}

}  // namespace linkstudy

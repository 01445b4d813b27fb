#include "study/tune/tuning_setup.h"

#include <fmt/format.h>

#include <algorithm>

namespace linkstudy {
namespace {

constexpr const char* kStepPath = "simulation.step";

// The tuner names its own options and what belongs to lists of the file.
std::string path_in_file(const std::string& path) {
  if (path.starts_with("tune.")) return "tune.0" + path.substr(4);
  return path == "tune" || path.starts_with("match") ? path : "search." + path;
}

}  // namespace

tuning::TuningProblem make_tuning_problem(const Evaluator& evaluator) {
  tuning::TuningProblem problem;
  for (const TuneInput& tune : evaluator.input().tune) {
    problem.variables.push_back({tune.parameter.path, tune.parameter.unit, tune.low, tune.high});
  }
  for (const JudgedError& error : evaluator.judged_errors()) {
    problem.components.push_back({error.name, error.tolerance});
  }
  return problem;
}

tuning::TuningOptions make_tuning_options(const StudyInput& input) {
  tuning::TuningOptions options{input.search};
  options.seed = input.run.seed;
  return options;
}

void check_tune(const StudyInput& input, Diagnostics& diagnostics) {
  for (std::size_t i = 0; i < input.tune.size(); ++i) {
    const TuneInput& tune = input.tune[i];
    if (!tune.is_logarithmic) {
      diagnostics.add(locate(input.resolved, fmt::format("tune.{}.range.lin", i)),
                      "this version searches in decades only",
                      "write range = { log = [lowest, highest] }");
    }
    if (tune.parameter.path == kStepPath) {
      diagnostics.add(tune.at, "simulation.step cannot be tuned: the certificate halves it",
                      "vary it in a study");
    }
  }
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
  for (Problem& found : tuning::check(make_tuning_problem(evaluator), make_tuning_options(input))) {
    diagnostics.add(locate(input.resolved, path_in_file(found.path)), std::move(found.message),
                    std::move(found.remedy));
  }
}

}  // namespace linkstudy

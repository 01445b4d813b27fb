#include "study/cli/input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/cli/output.h"
#include "study/cli/tuning_setup.h"
#include "study/config/precedence.h"
#include "study/config/unit.h"
#include "study/design/design.h"

namespace linkstudy {
namespace {

constexpr const char* kStepPath = "simulation.step";

std::vector<Override> parse_sets(const std::vector<std::string>& texts, Diagnostics& diagnostics) {
  std::vector<Override> set;
  for (const std::string& text : texts) {
    if (const std::optional<Override> one = parse_set(text, diagnostics)) set.push_back(*one);
  }
  return set;
}

FailureLimit parse_limit(const std::string& text) {
  const std::optional<WrittenQuantity> quantity = split_quantity(text);
  const bool is_percent = quantity && quantity->unit == "%";
  const bool is_right =
      quantity && quantity->value >= 0.0 &&
      (is_percent ? quantity->value <= 100.0
                  : quantity->unit.empty() && quantity->value == std::floor(quantity->value));
  if (!is_right) {
    throw UsageError(
        fmt::format("--max-failures must be a count or a share such as 5%, got '{}'", text));
  }
  return {quantity->value, is_percent};
}

void apply_run_options(const CommandLine& line, RunOptions& run) {
  if (line.timeout_s) run.timeout = line.timeout_s;
  if (line.max_failures) run.max_failures = parse_limit(*line.max_failures);
  if (line.on_failure) {
    run.on_failure = *line.on_failure == "abort" ? FailurePolicy::abort : FailurePolicy::record;
  }
}

std::vector<Axis> axes_of(const StudyInput& input) {
  std::vector<Axis> axes;
  for (const VaryInput& vary : input.vary) axes.push_back({vary.parameter, vary.values});
  return axes;
}

Design design_of(const StudyInput& input) {
  return input.design;
}

std::vector<Value> first_point(const StudyInput& input) {
  if (input.kind == StudyKind::tune) return {input.tune.front().low, base_step_of(input)};
  return make_point(design_of(input), axes_of(input), 0).values;
}

}  // namespace

InputError::InputError(Diagnostics diagnostics)
    : std::runtime_error(to_string(diagnostics)), diagnostics_(std::move(diagnostics)) {}

void throw_if_any(const Diagnostics& diagnostics) {
  if (!diagnostics.empty()) throw InputError(diagnostics);
}

void print_remarks(const std::vector<Diagnostic>& remarks) {
  for (const Diagnostic& remark : remarks) print_err(to_string(remark) + "\n");
}

ModelInput read_model_input(const CommandLine& line) {
  Diagnostics diagnostics;
  const std::vector<Override> set = parse_sets(line.set, diagnostics);
  const auto document = ModelDocument::load(line.inputs.front(), diagnostics);
  throw_if_any(diagnostics);
  std::optional<ModelInput> model = read_model_file(*document, set, line.verb, diagnostics);
  throw_if_any(diagnostics);
  print_remarks(diagnostics.sorted_remarks());
  return std::move(*model);
}

StudyInput read_study_input(const CommandLine& line, StudyKind kind) {
  Diagnostics diagnostics;
  std::vector<std::string> texts = line.set;
  if (line.seed) texts.push_back(fmt::format("run.seed={}", *line.seed));
  if (line.batch) texts.push_back(fmt::format("search.batch={}", *line.batch));
  const std::vector<Override> set = parse_sets(texts, diagnostics);
  std::optional<StudyInput> input = read_study(line.inputs.front(), set, diagnostics);
  throw_if_any(diagnostics);
  if (input->kind != kind) {
    const char* other = input->kind == StudyKind::tune ? "tune" : "study";
    diagnostics.add(make_location(input->file), fmt::format("this file has kind = \"{}\"", other),
                    fmt::format("run 'linkstudy {} {}'", other, input->file));
    throw InputError(diagnostics);
  }
  apply_run_options(line, input->run);
  return std::move(*input);
}

std::vector<Parameter> parameters_of(const StudyInput& input) {
  std::vector<Parameter> parameters;
  for (const VaryInput& vary : input.vary) parameters.push_back(vary.parameter);
  if (input.kind == StudyKind::tune) {
    parameters.push_back(input.tune.front().parameter);
    parameters.push_back(parameter_for(*input.model, kStepPath)
                             .value_or(Parameter{kStepPath, "s", "length of a step"}));
  }
  return parameters;
}

std::vector<Point> points_of(const StudyInput& input) {
  return make_points(design_of(input), axes_of(input));
}

double base_step_of(const StudyInput& input) {
  const Override low = make_override(input.tune.front().parameter.path, input.tune.front().low);
  Diagnostics diagnostics;
  const std::optional<ModelInput> model =
      input.model->with(case_overrides(input, {}, {low}), diagnostics);
  throw_if_any(diagnostics);
  return model->options.step;
}

std::unique_ptr<Evaluator> make_evaluator(const StudyInput& input, Diagnostics& diagnostics) {
  if (input.kind == StudyKind::tune) check_tune(input, diagnostics);
  if (!diagnostics.empty()) return nullptr;
  std::unique_ptr<Evaluator> evaluator =
      Evaluator::make(input, parameters_of(input), first_point(input), diagnostics);
  if (evaluator && input.kind == StudyKind::tune) check_tuning(*evaluator, diagnostics);
  if (evaluator) evaluator->set_timeout(input.run.timeout.value_or(0.0));
  return evaluator;
}

}  // namespace linkstudy

#include "study/session/study_points.h"

#include <malloc.h>

#include "study/calibrate/fit_setup.h"
#include "study/config/case_selection.h"
#include "study/config/input_error.h"
#include "study/config/precedence.h"
#include "study/converge/check_instants.h"
#include "study/design/design.h"
#include "study/tune/tuning_setup.h"

namespace linkstudy {
namespace {

constexpr const char* kStepPath = "simulation.step";

std::vector<Value> first_point(const StudyInput& input) {
  if (input.kind == FileKind::calibrate) return calibration_point(input, first_fitted(input));
  if (input.kind == FileKind::tune) {
    std::vector<Value> lows;
    for (const TuneInput& tune : input.tune) lows.emplace_back(tune.low);
    lows.emplace_back(base_step_of(input));
    return lows;
  }
  return make_point(input.design, axes_of(input), 0).values;
}

// Text and trees of many values, read and judged, are holes in the heap; C++ does not ask for them
// to be given back.
void give_back_memory(const StudyInput& input) {
  constexpr std::size_t kMany = 10000;
  std::size_t values = 0;
  for (const VaryInput& vary : input.vary) values += vary.values.size();
  if (values > kMany) malloc_trim(0);
}

}  // namespace

std::vector<Parameter> parameters_of(const StudyInput& input) {
  if (input.kind == FileKind::calibrate) return calibration_parameters(input);
  std::vector<Parameter> parameters;
  for (const VaryInput& vary : input.vary) parameters.push_back(vary.parameter);
  if (input.kind == FileKind::tune) {
    for (const TuneInput& tune : input.tune) parameters.push_back(tune.parameter);
    parameters.push_back(parameter_for(*input.model, kStepPath)
                             .value_or(Parameter{kStepPath, "s", "length of a step"}));
  }
  return parameters;
}

std::uint64_t count_of(const StudyInput& input) {
  return count_points(input.design, axes_of(input));
}

std::vector<Point> points_of(const StudyInput& input) {
  return make_points(input.design, axes_of(input));
}

std::unique_ptr<Evaluator> make_evaluator(const StudyInput& input, Diagnostics& diagnostics) {
  if (input.kind == FileKind::tune) check_tune(input, diagnostics);
  if (!diagnostics.empty()) return nullptr;
  std::unique_ptr<Evaluator> evaluator =
      Evaluator::make(input, parameters_of(input), first_point(input), diagnostics);
  if (evaluator && input.kind == FileKind::tune) check_tuning(*evaluator, diagnostics);
  if (evaluator && input.kind == FileKind::converge) {
    convergence::check_common_instants(*evaluator, points_of(input), diagnostics);
  }
  if (evaluator && input.kind == FileKind::calibrate) check_calibration(*evaluator, diagnostics);
  if (evaluator) evaluator->set_timeout(input.run.timeout.value_or(0.0));
  give_back_memory(input);
  return evaluator;
}

}  // namespace linkstudy

#include "study/calibrate/fit_setup.h"

#include <fmt/format.h>

#include "study/config/precedence.h"

namespace linkstudy {
namespace {

using calibration::FitParameter;
using calibration::FitProblem;

bool is_free(const CalibratedInput& one) {
  return one.role == ParameterRole::free;
}

double end_time_of(const StudyInput& input, const LoadCaseInput& experiment) {
  std::vector<Override> point;
  const std::vector<Value> values = calibration_point(input, first_fitted(input));
  for (std::size_t i = 0; i < input.calibrated.size(); ++i) {
    point.push_back(make_override(input.calibrated[i].parameter.path, values[i]));
  }
  Diagnostics said_before;
  const auto model = input.model->with(case_overrides(input, experiment, point), said_before);
  return model ? model->options.end_time : 0.0;
}

FitParameter offset_parameter(const StudyInput& input, const LoadCaseInput& experiment,
                              const MeasuredSet& set) {
  const OffsetRange range = offset_range(set, end_time_of(input, experiment));
  FitParameter parameter{measured_offset_path(experiment.name), "s", false, range.low, range.high};
  if (range.low < 0.0 && range.high > 0.0) parameter.start = 0.0;
  return parameter;
}

std::string series_name(const LoadCaseInput& experiment, const MeasuredSignal& signal) {
  return fmt::format("{}.{}", experiment.name, signal.channel);
}

}  // namespace

std::vector<Parameter> calibration_parameters(const StudyInput& input) {
  std::vector<Parameter> parameters;
  for (const CalibratedInput& one : input.calibrated) parameters.push_back(one.parameter);
  for (const LoadCaseInput& one : input.load_case) {
    if (!one.measured || !one.measured->fits_offset) continue;
    parameters.push_back(
        {measured_offset_path(one.name), "s", "added to the instants of its data"});
  }
  return parameters;
}

std::vector<Value> calibration_point(const StudyInput& input, const std::vector<double>& fitted) {
  std::vector<Value> values(input.calibrated.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const CalibratedInput& one = input.calibrated[i];
    if (is_free(one)) values[i] = fitted.at(next++);
    if (one.role == ParameterRole::fixed) values[i] = one.fixed;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const CalibratedInput& one = input.calibrated[i];
    if (one.role == ParameterRole::tied) {
      values[i] = one.factor * std::get<double>(values[one.leader]);
    }
  }
  for (; next < fitted.size(); ++next) values.emplace_back(fitted[next]);
  return values;
}

std::vector<double> first_fitted(const StudyInput& input) {
  std::vector<double> fitted;
  for (const CalibratedInput& one : input.calibrated)
    if (is_free(one)) fitted.push_back(one.low);
  for (const LoadCaseInput& one : input.load_case) {
    if (one.measured && one.measured->fits_offset) fitted.push_back(0.0);
  }
  return fitted;
}

FitProblem make_fit_problem(Evaluator& evaluator) {
  const StudyInput& input = evaluator.input();
  FitProblem problem;
  for (const CalibratedInput& one : input.calibrated) {
    if (!is_free(one)) continue;
    problem.parameters.push_back(
        {one.parameter.path, one.parameter.unit, one.is_logarithmic, one.low, one.high, one.start});
  }
  std::size_t first = 0;
  for (std::size_t i = 0; i < input.load_case.size(); ++i) {
    const LoadCaseInput& experiment = input.load_case[i];
    const auto set = evaluator.measured_set(i);
    for (const MeasuredSignal& signal : set->signals) {
      const std::size_t end = first + signal.times.size();
      problem.series.push_back(
          {series_name(experiment, signal), signal.unit, signal.sigma, first, end});
      first = end;
    }
    if (!experiment.measured->fits_offset) continue;
    problem.parameters.push_back(offset_parameter(input, experiment, *set));
  }
  return problem;
}

FitOptions make_fit_options(const StudyInput& input) {
  FitOptions options = input.fit;
  options.seed = input.run.seed;
  return options;
}

void check_calibration(Evaluator& evaluator, Diagnostics& diagnostics) {
  const StudyInput& input = evaluator.input();
  std::vector<std::shared_ptr<const MeasuredSet>> sets;
  std::vector<const MeasuredSet*> seen;
  std::size_t samples = 0;
  for (std::size_t i = 0; i < input.load_case.size(); ++i) {
    if (evaluator.has_reference(i)) continue;
    sets.push_back(evaluator.measured_set(i));
    if (!sets.back()) return;  // said before
    seen.push_back(sets.back().get());
    samples += sets.back()->sample_count();
  }
  require_one_unit(seen, diagnostics);
  const std::size_t count = first_fitted(input).size();
  if (sets.size() < input.load_case.size() || samples > count) return;
  diagnostics.add(input.load_case.front().at,
                  fmt::format("{} samples in all cannot determine {} values", samples, count),
                  "fix some, or measure more");
}

}  // namespace linkstudy

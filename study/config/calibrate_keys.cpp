#include "study/config/calibrate_keys.h"

#include "study/config/common_fields.h"
#include "study/config/measured_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;

// Their values are of the units of the model: calibrate_reader.cpp reads them.
Fields<StudyInput> parameter_fields() {
  Fields<StudyInput> parameter;
  parameter.read("path", {.type = text,
                          .meaning = "path in the model, such as closure.S.sde.stiffness; * for a "
                                     "name: the same value at every place",
                          .required = true});
  parameter.table(
      "range", {.meaning = "bounds of the fit", .required = true, .group = "role"},
      range_fields<StudyInput>("[lowest, highest], fitted by its logarithm", "[lowest, highest]"));
  parameter.read(
      "fixed",
      {.type = scalar, .meaning = "value that is not fitted", .required = true, .group = "role"});
  parameter.read("tied_to", {.type = text,
                             .meaning = "path of another [[parameter]] that it follows",
                             .required = true,
                             .group = "role"});
  parameter.read("start", {.type = scalar,
                           .meaning = "where the first fit begins; default: the "
                                      "middle of the range"});
  parameter.read("factor",
                 {.meaning = "times the one it is tied to; default: 1", .range = kPositive});
  return parameter;
}

void read_sigma(MeasuredInput& to, Tree& value, const Reading&) {
  for (const Override& one : flatten_overrides(value)) {
    to.sigma.push_back({one.path, one.value, one.origin});
  }
}

void add_signals(Fields<MeasuredInput>& measured) {
  measured.read(
      "signals",
      {.type = texts, .meaning = "channels or vectors of the reference run, or of the results"},
      [](MeasuredInput& to, Tree& value, const Reading&) {
        for (const Tree& one : value.items) to.signals.push_back({one.text, one.at});
      });
}

void add_weights(Fields<MeasuredInput>& measured) {
  measured.read("sigma",
                {.type = overrides,
                 .meaning = "channel or vector = standard deviation of its error; default: one for "
                            "all, from the residuals",
                 .group = "sigma"},
                read_sigma);
  measured.add("weight", &MeasuredInput::weight,
               {.meaning = "of the residuals of this experiment, in SI units; default: 1",
                .range = kPositive,
                .group = "sigma"});
  add_time_offset(measured,
                  {.meaning = "added to the instants of the data, s, or \"fit\": within a tenth of "
                              "their duration, as far as the run reaches; default: 0"},
                  true);
}

Fields<LoadCaseInput> experiment_fields() {
  Fields<LoadCaseInput> experiment;
  experiment.add("name", &LoadCaseInput::name,
                 {.type = name, .meaning = "name of the experiment", .required = true});
  Fields<MeasuredInput> measured;
  add_file(measured, {.required = true, .group = "data"});
  add_results(measured, {.required = true, .group = "data"});
  add_columns(measured,
              "channel = head of its column in the file, for time and every channel compared; a "
              "unit stands in brackets at the end of the head. Of results: = name of the channel "
              "there, where signals do not do because the model has another one");
  add_signals(measured);
  add_window(measured,
             "first and last instant of the data that counts; default: all (of a reference run and "
             "of results: all but its start)");
  add_weights(measured);
  const auto part = [](LoadCaseInput& of) -> MeasuredInput& {
    if (!of.measured) of.measured.emplace();
    return *of.measured;
  };
  experiment.include(part, std::move(measured));
  Fields<ReferenceInput> reference;
  reference.add("set", &ReferenceInput::set,
                {.meaning = "model values of that run: path = value", .required = true});
  experiment.table("reference", &LoadCaseInput::reference,
                   {.meaning = "a run of the model itself in place of measurements",
                    .required = true,
                    .group = "data"},
                   std::move(reference), [](LoadCaseInput& to, Tree& table, const Reading&) {
                     to.reference->at = table.at;
                   });
  experiment.add("set", &LoadCaseInput::set,
                 {.meaning = "model values of this experiment: path = value"});
  experiment.finish([part](LoadCaseInput& to, Tree& table, const Reading&) {
    to.at = table.at;
    part(to);
  });
  return experiment;
}

Fields<FitOptions> fit_fields() {
  Fields<FitOptions> fit;
  fit.add(
      "starts", &FitOptions::starts,
      {.meaning = "fits from different points, side by side", .range = {.low = 1, .high = 1000}});
  fit.add("max_evaluations", &FitOptions::max_evaluations,
          {.meaning = "budget of evaluations", .range = {.low = 1, .high = 1.0e6}});
  fit.add("difference", &FitOptions::difference,
          {.meaning = "relative length of central differences: longer where runs are noisy",
           .range = {.low = 1e-7, .high = 0.2}});
  fit.add("autocorrelation", &FitOptions::autocorrelation,
          {.meaning = "of neighbouring residuals"});
  fit.add("confidence", &FitOptions::confidence,
          {.meaning = "of the intervals",
           .range = {.low = 0, .high = 1, .low_is_out = true, .high_is_out = true}});
  fit.add("profiles", &FitOptions::profiles,
          {.meaning = "intervals by refitting the others; false: linearised ones only"});
  return fit;
}

}  // namespace

Fields<StudyInput> calibration_fields() {
  Fields<StudyInput> calibration;
  calibration.tables("parameter",
                     {.meaning = "values that are fitted, fixed or tied", .required = true},
                     parameter_fields());
  calibration.tables("experiment", &StudyInput::load_case,
                     {.meaning = "runs and what was measured in them", .required = true},
                     experiment_fields());
  calibration.table("fit", &StudyInput::fit, {.meaning = "how the fit goes", .standard = "{}"},
                    fit_fields());
  return calibration;
}

}  // namespace linkstudy

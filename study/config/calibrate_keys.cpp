#include "study/config/calibrate_keys.h"

#include <fmt/format.h>

#include "study/config/common_fields.h"
#include "study/config/unit.h"

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

void read_columns(MeasuredInput& to, Tree& value, const Reading& reading) {
  for (const Override& one : flatten_overrides(value)) {
    if (one.value.is(Tree::Kind::text)) {
      to.columns.push_back({one.path, one.origin, one.value.text, one.value.at});
    } else {
      reading.diagnostics.add(one.value.at,
                              fmt::format("columns.{} must be the head of a column, got {}",
                                          one.path, shown(one.value)),
                              "write the head as it stands in the file, in quotes");
    }
  }
}

void read_sigma(MeasuredInput& to, Tree& value, const Reading&) {
  for (const Override& one : flatten_overrides(value)) {
    to.sigma.push_back({one.path, one.value, one.origin});
  }
}

void read_offset(MeasuredInput& to, Tree& value, const Reading& reading) {
  to.offset_at = value.at;
  to.fits_offset = value.is(Tree::Kind::text) && value.text == "fit";
  if (to.fits_offset) return;
  to.time_offset = value.as_number();
  if (value.is_numeric()) return;
  const auto quantity = value.is(Tree::Kind::text) ? split_quantity(value.text) : std::nullopt;
  const auto unit = quantity ? parse_unit(quantity->unit) : std::nullopt;
  const auto seconds = unit ? convert_unit(quantity->value, *unit, *parse_unit("s")) : std::nullopt;
  if (seconds) {
    to.time_offset = *seconds;
    return;
  }
  reading.report(value, fmt::format("time_offset must be a time, got {}", shown(value)),
                 "a number in s, a text such as \"3 ms\", or \"fit\"");
}

void add_signals(Fields<MeasuredInput>& measured) {
  measured.read("signals", {.type = texts, .meaning = "channels or vectors of the reference run"},
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
  measured.read("time_offset",
                {.type = scalar,
                 .meaning = "added to the instants of the data, s, or \"fit\": within a tenth of "
                            "their duration, as far as the run reaches; default: 0"},
                read_offset);
}

Fields<LoadCaseInput> experiment_fields() {
  Fields<LoadCaseInput> experiment;
  experiment.add("name", &LoadCaseInput::name,
                 {.type = name, .meaning = "name of the experiment", .required = true});
  Fields<MeasuredInput> measured;
  measured.add("file", &MeasuredInput::file,
               {.type = text,
                .meaning = "CSV file of measured histories, relative to this file",
                .required = true,
                .group = "data"},
               [](MeasuredInput& to, Tree& value, const Reading&) { to.file_at = value.at; });
  add_columns(measured);
  add_signals(measured);
  add_window(
      measured,
      "first and last instant of the data that counts; default: all (of a reference run: all "
      "but its start)");
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

void add_columns(Fields<MeasuredInput>& measured) {
  measured.read("columns",
                {.type = overrides,
                 .meaning = "channel = head of its column in the file, for time and every channel "
                            "compared; a unit stands in brackets at the end of the head"},
                read_columns);
}

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

#include "study/config/measured_keys.h"

#include <fmt/format.h>

#include "study/config/measured_reader.h"

namespace linkstudy {
namespace {

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

void read_offset(MeasuredInput& to, Tree& value, const Reading& reading, bool can_be_fitted) {
  to.offset_at = value.at;
  const bool is_text = value.is(Tree::Kind::text);
  to.fits_offset = can_be_fitted && is_text && value.text == "fit";
  if (to.fits_offset) return;
  to.time_offset = value.as_number();
  if (value.is_numeric()) return;
  const auto quantity = is_text ? split_quantity(value.text) : std::nullopt;
  const auto unit = quantity ? parse_unit(quantity->unit) : std::nullopt;
  const auto seconds = unit ? convert_unit(quantity->value, *unit, *parse_unit("s")) : std::nullopt;
  if (seconds) {
    to.time_offset = *seconds;
    return;
  }
  reading.report(value, fmt::format("time_offset must be a time, got {}", shown(value)),
                 can_be_fitted ? "a number in s, a text such as \"3 ms\", or \"fit\""
                               : "a number in s, or a text such as \"3 ms\"");
}

// A run or data, and of these all that they need.
void check_reference(ReferenceInput& reference, Tree& table, const Reading& reading) {
  reference.at = table.at;
  if (!reference.measured) return;
  MeasuredInput& measured = *reference.measured;
  const Tree* model = table.find("model");
  if (model != nullptr || !reference.set.empty()) {
    reading.diagnostics.add(model != nullptr ? model->at : reference.set.front().origin,
                            "a reference is a run, with model and set, or measured data, with file "
                            "or results, and this one is both",
                            "take one of them out");
  }
  const bool has_results = measured.results && !measured.results->directory.empty();
  if (measured.file.empty() && !has_results) {
    reading.diagnostics.add(
        table.at,
        measured.results ? "this reference names an evaluation or a load case of no results"
                         : "this reference has columns or an offset, and neither file nor results",
        "file = \"measured.csv\", or results = \"results/first\"");
    return;
  }
  check_data(measured, "this reference", measured.file_at, reading.diagnostics);
}

ResultsInput& results_of(MeasuredInput& measured) {
  return measured.results ? *measured.results : measured.results.emplace();
}

}  // namespace

void add_file(Fields<MeasuredInput>& measured, KeyRow row) {
  row.type = KeyType::text;
  row.meaning = "CSV file of measured histories, relative to this file" + row.meaning;
  measured.read("file", std::move(row), [](MeasuredInput& to, Tree& value, const Reading&) {
    to.file = value.text;
    to.file_at = value.at;
  });
}

void add_results(Fields<MeasuredInput>& measured, KeyRow row) {
  row.type = KeyType::text;
  row.meaning =
      "directory of earlier results, or a results.h5, relative to this file: histories of a run "
      "that stand for measurements" +
      row.meaning;
  measured.read("results", std::move(row), [](MeasuredInput& to, Tree& value, const Reading&) {
    results_of(to).directory = value.text;
    to.file_at = value.at;
  });
  measured.read("evaluation",
                {.type = KeyType::integer,
                 .meaning = "whose histories are taken; default: the only one of the results",
                 .range = kNotNegative},
                [](MeasuredInput& to, Tree& value, const Reading&) {
                  results_of(to).evaluation = static_cast<std::uint64_t>(value.integer);
                });
  measured.read("load_case",
                {.type = KeyType::name, .meaning = "of the results, where they have load cases"},
                [](MeasuredInput& to, Tree& value, const Reading&) {
                  results_of(to).load_case = value.text;
                });
}

void add_columns(Fields<MeasuredInput>& measured, const char* meaning) {
  measured.read("columns", {.type = KeyType::overrides, .meaning = meaning}, read_columns);
}

void add_time_offset(Fields<MeasuredInput>& measured, KeyRow row, bool can_be_fitted) {
  row.type = KeyType::scalar;
  measured.read("time_offset", std::move(row),
                [can_be_fitted](MeasuredInput& to, Tree& value, const Reading& reading) {
                  read_offset(to, value, reading, can_be_fitted);
                });
}

void add_reference_data(Fields<ReferenceInput>& reference) {
  Fields<MeasuredInput> measured;
  add_file(measured, {.meaning = ", in place of a run; a match is compared at its instants, by the "
                                 "straight line between two steps",
                      .group = "data"});
  add_results(measured, {.meaning = ", in the same way", .group = "data"});
  add_columns(measured,
              "channel = head of its column in the file, for time and every component that a match "
              "compares (where only one is measured, the match names it: closure.S.force.x); a "
              "unit stands in brackets at the end of the head. Of results: = name of the channel "
              "there; default: reference_signal of the matches");
  add_time_offset(measured, {.meaning = "added to the instants of the data, s; default: 0"}, false);
  const auto part = [](ReferenceInput& of) -> MeasuredInput& {
    if (!of.measured) of.measured.emplace();
    return *of.measured;
  };
  reference.include(part, std::move(measured));
  reference.finish(check_reference);
}

}  // namespace linkstudy

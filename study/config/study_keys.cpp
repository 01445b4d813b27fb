// The keys of kind = "study" and kind = "tune".
#include <string>
#include <vector>

#include "study/config/model_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Rows = std::vector<KeyRow>;

void add_head_rows(Rows& rows, const std::string& kind) {
  add_file_rows(rows, kind);
  rows.push_back({.path = "model",
                  .type = text,
                  .meaning = "model file, relative to this file",
                  .required = true});
  rows.push_back(
      {.path = "reference", .type = table, .meaning = "the run that [[match]] compares with"});
  rows.push_back({.path = "reference.model",
                  .type = text,
                  .meaning = "another model file; default: the same model"});
  rows.push_back(
      {.path = "reference.set",
       .type = overrides,
       .meaning = "model values of the reference: path = value; * for a name: everywhere",
       .standard = "{}"});
  rows.push_back(
      {.path = "base", .type = table, .meaning = "the run that is varied", .standard = "{}"});
  rows.push_back({.path = "base.set",
                  .type = overrides,
                  .meaning = "model values of every case: path = value; * for a name: everywhere",
                  .standard = "{}"});
}

void add_window_row(Rows& rows, const std::string& path) {
  rows.push_back({.path = path + ".window",
                  .type = numbers,
                  .meaning = "first and last time that count; default: the whole run",
                  .unit = "s",
                  .range = kNotNegative,
                  .counts = {2}});
}

void add_parameter_row(Rows& rows, const std::string& path) {
  rows.push_back({.path = path + ".parameter",
                  .type = text,
                  .meaning =
                      "path in the model, such as closure.S.sde.stiffness; * for a name: the "
                      "same value at every place (closure.*.sde.stiffness)",
                  .required = true});
}

void add_match_rows(Rows& rows) {
  rows.push_back(
      {.path = "match", .type = tables, .meaning = "signals compared with the reference"});
  rows.push_back({.path = "match.*.signal",
                  .type = text,
                  .meaning = "channel, such as closure.S.force; every component counts",
                  .required = true});
  rows.push_back(
      {.path = "match.*.reference_signal",
       .type = text,
       .meaning = "channel of the reference, '-' in front turns its sign; default: signal"});
  rows.push_back({.path = "match.*.norm",
                  .type = word,
                  .meaning = "largest or root-mean-square error",
                  .standard = "\"max\"",
                  .words = {"max", "rms"}});
  rows.push_back({.path = "match.*.scale",
                  .type = word,
                  .meaning = "error relative to each component's reference, or to the vector's",
                  .standard = "\"component\"",
                  .words = {"component", "vector"}});
  rows.push_back({.path = "match.*.tolerance",
                  .type = number,
                  .meaning = "largest relative error that still matches",
                  .range = kPositive,
                  .required = true});
  add_window_row(rows, "match.*");
  rows.push_back({.path = "match.*.floor",
                  .type = number,
                  .meaning =
                      "a component whose reference stays under this fraction of the vector's "
                      "is nearly zero and is scaled by that",
                  .range = {.low = 0, .high = 1},
                  .standard = "0.05"});
}

void add_output_rows(Rows& rows) {
  rows.push_back({.path = "response", .type = tables, .meaning = "numbers kept of every run"});
  rows.push_back(
      {.path = "response.*.name", .type = name, .meaning = "name of the number", .required = true});
  rows.push_back({.path = "response.*.signal",
                  .type = text,
                  .meaning = "channel or vector (linkstudy describe channels)",
                  .required = true});
  rows.push_back({.path = "response.*.reduce",
                  .type = word,
                  .meaning = "what is kept of its course",
                  .required = true,
                  .words = {"max", "min", "max_abs", "rms", "mean", "last"}});
  add_window_row(rows, "response.*");
  rows.push_back({.path = "trace", .type = tables, .meaning = "time histories kept"});
  rows.push_back({.path = "trace.*.signals",
                  .type = texts,
                  .meaning = "channels, or groups such as closure.S.force, joint.A, energy",
                  .required = true});
  rows.push_back({.path = "load_case",
                  .type = tables,
                  .meaning = "model values that are run beside each other, each case with all"});
  rows.push_back({.path = "load_case.*.name",
                  .type = name,
                  .meaning = "name of the load case",
                  .required = true});
  rows.push_back({.path = "load_case.*.set",
                  .type = overrides,
                  .meaning = "model values: path = value; * for a name: everywhere",
                  .standard = "{}"});
}

void add_run_rows(Rows& rows) {
  rows.push_back(
      {.path = "run", .type = table, .meaning = "how the evaluations are run", .standard = "{}"});
  rows.push_back({.path = "run.seed",
                  .type = integer,
                  .meaning = "seed of random numbers",
                  .range = kNotNegative,
                  .standard = "1"});
  rows.push_back({.path = "run.timeout",
                  .type = number,
                  .meaning = "longest time of one evaluation; default: none",
                  .unit = "s",
                  .range = kPositive});
  rows.push_back({.path = "run.max_failures",
                  .type = scalar,
                  .meaning = "failed evaluations accepted, a count or \"10 %\"; default: all"});
  rows.push_back({.path = "run.on_failure",
                  .type = word,
                  .meaning = "record: note it and go on; abort: stop",
                  .standard = "\"record\"",
                  .words = {"record", "abort"},
                  .planned = {"refine"}});
}

void add_vary_rows(Rows& rows) {
  rows.push_back(
      {.path = "vary", .type = tables, .meaning = "varied model values", .required = true});
  add_parameter_row(rows, "vary.*");
  rows.push_back({.path = "vary.*.values",
                  .type = scalars,
                  .meaning = "the values: numbers, texts with units, or words",
                  .required = true,
                  .group = "values"});
  rows.push_back({.path = "vary.*.lin",
                  .type = scalars,
                  .meaning = "[first, last, count], equally spaced",
                  .required = true,
                  .counts = {3},
                  .group = "values"});
  rows.push_back({.path = "vary.*.log",
                  .type = scalars,
                  .meaning = "[first, last, count], equal ratios",
                  .required = true,
                  .counts = {3},
                  .group = "values"});
  rows.push_back({.path = "vary.*.ladder",
                  .type = table,
                  .meaning = "from, from*ratio, from*ratio^2, ...",
                  .required = true,
                  .group = "values"});
  rows.push_back(
      {.path = "vary.*.ladder.from", .type = scalar, .meaning = "first value", .required = true});
  rows.push_back({.path = "vary.*.ladder.ratio",
                  .type = number,
                  .meaning = "ratio of neighbours, not 1",
                  .range = kPositive,
                  .required = true});
  rows.push_back({.path = "vary.*.ladder.levels",
                  .type = integer,
                  .meaning = "number of values",
                  .range = {.low = 1, .high = 1.0e6},
                  .required = true});
  rows.push_back({.path = "design",
                  .type = table,
                  .meaning = "how [[vary]] entries combine",
                  .standard = "{}"});
  rows.push_back({.path = "design.type",
                  .type = word,
                  .meaning = "grid: every combination; list: first with first, and so on",
                  .standard = "\"grid\"",
                  .words = {"grid", "list"},
                  .planned = {"centered", "vector", "latin_hypercube", "sobol"}});
}

void add_tune_rows(Rows& rows) {
  rows.push_back({.path = "tune",
                  .type = tables,
                  .meaning = "values whose lowest is wanted",
                  .required = true});
  add_parameter_row(rows, "tune.*");
  rows.push_back(
      {.path = "tune.*.range", .type = table, .meaning = "where to search", .required = true});
  rows.push_back({.path = "tune.*.range.log",
                  .type = scalars,
                  .meaning = "[lowest, highest], searched in decades",
                  .required = true,
                  .counts = {2},
                  .group = "range"});
  rows.push_back({.path = "tune.*.range.lin",
                  .type = scalars,
                  .meaning = "[lowest, highest], searched linearly",
                  .required = true,
                  .counts = {2},
                  .group = "range"});
  rows.push_back(
      {.path = "search", .type = table, .meaning = "how the search goes", .standard = "{}"});
  rows.push_back({.path = "search.scan",
                  .type = integer,
                  .meaning = "points of the first scan over the range",
                  .range = {.low = 2, .high = 10000},
                  .standard = "16"});
  rows.push_back({.path = "search.batch",
                  .type = integer,
                  .meaning = "points evaluated side by side; changes the path of the search",
                  .range = {.low = 1, .high = 1024},
                  .standard = "8"});
  rows.push_back({.path = "search.resolution",
                  .type = number,
                  .meaning = "width in decades at which the search ends",
                  .range = {.low = 0, .high = 1, .low_is_out = true},
                  .standard = "0.001"});
  rows.push_back({.path = "search.max_evaluations",
                  .type = integer,
                  .meaning = "budget of evaluations",
                  .range = {.low = 1, .high = 1.0e6},
                  .standard = "200"});
  rows.push_back({.path = "search.delta",
                  .type = number,
                  .meaning = "certificate: (1 - delta) times the answer must fail",
                  .range = {.low = 0, .high = 1, .low_is_out = true, .high_is_out = true},
                  .standard = "0.02"});
}

}  // namespace

const std::vector<KeyRow>& study_rows() {
  static const Rows rows = [] {
    Rows all;
    add_head_rows(all, "study");
    add_vary_rows(all);
    add_match_rows(all);
    add_output_rows(all);
    add_run_rows(all);
    return all;
  }();
  return rows;
}

const std::vector<KeyRow>& tune_rows() {
  static const Rows rows = [] {
    Rows all;
    add_head_rows(all, "tune");
    add_tune_rows(all);
    add_match_rows(all);
    add_output_rows(all);
    add_run_rows(all);
    return all;
  }();
  return rows;
}

}  // namespace linkstudy

// The keys of the files that vary a model: common ones, and those of their kind.
#include <fmt/format.h>

#include <algorithm>

#include "study/config/calibrate_keys.h"
#include "study/config/common_fields.h"
#include "study/config/measured_keys.h"
#include "study/config/model_keys.h"
#include "study/config/study_checks.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Study = StudyInput;

constexpr const char* kWholeRun = "first and last time that count; default: the whole run";

KeyRow set_row(const char* of) {
  return {.meaning = std::string("model values of ") + of +
                     ": path = value; * for a name: "
                     "everywhere"};
}

void add_reference(Fields<Study>& study) {
  Fields<ReferenceInput> reference;
  reference.read("model", {.type = text, .meaning = "another model file; default: the same model"});
  reference.add("set", &ReferenceInput::set, set_row("the reference"));
  add_reference_data(reference);
  study.table("reference", &Study::reference,
              {.meaning = "what [[match]] compares with: a run, or measured data"},
              std::move(reference));
}

void add_base(Fields<Study>& study) {
  Fields<Study> base;
  base.add("set", &Study::base_set, set_row("every case"));
  study.table("base", {.meaning = "the run that is varied", .standard = "{}"}, std::move(base));
}

template <class Record>
void add_signal(Fields<Record>& record, const char* meaning) {
  record.add("signal", &Record::signal, {.meaning = meaning, .required = true},
             [](Record& to, Tree& value, const Reading&) { to.at = value.at; });
}

template <class Record>
void add_parameter(Fields<Record>& entry) {
  entry.read("parameter",
             {.type = text,
              .meaning = "path in the model, such as closure.S.sde.stiffness; * for a name: the "
                         "same value at every place (closure.*.sde.stiffness)",
              .required = true});
}

// Of a record with members `window` and `cycle`.
template <class Record>
void add_window_or_cycle(Fields<Record>& record, const char* of_what) {
  add_window(record, kWholeRun, "window");
  Fields<CycleInput> cycle;
  cycle.add("of", &CycleInput::of,
            {.meaning = "channel of the joint's angle, such as joint.crank.q", .required = true},
            [](CycleInput& to, Tree& value, const Reading&) { to.at = value.at; });
  cycle.add("turns", &CycleInput::turns,
            {.meaning = "how many full turns", .range = {.low = 1, .high = 1.0e6}});
  record.table("cycle", &Record::cycle, {.meaning = of_what, .group = "window"}, std::move(cycle));
}

Fields<MatchInput> match_fields(FileKind kind) {
  Fields<MatchInput> match;
  add_signal(match, "channel, such as closure.S.force; every component counts");
  match.read("reference_signal",
             {.type = text,
              .meaning = "channel of the reference, '-' in front turns its sign; default: signal",
              .derive = [](const Tree& one) -> std::optional<Tree> {
                const Tree* signal = one.find("signal");
                return signal != nullptr && signal->is_valid() ? std::optional(*signal)
                                                               : std::nullopt;
              }},
             read_reference_signal);
  match.add("norm", &MatchInput::norm, {.meaning = "error that counts"});
  match.add("scale", &MatchInput::scale, {.meaning = "what the error is divided by"});
  KeyRow tolerance{.meaning = "largest relative error that still matches",
                   .range = kPositive,
                   .required = kind != FileKind::converge};
  if (kind == FileKind::tune) {
    tolerance.type = number_or_numbers;
    tolerance.meaning += "; several: an answer for each, the first of every match together";
  }
  if (!tolerance.required) {
    tolerance.meaning = "wanted relative error; default: wanted_error";
    tolerance.derive = [](const Tree&) { return std::optional<Tree>(); };
  }
  match.read("tolerance", std::move(tolerance),
             [](MatchInput& to, Tree& value, const Reading&) { fill_member(to.tolerance, value); });
  add_window_or_cycle(match,
                      "the last full turns of a joint of the reference run, in place of a "
                      "window: the same instants of both runs");
  match.add("floor", &MatchInput::floor,
            {.meaning = "a component whose reference stays under this fraction of the vector's is "
                        "nearly zero and is scaled by that",
             .range = {.low = 0, .high = 1}});
  return match;
}

Fields<ResponseInput> response_fields() {
  Fields<ResponseInput> response;
  response.add("name", &ResponseInput::name,
               {.type = name, .meaning = "name of the number", .required = true},
               [](ResponseInput& to, Tree& value, const Reading&) { to.name_at = value.at; });
  add_signal(response, "channel or vector (linkstudy describe channels)");
  response.add("reduce", &ResponseInput::reduce,
               {.meaning = "what is kept of its course", .required = true});
  add_window_or_cycle(response,
                      "the last full turns of a joint, up to the end of the run, in place of a "
                      "window; a run without them fails (no_full_turn)");
  response.read(
      "where",
      {.type = scalar,
       .meaning = "of max, min and max_abs: true keeps when they are reached (NAME_at), a "
                  "channel also what it has there (NAME_where)"},
      read_place);
  response.finish(check_place);
  return response;
}

void add_matches(Fields<Study>& study, FileKind kind) {
  study.tables("match", &Study::match, {.meaning = "signals compared with the reference"},
               match_fields(kind));
}

void add_responses(Fields<Study>& study) {
  study.tables("response", &Study::response, {.meaning = "numbers kept of every run"},
               response_fields());
}

void add_traces_and_cases(Fields<Study>& study) {
  Fields<Study> trace;
  trace.read("signals",
             {.type = texts,
              .meaning = "channels, or groups such as closure.S.force, joint.A, energy",
              .required = true},
             read_trace);
  study.tables("trace", {.meaning = "time histories kept"}, std::move(trace));
  Fields<LoadCaseInput> load_case;
  load_case.add("name", &LoadCaseInput::name,
                {.type = name, .meaning = "name of the load case", .required = true});
  load_case.add("set", &LoadCaseInput::set, set_row("the load case"));
  Fields<ReferenceInput> reference;
  add_reference_data(reference);
  load_case.table("reference", &LoadCaseInput::reference,
                  {.meaning = "data measured in this load case; default: the [reference] of all"},
                  std::move(reference));
  load_case.finish([](LoadCaseInput& to, Tree& table, const Reading&) { to.at = table.at; });
  study.tables("load_case", &Study::load_case,
               {.meaning = "model values that are run beside each other, each case with all"},
               std::move(load_case));
}

void add_run(Fields<Study>& study) {
  Fields<RunOptions> run;
  run.add("seed", &RunOptions::seed, {.meaning = "seed of random numbers", .range = kNotNegative});
  run.add("timeout", &RunOptions::timeout,
          {.meaning = "longest time of one evaluation; default: none",
           .unit = "s",
           .range = kPositive});
  run.read(
      "max_failures",
      {.type = scalar, .meaning = "failed evaluations accepted, a count or \"10 %\"; default: all"},
      read_failure_limit);
  run.add("on_failure", &RunOptions::on_failure, {.planned = {"refine"}});
  study.table("run", &Study::run, {.meaning = "how the evaluations are run", .standard = "{}"},
              std::move(run));
}

template <class Record>
Fields<Record> ladder_fields() {
  Fields<Record> ladder;
  ladder.read("from", {.type = scalar, .meaning = "first value", .required = true});
  ladder.read("ratio",
              {.meaning = "ratio of neighbours, not 1", .range = kPositive, .required = true});
  ladder.read("levels", {.type = integer,
                         .meaning = "number of values",
                         .range = {.low = 1, .high = 1.0e6},
                         .required = true});
  return ladder;
}

// Their values are of the units of the model: study_reader.cpp reads them. `counts`: entries of lin
// and log, which axis_reader.cpp tells apart by the design.
template <class Record>
void add_values(Fields<Record>& vary, const std::vector<int>& counts,
                const std::string& else_range) {
  add_parameter(vary);
  const auto add_list = [&](const char* key, const std::string& meaning, std::vector<int> lengths) {
    vary.read(key, {.type = scalars, .meaning = meaning, .required = true, .group = "values"});
    vary.back().counts = std::move(lengths);
  };
  add_list("values", "the values: numbers, texts with units, or words", {});
  add_list("lin", "[first, last, count], equally spaced" + else_range, counts);
  add_list("log", "[first, last, count], equal ratios" + else_range, counts);
  vary.table(
      "ladder",
      {.meaning = "from, from*ratio, from*ratio^2, ...", .required = true, .group = "values"},
      ladder_fields<Record>());
}

Fields<Study> around_fields() {
  Fields<Study> around;
  around.read("center", {.type = scalar, .meaning = "the middle; default: the model's value"});
  around.read("step", {.type = scalar,
                       .meaning = "difference of neighbours",
                       .required = true,
                       .group = "spacing"});
  around.read("ratio", {.meaning = "ratio of neighbours, not 1",
                        .range = kPositive,
                        .required = true,
                        .group = "spacing"});
  around.read("steps", {.type = integer,
                        .meaning = "number of values on either side",
                        .range = {.low = 1, .high = 1.0e6},
                        .required = true});
  return around;
}

void add_distributions(Fields<Study>& vary) {
  const auto add = [](Fields<Study>& table, const char* key, const char* meaning, bool required) {
    table.read(key, {.type = scalar, .meaning = meaning, .required = required});
  };
  Fields<Study> normal;
  add(normal, "mean", "of the distribution without bounds", true);
  add(normal, "deviation", "standard deviation of the same", true);
  add(normal, "low", "no sample is below; default: no bound", false);
  add(normal, "high", "no sample is above; default: no bound", false);
  vary.table("normal",
             {.meaning = "samples follow a normal distribution, cut off at its bounds; without "
                         "them they reach 8.2 deviations",
              .required = true,
              .group = "values"},
             std::move(normal));
  Fields<Study> triangular;
  add(triangular, "low", "no sample is below", true);
  add(triangular, "mode", "the most likely value", true);
  add(triangular, "high", "no sample is above", true);
  vary.table(
      "triangular",
      {.meaning = "samples follow a triangular distribution", .required = true, .group = "values"},
      std::move(triangular));
}

Fields<DesignOptions> design_fields() {
  using enum Design;
  Fields<DesignOptions> design;
  design.add("type", &DesignOptions::type, {.meaning = "which points"});
  design.add("samples", &DesignOptions::samples,
             {.meaning = "number of samples; of saltelli of blocks of 2 + parameters points. "
                         "Powers of two are best; of latin_hypercube twice as many keep the "
                         "earlier ones, of the others any more do",
              .range = {.low = 1, .high = 1.0e8},
              .required = true,
              .only = only_where("type", {latin_hypercube, sobol, saltelli})});
  design.add("steps", &DesignOptions::steps,
             {.meaning = "number of steps from first to last",
              .range = {.low = 1, .high = 1.0e6},
              .required = true,
              .only = only_where("type", {vector})});
  design.add("trajectories", &DesignOptions::trajectories,
             {.meaning = "number of trajectories of 1 + parameters points",
              .range = {.low = 2, .high = 1.0e8},
              .required = true,
              .only = only_where("type", {morris})});
  design.add("levels", &DesignOptions::levels,
             {.meaning = "levels of every range, an even number",
              .range = {.low = 2, .high = 1.0e6},
              .only = only_where("type", {morris})},
             [](DesignOptions& to, Tree& value, const Reading& reading) {
               if (to.levels % 2 == 0) return;
               reading.report(value, fmt::format("design: levels must be even, got {}", to.levels),
                              "all levels are as likely then: 4, 6 or 8");
             });
  design.read("file", {.type = text,
                       .meaning = "CSV file, relative to this file, that holds the points, in "
                                  "place of [[vary]]: a column a parameter, a unit in brackets at "
                                  "the end of its head",
                       .only = only_where("type", {list})});
  design.read("columns", {.type = overrides,
                          .meaning = "parameter = head of its column in file; default: heads are "
                                     "the parameters' paths, as plan --csv writes them",
                          .only = only_where("type", {list})});
  design.finish([](DesignOptions& to, Tree& table, const Reading& reading) {
    if (to.type == saltelli && to.samples == 1) {
      reading.diagnostics.add(
          table.find("samples")->at,
          "design: samples of saltelli are blocks, and one tells nothing, got 1",
          "take 64 or more");
    }
    const Tree* columns = table.find("columns");
    if (columns == nullptr || table.find("file") != nullptr) return;
    reading.diagnostics.add(columns->at, "design: columns are those of a file, and none is given",
                            "add file = \"points.csv\", or leave columns out");
  });
  return design;
}

void add_vary(Fields<Study>& study) {
  Fields<Study> vary;
  add_values(vary, {2, 3}, "; of a vector [first, last], of samples [lowest, highest]");
  vary.table("around",
             {.meaning = "steps to both sides of a centre", .required = true, .group = "values"},
             around_fields());
  add_distributions(vary);
  study.tables("vary", {.meaning = "varied model values; without any the model runs once"},
               std::move(vary));
  study.table("design", &Study::design,
              {.meaning = "how [[vary]] entries combine", .standard = "{}"}, design_fields());
}

void add_objective(Fields<Study>& study) {
  Fields<ObjectiveInput> objective;
  const auto add = [&](const char* key, const char* meaning, bool maximizes) {
    objective.read(key, {.type = text, .meaning = meaning, .required = true, .group = "objective"},
                   [maximizes](ObjectiveInput& to, Tree& value, const Reading&) {
                     to = {value.text, maximizes, value.at};
                   });
  };
  add("minimize", "a tuned value, or a response: of several components or load cases the largest",
      false);
  add("maximize", "the same, the smallest as large as it may be", true);
  study.table("objective", &Study::objective,
              {.meaning = "what is best among the points that match; default: the least sum of the "
                          "log10 of the tuned values"},
              std::move(objective));
}

void add_limits(Fields<Study>& study) {
  Fields<LimitInput> limit;
  limit.add("response", &LimitInput::response,
            {.meaning = "[[response]], one component of it (peak_x), or a number that is always "
                        "kept (gap_max, drift_max, energy_residual_max, contacts, ...)",
             .required = true},
            [](LimitInput& to, Tree& value, const Reading&) { to.at = value.at; });
  const auto add = [&](const char* key, const char* meaning,
                       std::optional<Tree> LimitInput::*member) {
    limit.read(key, {.type = scalar, .meaning = meaning, .required = true, .group = "bound"},
               [member](LimitInput& to, Tree& value, const Reading&) { to.*member = value; });
  };
  add("at_most", "number in the response's unit, or text with a unit", &LimitInput::at_most);
  add("at_least", "likewise", &LimitInput::at_least);
  study.tables("limit", &Study::limit,
               {.meaning = "bounds on responses that a tuned point must keep, beside the matches"},
               std::move(limit));
}

void add_tune(Fields<Study>& study) {
  Fields<Study> tune;
  add_parameter(tune);
  tune.table(
      "range", {.meaning = "where to search", .required = true},
      range_fields<Study>("[lowest, highest], searched in decades",
                          "[lowest, highest], searched linearly: for values that may be zero "
                          "or negative"));
  study.tables("tune", {.meaning = "values whose lowest is wanted", .required = true},
               std::move(tune));
  add_objective(study);
  add_limits(study);
  Fields<SearchOptions> search;
  search.add("scan", &SearchOptions::scan,
             {.meaning = "points of the first scan over the range; of several values along the "
                         "diagonal of their ranges, and as many for each further one in the box",
              .range = {.low = 2, .high = 10000}});
  search.add("batch", &SearchOptions::batch,
             {.meaning = "points evaluated side by side; changes the path of the search",
              .range = {.low = 1, .high = 1024}});
  search.add(
      "resolution", &SearchOptions::resolution,
      {.meaning = "width in decades, or in parts of a linear range, at which the search ends",
       .range = {.low = 0, .high = 1, .low_is_out = true}});
  search.add("max_evaluations", &SearchOptions::max_evaluations,
             {.meaning = "budget of evaluations of each answer; default: 200, of two values 1500, "
                         "of more 4000",
              .range = {.low = 1, .high = 1.0e6}});
  search.add(
      "delta", &SearchOptions::delta,
      {.meaning = "certificate: (1 - delta) times the answer must fail; of a linear range the "
                  "answer less delta of the range",
       .range = {.low = 0, .high = 1, .low_is_out = true, .high_is_out = true}});
  search.add("gap", &SearchOptions::gap,
             {.meaning = "of two or three values: decades of the sum of log10 by which a lower "
                         "match is to be excluded, if errors are monotone",
              .range = {.low = 0.001, .high = 10}});
  search.add("mu", &SearchOptions::mu,
             {.meaning = "of the same proof: relative rise of an error with a stiffer joint that "
                         "is put down to noise; twice the worst rise seen, where that is more",
              .range = {.low = 0, .high = 1}});
  search.add("steps", &SearchOptions::steps,
             {.meaning = "steps of integration, an answer for each: the map of value and step; "
                         "default: that of the model",
              .unit = "s",
              .range = kPositive});
  study.table("search", &Study::search, {.meaning = "how the search goes", .standard = "{}"},
              std::move(search));
}

// Values that stand for fineness by their size; all others are the size of something that ends.
std::optional<Tree> usual_limit(const Tree& refine) {
  const Tree* parameter = refine.find("parameter");
  if (parameter == nullptr || !parameter->is(Tree::Kind::text)) return std::nullopt;
  const std::vector<std::string> parts = split_path(parameter->text);
  const bool grows = std::ranges::any_of(parts, [](const std::string& part) {
    return part == "stiffness" || part == "segments" || part == "young" || part == "shear";
  });
  const RefineLimit limit = grows ? RefineLimit::infinity : RefineLimit::zero;
  return Tree::make_text(std::string(name_of(limit)), parameter->at);
}

void add_refine(Fields<Study>& study) {
  Fields<RefineInput> refine;
  add_values(refine, {3}, "");
  refine.add("limit", &RefineInput::limit,
             {.meaning = "where finer values lead; default: infinity of stiffness, segments, young "
                         "and shear, else zero",
              .derive = usual_limit});
  refine.add("formal_order", &RefineInput::formal_order,
             {.meaning = "order that the method should show; default: that of the integrator, 1 of "
                         "stiffness, 2 of segments",
              .range = kPositive});
  study.tables("refine", &Study::refine,
               {.meaning = "the ladder, or two: each is judged at every value of the other that "
                           "matters",
                .required = true},
               std::move(refine));
  Fields<SeriesInput> series;
  add_signal(series,
             "channel, vector or group; its time histories are compared with those of the "
             "next level at the instants that all levels keep");
  series.add("norm", &SeriesInput::norm, {.meaning = "of a difference"});
  add_window(series, kWholeRun);
  study.tables("series", &Study::series, {.meaning = "time histories that are refined"},
               std::move(series));
  study.add("wanted_error", &Study::wanted_error,
            {.meaning = "relative error for which the coarsest sufficient level is told",
             .range = kPositive});
  study.add("rounding", &Study::rounding,
            {.meaning = "relative differences below it are rounding and show no order",
             .range = kNotNegative});
}

}  // namespace

std::vector<KeyRow> make_study_rows(FileKind kind) {
  Fields<Study> study;
  add_file_fields(study, std::string(name_of(kind)));
  study.read("model",
             {.type = text, .meaning = "model file, relative to this file", .required = true});
  const bool is_calibration = kind == FileKind::calibrate;
  if (!is_calibration) add_reference(study);
  add_base(study);
  if (kind == FileKind::study) add_vary(study);
  if (kind == FileKind::tune) add_tune(study);
  if (kind == FileKind::converge) add_refine(study);
  if (is_calibration) study.append(calibration_fields());
  if (!is_calibration) add_matches(study, kind);
  add_responses(study);
  if (!is_calibration) add_traces_and_cases(study);
  add_run(study);
  return study.rows();
}

}  // namespace linkstudy

#include "study/store/results_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace linkstudy {
namespace {

template <class Row, class Field>
auto column_of(const std::vector<Row>& rows, Field field) {
  std::vector<std::decay_t<decltype(field(rows.front()))>> values;
  values.reserve(rows.size());
  for (const Row& row : rows) {
    values.push_back(field(row));
  }
  return values;
}

DataColumn evaluation_axis(const std::vector<Evaluation>& evaluations) {
  return {
      "evaluation",
      "",
      "position in the declared design",
      "axis",
      column_of(evaluations, [](const auto& e) { return static_cast<std::int64_t>(e.point.id); }),
      {}};
}

template <class Kind>
std::vector<Kind> parameter_values(const std::vector<Evaluation>& evaluations,
                                   const Parameter& parameter, std::size_t index) {
  std::vector<Kind> values;
  values.reserve(evaluations.size());
  for (const Evaluation& evaluation : evaluations) {
    const std::vector<Value>& point = evaluation.point.values;
    if (index >= point.size() || !std::holds_alternative<Kind>(point[index])) {
      throw std::invalid_argument(
          fmt::format("evaluation {}: parameter '{}' has no value or mixes numbers and words",
                      evaluation.point.id, parameter.path));
    }
    values.push_back(std::get<Kind>(point[index]));
  }
  return values;
}

DataColumn parameter_column(const std::vector<Evaluation>& evaluations, const Parameter& parameter,
                            std::size_t index) {
  DataColumn column{parameter.path, parameter.unit, parameter.long_name, "parameter", {}, {}};
  const bool words = !evaluations.empty() && index < evaluations[0].point.values.size() &&
                     std::holds_alternative<std::string>(evaluations[0].point.values[index]);
  if (words) {
    column.values = parameter_values<std::string>(evaluations, parameter, index);
  } else {
    column.values = parameter_values<double>(evaluations, parameter, index);
  }
  return column;
}

double response_of(const Evaluation& evaluation, std::size_t index) {
  return index < evaluation.responses.size() ? evaluation.responses[index]
                                             : std::numeric_limits<double>::quiet_NaN();
}

// By number.
std::vector<std::string> cause_names() {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kWords<Cause>.size(); ++i) {
    names.emplace_back(name_of(static_cast<Cause>(i)));
  }
  return names;
}

void add_outcome(DataGroup& group, const std::vector<Evaluation>& evaluations) {
  group.columns.push_back(
      {"status", "", "why the evaluation ended", "status",
       column_of(evaluations, [](const auto& e) { return static_cast<std::uint8_t>(e.status); }),
       cause_names()});
  group.columns.push_back({"message",
                           "",
                           "reason in words",
                           "message",
                           column_of(evaluations, [](const auto& e) { return e.message; }),
                           {}});
  group.columns.push_back(
      {"attempts",
       "",
       "times the evaluation was run",
       "attempts",
       column_of(evaluations, [](const auto& e) { return std::int64_t{e.attempts}; }),
       {}});
  group.columns.push_back({"parent_evaluation",
                           "",
                           "evaluation that this one refines, or -1",
                           "parent",
                           column_of(evaluations, [](const auto& e) { return e.parent; }),
                           {}});
}

}  // namespace

DataGroup study_group(const StudyDescription& description,
                      const std::vector<Evaluation>& evaluations) {
  DataGroup group{"study", {evaluation_axis(evaluations)}, {}, {}};
  group.attributes = {{"name", description.name}, {"kind", description.kind}};
  for (std::size_t i = 0; i < description.parameters.size(); ++i) {
    group.columns.push_back(parameter_column(evaluations, description.parameters[i], i));
  }
  for (std::size_t i = 0; i < description.responses.size(); ++i) {
    const Response& response = description.responses[i];
    group.columns.push_back(
        {response.name,
         response.unit,
         response.long_name,
         "response",
         column_of(evaluations, [i](const auto& e) { return response_of(e, i); }),
         {}});
  }
  add_outcome(group, evaluations);
  return group;
}

DataGroup runtime_group(const std::vector<Evaluation>& evaluations) {
  DataGroup group{"runtime", {evaluation_axis(evaluations)}, {}, {}};
  group.columns.push_back({"wall_s",
                           "s",
                           "wall time of the evaluation; of those that ran side by side, the "
                           "time of all divided by their number",
                           "runtime",
                           column_of(evaluations, [](const auto& e) { return e.wall_s; }),
                           {}});
  group.columns.push_back(
      {"rank",
       "",
       "MPI rank that ran it",
       "runtime",
       column_of(evaluations, [](const auto& e) { return std::int64_t{e.rank}; }),
       {}});
  group.columns.push_back({"host",
                           "",
                           "computer that ran it",
                           "runtime",
                           column_of(evaluations, [](const auto& e) { return e.host; }),
                           {}});
  return group;
}

DataGroup provenance_group(const std::vector<ProvenanceRow>& rows,
                           const std::vector<NamedText>& texts) {
  DataGroup group;
  group.name = "provenance";
  const auto add = [&](const char* name, const char* unit, const char* long_name,
                       ColumnValues values) {
    group.columns.push_back({name, unit, long_name, "provenance", std::move(values), {}});
  };
  using Row = ProvenanceRow;
  add("event", "", "start or resume", column_of(rows, [](const Row& r) { return r.event; }));
  add("time", "seconds since 1970-01-01 00:00:00", "when, UTC",
      column_of(rows, [](const Row& r) { return r.time_unix_s; }));
  add("total", "", "evaluations in the design, 0 where not known beforehand",
      column_of(rows, [](const Row& r) { return static_cast<std::int64_t>(r.total); }));
  add("ranks", "", "MPI ranks",
      column_of(rows, [](const Row& r) { return std::int64_t{r.ranks}; }));
  add("host", "", "computer of rank 0", column_of(rows, [](const Row& r) { return r.host; }));
  add("program_version", "", "version of linkstudy",
      column_of(rows, [](const Row& r) { return r.program_version; }));
  add("git_revision", "", "revision it was built from",
      column_of(rows, [](const Row& r) { return r.git_revision; }));
  add("simd", "", "instruction set of the step loops on rank 0",
      column_of(rows, [](const Row& r) { return r.simd; }));
  add("lanes", "", "evaluations that run side by side on rank 0",
      column_of(rows, [](const Row& r) { return std::int64_t{r.lanes}; }));
  add("job", "", "job of the queue that started it, empty without",
      column_of(rows, [](const Row& r) { return r.job; }));
  add("restart", "", "how often that job was requeued before",
      column_of(rows, [](const Row& r) { return std::int64_t{r.restart}; }));
  add("command", "", "command line", column_of(rows, [](const Row& r) { return r.command; }));
  for (const NamedText& text : texts) {
    group.attributes.push_back({text.name, text.text});
  }
  return group;
}

DataGroup traces_group(const TraceSet& set) {
  DataGroup group;
  group.name = set.name;
  group.compressed = true;
  group.attributes = {{"evaluation", set.evaluation}};
  for (const Trace& trace : set.traces) {
    const bool axis = trace.name == "time";
    const auto at = axis ? group.columns.begin() : group.columns.end();
    group.columns.insert(
        at, {trace.name, trace.unit, trace.name, axis ? "axis" : "channel", trace.values, {}});
  }
  return group;
}

}  // namespace linkstudy

#include "study/store/results_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

namespace linkstudy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Column evaluation_axis(const std::vector<Evaluation>& evaluations) {
  return {
      "evaluation", "", "position in the declared design", "axis",
      column_of(evaluations, [](const auto& e) { return static_cast<std::int64_t>(e.point.id); })};
}

template <class Kind>
std::vector<Kind> parameter_values(const std::vector<Evaluation>& evaluations,
                                   const Parameter& parameter, std::size_t index) {
  return column_of(evaluations, [&](const Evaluation& evaluation) {
    const std::vector<Value>& point = evaluation.point.values;
    if (index >= point.size() || !std::holds_alternative<Kind>(point[index])) {
      throw std::invalid_argument(
          fmt::format("evaluation {}: parameter '{}' has no value or mixes numbers and words",
                      evaluation.point.id, parameter.path));
    }
    return std::get<Kind>(point[index]);
  });
}

Column parameter_column(const std::vector<Evaluation>& evaluations, const Parameter& parameter,
                        std::size_t index) {
  Column column{parameter.path, parameter.unit, parameter.long_name, "parameter"};
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
  return index < evaluation.responses.size() ? evaluation.responses[index] : kNan;
}

// What is derived of the points, NaN where it is of others only.
void add_derived(Table& group, const std::vector<Evaluation>& evaluations) {
  std::map<std::string, std::size_t> known;
  for (const Column& column : group.columns) known.emplace(column.name, 0);
  for (std::size_t row = 0; row < evaluations.size(); ++row) {
    for (const Trace& one : evaluations[row].derived) {
      const auto [at, is_new] = known.emplace(one.name, group.columns.size());
      if (is_new) {
        group.columns.push_back({one.name, one.unit, "what the input says in other terms",
                                 "derived", std::vector<double>(evaluations.size(), kNan)});
      }
      if (at->second == 0 || one.values.empty()) continue;  // a parameter says it
      std::get<std::vector<double>>(group.columns[at->second].values)[row] = one.values.front();
    }
  }
}

void add_outcome(Table& group, const std::vector<Evaluation>& evaluations) {
  group.columns.push_back(
      {"status", "", "why the evaluation ended", "status",
       column_of(evaluations, [](const auto& e) { return static_cast<std::uint8_t>(e.status); }),
       cause_words()});
  const auto add = [&](const char* name, const char* meaning, const char* role, auto field) {
    group.columns.push_back({name, "", meaning, role, column_of(evaluations, field)});
  };
  add("message", "reason in words", "message", [](const Evaluation& e) { return e.message; });
  add("attempts", "times the evaluation was run", "attempts",
      [](const Evaluation& e) { return std::int64_t{e.attempts}; });
  add("parent_evaluation", "evaluation that this one refines, or -1", "parent",
      [](const Evaluation& e) { return e.parent; });
}

}  // namespace

Table study_group(const StudyDescription& description, const std::vector<Evaluation>& evaluations) {
  Table group{"study", {evaluation_axis(evaluations)}};
  group.attributes = {{"name", description.name}, {"kind", description.kind}};
  for (std::size_t i = 0; i < description.parameters.size(); ++i) {
    group.columns.push_back(parameter_column(evaluations, description.parameters[i], i));
  }
  for (std::size_t i = 0; i < description.responses.size(); ++i) {
    const Response& response = description.responses[i];
    group.columns.push_back(
        {response.name, response.unit, response.long_name, "response",
         column_of(evaluations, [i](const auto& e) { return response_of(e, i); })});
  }
  add_outcome(group, evaluations);
  add_derived(group, evaluations);
  return group;
}

Table runtime_group(const std::vector<Evaluation>& evaluations) {
  Table group{"runtime", {evaluation_axis(evaluations)}};
  const auto add = [&](const char* name, const char* unit, const char* meaning, auto field) {
    group.columns.push_back({name, unit, meaning, "runtime", column_of(evaluations, field)});
  };
  add("wall_s", "s",
      "wall time of the evaluation; of those that ran side by side, the time of all divided by "
      "their number",
      [](const Evaluation& e) { return e.wall_s; });
  add("rank", "", "MPI rank that ran it", [](const Evaluation& e) { return std::int64_t{e.rank}; });
  add("host", "", "computer that ran it", [](const Evaluation& e) { return e.host; });
  return group;
}

Table provenance_group(const std::vector<ProvenanceRow>& rows,
                       const std::vector<NamedText>& texts) {
  using Launched = ProvenanceRow;
  Table group{"provenance"};
  const auto add = [&](const char* name, const char* unit, const char* meaning, auto field) {
    group.columns.push_back({name, unit, meaning, "provenance", column_of(rows, field)});
  };
  const auto count = [](auto number) { return static_cast<std::int64_t>(number); };
  add("event", "", "start or resume", [](const Launched& r) { return r.event; });
  add("time", "seconds since 1970-01-01 00:00:00", "when, UTC",
      [](const Launched& r) { return r.time_unix_s; });
  group.columns.back().format = "{:.0f}";
  add("total", "", "evaluations in the design, 0 where not known beforehand",
      [&](const Launched& r) { return count(r.total); });
  add("ranks", "", "MPI ranks", [&](const Launched& r) { return count(r.ranks); });
  add("host", "", "computer of rank 0", [](const Launched& r) { return r.host; });
  add("program_version", "", "version of linkstudy",
      [](const Launched& r) { return r.program_version; });
  add("git_revision", "", "revision it was built from",
      [](const Launched& r) { return r.git_revision; });
  add("simd", "", "instruction set of the step loops on rank 0",
      [](const Launched& r) { return r.simd; });
  add("lanes", "", "evaluations that run side by side on rank 0",
      [&](const Launched& r) { return count(r.lanes); });
  add("job", "", "job of the queue that started it, empty without",
      [](const Launched& r) { return r.job; });
  add("restart", "", "how often that job was requeued before",
      [&](const Launched& r) { return count(r.restart); });
  add("command", "", "command line", [](const Launched& r) { return r.command; });
  for (const NamedText& text : texts) group.attributes.push_back({text.name, text.text});
  return group;
}

Table traces_group(const TraceSet& set) {
  Table group{set.name};
  group.compressed = true;
  group.attributes = {{"evaluation", set.evaluation}};
  for (const Trace& trace : set.traces) {
    const bool axis = trace.name == "time";
    const auto at = axis ? group.columns.begin() : group.columns.end();
    group.columns.insert(
        at, {trace.name, trace.unit, trace.name, axis ? "axis" : "channel", trace.values});
  }
  return group;
}

}  // namespace linkstudy

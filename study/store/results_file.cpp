#include "study/store/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "study/record/digest.h"
#include "study/store/group_file.h"
#include "study/store/results_tree.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

constexpr std::string_view kFormat = "linkstudy results";
constexpr std::int64_t kFormatVersion = 1;
constexpr std::array<std::string_view, 3> kRunStatusNames = {"running", "complete", "interrupted"};

constexpr std::string_view kReferencePrefix = "reference";
constexpr std::string_view kTuningPrefix = "tuning/";

void add_groups(DataGroup& root, const std::string& name, std::vector<DataGroup> groups) {
  if (!groups.empty()) {
    root.groups.push_back({name, {}, {}, std::move(groups)});
  }
}

std::vector<DataGroup> trace_groups(const std::vector<TraceSet>& sets) {
  std::vector<DataGroup> groups;
  std::ranges::transform(sets, std::back_inserter(groups), traces_group);
  return groups;
}

// Part of the tree, or an empty one where the file has none.
const DataGroup& part(const DataGroup& tree, std::string_view name) {
  static const DataGroup empty;
  const DataGroup* found = find_group(tree, name);
  return found == nullptr ? empty : *found;
}

template <class Type>
Type attribute(const DataGroup& group, std::string_view name) {
  const DataAttribute* found = find_attribute(group, name);
  const Type* value = found == nullptr ? nullptr : std::get_if<Type>(&found->value);
  if (value == nullptr) {
    throw StoreError(fmt::format("group '{}' has no attribute '{}'", group.name, name));
  }
  return *value;
}

template <class Type>
const std::vector<Type>& values_of(const DataGroup& group, std::string_view name) {
  const DataColumn* found = find_column(group, name);
  const auto* values = found == nullptr ? nullptr : std::get_if<std::vector<Type>>(&found->values);
  if (values == nullptr) {
    throw StoreError(fmt::format("group '{}' has no column '{}'", group.name, name));
  }
  return *values;
}

// The column of a role: a parameter may have the name of an outcome, its role tells them apart.
template <class Type>
const std::vector<Type>& values_with_role(const DataGroup& group, std::string_view role) {
  const auto found = std::ranges::find(group.columns, role, &DataColumn::role);
  if (found == group.columns.end() || !std::holds_alternative<std::vector<Type>>(found->values)) {
    throw StoreError(fmt::format("group '{}' has no column of role '{}'", group.name, role));
  }
  return std::get<std::vector<Type>>(found->values);
}

void read_parameter(const DataColumn& column, std::vector<Evaluation>& evaluations) {
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    std::vector<Value>& point = evaluations[i].point.values;
    if (const auto* words = std::get_if<std::vector<std::string>>(&column.values)) {
      point.emplace_back((*words)[i]);
    } else {
      point.emplace_back(std::get<std::vector<double>>(column.values)[i]);
    }
  }
}

void read_columns(const DataGroup& study, StudyResults& results) {
  for (const DataColumn& column : study.columns) {
    if (column.role == "parameter") {
      results.description.parameters.push_back({column.name, column.unit, column.long_name});
      read_parameter(column, results.evaluations);
    } else if (column.role == "response") {
      results.description.responses.push_back({column.name, column.unit, column.long_name});
      const auto& values = std::get<std::vector<double>>(column.values);
      for (std::size_t i = 0; i < results.evaluations.size(); ++i) {
        results.evaluations[i].responses.push_back(values[i]);
      }
    }
  }
}

Cause cause_of(std::uint8_t number) {
  if (number >= kWords<Cause>.size()) {
    throw StoreError(fmt::format("unknown status {}", number));
  }
  return static_cast<Cause>(number);
}

void read_study(const DataGroup& study, const DataGroup& runtime, StudyResults& results) {
  const auto& ids = values_with_role<std::int64_t>(study, "axis");
  const auto& status = values_with_role<std::uint8_t>(study, "status");
  const auto& message = values_with_role<std::string>(study, "message");
  const auto& attempts = values_with_role<std::int64_t>(study, "attempts");
  const auto& parents = values_with_role<std::int64_t>(study, "parent");
  const auto& wall_s = values_of<double>(runtime, "wall_s");
  const auto& rank = values_of<std::int64_t>(runtime, "rank");
  const auto& host = values_of<std::string>(runtime, "host");
  results.evaluations.resize(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    Evaluation& evaluation = results.evaluations[i];
    evaluation.point.id = static_cast<std::uint64_t>(ids[i]);
    evaluation.status = cause_of(status[i]);
    evaluation.message = message[i];
    evaluation.attempts = static_cast<std::uint32_t>(attempts[i]);
    evaluation.parent = parents[i];
    evaluation.wall_s = wall_s[i];
    evaluation.rank = static_cast<std::int32_t>(rank[i]);
    evaluation.host = host[i];
  }
  read_columns(study, results);
}

void read_provenance(const DataGroup& group, StudyResults& results) {
  const auto& event = values_of<std::string>(group, "event");
  const auto& time = values_of<double>(group, "time");
  const auto& total = values_of<std::int64_t>(group, "total");
  const auto& ranks = values_of<std::int64_t>(group, "ranks");
  const auto& host = values_of<std::string>(group, "host");
  const auto& version = values_of<std::string>(group, "program_version");
  const auto& revision = values_of<std::string>(group, "git_revision");
  const auto& command = values_of<std::string>(group, "command");
  const bool has_lanes = find_column(group, "lanes") != nullptr;
  for (std::size_t i = 0; i < event.size(); ++i) {
    results.provenance.push_back({event[i], time[i], static_cast<std::uint64_t>(total[i]),
                                  static_cast<std::uint32_t>(ranks[i]), host[i], version[i],
                                  revision[i], command[i], "", 1});
    if (!has_lanes) continue;
    results.provenance.back().simd = values_of<std::string>(group, "simd")[i];
    results.provenance.back().lanes =
        static_cast<std::uint32_t>(values_of<std::int64_t>(group, "lanes")[i]);
  }
  for (const DataAttribute& text : group.attributes) {
    results.texts.push_back({text.name, attribute<std::string>(group, text.name)});
  }
}

std::vector<TraceSet> read_traces(const DataGroup& parent) {
  std::vector<TraceSet> sets;
  for (const DataGroup& group : parent.groups) {
    TraceSet set{group.name, attribute<std::int64_t>(group, "evaluation"), {}};
    for (const DataColumn& column : group.columns) {
      set.traces.push_back(
          {column.name, column.unit, std::get<std::vector<double>>(column.values)});
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

RunStatus run_status(const std::string& name) {
  const auto found = std::ranges::find(kRunStatusNames, name);
  if (found == kRunStatusNames.end()) {
    throw StoreError(fmt::format("unknown status '{}'", name));
  }
  return static_cast<RunStatus>(found - kRunStatusNames.begin());
}

void require_format(const DataGroup& tree) {
  const DataAttribute* format = find_attribute(tree, "format");
  if (format == nullptr || format->value != DataAttribute{"", std::string(kFormat)}.value) {
    throw StoreError("not a results file of linkstudy");
  }
  const auto version = attribute<std::int64_t>(tree, "format_version");
  if (version != kFormatVersion) {
    throw StoreError(
        fmt::format("results format {}, this program reads {}; write it again with "
                    "'linkstudy study'",
                    version, kFormatVersion));
  }
}

}  // namespace

DataGroup tree_of(const StudyResults& results) {
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  const StudyDescription& description = results.description;
  DataGroup root;
  root.attributes = {
      {"format", std::string(kFormat)},
      {"format_version", kFormatVersion},
      {"status", std::string(kRunStatusNames[static_cast<std::size_t>(results.status)])},
      {"input_sha256", results.input_sha256},
      {"results_digest",
       results_digest(description.parameters, description.responses, evaluations)},
      {"seed", description.seed},
      {"program_version", results.program_version},
      {"git_revision", results.git_revision}};
  root.groups.push_back(study_group(description, evaluations));
  add_groups(root, "reference", trace_groups(results.references));
  add_groups(root, "traces", trace_groups(results.traces));
  add_groups(root, "tuning", results.tunings);
  add_groups(root, "convergence", results.convergences);
  root.groups.push_back(runtime_group(evaluations));
  root.groups.push_back(provenance_group(results.provenance, results.texts));
  return root;
}

StudyResults results_of(const DataGroup& tree) {
  require_format(tree);
  StudyResults results;
  results.status = run_status(attribute<std::string>(tree, "status"));
  results.input_sha256 = attribute<std::string>(tree, "input_sha256");
  results.results_digest = attribute<std::string>(tree, "results_digest");
  results.description.seed = attribute<std::uint64_t>(tree, "seed");
  results.program_version = attribute<std::string>(tree, "program_version");
  results.git_revision = attribute<std::string>(tree, "git_revision");
  const DataGroup& study = part(tree, "study");
  results.description.name = attribute<std::string>(study, "name");
  results.description.kind = attribute<std::string>(study, "kind");
  read_study(study, part(tree, "runtime"), results);
  read_provenance(part(tree, "provenance"), results);
  results.references = read_traces(part(tree, "reference"));
  results.traces = read_traces(part(tree, "traces"));
  results.tunings = part(tree, "tuning").groups;
  results.convergences = part(tree, "convergence").groups;
  return results;
}

StudyResults results_from(const JournalContents& contents) {
  StudyResults results;
  results.description = contents.description.value_or(StudyDescription{});
  results.input_sha256 = contents.input_sha256;
  results.evaluations = contents.evaluations;
  results.provenance = contents.provenance;
  if (!contents.provenance.empty()) {
    results.program_version = contents.provenance.back().program_version;
    results.git_revision = contents.provenance.back().git_revision;
  }
  for (const TraceSet& set : contents.traces) {
    (set.name.starts_with(kReferencePrefix) ? results.references : results.traces).push_back(set);
  }
  for (const NamedText& text : contents.texts) {
    if (text.name.starts_with(kTuningPrefix)) {
      results.tunings.push_back(
          {text.name.substr(kTuningPrefix.size()), {}, {{"certificate", text.text}}, {}});
    } else {
      results.texts.push_back(text);
    }
  }
  return results;
}

std::string write_results(const std::filesystem::path& path, const StudyResults& results) {
  const DataGroup tree = tree_of(results);
  write_group_file(path, tree);
  return attribute<std::string>(tree, "results_digest");
}

StudyResults read_results(const std::filesystem::path& path) {
  const DataGroup tree = read_group_file(path);
  try {
    return results_of(tree);
  } catch (const StoreError& error) {
    throw StoreError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace linkstudy

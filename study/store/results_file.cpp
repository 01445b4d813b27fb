#include "study/store/results_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "study/record/bytes.h"
#include "study/record/digest.h"
#include "study/store/directory.h"
#include "study/store/file.h"
#include "study/store/group_file.h"
#include "study/store/results_tree.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

constexpr std::string_view kFormat = "linkstudy results";
constexpr std::int64_t kFormatVersion = 1;

constexpr std::string_view kReferencePrefix = "reference";
constexpr std::string_view kDerivedPrefix = "derived_";
constexpr std::string_view kResidualsPrefix = "residuals_";
constexpr std::string_view kTablesSuffix = "_tables";
constexpr std::string_view kContactsPrefix = "contacts/";
constexpr const char* kAnswer = "answer";

void add_groups(Table& root, const std::string& name, std::vector<Table> groups) {
  if (!groups.empty()) {
    root.parts.push_back({name, {}, {}, std::move(groups)});
  }
}

std::vector<Table> trace_groups(const std::vector<TraceSet>& sets) {
  std::vector<Table> groups;
  std::ranges::transform(sets, std::back_inserter(groups), traces_group);
  return groups;
}

// Part of the tree, or an empty one where the file has none.
const Table& part(const Table& tree, std::string_view name) {
  static const Table empty;
  const Table* found = find_part(tree, name);
  return found == nullptr ? empty : *found;
}

template <class Type>
Type attribute(const Table& group, std::string_view name) {
  const Attribute* found = find_attribute(group, name);
  const Type* value = found == nullptr ? nullptr : std::get_if<Type>(&found->value);
  if (value == nullptr) {
    throw StoreError(fmt::format("group '{}' has no attribute '{}'", group.name, name));
  }
  return *value;
}

template <class Type>
const std::vector<Type>& values_of(const Table& group, std::string_view name) {
  const Column* found = find_column(group, name);
  const auto* values = found == nullptr ? nullptr : std::get_if<std::vector<Type>>(&found->values);
  if (values == nullptr) {
    throw StoreError(fmt::format("group '{}' has no column '{}'", group.name, name));
  }
  return *values;
}

// The column of a role: a parameter may have the name of an outcome, its role tells them apart.
template <class Type>
const std::vector<Type>& values_with_role(const Table& group, std::string_view role) {
  const auto found = std::ranges::find(group.columns, role, &Column::role);
  if (found == group.columns.end() || !std::holds_alternative<std::vector<Type>>(found->values)) {
    throw StoreError(fmt::format("group '{}' has no column of role '{}'", group.name, role));
  }
  return std::get<std::vector<Type>>(found->values);
}

void read_parameter(const Column& column, std::vector<Evaluation>& evaluations) {
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    std::vector<Value>& point = evaluations[i].point.values;
    if (const auto* words = std::get_if<std::vector<std::string>>(&column.values)) {
      point.emplace_back((*words)[i]);
    } else {
      point.emplace_back(std::get<std::vector<double>>(column.values)[i]);
    }
  }
}

void read_columns(const Table& study, StudyResults& results) {
  for (const Column& column : study.columns) {
    if (column.role == "parameter") {
      results.description.parameters.push_back({column.name, column.unit, column.meaning});
      read_parameter(column, results.evaluations);
    } else if (column.role == "response") {
      results.description.responses.push_back({column.name, column.unit, column.meaning});
      const auto& values = std::get<std::vector<double>>(column.values);
      for (std::size_t i = 0; i < results.evaluations.size(); ++i) {
        results.evaluations[i].responses.push_back(values[i]);
      }
    } else if (column.role == "derived") {
      const auto& values = std::get<std::vector<double>>(column.values);
      for (std::size_t i = 0; i < results.evaluations.size(); ++i) {
        if (std::isnan(values[i])) continue;
        results.evaluations[i].derived.push_back({column.name, column.unit, {values[i]}});
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

void read_study(const Table& study, const Table& runtime, StudyResults& results) {
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

// A column that older files may lack.
template <class Type, class Field>
void read_if_there(const Table& group, const char* name, std::vector<ProvenanceRow>& rows,
                   Field ProvenanceRow::*member) {
  if (find_column(group, name) == nullptr) return;
  const auto& values = values_of<Type>(group, name);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = static_cast<Field>(values[i]);
}

void read_provenance(const Table& group, StudyResults& results) {
  using Row = ProvenanceRow;
  using Count = std::int64_t;
  std::vector<Row>& rows = results.provenance;
  rows.resize(values_of<std::string>(group, "event").size());
  read_if_there<std::string>(group, "event", rows, &Row::event);
  read_if_there<double>(group, "time", rows, &Row::time_unix_s);
  read_if_there<Count>(group, "total", rows, &Row::total);
  read_if_there<Count>(group, "ranks", rows, &Row::ranks);
  read_if_there<std::string>(group, "host", rows, &Row::host);
  read_if_there<std::string>(group, "program_version", rows, &Row::program_version);
  read_if_there<std::string>(group, "git_revision", rows, &Row::git_revision);
  read_if_there<std::string>(group, "command", rows, &Row::command);
  read_if_there<std::string>(group, "simd", rows, &Row::simd);
  read_if_there<Count>(group, "lanes", rows, &Row::lanes);
  read_if_there<std::string>(group, "job", rows, &Row::job);
  read_if_there<Count>(group, "restart", rows, &Row::restart);
  for (const Attribute& text : group.attributes) {
    results.texts.push_back({text.name, attribute<std::string>(group, text.name)});
  }
}

std::vector<TraceSet> read_traces(const Table& parent) {
  std::vector<TraceSet> sets;
  for (const Table& group : parent.parts) {
    TraceSet set{group.name, attribute<std::int64_t>(group, "evaluation"), {}};
    for (const Column& column : group.columns) {
      set.traces.push_back(
          {column.name, column.unit, std::get<std::vector<double>>(column.values)});
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

RunStatus run_status(const std::string& name) {
  const std::optional<RunStatus> found = find_word<RunStatus>(name);
  if (!found) {
    throw StoreError(fmt::format("unknown status '{}'", name));
  }
  return *found;
}

void require_format(const Table& tree) {
  const Attribute* format = find_attribute(tree, "format");
  if (format == nullptr || format->value != Attribute{"", std::string(kFormat)}.value) {
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

void add_traces(const TraceSet& set, StudyResults& results) {
  const bool is_derived = set.name.starts_with(kDerivedPrefix);
  if (!is_derived && !set.name.starts_with(kResidualsPrefix)) {
    (set.name.starts_with(kReferencePrefix) ? results.references : results.traces).push_back(set);
    return;
  }
  const auto id = static_cast<std::uint64_t>(set.evaluation);
  const auto found = std::ranges::lower_bound(results.evaluations, id, {},
                                              [](const Evaluation& one) { return one.point.id; });
  const bool is_there = found != results.evaluations.end() && found->point.id == id;
  if (!is_there) return;
  if (is_derived) {
    found->derived = set.traces;
  } else if (!set.traces.empty()) {
    found->residuals = set.traces.front().values;
  }
}

Table& answer_of(StudyResults& results, AnswerKind kind, std::string_view name) {
  const auto found = std::ranges::find_if(results.answers, [&](const VerbAnswer& answer) {
    return answer.kind == kind && answer.tables.name == name;
  });
  if (found != results.answers.end()) return found->tables;
  return results.answers.emplace_back(VerbAnswer{kind, Table{std::string(name)}}).tables;
}

// A later run of the same evaluation takes its place.
void add_contacts(Table contacts, StudyResults& results) {
  const auto found = std::ranges::find(results.contacts, contacts.name, &Table::name);
  if (found == results.contacts.end()) {
    results.contacts.push_back(std::move(contacts));
  } else {
    *found = std::move(contacts);
  }
}

void add_text(const NamedText& text, StudyResults& results) {
  if (text.name.starts_with(kContactsPrefix)) {
    add_contacts(from_bytes<Table>(text.text), results);
    return;
  }
  const std::optional<AnswerKind> kind = answer_kind_of(text);
  if (!kind) {
    results.texts.push_back(text);
    return;
  }
  const std::string_view name = text.name;
  const std::size_t slash = name.find('/');
  Table& tables = answer_of(results, *kind, name.substr(slash + 1));
  if (name.substr(0, slash).ends_with(kTablesSuffix)) {
    tables.parts = from_bytes<std::vector<Table>>(text.text);
  } else {
    tables.attributes = {{kAnswer, text.text}};
  }
}

}  // namespace

Table tree_of(const StudyResults& results) {
  const std::vector<Evaluation> evaluations = latest_by_id(results.evaluations);
  const StudyDescription& description = results.description;
  Table root;
  root.attributes = {{"format", std::string(kFormat)},
                     {"format_version", kFormatVersion},
                     {"status", std::string(name_of(results.status))},
                     {"input_sha256", results.input_sha256},
                     {"results_digest",
                      results_digest(description.parameters, description.responses, evaluations)},
                     {"seed", description.seed},
                     {"program_version", results.program_version},
                     {"git_revision", results.git_revision}};
  root.parts.push_back(study_group(description, evaluations));
  add_groups(root, "reference", trace_groups(results.references));
  add_groups(root, "traces", trace_groups(results.traces));
  add_groups(root, "contacts", results.contacts);
  for (const Word<AnswerKind>& kind : kWords<AnswerKind>) {
    std::vector<Table> groups;
    for (const VerbAnswer& answer : results.answers) {
      if (answer.kind == kind.value) groups.push_back(answer.tables);
    }
    add_groups(root, std::string(kind.text), std::move(groups));
  }
  root.parts.push_back(runtime_group(evaluations));
  root.parts.push_back(provenance_group(results.provenance, results.texts));
  return root;
}

StudyResults results_of(const Table& tree) {
  require_format(tree);
  StudyResults results;
  results.status = run_status(attribute<std::string>(tree, "status"));
  results.input_sha256 = attribute<std::string>(tree, "input_sha256");
  results.results_digest = attribute<std::string>(tree, "results_digest");
  results.description.seed = attribute<std::uint64_t>(tree, "seed");
  results.program_version = attribute<std::string>(tree, "program_version");
  results.git_revision = attribute<std::string>(tree, "git_revision");
  const Table& study = part(tree, "study");
  results.description.name = attribute<std::string>(study, "name");
  results.description.kind = attribute<std::string>(study, "kind");
  read_study(study, part(tree, "runtime"), results);
  read_provenance(part(tree, "provenance"), results);
  results.references = read_traces(part(tree, "reference"));
  results.traces = read_traces(part(tree, "traces"));
  results.contacts = part(tree, "contacts").parts;
  for (const Word<AnswerKind>& kind : kWords<AnswerKind>) {
    for (const Table& tables : part(tree, std::string(kind.text)).parts) {
      results.answers.push_back({kind.value, tables});
    }
  }
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
  for (const TraceSet& set : contents.traces) add_traces(set, results);
  for (const NamedText& text : contents.texts) add_text(text, results);
  return results;
}

namespace {

// The journal of a directory; where it is missing or damaged, the file of results may be left.
JournalContents read_begun_journal(const std::filesystem::path& directory) {
  try {
    JournalContents contents = read_journal(directory);
    if (contents.description) return contents;
    throw StoreError(
        fmt::format("{}: ended before anything was begun; run it again", directory.string()));
  } catch (const StoreError& error) {
    const std::filesystem::path results = directory / kResultsName;
    if (!std::filesystem::exists(results)) throw;
    throw StoreError(fmt::format("{}; to read the results that are left, name {}", error.what(),
                                 results.string()));
  }
}

}  // namespace

StudyResults read_stored(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path)) return read_results(path);
  const JournalContents contents = read_begun_journal(path);
  StudyResults results = results_from(contents);
  // A study that runs is written to at this moment.
  if (!is_locked(path / kJournalName)) results.dropped = dropped_text(contents, path);
  const bool misses_tables = std::ranges::any_of(
      results.answers, [](const VerbAnswer& answer) { return answer.tables.parts.empty(); });
  if (misses_tables && std::filesystem::exists(path / kResultsName)) {
    results.answers = read_results(path / kResultsName).answers;
  }
  return results;
}

TraceSet derived_set(const Evaluation& evaluation) {
  return {fmt::format("{}{}", kDerivedPrefix, evaluation.point.id),
          static_cast<std::int64_t>(evaluation.point.id), evaluation.derived};
}

TraceSet residuals_set(const Evaluation& evaluation) {
  return {fmt::format("{}{}", kResidualsPrefix, evaluation.point.id),
          static_cast<std::int64_t>(evaluation.point.id),
          {{"residuals", "", evaluation.residuals}}};
}

NamedText contacts_text(const Table& contacts) {
  return {fmt::format("{}{}", kContactsPrefix, contacts.name), to_bytes(contacts)};
}

std::vector<NamedText> answer_texts(const VerbAnswer& answer) {
  const Attribute* json = find_attribute(answer.tables, kAnswer);
  const std::string_view kind = name_of(answer.kind);
  return {{fmt::format("{}/{}", kind, answer.tables.name), std::get<std::string>(json->value)},
          {fmt::format("{}{}/{}", kind, kTablesSuffix, answer.tables.name),
           to_bytes(answer.tables.parts)}};
}

std::optional<AnswerKind> answer_kind_of(const NamedText& text) {
  const std::string_view name = text.name;
  const std::size_t slash = name.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  std::string_view kind = name.substr(0, slash);
  if (kind.ends_with(kTablesSuffix)) kind.remove_suffix(kTablesSuffix.size());
  return find_word<AnswerKind>(kind);
}

std::string write_results(const std::filesystem::path& path, const StudyResults& results) {
  const Table tree = tree_of(results);
  write_group_file(path, tree);
  return attribute<std::string>(tree, "results_digest");
}

StudyResults read_results(const std::filesystem::path& path) {
  const Table tree = read_group_file(path);
  try {
    return results_of(tree);
  } catch (const StoreError& error) {
    throw StoreError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace linkstudy

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/cli/verb_table.h"
#include "study/report/console.h"
#include "study/report/results_table.h"
#include "study/session/exit_code.h"
#include "study/store/file.h"
#include "study/store/results_file.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

const Trace* find_trace(const TraceSet& set, const std::string& name) {
  const auto found = std::ranges::find(set.traces, name, &Trace::name);
  return found == set.traces.end() ? nullptr : &*found;
}

// "evaluation_3_fast" belongs to "reference_fast", "evaluation_3" to "reference".
const TraceSet* find_reference(const StudyResults& results, const TraceSet& set) {
  const std::string own = fmt::format("evaluation_{}", set.evaluation);
  if (!set.name.starts_with(own)) return nullptr;
  const std::string name = "reference" + set.name.substr(own.size());
  const auto found = std::ranges::find(results.references, name, &TraceSet::name);
  return found == results.references.end() ? nullptr : &*found;
}

// One long table: a column for the run, time, every channel and every difference.
class TraceTable {
 public:
  explicit TraceTable(const StudyResults& results) {
    table_.title = results.description.name;
    table_.columns = {{"run", "", "{}", Align::left}, {"time", "s"}};
    for (const TraceSet& set : results.references) add_columns(set, nullptr);
    for (const TraceSet& set : results.traces) add_columns(set, find_reference(results, set));
    for (const TraceSet& set : results.references) add_rows(set, nullptr);
    for (const TraceSet& set : results.traces) add_rows(set, find_reference(results, set));
  }

  Table take() { return std::move(table_); }

 private:
  static std::string error_name(const std::string& channel) { return channel + ".difference"; }

  std::size_t column_of(const std::string& name) const {
    const auto found = std::ranges::find(table_.columns, name, &TableColumn::name);
    return static_cast<std::size_t>(found - table_.columns.begin());
  }

  void add_column(const std::string& name, const std::string& unit) {
    if (column_of(name) == table_.columns.size()) table_.columns.push_back({name, unit});
  }

  void add_columns(const TraceSet& set, const TraceSet* reference) {
    for (const Trace& trace : set.traces) {
      add_column(trace.name, trace.unit);
      const bool compared = reference != nullptr && trace.name != "time";
      if (compared && find_trace(*reference, trace.name) != nullptr) {
        add_column(error_name(trace.name), trace.unit);
      }
    }
  }

  void add_rows(const TraceSet& set, const TraceSet* reference) {
    const Trace* time = find_trace(set, "time");
    if (time == nullptr) return;
    for (std::size_t i = 0; i < time->values.size(); ++i) {
      std::vector<Cell> row(table_.columns.size());
      row[0] = set.name;
      for (const Trace& trace : set.traces) {
        row[column_of(trace.name)] = trace.values[i];
        add_difference(row, trace, i, time->values[i], reference);
      }
      table_.rows.push_back(std::move(row));
    }
  }

  // Only where the reference has a value at the same time.
  void add_difference(std::vector<Cell>& row, const Trace& trace, std::size_t i, double time,
                      const TraceSet* reference) const {
    if (reference == nullptr || trace.name == "time") return;
    const Trace* other = find_trace(*reference, trace.name);
    const Trace* other_time = find_trace(*reference, "time");
    if (other == nullptr || other_time == nullptr || i >= other->values.size()) return;
    if (std::abs(other_time->values[i] - time) > 1e-9 * std::max(1.0, time)) return;
    row[column_of(error_name(trace.name))] = trace.values[i] - other->values[i];
  }

  Table table_;
};

}  // namespace

int run_export(const CommandLine& line) {
  const JournalContents contents = read_journal(line.inputs.front());
  // A study that runs is written to at this moment.
  const std::string dropped = dropped_text(contents, line.inputs.front());
  if (!dropped.empty() && !is_locked(std::filesystem::path(line.inputs.front()) / kJournalName)) {
    print_err(fmt::format("linkstudy: warning: {}\n", dropped));
  }
  StudyResults results = results_from(contents);
  std::ranges::stable_sort(results.traces, {}, &TraceSet::evaluation);
  if (line.traces && results.traces.empty() && results.references.empty()) {
    throw StoreError(fmt::format("{}: holds no time histories; ask for them with [[trace]]",
                                 line.inputs.front()));
  }
  const Table table = line.traces ? TraceTable(results).take() : results_table(results);
  const std::string text = write_table(table, table_format(line.format));
  if (line.output) {
    write_file_atomically(*line.output, text);
  } else {
    print_out(text);
  }
  return kDone;
}

}  // namespace linkstudy

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/report/results_tables.h"

namespace linkstudy {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

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

// Run after run, each over its time.
class TraceColumns {
 public:
  explicit TraceColumns(const std::string& name) : table_{name} {
    table_.columns.push_back({"run", "", "", "", std::vector<std::string>()});
    column("time", "s");
  }

  void add(const TraceSet& set, const TraceSet* reference) {
    const Trace* time = find_trace(set, "time");
    if (time == nullptr) return;
    const std::size_t begin = rows_;
    rows_ += time->values.size();
    std::get<std::vector<std::string>>(table_.columns.front().values).resize(rows_, set.name);
    for (const Trace& trace : set.traces) {
      std::ranges::copy(trace.values, fill(trace.name, trace.unit) + offset(begin));
      if (reference != nullptr && trace.name != "time")
        add_difference(trace, *time, *reference, begin);
    }
  }

  Table take() {
    for (std::size_t i = 1; i < table_.columns.size(); ++i) numbers(i).resize(rows_, kNan);
    return std::move(table_);
  }

 private:
  static std::ptrdiff_t offset(std::size_t i) { return static_cast<std::ptrdiff_t>(i); }

  std::vector<double>& numbers(std::size_t i) {
    return std::get<std::vector<double>>(table_.columns[i].values);
  }

  std::size_t column(const std::string& name, const std::string& unit) {
    const auto found = std::ranges::find(table_.columns, name, &Column::name);
    const auto index = static_cast<std::size_t>(found - table_.columns.begin());
    if (found == table_.columns.end()) {
      table_.columns.push_back({name, unit, "", "", std::vector<double>()});
    }
    return index;
  }

  // Missing numbers up to the present end.
  std::vector<double>::iterator fill(const std::string& name, const std::string& unit) {
    std::vector<double>& values = numbers(column(name, unit));
    values.resize(rows_, kNan);
    return values.begin();
  }

  // Only where the reference has a value at the same time.
  void add_difference(const Trace& trace, const Trace& time, const TraceSet& reference,
                      std::size_t begin) {
    const Trace* other = find_trace(reference, trace.name);
    const Trace* other_time = find_trace(reference, "time");
    if (other == nullptr) return;
    const auto differences = fill(trace.name + ".difference", trace.unit) + offset(begin);
    if (other_time == nullptr) return;
    const std::size_t count = std::min(trace.values.size(), other->values.size());
    for (std::size_t i = 0; i < count; ++i) {
      const double t = time.values[i];
      if (std::abs(other_time->values[i] - t) > 1e-9 * std::max(1.0, t)) continue;
      differences[offset(i)] = trace.values[i] - other->values[i];
    }
  }

  Table table_;
  std::size_t rows_ = 0;
};

}  // namespace

std::optional<Table> traces_table(const StudyResults& results) {
  if (results.traces.empty() && results.references.empty()) return std::nullopt;
  TraceColumns columns(results.description.name);
  for (const TraceSet& set : results.references) columns.add(set, nullptr);
  std::vector<const TraceSet*> sets;
  for (const TraceSet& set : results.traces) sets.push_back(&set);
  std::ranges::stable_sort(sets, {}, [](const TraceSet* set) { return set->evaluation; });
  for (const TraceSet* set : sets) columns.add(*set, find_reference(results, *set));
  return columns.take();
}

}  // namespace linkstudy

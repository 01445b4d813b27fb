#include "study/report/summary_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/metrics/response_list.h"
#include "study/record/digest.h"

namespace linkstudy {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

struct Worst {
  double error = kNoValue;
  std::size_t component = 0;
};

// Columns over the rows (evaluation, load case).
class Summary {
 public:
  explicit Summary(const StudyResults& results)
      : description_(results.description),
        evaluations_(latest_by_id(results.evaluations)),
        cases_(split_responses(description_.responses)) {
    table_.name = description_.name;
  }

  Table build() {
    if (cases_.empty()) cases_.emplace_back();
    add_inputs();
    for (std::size_t i = 0; i < cases_.front().matches.size(); ++i) add_match(i);
    for (std::size_t i = 0; i < cases_.front().responses.size(); ++i) add_response(i);
    add_run_number(RunNumber::gap_max);
    add_run_number(RunNumber::step_limit);
    add("status", "", "why the evaluation ended", "{}",
        [](const Evaluation& e, const StoredCase&) { return static_cast<std::uint8_t>(e.status); });
    table_.columns.back().role = "status";
    table_.columns.back().words = cause_words();
    return std::move(table_);
  }

 private:
  template <class Field>
  void add(const std::string& name, const std::string& unit, const std::string& meaning,
           const char* format, Field field) {
    std::vector<std::decay_t<decltype(field(evaluations_[0], cases_[0]))>> values;
    for (const Evaluation& evaluation : evaluations_) {
      for (const StoredCase& one : cases_) values.push_back(field(evaluation, one));
    }
    Column column{name, unit, meaning, "summary", std::move(values)};
    column.format = format;
    table_.columns.push_back(std::move(column));
  }

  void add_inputs() {
    add("evaluation", "", "position in the declared design", "{}",
        [](const Evaluation& e, const StoredCase&) {
          return static_cast<std::int64_t>(e.point.id);
        });
    const bool has_load_cases = !cases_.front().load_case.empty();
    if (has_load_cases) {
      add("load_case", "", "its name", "{}",
          [](const Evaluation&, const StoredCase& one) { return one.load_case; });
    }
    for (std::size_t i = 0; i < description_.parameters.size(); ++i) {
      if (varies(i)) add_parameter(i);
    }
    for (const Trace& derived : list_derived()) add_derived(derived.name, derived.unit);
  }

  bool varies(std::size_t parameter) const {
    const auto value = [&](const Evaluation& e) { return e.point.values.at(parameter); };
    return evaluations_.size() < 2 || !std::ranges::all_of(evaluations_, [&](const Evaluation& e) {
             return value(e) == value(evaluations_.front());
           });
  }

  void add_parameter(std::size_t i) {
    const Parameter& parameter = description_.parameters[i];
    const bool is_word = !evaluations_.empty() && std::holds_alternative<std::string>(
                                                      evaluations_.front().point.values.at(i));
    const auto value = [i](const Evaluation& e) { return e.point.values.at(i); };
    if (is_word) {
      add(parameter.path, parameter.unit, parameter.long_name, "{}",
          [&](const Evaluation& e, const StoredCase&) { return std::get<std::string>(value(e)); });
    } else {
      add(parameter.path, parameter.unit, parameter.long_name, "{:.6g}",
          [&](const Evaluation& e, const StoredCase&) { return std::get<double>(value(e)); });
    }
  }

  static std::string prefix_of(const StoredCase& one) {
    return one.load_case.empty() ? "" : one.load_case + "_";
  }

  static const Trace* find_derived(const Evaluation& evaluation, const std::string& name) {
    const auto found = std::ranges::find(evaluation.derived, name, &Trace::name);
    return found == evaluation.derived.end() ? nullptr : &*found;
  }

  // Names less the load case; of pure numbers (the ratios) none.
  std::vector<Trace> list_derived() const {
    std::vector<Trace> all;
    const std::string prefix = prefix_of(cases_.front());
    for (const Evaluation& evaluation : evaluations_) {
      for (const Trace& one : evaluation.derived) {
        if (one.unit.empty() || !one.name.starts_with(prefix)) continue;
        const std::string name = one.name.substr(prefix.size());
        if (std::ranges::find(all, name, &Trace::name) == all.end()) {
          all.push_back({name, one.unit, {}});
        }
      }
    }
    return all;
  }

  void add_derived(const std::string& name, const std::string& unit) {
    add(name, unit, "what the input says in other terms", "{:.4g}",
        [&](const Evaluation& e, const StoredCase& one) {
          const Trace* derived = find_derived(e, prefix_of(one) + name);
          return derived == nullptr ? kNoValue : derived->values.front();
        });
  }

  static double response(const Evaluation& evaluation, std::size_t index) {
    return index < evaluation.responses.size() ? evaluation.responses[index] : kNoValue;
  }

  static Worst find_worst(const Evaluation& evaluation, std::size_t first, std::size_t count) {
    Worst worst;
    for (std::size_t i = 0; i < count; ++i) {
      const double error = response(evaluation, first + i);
      if (std::isnan(error) || error <= worst.error) continue;
      worst = {error, i};
    }
    return worst;
  }

  void add_match(std::size_t i) {
    const StoredErrors& first = cases_.front().matches[i];
    const std::size_t count = first.channels.size();
    const std::string group = group_of(first.channels);
    add("error_max_" + first.name, "%", "largest relative error of the components of " + group,
        "{:.3g}", [&](const Evaluation& e, const StoredCase& one) {
          return 100.0 * find_worst(e, one.matches[i].max, count).error;
        });
    if (count > 1) {
      add("worst_" + first.name, "", "component with the largest error", "{}",
          [&](const Evaluation& e, const StoredCase& one) {
            const Worst worst = find_worst(e, one.matches[i].max, count);
            return std::isnan(worst.error)
                       ? std::string()
                       : first.channels[worst.component].substr(group.size() + 1);
          });
    }
    add("error_rms_" + first.name, "%", "root-mean-square relative error, likewise", "{:.3g}",
        [&](const Evaluation& e, const StoredCase& one) {
          return 100.0 * find_worst(e, one.matches[i].rms, count).error;
        });
  }

  // Under its name less the load case.
  void add_listed(std::size_t index_in_first, const char* format, auto index_of) {
    const Response& listed = description_.responses[index_in_first];
    add(listed.name.substr(prefix_of(cases_.front()).size()), listed.unit, listed.long_name, format,
        [&](const Evaluation& e, const StoredCase& one) { return response(e, index_of(one)); });
  }

  void add_response(std::size_t i) {
    add_listed(cases_.front().responses[i], "{:.4g}",
               [i](const StoredCase& one) { return one.responses.at(i); });
  }

  void add_run_number(RunNumber number) {
    const auto offset = static_cast<std::size_t>(number);
    if (cases_.front().always + offset >= description_.responses.size()) return;
    add_listed(cases_.front().always + offset, "{:.3g}",
               [offset](const StoredCase& one) { return one.always + offset; });
  }

  StudyDescription description_;
  std::vector<Evaluation> evaluations_;
  std::vector<StoredCase> cases_;
  Table table_;
};

}  // namespace

Table summary_table(const StudyResults& results) {
  return Summary(results).build();
}

}  // namespace linkstudy

#include "study/tune/tuning_tables.h"

#include <fmt/format.h>

#include <limits>

namespace linkstudy::tuning {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

std::int64_t to_count(std::uint64_t number) {
  return static_cast<std::int64_t>(number);
}

Table make_result_table(const TuningResult& result) {
  const std::vector<TuningResult> one = {result};
  TableOf table("result", "tuning", one);
  using Result = TuningResult;
  const bool matches = !result.point.empty();
  const std::string unit = variable_of(result).unit;
  const auto of_window = [](double Window::*member) {
    return [member](const Result& r) { return r.window ? (*r.window).*member : kNan; };
  };
  table.add("parameter", "", "what was tuned", [](const Result& r) { return variable_of(r).path; });
  table.add("value", unit, "lowest that matches",
            [&](const Result& r) { return matches ? r.point.front() : kNan; });
  for (const Trace& derived : result.answer.derived) {
    table.add(derived.name, derived.unit, "what the input says in other terms, at the answer",
              [&](const Result&) { return matches ? derived.values.front() : kNan; });
  }
  table.add("window_low", unit, "where the values that match begin", of_window(&Window::low));
  table.add("window_high", unit, "where they end", of_window(&Window::high));
  table.add("margin_decades", "", "log10 of window_high / window_low", [](const Result& r) {
    return r.window ? decades_of(variable_of(r), *r.window) : kNan;
  });
  table.add("high_limited_by", "", "what ends the window", [](const Result& r) {
    return r.window ? std::string(name_of(r.window->high_limited_by)) : std::string();
  });
  table.add("status", "", "verdict of the certificate, or infeasible",
            [](const Result& r) { return std::string(name_of(r.status)); });
  table.add("reason", "", "of the verdict", [](const Result& r) { return r.reason; });
  table.add("suggested_step", "s", "that would open a window",
            [](const Result& r) { return r.suggestion ? r.suggestion->step : kNan; });
  table.add("evaluations", "", "how many it took",
            [](const Result& r) { return to_count(r.observations.size()); });
  table.add("rounds", "", "batches asked for", [](const Result& r) { return to_count(r.rounds); });
  table.add("objective", "", "what is best: the sum of log10 of the values, or what the file says",
            [&](const Result& r) { return matches ? shown_objective(r) : kNan; });
  table.add("largest_step", "s", "that matches at the answer, of the multiples tried",
            [](const Result& r) { return r.step_reach ? r.step_reach->step : kNan; });
  table.add("step_limit", "s", "of stability, at the answer",
            [&](const Result& r) { return matches ? r.answer.step_limit : kNan; });
  return table.take();
}

// One row a variable.
Table make_box_table(const TuningResult& result) {
  using Row = TunedVariable;
  const bool matches = !result.point.empty();
  TableOf table("result", "tuning", result.problem.variables);
  std::size_t i = 0;
  table.add("parameter", "", "what was tuned", [](const Row& r) { return r.path; });
  table.add("unit", "", "of its values", [](const Row& r) { return r.unit; });
  table.add("value", "", "of the match with the least sum of log10",
            [&](const Row&) { return matches ? result.point[i++] : kNan; });
  const auto add_end = [&](const char* name, const char* meaning, double Window::*member) {
    i = 0;
    table.add(name, "", meaning,
              [&](const Row&) { return matches ? result.windows[i++].*member : kNan; });
  };
  add_end("window_low", "where the values that match begin, the others being as here",
          &Window::low);
  add_end("window_high", "where they end", &Window::high);
  i = 0;
  table.add("margin_decades", "", "log10 of window_high / window_low",
            [&](const Row& r) { return matches ? decades_of(r, result.windows[i++]) : kNan; });
  i = 0;
  table.add("high_limited_by", "", "what ends the window", [&](const Row&) {
    return matches ? std::string(name_of(result.windows[i++].high_limited_by)) : std::string();
  });
  table.add("status", "", "verdict of the certificate, or infeasible",
            [&](const Row&) { return std::string(name_of(result.status)); });
  table.add("objective", "", "what is best: the sum of log10 of the values, or what the file says",
            [&](const Row&) { return matches ? shown_objective(result) : kNan; });
  table.add("evaluations", "", "how many it took",
            [&](const Row&) { return to_count(result.observations.size()); });
  return table.take();
}

Table make_component_table(const TuningResult& result) {
  std::vector<double> errors = result.answer.errors;
  errors.resize(result.problem.components.size(), kNan);
  using Row = MatchComponent;
  TableOf table("components", "tuning", result.problem.components);
  table.add("name", "", "of the matched component", [](const Row& r) { return r.name; });
  table.add("tolerance", "1", "largest relative error allowed",
            [](const Row& r) { return r.tolerance; });
  std::size_t i = 0;
  table.add("error", "1", "relative error at the answer", [&](const Row&) { return errors[i++]; });
  return table.take();
}

Table make_scan_table(const TuningResult& result) {
  using Row = ScanPoint;
  TableOf table("scan", "tuning", result.points);
  const std::vector<TunedVariable>& variables = result.problem.variables;
  if (variables.size() == 1) {
    table.add("value", variables[0].unit, "tried", [](const Row& r) { return r.value; });
  }
  for (std::size_t j = 0; j < variables.size() && variables.size() > 1; ++j) {
    table.add(variables[j].path, variables[j].unit, "tried", [j](const Row& r) { return r.x[j]; });
  }
  table.add("ratio", "1", "largest error over its tolerance", [](const Row& r) { return r.ratio; });
  table.add("side", "", "feasible, or on which side it fails",
            [](const Row& r) { return std::string(name_of(r.side)); });
  table.add("cause", "", "why the run ended",
            [](const Row& r) { return std::string(linkstudy::name_of(r.cause)); });
  table.add("h_omega", "1", "step times highest eigenfrequency",
            [](const Row& r) { return r.h_omega; });
  table.add("evaluation", "", "its number", [](const Row& r) { return to_count(r.evaluation); });
  return table.take();
}

// Of several variables: nothing found that matches lies below one of them in every value.
Table make_staircase_table(const TuningResult& result) {
  using Row = Observation;
  TableOf table("staircase", "tuning", result.staircase);
  const std::vector<TunedVariable>& variables = result.problem.variables;
  for (std::size_t j = 0; j < variables.size(); ++j) {
    table.add(variables[j].path, variables[j].unit, "of a minimal match",
              [j](const Row& r) { return r.request.x[j]; });
  }
  table.add("objective", "", "sum of log10 of the values",
            [](const Row& r) { return compute_objective(r.request.x); });
  table.add("ratio", "1", "largest error over its tolerance",
            [&](const Row& r) { return compute_ratio(r.answer, result.problem.components); });
  table.add("evaluation", "", "its number", [](const Row& r) { return to_count(r.answer.id); });
  return table.take();
}

Table make_certificate_table(const TuningResult& result) {
  std::vector<Claim> claims;
  if (result.certificate) {
    claims.assign(result.certificate->claims.begin(), result.certificate->claims.end());
  }
  using Row = Claim;
  TableOf table("certificate", "tuning", claims);
  table.add("claim", "", "", [](const Row& r) { return r.name; });
  table.add("statement", "", "", [](const Row& r) { return r.statement; });
  table.add("verdict", "", "", [](const Row& r) { return std::string(name_of(r.verdict)); });
  table.add("reason", "", "", [](const Row& r) { return r.reason; });
  table.add("evaluations", "", "that the claim rests on",
            [](const Row& r) { return fmt::format("{}", fmt::join(r.evaluations, " ")); });
  return table.take();
}

Table make_evaluation_table(const TuningResult& result) {
  using Row = Observation;
  TableOf table("evaluations", "tuning", result.observations);
  table.add("evaluation", "", "its number", [](const Row& r) { return to_count(r.answer.id); });
  const std::vector<TunedVariable>& variables = result.problem.variables;
  for (std::size_t j = 0; j < variables.size(); ++j) {
    table.add(variables.size() == 1 ? "value" : variables[j].path, variables[j].unit, "tried",
              [j](const Row& r) { return r.request.x[j]; });
  }
  table.add("step_factor", "1", "of the base step",
            [](const Row& r) { return r.request.step_factor; });
  table.add("purpose", "", "why it was asked for", [](const Row& r) { return r.request.purpose; });
  table.add("status", "", "why the run ended",
            [](const Row& r) { return std::string(linkstudy::name_of(r.answer.status)); });
  table.add("ratio", "1", "largest error over its tolerance",
            [&](const Row& r) { return compute_ratio(r.answer, result.problem.components); });
  return table.take();
}

// Values of a column that a table lacks.
ColumnValues missing_like(const ColumnValues& values, std::size_t rows) {
  return std::visit(
      [rows](const auto& own) -> ColumnValues {
        using Values = std::decay_t<decltype(own)>;
        if constexpr (std::is_same_v<Values, std::vector<double>>) return Values(rows, kNan);
        return Values(rows);
      },
      values);
}

void append_values(ColumnValues& to, const ColumnValues& from) {
  std::visit(
      [&](auto& own) {
        const auto& other = std::get<std::decay_t<decltype(own)>>(from);
        own.insert(own.end(), other.begin(), other.end());
      },
      to);
}

// Below the rows of `whole`, by the names of columns.
void stack(Table& whole, const Table& part) {
  const std::size_t before = row_count(whole);
  const std::size_t rows = row_count(part);
  for (const Column& column : part.columns) {
    if (find_column(whole, column.name) != nullptr) continue;
    whole.columns.push_back(column);
    whole.columns.back().values = missing_like(column.values, before);
  }
  for (Column& column : whole.columns) {
    const Column* own = find_column(part, column.name);
    append_values(column.values, own == nullptr ? missing_like(column.values, rows) : own->values);
  }
}

void add_target(Table& table, const TuningResult& result) {
  const std::size_t rows = row_count(table);
  const auto add = [&](const char* name, const char* unit, const char* meaning, double value) {
    table.columns.insert(table.columns.begin(),
                         Column{name, unit, meaning, "tuning", std::vector<double>(rows, value)});
  };
  add("target_step", "s", "of integration", step_of(result));
  add("target_tolerance", "1", "of the first match", tolerance_of(result));
}

}  // namespace

std::vector<Table> make_tables(const std::vector<TuningResult>& results) {
  if (results.size() == 1) return make_tables(results.front());
  std::vector<Table> whole;
  for (const TuningResult& result : results) {
    std::vector<Table> tables = make_tables(result);
    for (Table& table : tables) add_target(table, result);
    if (whole.empty()) {
      whole = std::move(tables);
      continue;
    }
    for (std::size_t i = 0; i < whole.size(); ++i) stack(whole[i], tables[i]);
  }
  return whole;
}

std::vector<Table> make_tables(const TuningResult& result) {
  const bool is_box = result.problem.variables.size() > 1;
  std::vector<Table> tables = {is_box ? make_box_table(result) : make_result_table(result),
                               make_component_table(result), make_scan_table(result),
                               make_certificate_table(result), make_evaluation_table(result)};
  if (is_box) tables.push_back(make_staircase_table(result));
  return tables;
}

}  // namespace linkstudy::tuning

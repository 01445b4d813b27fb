#include "study/tune/tuning_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

namespace linkstudy::tuning {
namespace {

const TunedVariable& variable_of(const TuningResult& result) {
  return result.problem.variables.front();
}

template <typename Row, typename Get>
auto collect(const std::vector<Row>& rows, Get get) {
  using Value = std::decay_t<decltype(get(rows.front()))>;
  std::vector<Value> values;
  std::transform(rows.begin(), rows.end(), std::back_inserter(values), get);
  return values;
}

Table make_result_table(const TuningResult& result) {
  Table table{"result", {}};
  const auto number = [&](const std::string& name, const std::string& unit, double value) {
    table.columns.push_back({name, unit, std::vector<double>{value}});
  };
  const auto word = [&](const std::string& name, std::string_view value) {
    table.columns.push_back({name, "", std::vector<std::string>{std::string(value)}});
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Window none{nan, nan, nan, HighLimit::range, false};
  const Window window = result.window.value_or(none);
  const std::string unit = variable_of(result).unit;
  word("status", name_of(result.status));
  word("reason", result.reason);
  word("parameter", variable_of(result).path);
  number("value", unit, result.point.empty() ? nan : result.point.front());
  number("objective", "", result.point.empty() ? nan : result.objective);
  number("window_low", unit, window.low);
  number("window_high", unit, window.high);
  number("margin_decades", "", window.margin_decades);
  word("high_limited_by", result.window ? name_of(window.high_limited_by) : "");
  number("suggested_step", "s", result.suggestion ? result.suggestion->step : nan);
  number("evaluations", "", static_cast<double>(result.observations.size()));
  number("rounds", "", static_cast<double>(result.rounds));
  return table;
}

Table make_component_table(const TuningResult& result) {
  const auto& components = result.problem.components;
  std::vector<double> errors = result.answer.errors;
  errors.resize(components.size(), std::numeric_limits<double>::quiet_NaN());
  return {"components",
          {{"name", "", collect(components, [](const auto& row) { return row.name; })},
           {"tolerance", "", collect(components, [](const auto& row) { return row.tolerance; })},
           {"error", "", errors}}};
}

Table make_scan_table(const TuningResult& result) {
  const auto& points = result.points;
  return {
      "scan",
      {{"value", variable_of(result).unit, collect(points, [](const auto& p) { return p.value; })},
       {"ratio", "", collect(points, [](const auto& p) { return p.ratio; })},
       {"side", "", collect(points, [](const auto& p) { return std::string(name_of(p.side)); })},
       {"cause", "",
        collect(points, [](const auto& p) { return std::string(linkstudy::name_of(p.cause)); })},
       {"h_omega", "", collect(points, [](const auto& p) { return p.h_omega; })},
       {"evaluation", "",
        collect(points, [](const auto& p) { return static_cast<double>(p.evaluation); })}}};
}

Table make_certificate_table(const TuningResult& result) {
  std::vector<Claim> claims;
  if (result.certificate) {
    claims.assign(result.certificate->claims.begin(), result.certificate->claims.end());
  }
  return {"certificate",
          {{"claim", "", collect(claims, [](const auto& c) { return c.name; })},
           {"statement", "", collect(claims, [](const auto& c) { return c.statement; })},
           {"verdict", "",
            collect(claims, [](const auto& c) { return std::string(name_of(c.verdict)); })},
           {"reason", "", collect(claims, [](const auto& c) { return c.reason; })},
           {"evaluations", "", collect(claims, [](const auto& c) {
              return fmt::format("{}", fmt::join(c.evaluations, " "));
            })}}};
}

Table make_evaluation_table(const TuningResult& result) {
  const auto& seen = result.observations;
  const auto& components = result.problem.components;
  return {
      "evaluations",
      {{"evaluation", "",
        collect(seen, [](const auto& o) { return static_cast<double>(o.answer.id); })},
       {"value", variable_of(result).unit,
        collect(seen, [](const auto& o) { return o.request.x.front(); })},
       {"step_factor", "", collect(seen, [](const auto& o) { return o.request.step_factor; })},
       {"purpose", "", collect(seen, [](const auto& o) { return o.request.purpose; })},
       {"status", "",
        collect(seen,
                [](const auto& o) { return std::string(linkstudy::name_of(o.answer.status)); })},
       {"ratio", "",
        collect(seen, [&](const auto& o) { return compute_ratio(o.answer, components); })}}};
}

}  // namespace

std::vector<Table> make_tables(const TuningResult& result) {
  return {make_result_table(result), make_component_table(result), make_scan_table(result),
          make_certificate_table(result), make_evaluation_table(result)};
}

}  // namespace linkstudy::tuning

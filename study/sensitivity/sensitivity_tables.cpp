#include "study/sensitivity/sensitivity_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace linkstudy::sensitivity {
namespace {

struct Row {
  const Sensitivity* result;
  const QuantitySensitivity* quantity;
  const ParameterSensitivity* own;

  const Parameter& parameter() const { return result->parameters[own->parameter]; }
};

using GetEstimate = const Estimate& (*)(const Row&);

const Estimate& main_of(const Row& row) {
  return row.own->main;
}
const Estimate& total_of(const Row& row) {
  return row.own->total;
}

struct Names {
  const char* main;
  const char* main_meaning;
  const char* total;
  const char* total_meaning;
};

Names names_of(Design design) {
  if (design == Design::morris) {
    return {"mu", "mean elementary effect, over the whole range of the parameter", "mu_star",
            "mean size of the effects"};
  }
  return {"first", "Sobol index of first order: share of the variance by this parameter alone",
          "total", "total Sobol index: share with all that others do together with it"};
}

void add_estimate(TableOf<Row>& table, const std::string& name, const std::string& meaning,
                  GetEstimate get) {
  table.add(
      name, "", meaning, [get](const Row& row) { return get(row).value; }, "{:.4g}");
  table.add(
      name + "_low", "", "lower end of its 95 % interval (bootstrap)",
      [get](const Row& row) { return get(row).interval.low; }, "{:.4g}");
  table.add(
      name + "_high", "", "upper end", [get](const Row& row) { return get(row).interval.high; },
      "{:.4g}");
  table.add(name + "_finding", "", "what the interval says",
            [get](const Row& row) { return std::string(name_of(get(row).finding)); });
  table.add(
      name + "_needed", "", "blocks that would tell it from 0",
      [get](const Row& row) { return get(row).needed; }, "{:.0f}");
}

void add_sigma(TableOf<Row>& table) {
  table.add(
      "sigma", "", "standard deviation of the effects: curved, or with other parameters",
      [](const Row& row) { return row.own->sigma; }, "{:.4g}");
}

Table make_sensitivity_table(const Sensitivity& result) {
  std::vector<Row> rows;
  for (const QuantitySensitivity& quantity : result.quantities) {
    for (const ParameterSensitivity& own : quantity.parameters) {
      rows.push_back({&result, &quantity, &own});
    }
  }
  TableOf<Row> table("sensitivity", "sensitivity", std::move(rows));
  table.add("quantity", "", "response or error", [](const Row& r) { return r.quantity->name; });
  table.add("unit", "", "of the quantity, of its mean and of effects",
            [](const Row& r) { return r.quantity->unit; });
  table.add("parameter", "", "that varies", [](const Row& r) { return r.parameter().path; });
  const Names names = names_of(result.design);
  add_estimate(table, names.main, names.main_meaning, main_of);
  add_estimate(table, names.total, names.total_meaning, total_of);
  const auto count = [](std::size_t n) { return static_cast<std::int64_t>(n); };
  if (result.design == Design::morris) {
    add_sigma(table);
  } else {
    table.add("mean", "", "of the quantity", [](const Row& r) { return r.quantity->mean; });
    table.add("deviation", "", "standard deviation of the quantity",
              [](const Row& r) { return r.quantity->deviation; });
  }
  table.add("blocks", "", "trajectories or blocks that are complete",
            [count](const Row& r) { return count(r.quantity->blocks); });
  table.add("left_out", "", "blocks with an evaluation that failed",
            [count](const Row& r) { return count(r.quantity->left_out); });
  return table.take();
}

std::string interval_text(const Interval& interval) {
  if (std::isnan(interval.low)) return "";
  return fmt::format("{:.3g} .. {:.3g}", interval.low, interval.high);
}

using Region = FailureRegion;

// Columns that both forms of the failures begin with.
TableOf<Region> begin_failures(const Sensitivity& result) {
  TableOf<Region> table("failures", "failures", result.failures);
  const auto parameter = [&result](const Region& r) { return result.parameters[r.parameter]; };
  table.add("cause", "", "why they failed",
            [](const Region& r) { return std::string(name_of(r.cause)); });
  table.add("parameter", "", "that varies",
            [parameter](const Region& r) { return parameter(r).path; });
  table.add("unit", "", "of its values",
            [parameter](const Region& r) { return parameter(r).unit; });
  table.add("failed", "", "evaluations of this cause",
            [](const Region& r) { return static_cast<std::int64_t>(r.count); });
  return table;
}

void add_ok_count(TableOf<Region>& table) {
  table.add("ok", "", "evaluations that ended ok",
            [](const Region& r) { return static_cast<std::int64_t>(r.ok); });
}

void add_separation(TableOf<Region>& table) {
  table.add(
      "separation", "", "largest difference of both distribution functions, 1: apart",
      [](const Region& r) { return r.separation; }, "{:.2f}");
}

}  // namespace

Table make_failure_table(const Sensitivity& result) {
  TableOf<Region> table = begin_failures(result);
  table.add("failed_low", "", "least value of them", [](const Region& r) { return r.failed.low; });
  table.add("failed_median", "", "median", [](const Region& r) { return r.failed.median; });
  table.add("failed_high", "", "greatest", [](const Region& r) { return r.failed.high; });
  add_ok_count(table);
  table.add("ok_low", "", "least value of these", [](const Region& r) { return r.ran.low; });
  table.add("ok_median", "", "median", [](const Region& r) { return r.ran.median; });
  table.add("ok_high", "", "greatest", [](const Region& r) { return r.ran.high; });
  add_separation(table);
  return table.take();
}

Table make_failure_ranges(const Sensitivity& result) {
  TableOf<Region> table = begin_failures(result);
  table.add("failed_at", "", "least and greatest value of them", [](const Region& r) {
    return interval_text({r.failed.low, r.failed.high});
  });
  add_ok_count(table);
  table.add("ok_at", "", "least and greatest value of these", [](const Region& r) {
    return interval_text({r.ran.low, r.ran.high});
  });
  add_separation(table);
  Table all = table.take();
  all.name.clear();
  return all;
}

std::vector<Table> make_tables(const Sensitivity& result) {
  return {make_sensitivity_table(result), make_failure_table(result)};
}

Table make_quantity_table(const Sensitivity& result, const QuantitySensitivity& quantity) {
  std::vector<Row> rows;
  for (const ParameterSensitivity& own : quantity.parameters) {
    rows.push_back({&result, &quantity, &own});
  }
  std::ranges::stable_sort(
      rows, [](const Row& a, const Row& b) { return a.own->total.value > b.own->total.value; });
  TableOf<Row> table("", "sensitivity", std::move(rows));
  table.add("parameter", "", "that varies", [](const Row& r) { return r.parameter().path; });
  const Names names = names_of(result.design);
  const auto add = [&](const char* name, const char* meaning, GetEstimate get) {
    table.add(
        name, "", meaning, [get](const Row& r) { return get(r).value; }, "{:.3g}");
    table.add(fmt::format("{}_95_%", name), "", "interval",
              [get](const Row& r) { return interval_text(get(r).interval); });
  };
  add(names.main, names.main_meaning, main_of);
  add(names.total, names.total_meaning, total_of);
  if (result.design == Design::morris) add_sigma(table);
  return table.take();
}

}  // namespace linkstudy::sensitivity

#include "study/converge/convergence_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace linkstudy::convergence {
namespace {

// A level and the ladder it belongs to.
struct LevelRow {
  const QuantityLadder* ladder;
  std::size_t i;
  const RefinementRow& judged() const { return ladder->refinement.rows[i]; }
  const LevelSource& source() const { return ladder->levels[i]; }
};

std::string behaviour_word(const RefinementRow& row) {
  return row.behaviour == Behaviour::untold ? std::string() : std::string(name_of(row.behaviour));
}

// What is told of a level, after its size.
void add_level_columns(TableOf<LevelRow>& columns, const std::string& unit) {
  using Row = LevelRow;
  columns.add(
      "steps", "", "accepted steps", [](const Row& r) { return r.source().steps; }, "{:.0f}");
  columns.add(
      "value", unit, "of the quantity", [](const Row& r) { return r.judged().value; }, "{:.8g}");
  columns.add(
      "difference", unit, "from the next coarser level",
      [](const Row& r) { return r.judged().change; }, "{:.3e}");
  columns.add(
      "ratio", "", "of the sizes of both", [](const Row& r) { return r.judged().ratio; }, "{:.4g}");
  columns.add("class", "", "of this level and the two coarser ones",
              [](const Row& r) { return behaviour_word(r.judged()); });
  columns.add(
      "order", "", "observed", [](const Row& r) { return r.judged().order; }, "{:.3f}");
  columns.add(
      "extrapolated", unit, "to the limit of refinement",
      [](const Row& r) { return r.judged().extrapolated; }, "{:.8g}");
  columns.add(
      "gci", "%", "grid convergence index of the level",
      [](const Row& r) { return 100.0 * r.judged().gci; }, "{:.3g}");
  columns.add(
      "asymptotic_ratio", "", "1 where all three levels are asymptotic",
      [](const Row& r) { return r.judged().asymptotic_ratio; }, "{:.4f}");
  columns.add(
      "error", unit, "against the reference", [](const Row& r) { return r.judged().error; },
      "{:.3e}");
  columns.add(
      "error_order", "", "of the errors of this level and the next coarser one",
      [](const Row& r) { return r.judged().error_order; }, "{:.3f}");
}

void add_source_columns(TableOf<LevelRow>& columns) {
  columns.add("evaluation", "", "that the level is",
              [](const LevelRow& r) { return static_cast<std::int64_t>(r.source().evaluation); });
  columns.add(
      "wall_s", "s", "its wall time", [](const LevelRow& r) { return r.source().wall_s; },
      "{:.3g}");
  columns.add("status", "", "why it ended",
              [](const LevelRow& r) { return std::string(name_of(r.source().status)); });
}

Table make_level_table(const Convergence& result) {
  std::vector<LevelRow> rows;
  for (const QuantityLadder& ladder : result.ladders) {
    for (std::size_t i = 0; i < ladder.levels.size(); ++i) rows.push_back({&ladder, i});
  }
  TableOf columns("convergence", "convergence", std::move(rows));
  columns.add("quantity", "", "what is refined",
              [](const LevelRow& r) { return r.ladder->quantity; });
  columns.add("unit", "", "of value, difference, extrapolated and error",
              [](const LevelRow& r) { return r.ladder->unit; });
  columns.add("over", "", "refined value", [](const LevelRow& r) { return r.ladder->over; });
  columns.add("at", "", "the other refined value", [](const LevelRow& r) { return r.ladder->at; });
  columns.add("size", "", "of the refined value, in its unit",
              [](const LevelRow& r) { return r.source().size; });
  add_level_columns(columns, "");
  add_source_columns(columns);
  return columns.take();
}

std::string remarks_of(const QuantityLadder& ladder) {
  return fmt::format("{}", fmt::join(ladder.refinement.remarks, "; "));
}

void add_order_columns(TableOf<QuantityLadder>& columns) {
  using Row = QuantityLadder;
  columns.add("class", "", "of the finest levels above the floor",
              [](const Row& r) { return std::string(name_of(r.refinement.behaviour)); });
  columns.add(
      "order", "", "observed at them", [](const Row& r) { return r.refinement.order; }, "{:.3f}");
  columns.add(
      "formal", "", "order that the method should show",
      [](const Row& r) { return r.refinement.formal_order; }, "{:g}");
  columns.add(
      "fitted", "", "order over all levels that are asymptotic",
      [](const Row& r) { return r.refinement.fit ? r.refinement.fit->order : kUnknown; }, "{:.3f}");
  columns.add(
      "wanted", "%", "relative error", [](const Row& r) { return 100.0 * r.wanted; }, "{:g}");
  columns.add(
      "needed", "", "refined value at which the error is that",
      [](const Row& r) { return r.needed; }, "{:.4g}");
  columns.add(
      "extrapolated", "", "to the limit of refinement",
      [](const Row& r) { return r.refinement.extrapolated; }, "{:.8g}");
  columns.add(
      "gci", "%", "grid convergence index", [](const Row& r) { return 100.0 * r.refinement.gci; },
      "{:.2g}");
  columns.add(
      "reference", "", "value of the reference", [](const Row& r) { return r.reference; },
      "{:.8g}");
  columns.add(
      "off_reference", "%", "extrapolated less reference, of the reference",
      [](const Row& r) { return 100.0 * (r.refinement.extrapolated / r.reference - 1.0); },
      "{:.2g}");
}

void add_ladder_names(TableOf<QuantityLadder>& columns) {
  using Row = QuantityLadder;
  columns.add("quantity", "", "what is refined", [](const Row& r) { return r.quantity; });
  columns.add("unit", "", "of extrapolated and reference", [](const Row& r) { return r.unit; });
  columns.add("over", "", "refined value", [](const Row& r) { return r.over; });
  columns.add("at", "", "the other refined value", [](const Row& r) { return r.at; });
}

Table make_all_orders(const Convergence& result) {
  using Row = QuantityLadder;
  TableOf columns("orders", "convergence", result.ladders);
  add_ladder_names(columns);
  add_order_columns(columns);
  columns.add("needed_by", "", "levels: between two; coarsest: every level is enough",
              [](const Row& r) { return std::string(name_of(r.needed_by)); });
  columns.add(
      "difference_order", "", "with which differences fall, whatever their signs",
      [](const Row& r) { return r.refinement.difference_order; }, "{:.3f}");
  columns.add("fit_levels", "", "in the fit", [](const Row& r) {
    return static_cast<std::int64_t>(r.refinement.fit ? r.refinement.fit->count : 0);
  });
  columns.add(
      "fit_extrapolated", "", "by the fit",
      [](const Row& r) { return r.refinement.fit ? r.refinement.fit->limit : kUnknown; }, "{:.8g}");
  columns.add(
      "fit_deviation", "", "standard deviation about the fit",
      [](const Row& r) { return r.refinement.fit ? r.refinement.fit->deviation : kUnknown; },
      "{:.2e}");
  columns.add(
      "safety_factor", "", "in the index", [](const Row& r) { return r.refinement.safety_factor; },
      "{:g}");
  columns.add(
      "noise", "", "greatest difference taken for rounding",
      [](const Row& r) { return r.refinement.noise; }, "{:.2e}");
  columns.add("remarks", "", "what else is to be known", remarks_of);
  return columns.take();
}

bool says_nothing(const Column& column) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&column.values)) {
    return std::ranges::all_of(*numbers, [](double value) { return std::isnan(value); });
  }
  const auto* words = std::get_if<std::vector<std::string>>(&column.values);
  return words != nullptr && std::ranges::all_of(*words, &std::string::empty);
}

// A word that all rows share, "ok" for one.
bool is_always(const Column& column, const std::string& word) {
  const auto* words = std::get_if<std::vector<std::string>>(&column.values);
  return words != nullptr && std::ranges::all_of(*words, [&](const auto& w) { return w == word; });
}

void leave_out(Table& table, const std::vector<std::string>& names) {
  std::erase_if(table.columns, [&](const Column& column) {
    return says_nothing(column) || std::ranges::find(names, column.name) != names.end();
  });
}

bool has_one_ratio(const QuantityLadder& ladder) {
  double ratio = kUnknown;
  for (const RefinementRow& row : ladder.refinement.rows) {
    if (std::isnan(row.ratio)) continue;
    if (!std::isnan(ratio) && std::abs(row.ratio / ratio - 1.0) > 1e-9) return false;
    ratio = row.ratio;
  }
  return true;
}

}  // namespace

std::vector<Table> make_tables(const Convergence& result) {
  return {make_level_table(result), make_all_orders(result)};
}

Table make_ladder_table(const QuantityLadder& ladder) {
  std::vector<LevelRow> rows;
  for (std::size_t i = 0; i < ladder.levels.size(); ++i) rows.push_back({&ladder, i});
  const std::string unit = ladder.unit.empty() ? "" : fmt::format(" in {}", ladder.unit);
  const std::string at = ladder.at.empty() ? "" : ", " + ladder.at;
  TableOf columns(fmt::format("{}{}{}", ladder.quantity, unit, at), "convergence", std::move(rows));
  columns.add(ladder.over, ladder.over_unit, "refined value",
              [](const LevelRow& r) { return r.source().size; });
  add_level_columns(columns, "");
  add_source_columns(columns);
  Table table = columns.take();
  std::vector<std::string> aside = {"evaluation", "steps", "asymptotic_ratio", "wall_s"};
  if (has_one_ratio(ladder)) aside.emplace_back("ratio");
  if (ladder.kind == QuantityKind::error) aside.emplace_back("error");
  leave_out(table, aside);
  std::erase_if(table.columns, [](const Column& column) {
    return column.name == "status" && is_always(column, std::string(name_of(Cause::ok)));
  });
  return table;
}

Table make_order_table(const Convergence& result) {
  TableOf columns("", "convergence", result.ladders);
  add_ladder_names(columns);
  add_order_columns(columns);
  Table table = columns.take();
  std::vector<std::string> same;
  for (const char* name : {"over", "wanted"}) {
    const Column& column = *find_column(table, name);
    const auto shares = [&](const auto& values) {
      return std::ranges::all_of(values, [&](const auto& v) { return v == values.front(); });
    };
    if (std::visit(shares, column.values)) same.emplace_back(name);
  }
  leave_out(table, same);
  return table;
}

}  // namespace linkstudy::convergence

#include "study/converge/write_convergence.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace linkstudy::convergence {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json row_of(const QuantityLadder& ladder, std::size_t i) {
  const RefinementRow& row = ladder.refinement.rows[i];
  const LevelSource& source = ladder.levels[i];
  return {{"size", source.size},
          {"h", number(row.h)},
          {"steps", number(source.steps)},
          {"value", number(row.value)},
          {"difference", number(row.change)},
          {"ratio", number(row.ratio)},
          {"class", name_of(row.behaviour)},
          {"order", number(row.order)},
          {"extrapolated", number(row.extrapolated)},
          {"gci_percent", number(100.0 * row.gci)},
          {"asymptotic_ratio", number(row.asymptotic_ratio)},
          {"error", number(row.error)},
          {"error_order", number(row.error_order)},
          {"is_floor", row.is_floor},
          {"evaluation", source.evaluation},
          {"status", name_of(source.status)}};
}

Json fit_of(const Refinement& refinement) {
  if (!refinement.fit) return nullptr;
  return {{"order", number(refinement.fit->order)},
          {"extrapolated", number(refinement.fit->limit)},
          {"deviation", number(refinement.fit->deviation)},
          {"levels", refinement.fit->count}};
}

Json table_of(const QuantityLadder& ladder) {
  const Refinement& judged = ladder.refinement;
  Json rows = Json::array();
  for (std::size_t i = 0; i < ladder.levels.size(); ++i) rows.push_back(row_of(ladder, i));
  return {{"name", ladder.quantity},
          {"unit", ladder.unit},
          {"kind", name_of(ladder.kind)},
          {"over", ladder.over},
          {"at", ladder.at},
          {"class", name_of(judged.behaviour)},
          {"observed_order", number(judged.order)},
          {"formal_order", number(judged.formal_order)},
          {"fit", fit_of(judged)},
          {"difference_order", number(judged.difference_order)},
          {"extrapolated", number(judged.extrapolated)},
          {"gci_percent", number(100.0 * judged.gci)},
          {"safety_factor", number(judged.safety_factor)},
          {"reference", number(ladder.reference)},
          {"difference", number(judged.extrapolated - ladder.reference)},
          {"wanted", number(ladder.wanted)},
          {"needed", number(ladder.needed)},
          {"needed_by", name_of(ladder.needed_by)},
          {"remarks", judged.remarks},
          {"rows", std::move(rows)}};
}

Json needed_of(const NeededValue& all) {
  return {{"parameter", all.path},
          {"needed", number(all.needed)},
          {"needed_by", name_of(all.by)},
          {"quantity", all.quantity},
          {"wanted", number(all.wanted)},
          {"model", number(all.own)},
          {"fineness", number(all.fineness)},
          {"unknown", all.unknown}};
}

}  // namespace

std::string write_json(const Convergence& result, const std::string& digest) {
  Json tables = Json::array();
  for (const QuantityLadder& ladder : result.ladders) tables.push_back(table_of(ladder));
  Json needed = Json::array();
  for (const NeededValue& all : result.needed) needed.push_back(needed_of(all));
  const Json json = {{"status", result.is_settled() ? "converged" : "not converged"},
                     {"tables", std::move(tables)},
                     {"needed", std::move(needed)},
                     {"digest", digest}};
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace linkstudy::convergence

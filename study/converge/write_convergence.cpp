#include "study/converge/write_convergence.h"

#include <nlohmann/json.hpp>

#include "study/record/json_number.h"

namespace linkstudy::convergence {
namespace {

using Json = nlohmann::ordered_json;

Json row_of(const QuantityLadder& ladder, std::size_t i) {
  const RefinementRow& row = ladder.refinement.rows[i];
  const LevelSource& source = ladder.levels[i];
  return {{"size", source.size},
          {"h", json_number(row.h)},
          {"steps", json_number(source.steps)},
          {"value", json_number(row.value)},
          {"difference", json_number(row.change)},
          {"ratio", json_number(row.ratio)},
          {"class", name_of(row.behaviour)},
          {"order", json_number(row.order)},
          {"extrapolated", json_number(row.extrapolated)},
          {"gci_percent", json_number(100.0 * row.gci)},
          {"asymptotic_ratio", json_number(row.asymptotic_ratio)},
          {"error", json_number(row.error)},
          {"error_order", json_number(row.error_order)},
          {"is_floor", row.is_floor},
          {"evaluation", source.evaluation},
          {"status", name_of(source.status)}};
}

Json fit_of(const Refinement& refinement) {
  if (!refinement.fit) return nullptr;
  return {{"order", json_number(refinement.fit->order)},
          {"extrapolated", json_number(refinement.fit->limit)},
          {"deviation", json_number(refinement.fit->deviation)},
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
          {"observed_order", json_number(judged.order)},
          {"formal_order", json_number(judged.formal_order)},
          {"fit", fit_of(judged)},
          {"difference_order", json_number(judged.difference_order)},
          {"extrapolated", json_number(judged.extrapolated)},
          {"gci_percent", json_number(100.0 * judged.gci)},
          {"safety_factor", json_number(judged.safety_factor)},
          {"reference", json_number(ladder.reference)},
          {"difference", json_number(judged.extrapolated - ladder.reference)},
          {"wanted", json_number(ladder.wanted)},
          {"needed", json_number(ladder.needed)},
          {"needed_by", name_of(ladder.needed_by)},
          {"remarks", judged.remarks},
          {"rows", std::move(rows)}};
}

Json needed_of(const NeededValue& all) {
  return {{"parameter", all.path},
          {"needed", json_number(all.needed)},
          {"needed_by", name_of(all.by)},
          {"quantity", all.quantity},
          {"wanted", json_number(all.wanted)},
          {"model", json_number(all.own)},
          {"fineness", json_number(all.fineness)},
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

#include "study/report/convergence_report.h"

#include <fmt/format.h>

#include <cmath>

#include "study/converge/convergence_tables.h"
#include "study/report/write_table.h"

namespace linkstudy {
namespace {

using convergence::Convergence;
using convergence::NeededBy;
using convergence::NeededValue;
using convergence::QuantityLadder;

std::string with_unit(double value, const std::string& unit) {
  return fmt::format("{:.7g}{}{}", value, unit.empty() ? "" : " ", unit);
}

// What the limit of refinement says of the reference: of a stiffness, of the exact joint.
std::string reference_text(const QuantityLadder& ladder) {
  const double limit = ladder.refinement.extrapolated;
  if (std::isnan(limit) || std::isnan(ladder.reference)) return {};
  return fmt::format("  extrapolated {}; the reference has {}, {:.2g} % off\n",
                     with_unit(limit, ladder.unit), with_unit(ladder.reference, ladder.unit),
                     100.0 * std::abs(limit / ladder.reference - 1.0));
}

std::string ladder_text(const QuantityLadder& ladder, std::size_t width) {
  std::string text = text_of(convergence::make_ladder_table(ladder), width);
  text += reference_text(ladder);
  for (const std::string& remark : ladder.refinement.remarks) text += "  " + remark + "\n";
  return text + "\n";
}

std::string needed_text(const NeededValue& all) {
  if (all.by == NeededBy::nothing) {
    return fmt::format("{}: no quantity tells what the wanted error needs\n", all.path);
  }
  const char* how = all.by == NeededBy::coarsest        ? ", the coarsest level already"
                    : all.by == NeededBy::extrapolation ? ", finer than every level"
                                                        : "";
  std::string text =
      fmt::format("{}: {:g} % needs {:.3g}{}{} ({}{})", all.path, 100.0 * all.wanted, all.needed,
                  all.unit.empty() ? "" : " ", all.unit, all.quantity, how);
  if (std::isfinite(all.fineness)) {
    const bool is_enough = all.fineness >= 1.0;
    text += fmt::format("; the model's {} is {:.3g} times {}", with_unit(all.own, all.unit),
                        is_enough ? all.fineness : 1.0 / all.fineness,
                        is_enough ? "finer" : "too coarse");
  }
  if (all.unknown > 0) {
    text += fmt::format("; {} quantit{} do{} not tell", all.unknown, all.unknown == 1 ? "y" : "ies",
                        all.unknown == 1 ? "es" : "");
  }
  return text + "\n";
}

}  // namespace

std::string convergence_text(const Convergence& result, std::size_t width) {
  std::string text;
  for (const QuantityLadder& ladder : result.ladders) text += ladder_text(ladder, width);
  text += text_of(convergence::make_order_table(result), width) + "\n";
  for (const NeededValue& all : result.needed) text += needed_text(all);
  return text;
}

}  // namespace linkstudy

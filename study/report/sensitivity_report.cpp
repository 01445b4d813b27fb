#include "study/report/sensitivity_report.h"

#include <fmt/format.h>

#include <cmath>

#include "study/record/counted.h"
#include "study/report/write_table.h"
#include "study/sensitivity/sensitivity_tables.h"

namespace linkstudy {
namespace {

using sensitivity::Estimate;
using sensitivity::Finding;
using sensitivity::ParameterSensitivity;
using sensitivity::QuantitySensitivity;
using sensitivity::Sensitivity;

std::string title_of(const Sensitivity& result, const QuantitySensitivity& quantity) {
  const std::string unit = quantity.unit.empty() ? "" : " " + quantity.unit;
  const char* block = result.design == Design::morris ? "trajectory" : "block";
  std::string text = quantity.name;
  if (!quantity.unit.empty()) text += fmt::format(" [{}]", quantity.unit);
  text += quantity.blocks == 1 || block[0] == 'b'
              ? ": " + counted(static_cast<std::int64_t>(quantity.blocks), block)
              : fmt::format(": {} trajectories", quantity.blocks);
  if (!std::isnan(quantity.mean)) {
    text += fmt::format(", mean {:.5g}{}, deviation {:.3g}{}", quantity.mean, unit,
                        quantity.deviation, unit);
  }
  if (quantity.left_out > 0) {
    text += fmt::format("; {} left out for evaluations that failed", quantity.left_out);
  }
  return text + "\n";
}

// What is open of an estimate: the blocks that would tell it, or that a small one would be told.
std::string open_text(const std::string& what, const std::string& path, const Estimate& estimate,
                      const QuantitySensitivity& quantity, bool is_morris) {
  if (estimate.finding != Finding::indistinct) return {};
  const bool is_small = estimate.needed <= static_cast<double>(quantity.blocks);
  const std::string rest =
      is_small ? fmt::format("{} would be", is_morris ? "1 % of the greatest mu*" : "0.01")
               : fmt::format("about {:.0f} {} would tell", estimate.needed,
                             is_morris ? "trajectories" : "blocks");
  return fmt::format("  {} of {}: {}; {}\n", what, path, name_of(estimate.finding), rest);
}

std::string quantity_text(const Sensitivity& result, const QuantitySensitivity& quantity,
                          std::size_t width) {
  std::string text = title_of(result, quantity);
  if (quantity.parameters.front().total.finding == Finding::untold) {
    return text + (quantity.blocks < 2 ? "  too few complete blocks to tell anything\n\n"
                                       : "  it does not vary\n\n");
  }
  text += text_of(sensitivity::make_quantity_table(result, quantity), width);
  const bool is_morris = result.design == Design::morris;
  for (const ParameterSensitivity& own : quantity.parameters) {
    const std::string& path = result.parameters[own.parameter].path;
    if (own.total.finding == Finding::none) {
      text += fmt::format("  {}: {}\n", path, name_of(Finding::none));
      continue;
    }
    text += open_text(is_morris ? "mu" : "first order", path, own.main, quantity, is_morris);
    text += open_text(is_morris ? "mu*" : "total", path, own.total, quantity, is_morris);
  }
  return text + "\n";
}

}  // namespace

std::string sensitivity_text(const Sensitivity& result, std::size_t width) {
  std::string text;
  for (const QuantitySensitivity& one : result.quantities) {
    text += quantity_text(result, one, width);
  }
  if (result.failures.empty()) return text;
  text += fmt::format("{} of {} failed; what is told holds where the others ran. Both lie at:\n",
                      result.failed,
                      counted(static_cast<std::int64_t>(result.evaluations), "evaluation"));
  return text + text_of(sensitivity::make_failure_ranges(result), width) + "\n";
}

}  // namespace linkstudy

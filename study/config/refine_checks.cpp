#include "study/config/refine_checks.h"

#include <fmt/format.h>

#include <algorithm>

namespace linkstudy {
namespace {

void check_levels(const VaryInput& refine, const std::vector<Tree>& written,
                  Diagnostics& diagnostics) {
  if (refine.values.size() < 2) {
    diagnostics.add(
        refine.at,
        fmt::format("'{}' is refined in {} level", refine.parameter.path, refine.values.size()),
        "give three levels or more: fewer show no order");
  }
  for (const Tree& value : written) {
    if (value.is_numeric() && value.as_number() > 0.0) continue;
    diagnostics.add(value.at,
                    fmt::format("a level of '{}' must be a positive number, got {}",
                                refine.parameter.path, shown(value)),
                    value.is_numeric() ? "the limit itself is no level: give it to the reference"
                                       : "vary words in a study");
  }
}

}  // namespace

void finish_refinement(StudyInput& input, const WrittenValues& written, Diagnostics& diagnostics) {
  for (std::size_t i = 2; i < input.vary.size(); ++i) {
    diagnostics.add(input.vary[i].at, "more than two values are refined",
                    "keep two [[refine]]; the others have their best known values");
  }
  for (std::size_t i = 0; i < std::min(input.vary.size(), written.size()); ++i) {
    check_levels(input.vary[i], written[i], diagnostics);
  }
  for (MatchInput& match : input.match) {
    if (match.tolerance.empty()) match.tolerance = {input.wanted_error};
  }
  for (const SeriesInput& series : input.series) input.trace.push_back({series.signal, series.at});
}

}  // namespace linkstudy

#include "study/session/stored_program.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/isa.h"
#include "study/record/version.h"

namespace linkstudy {

std::optional<std::string> revision_warning(const StudyResults& results) {
  if (results.git_revision == git_revision()) return std::nullopt;
  return fmt::format("these results are of revision {}, this program is {}",
                     results.git_revision.empty() ? "unknown" : results.git_revision,
                     git_revision().empty() ? "of an unknown one" : git_revision());
}

std::optional<std::string> rounding_warning(const StudyResults& results) {
  if (results.provenance.empty()) return std::nullopt;
  const std::string baseline(name_of(InstructionSet::baseline));
  const std::string& before = results.provenance.back().simd;
  const std::string now(name_of(simd_level().isa));
  if (before.empty() || (before == baseline) == (now == baseline)) return std::nullopt;
  return fmt::format(
      "these results are of instruction set {}, this start has {}, which rounds differently",
      before, now);
}

std::string shown_number(double value) {
  return std::isnan(value) ? "nothing" : fmt::format("{:.17g}", value);
}

}  // namespace linkstudy

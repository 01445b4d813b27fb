// Why a run ended: a closed list, stored by number in results and by name in tables.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace linkstudy {

enum class Cause : std::uint8_t {
  ok,
  diverged,
  energy_blowup,
  step_budget,
  statics_failed,
  assembly_failed,
  constraint_drift,
  contact_budget,
  timeout,
  cancelled,
  exception,
  rank_lost,
  invalid_point,
  step_too_coarse
};

inline constexpr std::array<std::string_view, 14> kCauseNames = {"ok",
                                                                 "diverged",
                                                                 "energy_blowup",
                                                                 "step_budget",
                                                                 "statics_failed",
                                                                 "assembly_failed",
                                                                 "constraint_drift",
                                                                 "contact_budget",
                                                                 "timeout",
                                                                 "cancelled",
                                                                 "exception",
                                                                 "rank_lost",
                                                                 "invalid_point",
                                                                 "step_too_coarse"};

constexpr std::string_view name_of(Cause cause) {
  return kCauseNames[static_cast<std::size_t>(cause)];
}

}  // namespace linkstudy

// Why a run ended: a closed list, stored by number in results and by name in tables.
#pragma once

#include <cstdint>

#include "core/base/words.h"

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
  step_too_coarse,
  course_blocked,  // of kinematics: the drives cannot go as asked
  no_full_turn     // of a cycle that is to be looked at
};

template <>
inline constexpr auto kWords<Cause> =
    make_words<Cause>({{Cause::ok, "ok"},
                       {Cause::diverged, "diverged"},
                       {Cause::energy_blowup, "energy_blowup"},
                       {Cause::step_budget, "step_budget"},
                       {Cause::statics_failed, "statics_failed"},
                       {Cause::assembly_failed, "assembly_failed"},
                       {Cause::constraint_drift, "constraint_drift"},
                       {Cause::contact_budget, "contact_budget"},
                       {Cause::timeout, "timeout"},
                       {Cause::cancelled, "cancelled"},
                       {Cause::exception, "exception"},
                       {Cause::rank_lost, "rank_lost"},
                       {Cause::invalid_point, "invalid_point"},
                       {Cause::step_too_coarse, "step_too_coarse"},
                       {Cause::course_blocked, "course_blocked"},
                       {Cause::no_full_turn, "no_full_turn"}});

}  // namespace linkstudy

// Which failures are of the machine and not of the case: a second try may end otherwise.
#pragma once

#include "core/simulation/cause.h"

namespace linkstudy {

constexpr bool is_transient(Cause cause) {
  return cause == Cause::timeout || cause == Cause::exception || cause == Cause::rank_lost ||
         cause == Cause::cancelled;
}

}  // namespace linkstudy

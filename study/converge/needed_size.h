// The coarsest level that is fine enough: the largest h of which, and of all finer ones, the error
// stays within what is wanted. Between two levels by the power law through both; beyond the finest
// by the observed order, as far as a factor of 32.
#pragma once

#include <span>

#include "core/base/words.h"
#include "study/converge/refinement.h"

namespace linkstudy::convergence {

enum class NeededBy { levels, coarsest, extrapolation, nothing };

struct NeededSize {
  double h = kUnknown;
  NeededBy by = NeededBy::nothing;  // coarsest: no level is too coarse. nothing: it is not known
};

// `errors` coarse to fine, absolute, NaN where a level failed or tells none; order: NaN where there
// is none.
NeededSize find_needed_size(std::span<const Level> errors, double wanted, double order);

}  // namespace linkstudy::convergence

namespace linkstudy {

template <>
inline constexpr auto kWords<convergence::NeededBy> =
    make_words<convergence::NeededBy>({{convergence::NeededBy::levels, "levels"},
                                       {convergence::NeededBy::coarsest, "coarsest"},
                                       {convergence::NeededBy::extrapolation, "extrapolation"},
                                       {convergence::NeededBy::nothing, "nothing"}});

}  // namespace linkstudy

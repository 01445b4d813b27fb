// How the values of several parameters combine to cases; study/design makes the cases.
#pragma once

#include "core/base/words.h"

namespace linkstudy {

enum class Design { grid, list };

template <>
inline constexpr auto kWords<Design> =
    make_words<Design>({{Design::grid, "grid", "every combination"},
                        {Design::list, "list", "first with first, and so on"}});

}  // namespace linkstudy

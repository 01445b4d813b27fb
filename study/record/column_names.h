// Columns of every table of evaluations beside its parameters and responses (/study and /runtime of
// results.h5): no response may have one of these names.
#pragma once

#include <array>

namespace linkstudy {

inline constexpr std::array kEvaluationColumns = {
    "evaluation", "status", "message", "attempts", "parent_evaluation", "wall_s", "rank", "host"};

}  // namespace linkstudy

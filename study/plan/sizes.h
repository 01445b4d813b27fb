// How much memory and disk a study takes.
#pragma once

#include "study/plan/planned_work.h"
#include "study/plan/run_kinds.h"

namespace linkstudy::plan {

// Bytes.
struct Sizes {
  double rank = 0.0;        // memory of a rank, of this program as it is loaded here
  double first_rank = 0.0;  // of rank 0, which keeps all results
  double journal = 0.0;
  double results = 0.0;  // results.h5, at most: histories are compressed
};

// Of that many evaluations, `widest` of them side by side.
Sizes find_sizes(Evaluator& study, const RunKinds& kinds, std::uint64_t evaluations,
                 std::size_t widest);

}  // namespace linkstudy::plan

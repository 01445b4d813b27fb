// Looks for what is still missing to the proof of C4 (monotone_proof.h): boxes [a, b] of positions
// that may hold a point with f < F = f(k*) - gap, those with the lowest f(a) first, a batch at a
// time.
//   b is cut to what f < F leaves: b_j <= a_j + F - f(a).
//   A proof at or above b closes the box; one that is so in all directions but j moves a_j up.
//   Where no evaluated point that proves nothing lies in the way (at or below b), b is evaluated,
//   and at half its step too where it fails but what its step adds is not known.
//   Else the box is split before the point in the way, at the distance at which an error that falls
//   as 1/c would prove; or, where that is near the face, in the middle of its longest edge.
// A box narrower than the resolution cannot be decided: where it has the lowest f(a), no smaller
// gap is to be had, and the search ends. That is for mu where a point at or below b matches, or
// nearly; where all of them fail by their step, which proves nothing of softer ones, it is for the
// step. It also ends with a match lower than k*, for the caller to go on from, and with the budget.
#pragma once

#include "study/tune/monotone_proof.h"

namespace linkstudy::tuning {

enum class BoundEnd { closed, lower_match, undecided, step_ends_it, budget, not_monotone };

struct BoundReport {
  BoundEnd end = BoundEnd::closed;
  std::size_t evaluations = 0;
  std::uint64_t blocked_by = 0;  // the evaluation that ends by its step
};

// `reserve` evaluations are left in the budget.
BoundReport gather_proof(EvaluationLog& log, const std::vector<double>& point, std::size_t reserve);

}  // namespace linkstudy::tuning

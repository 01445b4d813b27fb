// NLopt asks whether anything lower matches: minimise sum_j weight_j s_j subject to
//   g_i(s) = log10(error_i / tolerance_i) <= 0,    x_j = start_j * 10^(s_j),
// (or a response over its size at the start)
// with s in decades from the point found, bounded by the declared range. COBYLA asks first,
// with an explicit initial step; its answer verifies when it ended by its own tolerance, within
// twice the resolution of the lowest feasible point known, and g there is no more than that. Where
// it does not verify, an augmented Lagrangian (AUGLAG) over BOBYQA asks again. Evaluations at the
// base step are remembered by exact x, so a repeated point costs nothing.
//
// NLopt is not trusted. Its returned point is reported and never used; it may be infeasible, or
// the last one tried. Budgets are counted here; when one ends the optimiser is told to stop and
// gets stale numbers until it does. g_i is kept in [-3, 3] and is 3 for an answer with a cause, so
// no NaN or infinity reaches it. An exception of the callback is kept, the optimiser stopped, and
// the exception thrown again from here.
#pragma once

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

struct NloptReport {
  bool ran = false;
  bool verified = false;        // by one of the two
  std::string algorithm;        // the last that ran
  std::string ended;            // what NLopt or our budgets said, and why that does not verify
  std::size_t calls = 0;        // objective and constraint calls
  std::size_t evaluations = 0;  // new ones it cost
  bool found_lower = false;     // a feasible point lower than the start by over the resolution
  double lowest = 0.0;          // lowest feasible value it saw (one variable)
};

// `reserve` evaluations are left in the budget; each algorithm may spend confirm_evaluations and
// confirm_calls of the options.
NloptReport confirm_with_nlopt(EvaluationLog& log, const std::vector<double>& start,
                               std::size_t reserve);

}  // namespace linkstudy::tuning

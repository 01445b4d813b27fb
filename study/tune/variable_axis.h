// A tuned variable along its axis: t = log10 x, in decades.
#pragma once

#include "study/tune/tuning_problem.h"

namespace linkstudy::tuning {

// 10^t kept in the declared range, the ends of which are exact.
double from_axis(const TunedVariable& variable, double t);
// `decades` farther, kept in the range.
double move_along(const TunedVariable& variable, double value, double decades);

// Whether a is nowhere higher than b.
bool is_below(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace linkstudy::tuning

// A tuned variable along its axis. Distances are decades, t = log10 x; of a linear range they are
// parts of the range, t = x / (high - low): what is said of decades then holds of those.
#pragma once

#include "study/tune/tuning_problem.h"

namespace linkstudy::tuning {

double position_of(const TunedVariable& variable, double x);
double value_at(const TunedVariable& variable, double t);
// t of b less that of a.
double distance(const TunedVariable& variable, double a, double b);
// `distance` farther, also out of the range.
double shifted(const TunedVariable& variable, double x, double distance);
double midway(const TunedVariable& variable, double a, double b);

// The value at t kept in the declared range, the ends of which are exact.
double from_axis(const TunedVariable& variable, double t);
// `distance` farther, kept in the range.
double move_along(const TunedVariable& variable, double value, double distance);

// Whether a is nowhere higher than b.
bool is_below(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace linkstudy::tuning

// Natural cubic spline through (t_i, p_i): twice continuously differentiable, without second
// derivative at both ends, so that a straight line goes on from either end as smoothly.
#pragma once

#include <vector>

namespace linkstudy {

// p + x (first + x (second / 2 + x third / 6)) with x = t - begin, up to the next knot.
struct SplineKnot {
  double begin = 0.0, value = 0.0, first = 0.0, second = 0.0, third = 0.0;
};

// One for each point; the last is the straight line that goes on. At least two
// points, times rising.
std::vector<SplineKnot> natural_spline(const std::vector<double>& t, const std::vector<double>& p);

}  // namespace linkstudy

// The place where a continuous function changes its sign, between two places where its signs
// differ (TOMS 748 of Boost.Math; no more than a hundred evaluations).
#pragma once

#include <functional>

namespace linkstudy {

// The last interval, 4 epsilon of its size wide or less: f(first) has the sign of f(low), f(second)
// that of f(high), unless zero. Signs that do not differ leave the interval as it was.
struct Bracket {
  double first, second;
};
Bracket bracket_root(const std::function<double(double)>& f, double low, double high, double fa,
                     double fb);

}  // namespace linkstudy

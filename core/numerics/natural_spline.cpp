#include "core/numerics/natural_spline.h"

#include <algorithm>

#include "core/base/ensure.h"

namespace linkstudy {

// Second derivatives m at the points, zero at both ends, from
//   h_i m_i + 2 (h_i + h_i+1) m_i+1 + h_i+1 m_i+2 = 6 (slope_i+1 - slope_i)
std::vector<SplineKnot> natural_spline(const std::vector<double>& t, const std::vector<double>& p) {
  ensure(t.size() >= 2 && p.size() == t.size(), "two points at least, a position for each time");
  ensure(std::ranges::is_sorted(t, std::less_equal<>()), "times rise");
  const std::size_t last = t.size() - 1;
  const auto width = [&](std::size_t i) { return t[i + 1] - t[i]; };
  const auto slope = [&](std::size_t i) { return (p[i + 1] - p[i]) / width(i); };
  std::vector<double> m(t.size()), above(t.size());
  // Forward elimination of the tridiagonal system, then backward.
  for (std::size_t i = 1; i < last; ++i) {
    const double pivot = 2.0 * (width(i - 1) + width(i)) - width(i - 1) * above[i - 1];
    above[i] = width(i) / pivot;
    m[i] = (6.0 * (slope(i) - slope(i - 1)) - width(i - 1) * m[i - 1]) / pivot;
  }
  for (std::size_t i = last; i-- > 1;) m[i] -= above[i] * m[i + 1];
  std::vector<SplineKnot> knots;
  for (std::size_t i = 0; i < last; ++i) {
    knots.push_back({t[i], p[i], slope(i) - width(i) * (2.0 * m[i] + m[i + 1]) / 6.0, m[i],
                     (m[i + 1] - m[i]) / width(i)});
  }
  const double end = slope(last - 1) + width(last - 1) * m[last - 1] / 6.0;
  knots.push_back({t[last], p[last], end, 0.0, 0.0});
  return knots;
}

}  // namespace linkstudy

#include "study/converge/fit_order.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

namespace linkstudy::convergence {
namespace {

constexpr double kLeastOrder = 0.05;
constexpr double kGreatestOrder = 12.0;
constexpr int kScanned = 240;  // orders, 0.05 apart

// A straight line y = y_0 + slope x.
struct Line {
  double intercept = 0.0;
  double slope = 0.0;
  double squares = 0.0;  // of the deviations
};

template <class Abscissa, class Ordinate>
Line fit_line(std::span<const Level> levels, Abscissa x_of, Ordinate y_of) {
  const auto n = static_cast<double>(levels.size());
  double mean_x = 0.0, mean_y = 0.0;
  for (const Level& level : levels) {
    mean_x += x_of(level) / n;
    mean_y += y_of(level) / n;
  }
  double xx = 0.0, xy = 0.0;
  for (const Level& level : levels) {
    const double dx = x_of(level) - mean_x;
    xx += dx * dx;
    xy += dx * (y_of(level) - mean_y);
  }
  Line line;
  line.slope = xx > 0.0 ? xy / xx : 0.0;
  line.intercept = mean_y - line.slope * mean_x;
  for (const Level& level : levels) {
    const double rest = y_of(level) - line.intercept - line.slope * x_of(level);
    line.squares += rest * rest;
  }
  return line;
}

}  // namespace

std::optional<OrderFit> fit_order(std::span<const Level> levels) {
  if (levels.size() < 3) return std::nullopt;
  // Sizes over the largest, so that powers of them stay near 1.
  const double unit = std::ranges::max_element(levels, {}, &Level::h)->h;
  const auto line_of = [&](double p) {
    return fit_line(
        levels, [&](const Level& level) { return std::pow(level.h / unit, p); },
        [](const Level& level) { return level.value; });
  };
  const auto squares_of = [&](double p) { return line_of(p).squares; };
  const double width = (kGreatestOrder - kLeastOrder) / kScanned;
  int best = 0;
  double least = squares_of(kLeastOrder);
  for (int i = 1; i <= kScanned; ++i) {
    const double squares = squares_of(kLeastOrder + i * width);
    if (squares < least) {
      least = squares;
      best = i;
    }
  }
  if (best == 0 || best == kScanned) return std::nullopt;
  const double middle = kLeastOrder + best * width;
  std::uintmax_t most = 200;
  const double order =
      boost::math::tools::brent_find_minima(squares_of, middle - width, middle + width,
                                            std::numeric_limits<double>::digits / 2, most)
          .first;
  const Line line = line_of(order);
  OrderFit fit{line.intercept, line.slope / std::pow(unit, order), order, 0.0, levels.size()};
  if (levels.size() > 3) {
    fit.deviation = std::sqrt(line.squares / static_cast<double>(levels.size() - 3));
  }
  return fit;
}

double fit_difference_order(std::span<const Level> differences) {
  std::vector<Level> seen;
  std::ranges::copy_if(differences, std::back_inserter(seen),
                       [](const Level& level) { return std::abs(level.value) > 0.0; });
  if (seen.size() < 2) return std::numeric_limits<double>::quiet_NaN();
  return fit_line(
             seen, [](const Level& level) { return std::log(level.h); },
             [](const Level& level) { return std::log(std::abs(level.value)); })
      .slope;
}

}  // namespace linkstudy::convergence

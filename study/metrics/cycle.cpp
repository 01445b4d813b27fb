#include "study/metrics/cycle.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace linkstudy {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kSlack = 1e-9;  // of what is asked for: a drive of just so many turns counts

}  // namespace

std::optional<TimeWindow> find_cycle(const CycleInput& cycle, const Series& angle, double h) {
  const std::vector<double>& q = angle.values;
  if (q.empty()) return std::nullopt;
  const double way = kTurn * static_cast<double>(cycle.turns) * (1.0 - kSlack);
  const auto away = [&](std::size_t i) { return std::abs(q[i] - q.back()); };
  for (std::size_t i = q.size(); i-- > 0;) {
    if (away(i) < way) continue;
    // Between this step and the next.
    const double part = (away(i) - way) / (away(i) - away(i + 1));
    return TimeWindow{h * (static_cast<double>(i) + part), h * static_cast<double>(q.size() - 1),
                      cycle.at};
  }
  return std::nullopt;
}

std::string no_cycle_text(const CycleInput& cycle, const Series& angle) {
  double most = 0.0;
  for (const double q : angle.values) most = std::max(most, std::abs(q - angle.values.back()));
  return fmt::format(
      "{} was at most {:.4g} turns away from where it ends, and the last {} of it "
      "are to be looked at",
      cycle.of, most / kTurn, cycle.turns);
}

}  // namespace linkstudy

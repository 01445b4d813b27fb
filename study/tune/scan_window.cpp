#include "study/tune/scan_window.h"

#include <algorithm>
#include <cmath>

#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

// Below this h * omega a step error, (h omega)^4 of a period, is under 2e-7: a rising error there
// belongs to the model and not to the step.
constexpr double kStepErrorFree = 0.02;

bool past_limit(const Answer& answer) {
  return answer.step_limit > 0.0 && answer.step > answer.step_limit;
}

bool step_may_matter(double h_omega) {
  return !(h_omega > 0.0) || h_omega > kStepErrorFree;
}

ScanPoint describe(const EvaluationLog& log, double value) {
  const Observation& observation = *log.find({value}, 1.0);
  const Answer& answer = observation.answer;
  ScanPoint point;
  point.declared = observation.request.purpose == "scan" || observation.request.purpose == "refine";
  point.value = value;
  point.ratio = compute_ratio(answer, log.problem().components);
  point.cause = answer.status;
  point.evaluation = answer.id;
  point.h_omega = answer.h_omega;
  point.side = Side::too_soft;
  if (point.ratio <= 1.0) {
    point.side = Side::feasible;
  } else if (is_instability(answer.status)) {
    point.side = Side::diverged;
  } else if (!std::isfinite(point.ratio)) {
    point.side = Side::failed;
  } else if (past_limit(answer)) {
    point.side = Side::step_too_coarse;
  }
  return point;
}

struct Span {
  double low = 0.0;
  double high = 0.0;
};

// Values between which a finite failing point is neither plainly below nor plainly above: the
// feasible points, or the smallest ratio where there are none.
Span find_valley(const std::vector<ScanPoint>& points) {
  constexpr double kEnd = std::numeric_limits<double>::infinity();
  Span feasible{kEnd, -kEnd};
  for (const ScanPoint& point : points) {
    if (point.side == Side::feasible) {
      feasible = {std::min(feasible.low, point.value), std::max(feasible.high, point.value)};
    }
  }
  if (feasible.low <= feasible.high) return feasible;
  const auto best = std::min_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.ratio < b.ratio; });
  return {best->value, best->value};
}

bool falls_through(const std::vector<ScanPoint>& points, std::size_t i) {
  const bool last = i + 1 == points.size();
  const double before = i == 0 ? points[i].ratio : points[i - 1].ratio;
  const double after = last ? points[i].ratio : points[i + 1].ratio;
  return after < before;
}

Side decide_side(const std::vector<ScanPoint>& points, std::size_t i, const Span& valley) {
  const ScanPoint& point = points[i];
  if (!step_may_matter(point.h_omega) || point.value < valley.low) return Side::too_soft;
  if (point.value > valley.high) return Side::step_too_coarse;
  if (valley.low < valley.high) {
    return falls_through(points, i) ? Side::too_soft : Side::step_too_coarse;
  }
  // The smallest ratio itself: at the stiff end of the range it was still falling.
  const bool at_stiff_end = i + 1 == points.size() && i > 0;
  return at_stiff_end ? Side::too_soft : Side::step_too_coarse;
}

struct Split {
  double log_ratio = 0.0;
  double value = 0.0;
};

double known_log_ratio(const EvaluationLog& log, double value) {
  return compute_log_ratio(log.ratio(value, 1.0).value());
}

// A cause is a cliff: how high the ratio would be behind it bounds nothing, only the other end
// does.
IntervalBound bound_beside_failure(const TunedVariable& variable, double a, double log_ratio_a,
                                   double b, double log_ratio_b, const Steepest& steepest) {
  const double width = distance(variable, a, b);
  const double middle = midway(variable, a, b);
  if (log_ratio_b >= 12.0) {
    return {log_ratio_a - steepest.fall * width, middle};
  }
  if (log_ratio_a >= 12.0) {
    return {log_ratio_b - steepest.rise * width, middle};
  }
  return bound_between(variable, a, log_ratio_a, b, log_ratio_b, steepest);
}

Steepest find_steepest(const EvaluationLog& log, const std::vector<double>& values) {
  const TunedVariable& variable = log.problem().variables.front();
  Steepest steepest;
  if (variable.is_logarithmic) return steepest;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double a = known_log_ratio(log, values[i]);
    const double b = known_log_ratio(log, values[i + 1]);
    if (a >= 12.0 || b >= 12.0) continue;
    const double slope = 2.0 * std::abs(b - a) / distance(variable, values[i], values[i + 1]);
    steepest = {std::max(steepest.fall, slope), std::max(steepest.rise, slope)};
  }
  return steepest;
}

// Intervals that could still hide a window, lowest bound first.
std::vector<Split> find_splits(const EvaluationLog& log) {
  const TunedVariable& variable = log.problem().variables.front();
  const std::vector<double> values = log.base_values();
  const Steepest steepest = find_steepest(log, values);
  const double narrowest = 4.0 * log.options().resolution;
  std::vector<Split> splits;
  for (std::size_t i = 0; i + 1 < values.size(); ++i) {
    const double a = known_log_ratio(log, values[i]);
    const double b = known_log_ratio(log, values[i + 1]);
    const bool both_failed = a >= 12.0 && b >= 12.0;
    if (both_failed || distance(variable, values[i], values[i + 1]) <= narrowest) continue;
    const IntervalBound bound =
        bound_beside_failure(variable, values[i], a, values[i + 1], b, steepest);
    if (bound.log_ratio <= 0.0) {
      splits.push_back({bound.log_ratio, bound.value});
    }
  }
  std::stable_sort(splits.begin(), splits.end(),
                   [](const Split& a, const Split& b) { return a.log_ratio < b.log_ratio; });
  return splits;
}

}  // namespace

std::vector<double> make_scan_values(const TunedVariable& variable, std::size_t count) {
  std::vector<double> values(count);
  const double length = distance(variable, variable.low, variable.high);
  for (std::size_t i = 0; i < count; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(count - 1);
    values[i] = shifted(variable, variable.low, part * length);
  }
  values.back() = variable.high;
  return values;
}

double compute_log_ratio(double ratio) {
  return std::isnan(ratio) ? 12.0 : std::clamp(std::log10(ratio), -12.0, 12.0);
}

IntervalBound bound_between(const TunedVariable& variable, double a, double log_ratio_a, double b,
                            double log_ratio_b, const Steepest& steepest) {
  const double width = distance(variable, a, b);
  const double meet =
      (log_ratio_a - log_ratio_b + steepest.rise * width) / (steepest.fall + steepest.rise);
  // Away from the ends, so that a split always shortens both parts.
  const double offset = std::clamp(meet, 0.1 * width, 0.9 * width);
  const double attained = std::clamp(meet, 0.0, width);
  return {log_ratio_a - steepest.fall * attained, shifted(variable, a, offset)};
}

std::vector<ScanPoint> classify_points(const EvaluationLog& log) {
  std::vector<ScanPoint> points;
  for (const double value : log.base_values()) points.push_back(describe(log, value));
  if (points.empty()) return points;
  const Span valley = find_valley(points);
  const std::vector<ScanPoint> seen = points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].side == Side::too_soft) points[i].side = decide_side(seen, i, valley);
  }
  return points;
}

bool any_feasible(const EvaluationLog& log) {
  const std::vector<double> values = log.base_values();
  return std::any_of(values.begin(), values.end(),
                     [&](double value) { return log.ratio(value, 1.0).value() <= 1.0; });
}

bool refine_scan(EvaluationLog& log) {
  while (!any_feasible(log) && !log.exhausted()) {
    const std::vector<Split> splits = find_splits(log);
    if (splits.empty()) return false;
    std::vector<Request> requests;
    for (std::size_t i = 0; i < std::min(splits.size(), log.options().batch); ++i) {
      requests.push_back({{splits[i].value}, 1.0, "refine"});
    }
    log.evaluate(requests);
  }
  return any_feasible(log);
}

}  // namespace linkstudy::tuning

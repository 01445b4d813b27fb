#include "study/tune/scan_box.h"

#include <algorithm>
#include <cmath>

#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

// At part u of the range.
double value_at_part(const TunedVariable& variable, double u) {
  const double low = position_of(variable, variable.low);
  const double high = position_of(variable, variable.high);
  return from_axis(variable, low + u * (high - low));
}

double golden_ratio(std::size_t n) {
  double g = 1.5;
  for (int i = 0; i < 64; ++i) g = std::pow(1.0 + g, 1.0 / static_cast<double>(n + 1));
  return g;
}

bool is_matched(const EvaluationLog& log, const Observation& seen) {
  return compute_ratio(seen.answer, log.problem().components) <= 1.0;
}

Side find_side(const EvaluationLog& log, const Observation& seen,
               const std::vector<std::vector<double>>& matching) {
  const Answer& answer = seen.answer;
  const double ratio = compute_ratio(answer, log.problem().components);
  if (ratio <= 1.0) return Side::feasible;
  if (is_instability(answer.status)) return Side::diverged;
  if (!std::isfinite(ratio)) return Side::failed;
  if (answer.step_limit > 0.0 && answer.step > answer.step_limit) return Side::step_too_coarse;
  const bool is_above = std::ranges::any_of(
      matching, [&](const std::vector<double>& x) { return is_below(x, seen.request.x); });
  const Observation* half = log.find(seen.request.x, 0.5);
  const bool is_helped = half != nullptr && compute_ratio(half->answer, log.problem().components) <=
                                                0.5 * (1.0 + ratio);
  return is_above || is_helped ? Side::step_too_coarse : Side::too_soft;
}

}  // namespace

std::vector<std::vector<double>> make_box_scan(const TuningProblem& problem, std::size_t scan) {
  const std::size_t n = problem.variables.size();
  std::vector<std::vector<double>> points;
  for (std::size_t i = 0; i < scan; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(scan - 1);
    std::vector<double>& x = points.emplace_back();
    for (const TunedVariable& variable : problem.variables) {
      x.push_back(value_at_part(variable, part));
    }
  }
  const double g = golden_ratio(n);
  for (std::size_t i = 1; i <= scan * (n - 1); ++i) {
    std::vector<double>& x = points.emplace_back();
    for (std::size_t j = 0; j < n; ++j) {
      const double step = std::pow(g, -static_cast<double>(j + 1));
      const double u = 0.5 + static_cast<double>(i) * step;
      x.push_back(value_at_part(problem.variables[j], u - std::floor(u)));
    }
  }
  return points;
}

std::vector<ScanPoint> classify_box(const EvaluationLog& log,
                                    const std::vector<std::vector<double>>& scan) {
  std::vector<std::vector<double>> matching;
  for (const Observation& seen : log.observations()) {
    if (seen.request.step_factor == 1.0 && is_matched(log, seen)) {
      matching.push_back(seen.request.x);
    }
  }
  std::vector<ScanPoint> points;
  for (const Observation& seen : log.observations()) {
    if (seen.request.step_factor != 1.0) continue;
    ScanPoint point;
    point.x = seen.request.x;
    point.value = seen.request.x.front();
    point.ratio = compute_ratio(seen.answer, log.problem().components);
    point.side = find_side(log, seen, matching);
    point.cause = seen.answer.status;
    point.evaluation = seen.answer.id;
    point.h_omega = seen.answer.h_omega;
    point.declared = std::ranges::find(scan, point.x) != scan.end();
    points.push_back(std::move(point));
  }
  return points;
}

}  // namespace linkstudy::tuning

#include "study/tune/polish_point.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "study/tune/axis_search.h"
#include "study/tune/find_window.h"
#include "study/tune/lockstep.h"

namespace linkstudy::tuning {
namespace {

constexpr int kMostRounds = 4;
// Distances up an axis at which its window is sought first, decades; doubled to the end.
constexpr double kFirstRise = 0.3;

std::size_t budget_of(const EvaluationLog& log, std::size_t reserve) {
  return log.remaining() > reserve ? log.remaining() - reserve : 0;
}

bool matches_at_base(const EvaluationLog& log, double v) {
  const std::optional<double> ratio = log.ratio(v, 1.0);
  return ratio && *ratio <= 1.0;
}

// Evaluates values below at growing distances, farther where all of them match.
void look_below(EvaluationLog& axis, double v) {
  const TuningOptions& options = axis.options();
  const double low = axis.problem().variables.front().low;
  double reach = options.resolution;
  double lowest = v;
  while (lowest > low && !axis.exhausted()) {
    std::vector<Request> requests;
    for (int i = 0; i < 4; ++i, reach *= 4.0) {
      const double below = std::max(low, v * std::pow(10.0, -reach));
      requests.push_back({{below}, 1.0, "section"});
      lowest = below;
    }
    axis.evaluate(requests);
    if (!matches_at_base(axis, lowest)) return;
  }
}

void look_above(EvaluationLog& axis, double v) {
  const double high = axis.problem().variables.front().high;
  std::vector<Request> requests;
  for (double rise = kFirstRise; v * std::pow(10.0, rise) < high; rise *= 2.0) {
    requests.push_back({{v * std::pow(10.0, rise)}, 1.0, "window"});
  }
  requests.push_back({{high}, 1.0, "window"});
  axis.evaluate(requests);
}

// Down along one axis; the point itself where nothing lower is accepted.
std::vector<double> descend_axis(EvaluationLog& log, const std::vector<double>& point,
                                 std::size_t j, std::size_t reserve) {
  AxisSearch axis(log, point, j, budget_of(log, reserve), ask_log(log));
  look_below(axis.log(), axis.start());
  const std::optional<double> candidate = find_lowest_candidate(axis.log());
  if (!candidate) return point;
  const double v = descend(axis.log(), std::min(*candidate, axis.start()));
  if (v >= axis.start() || axis.log().acceptance({v}) != Acceptance::accepted) return point;
  std::vector<double> lower = point;
  lower[j] = v;
  return lower;
}

Window find_axis_window(AxisSearch& axis) {
  const double v = axis.start();
  look_above(axis.log(), v);
  return find_window(axis.log(), v);
}

}  // namespace

EvaluateBatch ask_log(EvaluationLog& log) {
  return [&log](const std::vector<Request>& requests) {
    log.evaluate(requests);
    std::vector<Answer> answers;
    for (const Request& request : requests) {
      const Observation* seen = log.find(request.x, request.step_factor);
      if (seen == nullptr) throw std::logic_error("a search went beyond its budget");
      answers.push_back(seen->answer);
    }
    return answers;
  };
}

std::optional<std::vector<double>> settle_lowest(EvaluationLog& log, std::size_t reserve) {
  while (true) {
    const Observation* lowest = nullptr;
    double objective = 0.0;
    for (const Observation& seen : log.observations()) {
      if (seen.request.step_factor != 1.0 || !log.is_candidate(seen.request.x)) continue;
      const double own = compute_objective(seen.request.x);
      if (lowest != nullptr && own >= objective) continue;
      lowest = &seen;
      objective = own;
    }
    if (lowest == nullptr) return std::nullopt;
    const std::vector<double> x = lowest->request.x;
    const bool is_open = log.acceptance(x) == Acceptance::open;
    // A half step that ended by a cause of the machine stays open.
    if (!is_open || log.find(x, 0.5) != nullptr || budget_of(log, reserve) == 0) return x;
    log.evaluate({{x, 0.5, "half_step"}});
  }
}

std::vector<double> polish_point(EvaluationLog& log, std::vector<double> point,
                                 std::size_t reserve) {
  for (int round = 0; round < kMostRounds && budget_of(log, reserve) > 0; ++round) {
    const double before = compute_objective(point);
    for (std::size_t j = 0; j < point.size(); ++j) {
      point = descend_axis(log, point, j, reserve);
    }
    if (before - compute_objective(point) <= log.options().resolution) break;
  }
  return point;
}

std::vector<Window> find_windows(EvaluationLog& log, const std::vector<double>& point,
                                 std::size_t reserve) {
  const std::size_t n = point.size();
  std::vector<Window> windows(n);
  const std::size_t share = budget_of(log, reserve) / n;
  std::vector<LockstepSearch> searches;
  for (std::size_t j = 0; j < n; ++j) {
    searches.push_back([&, j](const EvaluateBatch& ask) {
      AxisSearch axis(log, point, j, share, ask);
      windows[j] = find_axis_window(axis);
    });
  }
  run_in_lockstep(ask_log(log), searches);
  return windows;
}

}  // namespace linkstudy::tuning

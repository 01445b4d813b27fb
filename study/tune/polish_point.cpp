#include "study/tune/polish_point.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "study/tune/axis_search.h"
#include "study/tune/find_window.h"
#include "study/tune/lockstep.h"
#include "study/tune/search_section.h"
#include "study/tune/variable_axis.h"

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
  const TunedVariable& variable = axis.problem().variables.front();
  const double low = variable.low;
  double reach = options.resolution;
  double lowest = v;
  while (lowest > low && !axis.exhausted()) {
    std::vector<Request> requests;
    for (int i = 0; i < 4; ++i, reach *= 4.0) {
      const double below = std::max(low, shifted(variable, v, -reach));
      requests.push_back({{below}, 1.0, "section"});
      lowest = below;
    }
    axis.evaluate(requests);
    if (!matches_at_base(axis, lowest)) return;
  }
}

void look_above(EvaluationLog& axis, double v) {
  const TunedVariable& variable = axis.problem().variables.front();
  const double high = variable.high;
  std::vector<Request> requests;
  for (double rise = kFirstRise; shifted(variable, v, rise) < high; rise *= 2.0) {
    requests.push_back({{shifted(variable, v, rise)}, 1.0, "window"});
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

// The lower end of the interval that matches about v.
void find_low_end(EvaluationLog& axis, double v, Window& window) {
  look_below(axis, v);
  const std::vector<double> values = axis.base_values();
  double low = v;
  auto at = std::ranges::find(values, v);
  while (at != values.begin() && matches_at_base(axis, *(at - 1))) low = *--at;
  window.low_open = at == values.begin();
  if (!window.low_open) {
    const SectionSettings settings{WindowEnd::lower, Steps::base, axis.options().resolution,
                                   "window"};
    low = search_section(axis, {*(at - 1), low}, settings).feasible;
  }
  window.low = low;
  window.margin = distance(axis.problem().variables.front(), low, window.high);
}

Window find_axis_window(AxisSearch& axis) {
  const double v = axis.start();
  look_above(axis.log(), v);
  Window window = find_window(axis.log(), v);
  const TuningProblem& problem = axis.log().problem();
  const bool begins_here = !problem.response && problem.variables.front().weight > 0.0;
  if (!begins_here) find_low_end(axis.log(), v, window);
  return window;
}

// Better than another, in this order: the objective, then the distance from the tolerances.
struct Merit {
  double objective = 0.0;
  double ratio = 0.0;
  bool is_better_than(const Merit& other) const {
    const double slack = 1e-9 * std::max(1.0, std::abs(other.objective));
    if (std::abs(objective - other.objective) > slack) return objective < other.objective;
    return ratio < other.ratio * (1.0 - 1e-4);
  }
};

// The best match among the neighbours at `decades` along the axes that is better than the point.
std::optional<std::vector<double>> find_better(EvaluationLog& log, const std::vector<double>& point,
                                               double decades) {
  std::vector<std::vector<double>> neighbours;
  std::vector<Request> requests;
  for (std::size_t j = 0; j < point.size(); ++j) {
    for (const double way : {-decades, decades}) {
      std::vector<double> x = point;
      x[j] = move_along(log.problem().variables[j], x[j], way);
      neighbours.push_back(x);
      requests.push_back({x, 1.0, "polish"});
    }
  }
  log.evaluate(requests);
  const auto merit_of = [&](const std::vector<double>& x) {
    const Observation& seen = *log.find(x, 1.0);
    return Merit{log.objective(seen), compute_ratio(seen.answer, log.problem().components)};
  };
  std::erase_if(neighbours, [&](const std::vector<double>& x) {
    return !log.is_candidate(x) || !merit_of(x).is_better_than(merit_of(point));
  });
  std::ranges::stable_sort(neighbours, [&](const auto& a, const auto& b) {
    return merit_of(a).is_better_than(merit_of(b));
  });
  for (const std::vector<double>& x : neighbours) {
    log.evaluate({{x, 0.5, "polish"}});
    if (log.acceptance(x) == Acceptance::accepted) return x;
  }
  return std::nullopt;
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
      const double own = log.objective(seen);
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
    for (std::size_t j = 0; j < point.size(); ++j) point = descend_axis(log, point, j, reserve);
    if (before - compute_objective(point) <= log.options().resolution) break;
  }
  return point;
}

std::vector<double> polish_freely(EvaluationLog& log, std::vector<double> point,
                                  std::size_t reserve) {
  constexpr double kFirstStep = 0.1;          // decades
  const std::size_t most = 4 * point.size();  // of evaluations in a round
  double decades = kFirstStep;
  while (decades >= log.options().resolution && budget_of(log, reserve) > most) {
    const auto better = find_better(log, point, decades);
    if (better) point = *better;
    if (!better) decades *= 0.5;
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

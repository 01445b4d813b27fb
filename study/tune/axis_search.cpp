#include "study/tune/axis_search.h"

namespace linkstudy::tuning {
namespace {

// Requests on the axis through the point that were answered, as requests of the axis.
std::vector<Request> find_seen(const EvaluationLog& known, const std::vector<double>& point,
                               std::size_t j) {
  std::vector<Request> seen;
  for (const Observation& observation : known.observations()) {
    std::vector<double> x = observation.request.x;
    x[j] = point[j];
    if (x != point) continue;
    const Request& request = observation.request;
    seen.push_back({{request.x[j]}, request.step_factor, request.purpose});
  }
  return seen;
}

}  // namespace

AxisSearch::AxisSearch(const EvaluationLog& known, std::vector<double> point, std::size_t j,
                       std::size_t budget, EvaluateBatch ask)
    : point_(std::move(point)), j_(j), ask_(std::move(ask)), log_({}, {}, {}) {
  const std::vector<Request> seen = find_seen(known, point_, j_);
  TuningProblem problem = known.problem();
  problem.variables = {known.problem().variables[j_]};
  TuningOptions options = known.options();
  options.max_evaluations = budget + seen.size();
  log_ = EvaluationLog(problem, options, [this](const auto& requests) { return answer(requests); });
  log_.evaluate(seen);
}

std::vector<Answer> AxisSearch::answer(const std::vector<Request>& requests) const {
  std::vector<Request> asked = requests;
  for (Request& request : asked) {
    const double value = request.x.front();
    request.x = point_;
    request.x[j_] = value;
  }
  return ask_(asked);
}

}  // namespace linkstudy::tuning

#include "study/tune/find_window.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/tune/search_section.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

double neighbour_of(const EvaluationLog& log, double value) {
  return shifted(log.problem().variables.front(), value, log.options().neighbourhood);
}

// The upper neighbour of the certificate: it also tells a noisy boundary from a narrow window.
std::vector<Request> ask_neighbour(const EvaluationLog& log, double value) {
  const double neighbour = neighbour_of(log, value);
  if (neighbour > log.problem().variables.front().high) {
    return {};
  }
  return {{{neighbour}, 1.0, "neighbour"}};
}

bool feasible_at_base(const EvaluationLog& log, double value) {
  const std::optional<double> ratio = log.ratio(value, 1.0);
  return ratio && *ratio <= 1.0;
}

std::optional<double> find_rejected_below(const EvaluationLog& log, double value) {
  std::optional<double> below;
  for (const double other : log.base_values()) {
    const bool open = log.acceptance({other}) == Acceptance::open && feasible_at_base(log, other);
    if (other < value && !open && log.acceptance({other}) != Acceptance::accepted) below = other;
  }
  return below;
}

// A failing value closer than the neighbourhood to a matching one above it is a gap made by noise.
bool is_noise_gap(const EvaluationLog& log, double failing) {
  const double reach = neighbour_of(log, failing);
  const std::vector<double> values = log.base_values();
  return std::any_of(values.begin(), values.end(), [&](double other) {
    return other > failing && other <= reach && feasible_at_base(log, other);
  });
}

std::optional<double> find_failing_above(const EvaluationLog& log, double value) {
  for (const double other : log.base_values()) {
    if (other > value && !feasible_at_base(log, other) && !is_noise_gap(log, other)) return other;
  }
  return std::nullopt;
}

// Values above `from` at doubling distances, up to `ceiling`.
std::vector<double> make_climb(const TunedVariable& variable, double from, double ceiling,
                               double first) {
  std::vector<double> values;
  for (double up = first; shifted(variable, from, up) < ceiling; up *= 2.0) {
    values.push_back(shifted(variable, from, up));
  }
  return values;
}

// Looks above a value that fails at half the step for one that passes at both.
void climb(EvaluationLog& log, double value) {
  const double beyond =
      std::nextafter(log.problem().variables.front().high, std::numeric_limits<double>::infinity());
  const double failing = find_failing_above(log, value).value_or(beyond);
  // A failing value nearer than the neighbourhood may be noise: look past it.
  const double ceiling = std::min(beyond, std::max(failing, neighbour_of(log, value)));
  const std::vector<double> values =
      make_climb(log.problem().variables.front(), value, ceiling, 2.0 * log.options().resolution);
  const std::size_t group = std::max<std::size_t>(1, log.options().batch / 2);
  for (std::size_t first = 0; first < values.size() && !log.exhausted(); first += group) {
    std::vector<Request> requests;
    for (std::size_t i = first; i < std::min(first + group, values.size()); ++i) {
      requests.push_back({{values[i]}, 1.0, "climb"});
      requests.push_back({{values[i]}, 0.5, "climb"});
    }
    log.evaluate(requests);
    for (std::size_t i = first; i < std::min(first + group, values.size()); ++i) {
      if (log.acceptance({values[i]}) == Acceptance::accepted) return;
    }
  }
}

std::optional<double> find_accepted_from(const EvaluationLog& log, double value) {
  for (const double other : log.base_values()) {
    if (other >= value && log.acceptance({other}) == Acceptance::accepted) return other;
  }
  return std::nullopt;
}

double settle_at_both(EvaluationLog& log, double value) {
  const std::optional<double> accepted = find_accepted_from(log, value);
  if (!accepted) return value;
  const std::optional<double> rejected = find_rejected_below(log, *accepted);
  if (!rejected) return *accepted;
  const double resolution = log.options().resolution;
  return search_section(log, {*rejected, *accepted},
                        {WindowEnd::lower, Steps::both, resolution, "half_step"})
      .feasible;
}

HighLimit find_high_limit(const Answer& failing) {
  const bool past_limit = failing.step_limit > 0.0 && failing.step > failing.step_limit;
  return failing.status != Cause::ok || past_limit ? HighLimit::stability : HighLimit::accuracy;
}

}  // namespace

std::optional<double> find_lowest_accepted(const EvaluationLog& log) {
  return find_accepted_from(log, -std::numeric_limits<double>::infinity());
}

std::optional<double> find_lowest_candidate(const EvaluationLog& log) {
  for (const double value : log.base_values()) {
    if (log.is_candidate({value})) return value;
  }
  return std::nullopt;
}

double descend(EvaluationLog& log, double candidate) {
  double value = candidate;
  const std::optional<double> below = find_rejected_below(log, value);
  if (below && !feasible_at_base(log, *below)) {
    const SectionSettings settings{WindowEnd::lower, Steps::base, log.options().resolution,
                                   "lower_end"};
    value = search_section(log, {*below, value}, settings).feasible;
  }
  std::vector<Request> requests = {{{value}, 0.5, "half_step"}};
  for (const Request& neighbour : ask_neighbour(log, value)) requests.push_back(neighbour);
  log.evaluate(requests);
  if (log.acceptance({value}) == Acceptance::rejected) climb(log, value);
  return settle_at_both(log, value);
}

Window find_window(EvaluationLog& log, double low) {
  log.evaluate(ask_neighbour(log, low));
  Window window;
  window.low = low;
  window.low_open = !find_rejected_below(log, low).has_value();
  window.high = log.base_values().back();
  if (const std::optional<double> failing = find_failing_above(log, low)) {
    double feasible = low;  // the highest below it
    for (const double value : log.base_values()) {
      feasible =
          value < *failing && feasible_at_base(log, value) ? std::max(feasible, value) : feasible;
    }
    const Bracket bracket =
        search_section(log, {*failing, feasible},
                       {WindowEnd::upper, Steps::base, log.options().resolution, "upper_end"});
    window.high = bracket.feasible;
    window.high_limited_by = find_high_limit(log.find({bracket.failing}, 1.0)->answer);
  }
  window.margin = distance(log.problem().variables.front(), window.low, window.high);
  return window;
}

}  // namespace linkstudy::tuning

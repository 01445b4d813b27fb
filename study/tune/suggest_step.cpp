#include "study/tune/suggest_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/tune/scan_window.h"

namespace linkstudy::tuning {
namespace {

// Part of the opening step that is suggested, see the header.
constexpr double kComfort = 0.7;
constexpr double kNoLimit = std::numeric_limits<double>::infinity();
// At half the step the smallest error lies 2^(4/3) stiffer: c^3 = A / (2 B h^4).
const double kStifferAtHalf = std::pow(2.0, 4.0 / 3.0);

std::optional<double> find_best_value(const EvaluationLog& log) {
  std::optional<double> best;
  double smallest = kNoLimit;
  for (const double value : log.base_values()) {
    const double ratio = log.ratio(value, 1.0).value();
    if (ratio < smallest) {
      smallest = ratio;
      best = value;
    }
  }
  return best;
}

bool usable(const EvaluationLog& log, const Observation& observation, double center) {
  const Answer& answer = observation.answer;
  const bool finite = std::isfinite(compute_ratio(answer, log.problem().components));
  const bool near = std::abs(std::log10(observation.request.x.front() / center)) <= 1.0;
  const bool stable = !(answer.step_limit > 0.0) || answer.step <= 0.9 * answer.step_limit;
  return finite && near && stable && answer.step > 0.0;
}

std::vector<ErrorModel> fit_components(const EvaluationLog& log, double center) {
  std::vector<ErrorModel> models;
  for (std::size_t i = 0; i < log.problem().components.size(); ++i) {
    std::vector<ErrorSample> samples;
    for (const Observation& observation : log.observations()) {
      if (usable(log, observation, center)) {
        samples.push_back(
            {observation.request.x.front(), observation.answer.step, observation.answer.errors[i]});
      }
    }
    models.push_back(fit_error_model(samples));
  }
  return models;
}

struct Limit {
  double value = 0.0;
  double step = 0.0;
};

std::vector<Limit> find_limits(const EvaluationLog& log) {
  std::vector<Limit> limits;
  for (const double value : log.base_values()) {
    const double step_limit = log.find({value}, 1.0)->answer.step_limit;
    if (step_limit > 0.0 && std::isfinite(step_limit)) {
      limits.push_back({value, step_limit});
    }
  }
  return limits;
}

double interpolate_limit(const std::vector<Limit>& limits, double value) {
  if (limits.empty()) return kNoLimit;
  const auto above = std::find_if(limits.begin(), limits.end(),
                                  [&](const Limit& limit) { return limit.value >= value; });
  if (above == limits.end()) {
    return limits.back().step * std::sqrt(limits.back().value / value);
  }
  if (above == limits.begin()) return above->step;
  const Limit& below = *(above - 1);
  const double part = std::log(value / below.value) / std::log(above->value / below.value);
  return below.step * std::pow(above->step / below.step, part);
}

double allowed_step(const EvaluationLog& log, const std::vector<ErrorModel>& models, double value) {
  double step = kNoLimit;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const double left = log.problem().components[i].tolerance - models[i].soft / value;
    if (left <= 0.0) return 0.0;
    if (models[i].coarse > 0.0) {
      step = std::min(step, std::pow(left / (models[i].coarse * value * value), 0.25));
    }
  }
  return step;
}

// The largest step that leaves a matching value in the range up to `high`, and that value.
Limit find_opening(const EvaluationLog& log, const std::vector<ErrorModel>& models, double high) {
  const std::vector<Limit> limits = find_limits(log);
  Limit best;
  TunedVariable range = log.problem().variables.front();
  range.high = high;
  for (const double value : make_scan_values(range, 1001)) {
    const double step =
        std::min(allowed_step(log, models, value), interpolate_limit(limits, value));
    if (step > best.step) {
      best = {value, step};
    }
  }
  return best;
}

double round_down_to_two_digits(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::floor(value / unit * (1.0 + 1e-12)) * unit;
}

// The stiffness from which the soft error alone matches in every component.
double find_soft_limit(const EvaluationLog& log, const std::vector<ErrorModel>& models) {
  double needed = 0.0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    needed = std::max(needed, models[i].soft / log.problem().components[i].tolerance);
  }
  return needed;
}

std::optional<std::uint64_t> find_half_step_match(const EvaluationLog& log) {
  for (const Observation& observation : log.observations()) {
    const double ratio = compute_ratio(observation.answer, log.problem().components);
    if (observation.request.step_factor == 0.5 && ratio <= 1.0) return observation.answer.id;
  }
  return std::nullopt;
}

// The lowest value above `best` that failed by its step. Above it a stiffer joint is no help.
std::optional<ScanPoint> find_wall(const EvaluationLog& log, double best) {
  for (const ScanPoint& point : classify_points(log)) {
    const bool by_step = point.side == Side::step_too_coarse || point.side == Side::diverged;
    if (by_step && point.value > best) return point;
  }
  return std::nullopt;
}

// A window above the range and behind values that fail by their step: both must change.
std::string explain_wall(const EvaluationLog& log, const StepSuggestion& suggestion,
                         const ScanPoint& wall, double needed) {
  const TunedVariable& variable = log.problem().variables.front();
  const std::string fails = fmt::format("from {:.3g} {} on the runs fail by their step ({})",
                                        wall.value, variable.unit, name_of(wall.side));
  if (suggestion.step <= 0.0) {
    return fails + ": use a smaller step before you raise the end of the range";
  }
  return fmt::format(
      "{}, and below they are too soft: use step <= {:.2g} s and a range that ends "
      "above {:.3g} {}",
      fails, suggestion.step, std::max(needed, suggestion.value), variable.unit);
}

std::string explain(const EvaluationLog& log, const std::vector<ErrorModel>& models,
                    const StepSuggestion& suggestion, const std::optional<ScanPoint>& wall) {
  const TunedVariable& variable = log.problem().variables.front();
  const double needed = find_soft_limit(log, models);
  if (needed >= variable.high && wall) return explain_wall(log, suggestion, *wall, needed);
  if (needed >= variable.high) {
    return fmt::format("too soft over the whole range: raise its end above {:.3g} {}", needed,
                       variable.unit);
  }
  if (suggestion.step <= 0.0) {
    return "the error does not fall with a smaller step or a stiffer joint in this range";
  }
  return fmt::format("use step <= {:.2g} s; the window opens at {:.2g} s near {:.3g} {}",
                     suggestion.step, suggestion.opens_at, suggestion.value, variable.unit);
}

std::string explain_no_run(const StepSuggestion& suggestion) {
  if (suggestion.step <= 0.0) {
    return "no point of the range ran to its end, and no step limit is known";
  }
  return fmt::format(
      "no point of the range ran to its end: use step <= {:.2g} s; the stability limit is {:.2g} s "
      "at {:.3g}",
      suggestion.step, suggestion.opens_at, suggestion.value);
}

}  // namespace

ErrorModel fit_error_model(const std::vector<ErrorSample>& samples) {
  double aa = 0.0, ab = 0.0, bb = 0.0, a1 = 0.0, b1 = 0.0;
  double scale_c = 0.0, scale_h = 0.0;
  for (const ErrorSample& sample : samples) {
    scale_c = std::max(scale_c, sample.stiffness);
    scale_h = std::max(scale_h, sample.step);
  }
  for (const ErrorSample& sample : samples) {
    if (!(sample.error > 0.0)) continue;
    const double c = sample.stiffness / scale_c;
    const double h = sample.step / scale_h;
    const double a = 1.0 / (c * sample.error);
    const double b = c * c * h * h * h * h / sample.error;
    aa += a * a, ab += a * b, bb += b * b, a1 += a, b1 += b;
  }
  if (aa == 0.0) {
    return {};
  }
  const double determinant = aa * bb - ab * ab;
  double soft = determinant > 1e-12 * aa * bb ? (a1 * bb - b1 * ab) / determinant : -1.0;
  double coarse = determinant > 1e-12 * aa * bb ? (b1 * aa - a1 * ab) / determinant : -1.0;
  if (soft < 0.0 || coarse < 0.0) {
    // One term alone: the one that explains more of the (unit) relative errors.
    const bool soft_explains_more = a1 * a1 / aa >= b1 * b1 / bb;
    soft = soft_explains_more ? a1 / aa : 0.0;
    coarse = soft_explains_more ? 0.0 : b1 / bb;
  }
  return {soft * scale_c, coarse / (scale_c * scale_c * std::pow(scale_h, 4.0))};
}

void probe_half_step(EvaluationLog& log) {
  const std::optional<double> best = find_best_value(log);
  const double low = log.problem().variables.front().low;
  const double high = log.problem().variables.front().high;
  const double center = best.value_or(low);
  log.evaluate({{{center}, 0.5, "half_step"},
                {{std::min(center * kStifferAtHalf, high)}, 0.5, "half_step"}});
}

StepSuggestion suggest_step(const EvaluationLog& log) {
  const std::optional<double> best = find_best_value(log);
  const std::vector<ErrorModel> models =
      best ? fit_components(log, *best) : std::vector<ErrorModel>{};
  StepSuggestion suggestion;
  const std::optional<ScanPoint> wall = best ? find_wall(log, *best) : std::nullopt;
  const double high = log.problem().variables.front().high;
  // Without a wall the step is not what closes the range.
  const double ceiling = wall ? std::max(high, 10.0 * find_soft_limit(log, models)) : high;
  const Limit opening = find_opening(log, models, ceiling);
  if (opening.step > 0.0 && std::isfinite(opening.step)) {
    suggestion.opens_at = opening.step;
    suggestion.step = round_down_to_two_digits(kComfort * opening.step);
    suggestion.value = opening.value;
  }
  suggestion.confirmed_by = find_half_step_match(log);
  suggestion.message = best ? explain(log, models, suggestion, wall) : explain_no_run(suggestion);
  if (suggestion.confirmed_by) {
    suggestion.message +=
        fmt::format(" (evaluation {} matches at half the step)", *suggestion.confirmed_by);
  }
  return suggestion;
}

}  // namespace linkstudy::tuning

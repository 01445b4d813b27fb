#include "study/tune/search_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/tune/scan_window.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

// Half the distance of the close pair, in resolutions: if the estimate is right the pair encloses
// the boundary and the next bracket is narrow enough.
constexpr double kClose = 0.45;

constexpr double kLeastSlope = 0.3;

struct Slopes {
  double least = 0.0;
  double most = 0.0;
};

Slopes allowed_slopes(const SectionSettings& settings) {
  const bool is_lower = settings.end == WindowEnd::lower;
  constexpr double kMost = 1e6;
  if (!settings.variable.is_logarithmic) {
    return is_lower ? Slopes{-kMost, -kLeastSlope} : Slopes{kLeastSlope, kMost};
  }
  return is_lower ? Slopes{-2.0, -kLeastSlope} : Slopes{kLeastSlope, 4.0};
}

// Where on the axis the ratio is estimated to be 1, from the end nearer to it.
double estimate_boundary(const Bracket& bracket, const EndRatios& ends,
                         const SectionSettings& settings) {
  const double failing = position_of(settings.variable, bracket.failing);
  const double feasible = position_of(settings.variable, bracket.feasible);
  const Slopes allowed = allowed_slopes(settings);
  const double slope = std::clamp((ends.feasible - ends.failing) / (feasible - failing),
                                  allowed.least, allowed.most);
  return ends.failing < -ends.feasible ? failing - ends.failing / slope
                                       : feasible - ends.feasible / slope;
}

void add_about_estimate(std::vector<double>& places, double estimate, const Bracket& bracket,
                        const SectionSettings& settings, std::size_t count) {
  const TunedVariable& variable = settings.variable;
  const double close = kClose * settings.resolution;
  if (count == 1) {
    // Approach from the far end: the two ends then close in turn.
    const double to_feasible = std::abs(position_of(variable, bracket.feasible) - estimate);
    const double to_failing = std::abs(position_of(variable, bracket.failing) - estimate);
    const bool feasible_nearer = to_feasible < to_failing;
    const double toward = bracket.failing < bracket.feasible ? -close : close;
    places.push_back(estimate + (feasible_nearer ? toward : -toward));
    return;
  }
  places.insert(places.end(), {estimate - close, estimate + close});
  if (count >= 6) {
    const double wide = std::sqrt(close * width_of(variable, bracket));
    places.insert(places.end(), {estimate - wide, estimate + wide});
  }
}

void add_equal_sections(std::vector<double>& places, const TunedVariable& variable,
                        const Bracket& bracket, std::size_t count) {
  const double low = position_of(variable, std::min(bracket.failing, bracket.feasible));
  for (std::size_t i = 1; i <= count; ++i) {
    places.push_back(low + width_of(variable, bracket) * static_cast<double>(i) /
                               static_cast<double>(count + 1));
  }
}

// Values inside the bracket, no two closer than the separation.
std::vector<double> keep_inside(std::vector<double> places, const TunedVariable& variable,
                                const Bracket& bracket, double separation) {
  std::sort(places.begin(), places.end());
  double previous = position_of(variable, std::min(bracket.failing, bracket.feasible));
  const double last =
      position_of(variable, std::max(bracket.failing, bracket.feasible)) - separation;
  std::vector<double> values;
  for (const double place : places) {
    if (place >= previous + separation && place <= last) {
      values.push_back(value_at(variable, place));
      previous = place;
    }
  }
  return values;
}

std::optional<double> judged_ratio(const EvaluationLog& log, double value, Steps steps) {
  const std::optional<double> base = log.ratio(value, 1.0);
  if (!base || steps == Steps::base || *base > 1.0) return base;
  const std::optional<double> half = log.ratio(value, 0.5);
  return half ? std::optional<double>(std::max(*base, *half)) : std::nullopt;
}

EndRatios ratios_at(const EvaluationLog& log, const Bracket& bracket, Steps steps) {
  const double unknown = std::numeric_limits<double>::infinity();
  return {compute_log_ratio(judged_ratio(log, bracket.failing, steps).value_or(unknown)),
          compute_log_ratio(judged_ratio(log, bracket.feasible, steps).value_or(unknown))};
}

// Distance from the failing end grows toward the feasible end.
void tighten_lower(const EvaluationLog& log, std::vector<double> values, Steps steps,
                   Bracket& bracket) {
  std::sort(values.begin(), values.end(), [&](double a, double b) {
    return std::abs(a - bracket.failing) < std::abs(b - bracket.failing);
  });
  for (const double value : values) {
    const std::optional<double> ratio = judged_ratio(log, value, steps);
    if (ratio && *ratio <= 1.0) {
      bracket.feasible = value;
      return;
    }
    if (ratio) bracket.failing = value;
  }
}

void tighten_upper(const EvaluationLog& log, std::vector<double> values, Steps steps,
                   Bracket& bracket) {
  std::sort(values.begin(), values.end());
  for (const double value : values) {
    const std::optional<double> ratio = judged_ratio(log, value, steps);
    if (ratio && *ratio > 1.0) {
      bracket.failing = value;
      return;
    }
    if (ratio) bracket.feasible = value;
  }
}

std::vector<Request> make_requests(const std::vector<double>& values,
                                   const SectionSettings& settings) {
  std::vector<Request> requests;
  for (const double value : values) {
    requests.push_back({{value}, 1.0, settings.purpose});
    if (settings.steps == Steps::both) {
      requests.push_back({{value}, 0.5, settings.purpose});
    }
  }
  return requests;
}

}  // namespace

double width_of(const TunedVariable& variable, const Bracket& bracket) {
  return std::abs(distance(variable, bracket.failing, bracket.feasible));
}

std::vector<double> place_section(const Bracket& bracket, const EndRatios& ends,
                                  const SectionSettings& settings, std::size_t count,
                                  bool equal_sections) {
  std::vector<double> places;
  const bool has_slope = std::abs(ends.failing) < 12.0 && std::abs(ends.feasible) < 12.0;
  if (has_slope && !equal_sections) {
    const double estimate = estimate_boundary(bracket, ends, settings);
    add_about_estimate(places, estimate, bracket, settings, count);
  }
  const TunedVariable& variable = settings.variable;
  add_equal_sections(places, variable, bracket, count - std::min(count, places.size()));
  const double separation = std::min(0.05 * settings.resolution, 0.1 * width_of(variable, bracket));
  std::vector<double> values = keep_inside(std::move(places), variable, bracket, separation);
  if (values.empty()) values.push_back(midway(variable, bracket.failing, bracket.feasible));
  return values;
}

Bracket search_section(EvaluationLog& log, Bracket bracket, SectionSettings settings) {
  settings.variable = log.problem().variables.front();
  const auto width = [&] { return width_of(settings.variable, bracket); };
  const std::size_t per_value = settings.steps == Steps::both ? 2 : 1;
  const std::size_t count = std::max<std::size_t>(1, log.options().batch / per_value);
  bool equal_sections = false;
  while (width() > settings.resolution && !log.exhausted()) {
    const std::vector<double> values = place_section(
        bracket, ratios_at(log, bracket, settings.steps), settings, count, equal_sections);
    log.evaluate(make_requests(values, settings));
    const double before = width();
    if (settings.end == WindowEnd::lower) {
      tighten_lower(log, values, settings.steps, bracket);
    } else {
      tighten_upper(log, values, settings.steps, bracket);
    }
    equal_sections = width() > 0.5 * before;
    if (width() == before) {
      break;  // every answer was cut off by the budget
    }
  }
  return bracket;
}

}  // namespace linkstudy::tuning

#include "study/tune/search_section.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "study/tune/scan_window.h"

namespace linkstudy::tuning {
namespace {

// Half the distance of the close pair, in resolutions: if the estimate is right the pair encloses
// the boundary and the next bracket is narrow enough.
constexpr double kClose = 0.45;

struct Slopes {
  double least = 0.0;
  double most = 0.0;
};

Slopes allowed_slopes(WindowEnd end) {
  return end == WindowEnd::lower ? Slopes{-2.0, -0.3} : Slopes{0.3, 4.0};
}

// log10 of the value where the ratio is estimated to be 1, from the end nearer to it.
double estimate_boundary(const Bracket& bracket, const EndRatios& ends, WindowEnd end) {
  const double failing = std::log10(bracket.failing);
  const double feasible = std::log10(bracket.feasible);
  const Slopes allowed = allowed_slopes(end);
  const double slope = std::clamp((ends.feasible - ends.failing) / (feasible - failing),
                                  allowed.least, allowed.most);
  return ends.failing < -ends.feasible ? failing - ends.failing / slope
                                       : feasible - ends.feasible / slope;
}

void add_about_estimate(std::vector<double>& places, double estimate, const Bracket& bracket,
                        double resolution, std::size_t count) {
  const double close = kClose * resolution;
  if (count == 1) {
    // Approach from the far end: the two ends then close in turn.
    const double to_feasible = std::abs(std::log10(bracket.feasible) - estimate);
    const double to_failing = std::abs(std::log10(bracket.failing) - estimate);
    const bool feasible_nearer = to_feasible < to_failing;
    const double toward = bracket.failing < bracket.feasible ? -close : close;
    places.push_back(estimate + (feasible_nearer ? toward : -toward));
    return;
  }
  places.insert(places.end(), {estimate - close, estimate + close});
  if (count >= 6) {
    const double wide = std::sqrt(close * width_in_decades(bracket));
    places.insert(places.end(), {estimate - wide, estimate + wide});
  }
}

void add_equal_sections(std::vector<double>& places, const Bracket& bracket, std::size_t count) {
  const double low = std::log10(std::min(bracket.failing, bracket.feasible));
  for (std::size_t i = 1; i <= count; ++i) {
    places.push_back(low + width_in_decades(bracket) * static_cast<double>(i) /
                               static_cast<double>(count + 1));
  }
}

// Values inside the bracket, no two closer than the separation.
std::vector<double> keep_inside(std::vector<double> places, const Bracket& bracket,
                                double separation) {
  std::sort(places.begin(), places.end());
  double previous = std::log10(std::min(bracket.failing, bracket.feasible));
  const double last = std::log10(std::max(bracket.failing, bracket.feasible)) - separation;
  std::vector<double> values;
  for (const double place : places) {
    if (place >= previous + separation && place <= last) {
      values.push_back(std::pow(10.0, place));
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

// Distance from the failing end in decades grows toward the feasible end.
void tighten_lower(const EvaluationLog& log, std::vector<double> values, Steps steps,
                   Bracket& bracket) {
  std::sort(values.begin(), values.end(), [&](double a, double b) {
    return std::abs(std::log(a / bracket.failing)) < std::abs(std::log(b / bracket.failing));
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

double width_in_decades(const Bracket& bracket) {
  return std::abs(std::log10(bracket.feasible / bracket.failing));
}

std::vector<double> place_section(const Bracket& bracket, const EndRatios& ends,
                                  const SectionSettings& settings, std::size_t count,
                                  bool equal_sections) {
  std::vector<double> places;
  const bool has_slope = std::abs(ends.failing) < 12.0 && std::abs(ends.feasible) < 12.0;
  if (has_slope && !equal_sections) {
    const double estimate = estimate_boundary(bracket, ends, settings.end);
    add_about_estimate(places, estimate, bracket, settings.resolution, count);
  }
  add_equal_sections(places, bracket, count - std::min(count, places.size()));
  const double separation = std::min(0.05 * settings.resolution, 0.1 * width_in_decades(bracket));
  std::vector<double> values = keep_inside(std::move(places), bracket, separation);
  if (values.empty()) values.push_back(std::sqrt(bracket.failing) * std::sqrt(bracket.feasible));
  return values;
}

Bracket search_section(EvaluationLog& log, Bracket bracket, const SectionSettings& settings) {
  const std::size_t per_value = settings.steps == Steps::both ? 2 : 1;
  const std::size_t count = std::max<std::size_t>(1, log.options().batch / per_value);
  bool equal_sections = false;
  while (width_in_decades(bracket) > settings.resolution && !log.exhausted()) {
    const std::vector<double> values = place_section(
        bracket, ratios_at(log, bracket, settings.steps), settings, count, equal_sections);
    log.evaluate(make_requests(values, settings));
    const double before = width_in_decades(bracket);
    if (settings.end == WindowEnd::lower) {
      tighten_lower(log, values, settings.steps, bracket);
    } else {
      tighten_upper(log, values, settings.steps, bracket);
    }
    equal_sections = width_in_decades(bracket) > 0.5 * before;
    if (width_in_decades(bracket) == before) {
      break;  // every answer was cut off by the budget
    }
  }
  return bracket;
}

}  // namespace linkstudy::tuning

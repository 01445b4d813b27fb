#include "study/converge/check_instants.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "study/config/precedence.h"
#include "study/converge/level_course.h"
#include "study/converge/series_difference.h"

namespace linkstudy::convergence {
namespace {

std::optional<SimulationOptions> options_at(const Evaluator& evaluator,
                                            const LoadCaseInput& load_case, const Point& point) {
  std::vector<Override> set;
  for (std::size_t i = 0; i < point.values.size(); ++i) {
    set.push_back(make_override(evaluator.parameters()[i].path, point.values[i]));
  }
  const StudyInput& input = evaluator.input();
  Diagnostics ignored;
  const auto model = input.model->with(case_overrides(input, load_case, std::move(set)), ignored);
  return model ? std::optional(model->options) : std::nullopt;
}

std::vector<double> kept_instants(const SimulationOptions& options) {
  const StepGrid grid = make_step_grid(options);
  const Sampling sampling = sample_output(grid, options.output_interval);
  std::vector<double> instants;
  for (long step = sampling.begin; step <= sampling.end; step += sampling.stride) {
    instants.push_back(static_cast<double>(step) * grid.h);
  }
  return instants;
}

// What the levels of a course keep, and when the shortest of them ends.
struct KeptInstants {
  std::vector<std::vector<double>> times;
  double end_time = std::numeric_limits<double>::infinity();
};

KeptInstants find_kept(const Evaluator& evaluator, const LoadCaseInput& load_case,
                       const LevelCourse& course, const std::vector<Point>& points) {
  KeptInstants kept;
  for (const std::uint64_t id : course.ids) {
    const auto options = options_at(evaluator, load_case, points[id]);
    if (!options) continue;  // an invalid case is told of elsewhere
    kept.end_time = std::min(kept.end_time, options->end_time);
    kept.times.push_back(kept_instants(*options));
  }
  return kept;
}

// False when it was reported.
bool check_series(const SeriesInput& series, const KeptInstants& kept, Diagnostics& diagnostics) {
  const Location& at = series.window && series.window->at.file ? series.window->at : series.at;
  if (series.window && series.window->last > kept.end_time * (1.0 + 1e-9)) {
    diagnostics.add(at,
                    fmt::format("the window of '{}' ends at {:g} s, after the run ({:g} s)",
                                series.signal, series.window->last, kept.end_time),
                    "shorten the window or raise simulation.end_time");
    return false;
  }
  const std::vector<std::span<const double>> times(kept.times.begin(), kept.times.end());
  if (times.empty() || find_common_instants(times, series.window).size() > 1) return true;
  diagnostics.add(at,
                  fmt::format("the levels keep no two instants of '{}' in common", series.signal),
                  "choose steps whose ratios are integers, and simulation.output_interval a "
                  "multiple of the coarsest");
  return false;
}

}  // namespace

void check_common_instants(const Evaluator& evaluator, const std::vector<Point>& points,
                           Diagnostics& diagnostics) {
  const StudyInput& input = evaluator.input();
  if (input.series.empty()) return;
  std::vector<KeptInstants> all;
  for (const LoadCaseInput& load_case : load_cases_of(input)) {
    for (const LevelCourse& course : list_courses(input)) {
      all.push_back(find_kept(evaluator, load_case, course, points));
    }
  }
  for (const SeriesInput& series : input.series) {
    for (const KeptInstants& kept : all)
      if (!check_series(series, kept, diagnostics)) break;
  }
}

}  // namespace linkstudy::convergence

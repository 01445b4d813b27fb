#include "study/evaluate/check_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "study/config/case_selection.h"
#include "study/config/precedence.h"
#include "study/config/value_path.h"
#include "study/design/design.h"
#include "study/metrics/common_grid.h"
#include "study/metrics/response_list.h"

namespace linkstudy {
namespace {

constexpr std::size_t kMostCases = 256;
constexpr const char* kStepPath = "simulation.step";

// The times of one run.
struct RunTimes {
  double end_time = 0.0;  // s
  StepGrid grid{};
  Location step_at;
};

std::optional<RunTimes> read_times(const ModelDocument& document,
                                   const std::vector<Override>& overrides) {
  Diagnostics said_before;
  const std::optional<ModelInput> model = document.with(overrides, said_before);
  if (!model) return std::nullopt;
  return RunTimes{model->options.end_time, make_step_grid(model->options),
                  locate(model->resolved, kStepPath)};
}

class TimesCheck {
 public:
  TimesCheck(const StudyInput& input, const MeasuredReferences& measured, Diagnostics& diagnostics)
      : input_(input), measured_(measured), diagnostics_(diagnostics) {}

  void run() {
    const std::vector<std::vector<Override>> points = deciding_points();
    const std::vector<LoadCaseInput> load_cases = load_cases_of(input_);
    for (std::size_t i = 0; i < load_cases.size(); ++i) {
      std::optional<RunTimes> reference;
      if (const ReferenceInput* run = reference_run_of(input_, load_cases[i])) {
        reference = read_times(*run->model, reference_overrides(input_, load_cases[i]));
        if (!reference) continue;
      }
      for (const std::vector<Override>& point : points) {
        const auto own = read_times(*input_.model, case_overrides(input_, load_cases[i], point));
        if (own) check_run(*own, reference, measured_.at(i).get());
      }
    }
  }

 private:
  std::vector<std::vector<Override>> deciding_points() const {
    return input_.kind == FileKind::tune ? steps_of_tune() : points_of_study();
  }

  std::vector<std::vector<Override>> steps_of_tune() const {
    std::vector<Override> point;
    for (const TuneInput& tune : input_.tune) {
      point.push_back(make_override(tune.parameter.path, tune.low));
    }
    std::vector<std::vector<Override>> points;
    const auto add = [&](double step, const Location& at) {
      points.push_back(point);
      points.back().push_back(make_override(kStepPath, step));
      points.back().back().value.at = at;
    };
    for (const double step : input_.search.steps) {
      const Location at = locate(input_.resolved, "search.steps");
      add(step, at);
      add(step / 2.0, at);
    }
    if (!points.empty()) return points;
    points = {point};
    Diagnostics said_before;
    const auto model = input_.model->with(case_overrides(input_, {}, point), said_before);
    if (model) add(model->options.step / 2.0, {});
    return points;
  }

  // Of a grid, axes that leave the times alone stay at their first value.
  std::vector<std::vector<Override>> points_of_study() const {
    if (!combines_values(input_.design.type)) return points_of_samples();
    std::vector<std::size_t> sizes;
    for (const VaryInput& vary : input_.vary) {
      const bool counts = input_.design.type != Design::grid || decides_times(vary.parameter.path);
      sizes.push_back(counts ? vary.values.size() : 1);
    }
    std::vector<std::vector<Override>> points;
    for (const CasePositions& positions : choose_cases(input_.design.type, sizes, kMostCases)) {
      std::vector<Value> values;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        values.push_back(input_.vary[i].values[positions[i]]);
      }
      points.push_back(overrides_of(values));
    }
    return points;
  }

  std::vector<std::vector<Override>> points_of_samples() const {
    const bool decide = std::ranges::any_of(
        input_.vary, [](const VaryInput& one) { return decides_times(one.parameter.path); });
    const std::vector<Axis> axes = axes_of(input_);
    std::vector<std::vector<Override>> points;
    for (const std::uint64_t id : choose_ids(input_.design, axes, decide ? kMostCases : 1)) {
      points.push_back(overrides_of(make_point(input_.design, axes, id).values));
    }
    return points;
  }

  std::vector<Override> overrides_of(const std::vector<Value>& values) const {
    std::vector<Override> point;
    for (std::size_t i = 0; i < values.size(); ++i) {
      point.push_back(make_override(input_.vary[i].parameter.path, values[i]));
      point.back().value.at = input_.vary[i].at;
    }
    return point;
  }

  static bool decides_times(const std::string& path) {
    return split_path(path).front() == "simulation";
  }

  void check_run(const RunTimes& own, const std::optional<RunTimes>& reference,
                 const MeasuredReference* measured) {
    for (std::size_t i = 0; i < input_.match.size(); ++i) {
      if (reference) check_match(input_.match[i], own, *reference);
      if (measured != nullptr) check_measured(input_.match[i], own, measured->match[i]);
    }
    for (const ResponseInput& response : input_.response) {
      const Location& at = place_of(response.window, response.at);
      if (!check_end(response.window, own.end_time, at)) continue;
      if (response.window && sample_window(own.grid, 1, response.window).count() == 0) {
        report_empty(*response.window, own.grid.h, "the steps of the run lie", at);
      }
    }
  }

  void check_match(const MatchInput& match, const RunTimes& own, const RunTimes& reference) {
    const Location& at = place_of(match.window, match.at);
    if (!check_end(match.window, std::min(own.end_time, reference.end_time), at)) return;
    const std::optional<CommonGrid> common = find_common_grid(own.grid.h, reference.grid.h);
    if (!common) return report_grids(match, own, reference);
    if (match.cycle && own.end_time < reference.end_time * (1.0 - 1e-9)) {
      return report(match.cycle->at,
                    fmt::format("the last turns of the reference end with it, at {:.9g} s, after "
                                "the run ({:.9g} s)",
                                reference.end_time, own.end_time),
                    "give both runs the same simulation.end_time");
    }
    const Sampling sampling = sample_window(own.grid, common->stride, match.window);
    const double interval = own.grid.h * static_cast<double>(common->stride);
    if (sampling.count() == 0) {
      const TimeWindow whole{0.0, own.end_time, match.at};
      return report_empty(match.window.value_or(whole), interval, "the run and its reference meet",
                          at);
    }
    const long last = sampling.last() / common->stride * common->reference_stride;
    if (match.cycle || last <= reference.grid.count) return;
    report(at,
           fmt::format("'{}' is compared up to {:.9g} s, and the reference run ends at {:.9g} s",
                       match.signal, own.end_time, reference.end_time),
           "give a window, or equal end times");
  }

  void check_measured(const MatchInput& match, const RunTimes& own, const MeasuredSet& set) {
    const Location& at = place_of(match.window, match.at);
    if (!check_end(match.window, own.end_time, at)) return;
    const double reached = own.grid.h * static_cast<double>(own.grid.count);
    const double slack = 1e-9 * reached;
    if (set.first() >= -slack && set.last() <= reached + slack) return;
    report(at,
           fmt::format("'{}' was measured from {:.9g} s to {:.9g} s, and the run reaches from 0 to "
                       "{:.9g} s",
                       match.signal, set.first(), set.last(), reached),
           "give a window or a time_offset, or change simulation.end_time");
  }

  void report_grids(const MatchInput& match, const RunTimes& own, const RunTimes& reference) {
    report(own.step_at,
           fmt::format("the steps {:.9g} s of a case and {:.9g} s of the reference have no common "
                       "time grid, so that '{}' cannot be compared",
                       own.grid.h, reference.grid.h, match.signal),
           fmt::format("choose steps whose ratio is one of integers up to {}", kLargestRatio));
  }

  static const Location& place_of(const std::optional<TimeWindow>& window, const Location& signal) {
    return window && window->at.file ? window->at : signal;
  }

  bool check_end(const std::optional<TimeWindow>& window, double end_time, const Location& at) {
    if (!window || window->last <= end_time * (1.0 + 1e-9)) return true;
    report(at,
           fmt::format("the window of this signal ends at {:g} s, after the run ({:g} s)",
                       window->last, end_time),
           "shorten the window or raise simulation.end_time");
    return false;
  }

  void report_empty(const TimeWindow& window, double interval, const char* what,
                    const Location& at) {
    report(at,
           fmt::format("the window [{:.9g}, {:.9g}] s holds no instant: {} {:.9g} s apart",
                       window.first, window.last, what, interval),
           "widen the window or take smaller steps");
  }

  // Of one place, the first case speaks.
  void report(const Location& at, std::string message, std::string remedy) {
    const std::string file = at.file ? *at.file : std::string();
    if (!places_.emplace(file, at.line, at.column).second) return;
    diagnostics_.add(at, std::move(message), std::move(remedy));
  }

  const StudyInput& input_;
  const MeasuredReferences& measured_;
  Diagnostics& diagnostics_;
  std::set<std::tuple<std::string, int, int>> places_;
};

}  // namespace

void check_times(const StudyInput& input, const MeasuredReferences& measured,
                 Diagnostics& diagnostics) {
  TimesCheck(input, measured, diagnostics).run();
}

}  // namespace linkstudy

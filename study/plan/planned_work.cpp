#include "study/plan/planned_work.h"

#include <algorithm>
#include <set>

#include "study/calibrate/fit_setup.h"
#include "study/calibrate/starts.h"
#include "study/session/study_points.h"
#include "study/tune/scan_box.h"
#include "study/tune/tuning_setup.h"

namespace linkstudy::plan {
namespace {

PlannedWork plan_design(const Evaluator& evaluator) {
  PlannedWork work;
  work.points = points_of(evaluator.input());
  work.most = work.points.size();
  work.batch = work.points.size();
  return work;
}

std::vector<std::vector<double>> scan_of(const tuning::TuningProblem& problem, std::size_t scan) {
  if (problem.variables.size() > 1) return tuning::make_box_scan(problem, scan);
  std::vector<std::vector<double>> points;
  for (const double value : tuning::make_scan_values(problem.variables.front(), scan)) {
    points.push_back({value});
  }
  return points;
}

PlannedWork plan_tune(const Evaluator& evaluator) {
  const StudyInput& input = evaluator.input();
  const double step = base_step_of(input);
  PlannedWork work;
  work.certain_are = "the scan";
  work.most = most_tuning_evaluations(input);
  work.batch = input.search.batch;
  std::set<double> factors;  // every step has a scan of its own, tolerances share it
  for (const tuning::TuningTarget& target : make_tuning_targets(evaluator)) {
    if (!factors.insert(target.step_factor).second) continue;
    for (const auto& values : scan_of(target.problem, input.search.scan)) {
      if (work.points.size() == work.most) break;
      Point& point = work.points.emplace_back();
      point.id = work.points.size() - 1;
      point.values.assign(values.begin(), values.end());
      point.values.emplace_back(step * target.step_factor);
    }
  }
  return work;
}

PlannedWork plan_fit(Evaluator& evaluator) {
  const StudyInput& input = evaluator.input();
  const calibration::FitProblem problem = make_fit_problem(evaluator);
  const FitOptions options = make_fit_options(input);
  PlannedWork work;
  work.certain_are = "the starts";
  work.most = static_cast<std::uint64_t>(options.max_evaluations);
  work.batch = static_cast<std::size_t>(options.starts);
  const std::size_t count = std::min<std::size_t>(work.batch, work.most);
  for (const calibration::Vector& start :
       calibration::list_starts(problem, options.seed, work.batch)) {
    if (work.points.size() == count) break;
    const std::vector<double> fitted = calibration::to_values(problem, start);
    work.points.push_back({work.points.size(), calibration_point(input, fitted)});
  }
  return work;
}

}  // namespace

PlannedWork list_work(Evaluator& evaluator) {
  const FileKind kind = evaluator.input().kind;
  if (kind == FileKind::tune) return plan_tune(evaluator);
  return kind == FileKind::calibrate ? plan_fit(evaluator) : plan_design(evaluator);
}

}  // namespace linkstudy::plan

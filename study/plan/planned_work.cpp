#include "study/plan/planned_work.h"

#include <algorithm>
#include <exception>
#include <set>

#include "study/calibrate/fit_setup.h"
#include "study/calibrate/starts.h"
#include "study/session/study_points.h"
#include "study/tune/tune.h"
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

// What comes after the scan depends on its answers.
class ScanEnded : public std::exception {};

// The values that a search asks for before it has seen any answer.
std::vector<std::vector<double>> scan_of(const tuning::TuningTarget& target,
                                         const tuning::TuningOptions& options) {
  std::vector<std::vector<double>> scan;
  const auto note = [&](const std::vector<tuning::Request>& requests) {
    std::vector<tuning::Answer> answers;
    for (const tuning::Request& request : requests) {
      if (request.purpose != "scan") throw ScanEnded();
      answers.push_back({scan.size(), Cause::cancelled, {}, {}});
      scan.push_back(request.x);
    }
    return answers;
  };
  try {
    tuning::tune(target.problem, options, note);
  } catch (const ScanEnded&) {
    // It has been noted.
  }
  return scan;
}

PlannedWork plan_tune(const Evaluator& evaluator) {
  const StudyInput& input = evaluator.input();
  PlannedWork work;
  work.certain_are = "the scan";
  work.most = most_tuning_evaluations(input);
  work.batch = input.search.batch;
  const double base_step = base_step_of(input);
  const tuning::TuningOptions options = make_tuning_options(input);
  std::set<double> steps;
  for (const tuning::TuningTarget& target : make_tuning_targets(evaluator)) {
    const double step = base_step * target.step_factor;
    if (!steps.insert(step).second) continue;  // its scan is known then
    for (const std::vector<double>& values : scan_of(target, options)) {
      Point& point = work.points.emplace_back();
      point.id = work.points.size() - 1;
      point.values.assign(values.begin(), values.end());
      point.values.emplace_back(step);
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

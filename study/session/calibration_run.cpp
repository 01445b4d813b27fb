#include "study/session/calibration_run.h"

#include <algorithm>

#include "study/calibrate/fit_setup.h"

namespace linkstudy {
namespace {

using calibration::FitAnswer;
using calibration::FitReport;
using calibration::OtherValue;

class CalibrationRun {
 public:
  CalibrationRun(const Evaluator& evaluator, const EvaluationSource& source)
      : evaluator_(evaluator), source_(source) {}

  std::vector<FitAnswer> evaluate(const std::vector<std::vector<double>>& fitted) {
    std::vector<Point> points;
    for (const std::vector<double>& one : fitted) {
      points.push_back({next_id_++, calibration_point(evaluator_.input(), one)});
    }
    source_.evaluate(points);
    std::vector<FitAnswer> answers;
    for (const Point& point : points) {
      const Evaluation& evaluation = source_.find(point.id);
      answers.push_back({point.id, evaluation.status, evaluation.message, evaluation.residuals});
    }
    return answers;
  }

 private:
  const Evaluator& evaluator_;
  const EvaluationSource& source_;
  std::uint64_t next_id_ = 0;
};

void add_others(const StudyInput& input, const Evaluation& best, FitReport& report) {
  for (std::size_t i = 0; i < input.calibrated.size(); ++i) {
    const CalibratedInput& one = input.calibrated[i];
    if (one.role == ParameterRole::free) continue;
    report.others.push_back({one.parameter.path, std::get<double>(best.point.values.at(i)),
                             one.parameter.unit,
                             one.role == ParameterRole::tied ? "tied" : "fixed"});
  }
  for (const Trace& one : best.derived) {
    report.others.push_back({one.name, one.values.front(), one.unit, "derived"});
  }
}

void add_data(Evaluator& evaluator, FitReport& report) {
  const StudyInput& input = evaluator.input();
  // Offsets follow the parameters.
  auto next = static_cast<std::size_t>(
      std::ranges::count(input.calibrated, ParameterRole::free, &CalibratedInput::role));
  for (std::size_t i = 0; i < input.load_case.size(); ++i) {
    const auto set = evaluator.measured_set(i);
    double offset = set->offset;
    if (input.load_case[i].measured->fits_offset && !report.fit.estimates.empty()) {
      offset = report.fit.estimates.at(next++).value;
    }
    for (const MeasuredSignal& signal : set->signals) {
      report.data.push_back({input.load_case[i].name, signal.channel, signal.times, signal.values});
      for (double& time : report.data.back().times) time += offset;
    }
  }
}

}  // namespace

FitReport fit_calibration(Evaluator& evaluator, const EvaluationSource& source) {
  const StudyInput& input = evaluator.input();
  CalibrationRun run(evaluator, source);
  FitReport report;
  report.fit = calibration::calibrate(make_fit_problem(evaluator), make_fit_options(input),
                                      [&](const auto& points) { return run.evaluate(points); });
  if (!report.fit.estimates.empty()) add_others(input, source.find(report.fit.evaluation), report);
  add_data(evaluator, report);
  return report;
}

FitReport run_calibration(StudySession& session) {
  FitReport report = fit_calibration(session.evaluator(), source_of(session));
  session.record().set_answer(AnswerKind::calibration, calibration::write_json(report, ""),
                              calibration::make_tables(report));
  return report;
}

}  // namespace linkstudy

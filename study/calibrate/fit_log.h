// Every evaluation a fit has asked for. A point that is known is not asked for again; what is not
// is asked for in one batch. The budget ends here: what it cuts off has Cause::cancelled.
#pragma once

#include <map>

#include "study/calibrate/fit_problem.h"

namespace linkstudy::calibration {

struct FitSample {
  std::vector<double> values;  // of the parameters
  std::uint64_t id = 0;
  Cause status = Cause::cancelled;
  std::string message{};
  Vector residuals{};  // empty with a cause
  double sum = 0.0;    // S; infinite with a cause

  bool is_ok() const { return status == Cause::ok; }
};

class FitLog {
 public:
  FitLog(const FitProblem& problem, const FitOptions& options, EvaluateBatch evaluate);

  // In the order of the points. The pointers stay valid.
  std::vector<const FitSample*> ask(const std::vector<Vector>& points);

  const FitProblem& problem() const { return problem_; }
  const FitOptions& options() const { return options_; }
  std::size_t evaluations() const { return known_.size(); }
  std::size_t failed() const { return failed_; }
  std::size_t rounds() const { return rounds_; }
  bool is_exhausted() const { return is_exhausted_; }
  const FitSample* first_failure() const { return first_failure_; }

 private:
  void evaluate(std::vector<std::vector<double>> values);

  FitProblem problem_;
  FitOptions options_;
  EvaluateBatch evaluate_;
  std::map<std::vector<double>, FitSample> known_;
  FitSample cut_off_;
  const FitSample* first_failure_ = nullptr;
  std::size_t failed_ = 0;
  std::size_t rounds_ = 0;
  bool is_exhausted_ = false;
};

// Works that say which points they want next and take the answers, side by side: the points of all
// go out together. Ends when all are done, or the budget is.
template <class Work>
void run_together(FitLog& log, std::vector<Work>& works) {
  while (!log.is_exhausted()) {
    std::vector<Vector> points;
    std::vector<std::pair<Work*, std::size_t>> askers;
    for (Work& work : works) {
      if (work.is_done()) continue;
      const std::vector<Vector> wanted = work.wanted();
      askers.emplace_back(&work, wanted.size());
      points.insert(points.end(), wanted.begin(), wanted.end());
    }
    if (askers.empty()) return;
    const std::vector<const FitSample*> answers = log.ask(points);
    auto next = answers.begin();
    for (const auto& [work, count] : askers) {
      work->take({next, next + static_cast<std::ptrdiff_t>(count)});
      next += static_cast<std::ptrdiff_t>(count);
    }
  }
}

}  // namespace linkstudy::calibration

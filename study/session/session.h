// Rank 0's side of the work of a study or tune: points go out in packs, what comes back is
// recorded.
#pragma once

#include <spdlog/logger.h>

#include "study/evaluate/run_costs.h"
#include "study/schedule/pool.h"
#include "study/schedule/progress.h"
#include "study/session/deadline.h"
#include "study/session/known_rows.h"
#include "study/session/options.h"
#include "study/session/study_record.h"
#include "study/session/warnings.h"

namespace linkstudy {

// More evaluations failed than are accepted.
class TooManyFailures : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class StudySession {
 public:
  StudySession(const SessionOptions& options, Evaluator& evaluator, StudyRecord& record,
               KnownRows& known, const RunDeadline& deadline, Pool& pool, spdlog::logger& log,
               std::uint64_t total);

  Evaluator& evaluator() { return evaluator_; }
  StudyRecord& record() { return record_; }
  spdlog::logger& log() { return log_; }

  // Evaluates the points that are neither in the record yet nor known otherwise, in packs that fill
  // the lanes of the ranks, and records each by itself. Throws Interrupted and TooManyFailures with
  // everything journalled.
  void evaluate(const std::vector<Point>& points);
  // The same of all points of the design, a stretch at a time: those of a large one would take more
  // memory than their results.
  void evaluate_design();

  // From the pool's clock.
  void tick();
  void finish_progress();
  // Tells where rows came from that were not run.
  void say_known();
  // Whether nothing of a design is left to do; of a tune, which has none, never.
  bool is_exhausted() const;
  // Tasks may still be running and are not waited for: cancelled in vain, or with lost ranks.
  bool is_abandoned() const { return abandoned_; }

 private:
  std::vector<Point> missing_of(const std::vector<Point>& points) const;
  // Records those that are known, and returns the others.
  std::vector<Point> take_known(const std::vector<Point>& points);
  std::vector<std::vector<Point>> sorted(std::vector<std::vector<Point>> packs);
  void run_packs(const std::vector<std::vector<Point>>& packs);
  void take_pack(const std::vector<Point>& pack, const TaskResult& task);
  void end_run(const RunOutcome& outcome);
  void take(Evaluation taken);
  void warn(const Evaluation& evaluation);
  void check_failures();
  std::size_t count_running() const;

  Evaluator& evaluator_;
  StudyRecord& record_;
  KnownRows& known_;
  const RunDeadline& deadline_;
  Pool& pool_;
  spdlog::logger& log_;
  std::uint64_t total_;  // 0 where not known beforehand
  RunCosts costs_;
  std::uint64_t failures_ = 0;
  bool abandoned_ = false;
  bool has_cancelled_ = false;              // of the present packs
  std::vector<std::size_t> points_before_;  // of the packs in hand: in those before each, and all
  std::size_t packs_taken_ = 0;
  std::size_t points_taken_ = 0;
  Progress progress_;
  Warnings warnings_;
  std::string stop_reason_;
};

// "812 of 1000 done, 3 failed, 185 left"
std::string counts_text(const StudyRecord& record, std::uint64_t total);

// `total` of a tune, where that is 0, is its budget.
std::uint64_t most_evaluations(const StudyInput& input, std::uint64_t total);

std::string one_line(std::string text);

}  // namespace linkstudy

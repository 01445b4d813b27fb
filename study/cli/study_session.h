// What study and tune share: the same steps on every rank, with a gate after each, so that all
// ranks leave together with one exit code and only rank 0 speaks.
//   read the input -> open the results directory (rank 0) -> run the references -> hand out work
#pragma once

#include <spdlog/logger.h>

#include <functional>
#include <memory>

#include "study/cli/input.h"
#include "study/cli/interrupted.h"
#include "study/cli/study_record.h"
#include "study/schedule/pool.h"

namespace linkstudy {

// More evaluations failed than are accepted.
class TooManyFailures : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Rank 0's side of the work.
class StudySession {
 public:
  StudySession(const CommandLine& line, Evaluator& evaluator, StudyRecord& record, Pool& pool,
               spdlog::logger& log, std::uint64_t total);

  const CommandLine& line() const { return line_; }
  const Evaluator& evaluator() const { return evaluator_; }
  StudyRecord& record() { return record_; }
  spdlog::logger& log() { return log_; }

  // Evaluates the points that are not in the record yet, in packs that fill the lanes of the ranks,
  // and records each by itself. Throws Interrupted and TooManyFailures with everything journalled.
  void evaluate(const std::vector<Point>& points);

  // From the pool's clock.
  void tick();
  void finish_progress();
  // Whether nothing of a design is left to do; of a tune, which has none, never.
  bool is_exhausted() const;
  // Tasks may still be running and are not waited for: cancelled in vain, or with lost ranks.
  bool is_abandoned() const { return abandoned_; }

 private:
  std::vector<Point> missing_of(const std::vector<Point>& points) const;
  void run_packs(const std::vector<std::vector<Point>>& packs);
  void take_pack(const std::vector<Point>& pack, const TaskResult& task);
  void end_run(const RunOutcome& outcome);
  void take(const Evaluation& evaluation, const std::vector<CaseTraces>& traces);
  void check_failures();
  std::size_t count_running() const;

  const CommandLine& line_;
  Evaluator& evaluator_;
  StudyRecord& record_;
  Pool& pool_;
  spdlog::logger& log_;
  std::uint64_t total_;  // 0 where not known beforehand
  std::uint64_t failures_ = 0;
  bool abandoned_ = false;
  bool has_cancelled_ = false;              // of the present packs
  std::vector<std::size_t> points_before_;  // of the packs in hand: in those before each, and all
  std::size_t packs_taken_ = 0;
  std::size_t points_taken_ = 0;
  Progress progress_;
  std::string stop_reason_;
};

// `work` runs on rank 0 and returns the exit code; `total` is 0 where not known beforehand.
using SessionWork = std::function<int(StudySession& session)>;
int run_session(const CommandLine& line, StudyKind kind, const SessionWork& work);

// "812 of 1000 done, 3 failed, 185 left"
std::string counts_text(const StudyRecord& record, std::uint64_t total);

}  // namespace linkstudy

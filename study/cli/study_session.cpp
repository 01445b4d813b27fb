#include "study/cli/study_session.h"
#include "study/cli/output.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <limits>

#include "core/base/isa.h"
#include "study/cli/exit_code.h"
#include "study/cli/report_error.h"
#include "study/cli/run_deadline.h"
#include "study/cli/run_references.h"
#include "study/cli/study_identity.h"
#include "study/cli/version.h"
#include "study/evaluate/form_packs.h"
#include "study/schedule/batch_job.h"
#include "study/store/directory.h"
#include "study/store/file.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

// Runs a step on this rank and agrees on how it ended. What rank 0 has to say is said by it alone;
// what went wrong on another rank only, by that one.
int pass_gate(Transport& transport, const std::function<int()>& step) {
  Failure failure;
  try {
    failure.code = step();
  } catch (const Interrupted&) {
    failure.code = exit_resumable;
  } catch (...) {
    failure = describe_failure(std::current_exception());
  }
  const int agreed = transport.agree_exit_code(failure.code);
  if (agreed == kDone) return kDone;
  std::string first = failure.text;
  transport.broadcast(first);
  if (transport.rank() == 0 || first.empty()) print_err(failure.text);
  return agreed;
}

std::shared_ptr<spdlog::logger> open_log(const CommandLine& line, const StudyRecord& record) {
  const std::string path = (record.directory() / kLogName).string();
  auto log = std::make_shared<spdlog::logger>(
      "linkstudy", std::make_shared<spdlog::sinks::basic_file_sink_mt>(path));
  log->set_level(spdlog::level::from_str(line.log_level));
  log->flush_on(spdlog::level::info);
  return log;
}

// "TERM"
std::string name_of_signal(int number) {
  const char* name = sigabbrev_np(number);
  return name == nullptr ? "" : name;
}

// A script that passes signals on waits for this file: from now on every rank takes them.
void mark_ready() {
  if (const auto path = read_environment("LINKSTUDY_READY")) write_file_atomically(*path, "");
}

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

Evaluation to_evaluation(const Point& point, const CaseResult& result, int rank, double seconds) {
  Evaluation evaluation;
  evaluation.point = point;
  evaluation.status = result.status;
  evaluation.message = one_line(result.message);
  evaluation.responses = result.responses;
  evaluation.attempts = result.attempts;
  evaluation.wall_s = seconds;
  evaluation.rank = rank;
  evaluation.host = result.host;
  return evaluation;
}

std::vector<CaseResult> results_of(const TaskResult& task, std::size_t count) {
  if (!task.failed) return decode_results(task.bytes);
  CaseResult result;
  result.status = task.lost ? Cause::rank_lost : Cause::exception;
  result.message = task.bytes;
  return std::vector<CaseResult>(count, result);
}

bool same_values(const Point& a, const Point& b) {
  return encode_points({&a, 1}) == encode_points({&b, 1});
}

// What a rank does with a task.
std::string evaluate_task(Evaluator& evaluator, const std::string& task, const std::string& host) {
  std::vector<std::vector<Value>> values;
  for (Point& point : decode_points(task)) values.push_back(std::move(point.values));
  std::vector<CaseResult> results = evaluator.evaluate(values);
  for (CaseResult& result : results) result.host = host;
  return encode_results(results);
}

// Of a tune, the budget.
std::uint64_t most_evaluations(const StudyInput& input, std::uint64_t total) {
  return total > 0 ? total : static_cast<std::uint64_t>(input.search.max_evaluations);
}

// The session of one process, step by step.
class Launch {
 public:
  Launch(const CommandLine& line, StudyKind kind, Transport& transport, Clock::time_point start)
      : line_(line),
        kind_(kind),
        transport_(transport),
        job_(find_batch_job(read_environment)),
        deadline_(find_deadline(line, job_, start)) {}

  int run(const SessionWork& work) {
    int code = pass_gate(transport_, [this] { return read_input(); });
    if (code == kDone) code = pass_gate(transport_, [this] { return agree_on_rounding(); });
    if (code != kDone) return code;
    code = pass_gate(transport_, [this] { return open_record(); });
    if (code == kDone && wants_references()) {
      code = pass_gate(transport_, [this] { return make_references(); });
      // What interrupts the references keeps the pool from handing out anything: it ends as usual.
      has_references_ = code != exit_resumable;
      if (!has_references_) return hand_out(work);
      if (code != kDone) return leave_without_work(code);
      share_references(*evaluator_, transport_);
    }
    return code == kDone ? hand_out(work) : code;
  }

 private:
  bool is_first() const { return transport_.rank() == 0; }

  int read_input() {
    simd_level();  // a wrong LINKSTUDY_SIMD or LINKSTUDY_LANES ends the program here
    const StudyInput input = read_study_input(line_, kind_);
    Diagnostics diagnostics;
    evaluator_ = make_evaluator(input, diagnostics);
    throw_if_any(diagnostics);
    if (kind_ == StudyKind::study) total_ = points_of(input).size();
    return kDone;
  }

  // Sets with fused multiply-adds and the one without differ in bits: then it would matter which
  // rank evaluates what.
  int agree_on_rounding() {
    const std::string own(name_of(simd_level().isa));
    const std::string baseline(name_of(InstructionSet::baseline));
    std::string first = own;
    transport_.broadcast(first);
    if ((own == baseline) == (first == baseline)) return kDone;
    throw SimdError(fmt::format(
        "rank {} on {} runs on {}, rank 0 on {}, which rounds differently: use machines "
        "of one kind, or LINKSTUDY_SIMD=baseline for all",
        transport_.rank(), transport_.host(), own, first));
  }

  int make_references() {
    if (is_first()) run_references(*evaluator_, *record_, deadline_, *log_);
    return kDone;
  }

  int open_record() {
    if (!is_first()) return kDone;
    const StudyIdentity identity = make_identity(
        line_, *evaluator_, most_evaluations(evaluator_->input(), total_), transport_);
    const std::string directory = directory_of(line_, evaluator_->input());
    record_ = std::make_unique<StudyRecord>(directory, identity, line_.fresh);
    log_ = open_log(line_, *record_);
    log_->info("{} ({} ranks)", line_.command, transport_.size());
    if (!job_.id.empty()) log_->info("{}", text_of(job_));
    if (record_->keeps_own_job()) say_kept();
    print_banner(identity);
    return kDone;
  }

  void say_kept() {
    const std::string text =
        fmt::format("--fresh was for the first start of job {}; what it has done is kept", job_.id);
    fmt::print(stderr, "linkstudy: {}\n", text);
    log_->info("{}", text);
  }

  void print_banner(const StudyIdentity& identity) {
    const std::string revision = git_revision().empty() ? "" : " " + git_revision();
    fmt::print(stderr, "linkstudy {}{}, {} rank{} on {} node{}, SIMD {}, input {}\n",
               program_version(), revision, transport_.size(), transport_.size() == 1 ? "" : "s",
               transport_.nodes(), transport_.nodes() == 1 ? "" : "s", simd_text(),
               identity.input_sha256.substr(0, 12));
    const std::string dropped = dropped_text(record_->journal().contents(), record_->directory());
    if (!dropped.empty()) {
      print_err(fmt::format("linkstudy: warning: {}\n", dropped));
      log_->warn("{}", dropped);
    }
    const std::string counts = counts_text(*record_, total_);
    fmt::print(stderr, "{}: {}\n", record_->directory().string(), counts);
    log_->info("{}", counts);
    const std::vector<Diagnostic>& remarks = evaluator_->input().remarks;
    print_remarks(remarks);
    for (const Diagnostic& remark : remarks) log_->warn("{}", one_line(to_string(remark)));
  }

  // A finished study that is started again needs none. Rank 0 knows.
  bool wants_references() {
    std::string answer(1, '1');
    if (is_first()) {
      const bool is_finished = total_ > 0 && record_->evaluations().size() >= total_;
      answer[0] = is_finished ? '0' : '1';
    }
    transport_.broadcast(answer);
    return answer[0] == '1';
  }

  int leave_without_work(int code) {
    if (record_) log_->error("ended before any evaluation with exit code {}", code);
    if (record_) record_->discard_if_empty();
    return code;
  }

  PoolOptions pool_options() {
    PoolOptions options;
    options.deadline = deadline_.begin_until;
    options.cancel_at = deadline_.cancel_at;
    options.cancel_work = [this] { evaluator_->cancel(); };
    options.find_beat = [this] { return evaluator_->reached(); };
    options.task_limit_s = evaluator_->input().run.timeout.value_or(0.0);
    if (!is_first()) return options;
    options.on_lost = [this](const LostRank& lost) { say_lost(lost); };
    options.on_terminate = [this] {
      record_->journal().sync();
      log_->warn("stop signal {}: {}", name_of_signal(last_stop_signal()),
                 stop_level() >= stop_cancel ? "what is in flight is cancelled"
                                             : "what is in flight ends, nothing more is begun");
    };
    options.on_tick = [this] {
      if (session_) session_->tick();
    };
    return options;
  }

  void say_lost(const LostRank& lost) {
    const std::string text =
        fmt::format("rank {} is lost: {} for {:.0f} s; its {} tasks go elsewhere", lost.rank,
                    lost.answers ? "it answers, but its work stands still" : "no sign of life",
                    lost.silence_s, lost.tasks);
    fmt::print(stderr, "linkstudy: {}\n", text);
    log_->error("{}", text);
  }

  int hand_out(const SessionWork& work) {
    const std::string host = transport_.host();
    Evaluator& evaluator = *evaluator_;
    const auto compute = [&evaluator, host](const std::string& task) {
      return evaluate_task(evaluator, task, host);
    };
    int code = kDone;
    {
      Pool pool(transport_, compute, pool_options());
      if (is_first()) {
        code = lead(pool, work);
      } else {
        pool.serve();
      }
    }
    return transport_.agree_exit_code(code);
  }

  int lead(Pool& pool, const SessionWork& work) {
    int code = kInternalError;
    try {
      if (has_references_) record_->add_references(evaluator_->reference_traces());
      session_ = std::make_unique<StudySession>(line_, *evaluator_, *record_, pool, *log_, total_);
      code = work(*session_);
    } catch (...) {
      const Failure failure = describe_failure(std::current_exception());
      print_err(failure.text);
      log_->error("{}", failure.text);
      code = failure.code;
    }
    log_->info("exit code {}", code);
    if ((session_ && session_->is_abandoned()) || !pool.close()) pool.leave_now(code);
    return code;
  }

  const CommandLine& line_;
  StudyKind kind_;
  Transport& transport_;
  BatchJob job_;
  RunDeadline deadline_;
  bool has_references_ = true;
  std::unique_ptr<Evaluator> evaluator_;
  std::uint64_t total_ = 0;
  std::unique_ptr<StudyRecord> record_;  // rank 0
  std::shared_ptr<spdlog::logger> log_;  // rank 0
  std::unique_ptr<StudySession> session_;
};

std::size_t failure_limit(const RunOptions& run, std::uint64_t total) {
  if (!run.max_failures) return std::numeric_limits<std::size_t>::max();
  const double share = run.max_failures->is_percent ? static_cast<double>(total) / 100.0 : 1.0;
  return static_cast<std::size_t>(run.max_failures->value * share);
}

}  // namespace

std::string counts_text(const StudyRecord& record, std::uint64_t total) {
  const std::uint64_t finished = record.evaluations().size();
  const std::uint64_t failed = record.failure_count();
  if (total == 0) return fmt::format("{} done, {} failed", finished - failed, failed);
  return fmt::format("{} of {} done, {} failed, {} left", finished - failed, total, failed,
                     total - std::min(finished, total));
}

StudySession::StudySession(const CommandLine& line, Evaluator& evaluator, StudyRecord& record,
                           Pool& pool, spdlog::logger& log, std::uint64_t total)
    : line_(line),
      evaluator_(evaluator),
      record_(record),
      pool_(pool),
      log_(log),
      total_(total),
      failures_(record.failure_count()),
      progress_(*find_word<ProgressMode>(line.progress), most_evaluations(evaluator.input(), total),
                record.evaluations().size(), Clock::now()) {}

void StudySession::evaluate(const std::vector<Point>& points) {
  check_failures();
  const std::vector<Point> missing = missing_of(points);
  const auto& parameters = evaluator_.parameters();
  run_packs(form_packs(missing, parameters, simd_level().lanes, pool_.ranks()));
  // What failed outside the evaluations (no memory, a message over its limit) may do alone.
  run_packs(form_packs(missing_of(missing), parameters, 1, pool_.ranks()));
}

std::vector<Point> StudySession::missing_of(const std::vector<Point>& points) const {
  std::vector<Point> missing;
  for (const Point& point : points) {
    const auto known = record_.evaluations().find(point.id);
    if (known == record_.evaluations().end()) {
      missing.push_back(point);
    } else if (!same_values(known->second.point, point)) {
      throw StoreError(fmt::format(
          "{}: evaluation {} in the journal has other inputs than this program asks for; continue "
          "with the program that wrote it or overwrite it with --fresh",
          record_.directory().string(), point.id));
    }
  }
  return missing;
}

void StudySession::run_packs(const std::vector<std::vector<Point>>& packs) {
  if (packs.empty()) return;
  has_cancelled_ = false;
  std::vector<std::string> tasks;
  points_before_ = {0};
  packs_taken_ = points_taken_ = 0;
  for (const std::vector<Point>& pack : packs) {
    tasks.push_back(encode_points(pack));
    points_before_.push_back(points_before_.back() + pack.size());
  }
  const RunOutcome outcome = pool_.run(
      std::move(tasks), [&](const TaskResult& task) { take_pack(packs[task.index], task); });
  record_.journal().sync();
  end_run(outcome);
}

void StudySession::end_run(const RunOutcome& outcome) {
  abandoned_ = outcome.end == RunEnd::abandoned || outcome.end == RunEnd::no_rank;
  if (outcome.end == RunEnd::no_rank) {
    print_err("linkstudy: error: no rank is left that works\n");
  }
  if (outcome.interrupted() || has_cancelled_) {
    log_.warn("interrupted: {}", outcome.end == RunEnd::no_rank       ? "no rank is left"
                                 : outcome.reason == RunEnd::deadline ? "wall time"
                                                                      : "stop signal");
    throw Interrupted();
  }
  if (!stop_reason_.empty()) throw TooManyFailures(stop_reason_);
}

// A pack that failed as a whole is left missing, so that its points are run alone; what was
// cancelled is nobody's result and is left to the next start.
void StudySession::take_pack(const std::vector<Point>& pack, const TaskResult& task) {
  ++packs_taken_;
  points_taken_ += pack.size();
  if (task.failed && pack.size() > 1) {
    log_.warn("{} evaluations from {} on: {}", pack.size(), pack[0].id, one_line(task.bytes));
    return;
  }
  const std::vector<CaseResult> results = results_of(task, pack.size());
  const double seconds = task.seconds / static_cast<double>(pack.size());
  for (std::size_t i = 0; i < pack.size(); ++i) {
    if (results.at(i).status == Cause::cancelled) {
      has_cancelled_ = true;
    } else {
      take(to_evaluation(pack[i], results[i], task.rank, seconds), results[i].traces);
    }
  }
  progress_.update(record_.evaluations().size(), failures_, Clock::now());
}

void StudySession::take(const Evaluation& evaluation, const std::vector<CaseTraces>& traces) {
  record_.add(evaluation, traces);
  log_.debug("evaluation {}: {} in {:.3g} s on rank {}", evaluation.point.id,
             name_of(evaluation.status), evaluation.wall_s, evaluation.rank);
  if (evaluation.status == Cause::ok) return;
  ++failures_;
  log_.warn("evaluation {}: {}: {}", evaluation.point.id, name_of(evaluation.status),
            evaluation.message);
  try {
    check_failures();
  } catch (const TooManyFailures& reason) {
    stop_reason_ = reason.what();
    pool_.cancel();
  }
}

void StudySession::check_failures() {
  const RunOptions& run = evaluator_.input().run;
  if (failures_ > 0 && run.on_failure == FailurePolicy::abort) {
    const auto& all = record_.evaluations();
    const auto failed = std::ranges::find_if(
        all, [](const auto& entry) { return entry.second.status != Cause::ok; });
    throw TooManyFailures(fmt::format("evaluation {} failed ({}): {}; on-failure is abort",
                                      failed->first, name_of(failed->second.status),
                                      failed->second.message));
  }
  const std::size_t limit = failure_limit(run, most_evaluations(evaluator_.input(), total_));
  if (failures_ <= limit) return;
  throw TooManyFailures(
      fmt::format("{} evaluations failed, {} are accepted (max_failures)", failures_, limit));
}

// Packs are handed out in order.
std::size_t StudySession::count_running() const {
  if (points_before_.empty()) return 0;
  const std::size_t handed_out =
      std::min(packs_taken_ + pool_.in_flight(), points_before_.size() - 1);
  return points_before_[handed_out] - std::min(points_taken_, points_before_[handed_out]);
}

void StudySession::tick() {
  progress_.set_running(count_running());
  progress_.tick(Clock::now());
  record_.journal().sync_if_due();
  record_.write_if_due();
}

bool StudySession::is_exhausted() const {
  return total_ > 0 && record_.evaluations().size() >= total_;
}

void StudySession::finish_progress() {
  if (total_ == 0) return;  // a tune ends below its budget: "25 %, 1 min left" would mislead
  progress_.finish(Clock::now());
}

int run_session(const CommandLine& line, StudyKind kind, const SessionWork& work) {
  const Clock::time_point start = Clock::now();
  const std::unique_ptr<Transport> transport = make_transport();
  try {
    if (transport->rank() == 0) mark_ready();
    return Launch(line, kind, *transport, start).run(work);
  } catch (const std::exception& error) {
    // This rank cannot take part any more, and the others would wait for it.
    print_err(fmt::format("linkstudy: error: rank {}: {}\n", transport->rank(), error.what()));
    if (transport->size() > 1) transport->abort_all(kInternalError);
    return kInternalError;
  }
}

}  // namespace linkstudy

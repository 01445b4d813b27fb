#include "study/session/launch.h"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "core/base/isa.h"
#include "study/config/input_error.h"
#include "study/record/counted.h"
#include "study/record/version.h"
#include "study/report/console.h"
#include "study/schedule/batch_job.h"
#include "study/session/continuation.h"
#include "study/session/deadline.h"
#include "study/session/earlier_run.h"
#include "study/session/exit_code.h"
#include "study/session/failure.h"
#include "study/session/identity.h"
#include "study/session/interrupted.h"
#include "study/session/references.h"
#include "study/session/study_points.h"
#include "study/store/directory.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

std::shared_ptr<spdlog::logger> open_log(const SessionOptions& options, const StudyRecord& record) {
  const std::string path = (record.directory() / kLogName).string();
  auto log = std::make_shared<spdlog::logger>(
      "linkstudy", std::make_shared<spdlog::sinks::basic_file_sink_mt>(path));
  log->set_level(spdlog::level::from_str(options.log_level));
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

// What a rank does with a task.
std::string evaluate_task(Evaluator& evaluator, const std::string& task, const std::string& host) {
  std::vector<WholeEvaluation> whole;
  for (Evaluation& evaluation : evaluator.evaluate(from_bytes<std::vector<Point>>(task))) {
    evaluation.host = host;
    whole.push_back({std::move(evaluation)});
  }
  return to_bytes(whole);
}

// The session of one process, step by step.
class Launch {
 public:
  Launch(const SessionOptions& options, const ReadInput& read, Transport& transport,
         const RunDeadline& deadline)
      : options_(options),
        read_(read),
        transport_(transport),
        job_(find_batch_job(read_environment)),
        deadline_(deadline) {}

  int run(const SessionWork& work) {
    int code = pass_gate(transport_, [this] { return read_input(); });
    if (code == kDone) code = pass_gate(transport_, [this] { return agree_on_rounding(); });
    if (code != kDone) return code;
    code = pass_gate(transport_, [this] { return open_record(); });
    if (code == kDone && wants_references()) {
      code = pass_gate(transport_, [this] { return make_references(); });
      // What interrupts the references keeps the pool from handing out anything: it ends as usual.
      has_references_ = code != kExitResumable;
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
    const StudyInput input = read_();
    Diagnostics diagnostics;
    evaluator_ = make_evaluator(input, diagnostics);
    throw_if_any(diagnostics);
    if (has_design(input.kind)) total_ = count_of(input);
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
    const auto compute = [this](const std::string& task) {
      return run_reference_task(*evaluator_, task);
    };
    std::vector<std::size_t> missing;
    if (is_first()) missing = take_references(*evaluator_, *record_, *known_, *log_);
    PoolOptions options = pool_options();
    options.task_limit_s = 0.0;  // --timeout is that of evaluations
    Pool pool(transport_, compute, options);
    if (!is_first()) {
      pool.serve();
      return kDone;
    }
    return lead_references(missing, pool);
  }

  int lead_references(const std::vector<std::size_t>& missing, Pool& pool) {
    if (missing.empty()) return kDone;
    bool is_interrupted = false;
    try {
      run_references(missing, *evaluator_, *record_, *known_, pool, *log_);
    } catch (const Interrupted&) {
      is_interrupted = true;
      log_->warn("reference runs are left to the next start");
    }
    record_->journal().sync();
    if (!pool.close()) pool.leave_now(kExitResumable);
    return is_interrupted ? kExitResumable : kDone;
  }

  int open_record() {
    if (!is_first()) return kDone;
    const StudyIdentity identity = make_identity(
        options_, *evaluator_, most_evaluations(evaluator_->input(), total_), transport_);
    const std::string directory = directory_of(options_, evaluator_->input());
    refuse_own_results(evaluator_->input(), directory);
    std::optional<ResultCache> cache;
    if (options_.cache) cache = open_cache(*options_.cache);
    const std::string continued = prepare_continuation(options_, directory, identity, *evaluator_);
    try {
      record_ = std::make_unique<StudyRecord>(directory, identity, options_.fresh);
    } catch (const OtherInput& found) {
      throw_other_input(found, options_);
    }
    log_ = open_log(options_, *record_);
    known_ = std::make_unique<KnownRows>(
        *evaluator_, EarlierRows(record_->directory(), identity.start),
        cache ? std::make_unique<CachedRows>(std::move(*cache), *log_) : nullptr);
    log_->info("{} ({} ranks)", options_.command, transport_.size());
    if (!job_.id.empty()) log_->info("{}", text_of(job_));
    if (record_->keeps_own_job()) say_kept();
    print_banner(identity);
    if (!continued.empty()) say(continued);
    return kDone;
  }

  void say(const std::string& text) {
    fmt::print(stderr, "linkstudy: {}\n", text);
    log_->info("{}", one_line(text));
  }

  void say_kept() {
    say(fmt::format("--fresh was for the first start of job {}; what it has done is kept",
                    job_.id));
  }

  void print_banner(const StudyIdentity& identity) {
    if (!options_.is_part) {
      print_err(fmt::format("{}, input {}\n", ranks_text(transport_),
                            identity.input_sha256.substr(0, 12)));
    }
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
      // A refinement is judged against them when all levels are there; the journal has them.
      const bool is_judged_later = evaluator_->input().kind == FileKind::converge;
      answer[0] = is_finished && !is_judged_later ? '0' : '1';
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
                 stop_level() >= kStopCancel ? "what is in flight is cancelled"
                                             : "what is in flight ends, nothing more is begun");
    };
    options.on_tick = [this] {
      if (session_) session_->tick();
    };
    return options;
  }

  void say_lost(const LostRank& lost) {
    std::string text = fmt::format(
        "rank {} is lost: {} for {:.0f} s", lost.rank,
        lost.answers ? "it answers, but its work stands still" : "no sign of life", lost.silence_s);
    if (lost.tasks > 0) text += fmt::format("; tasks that go elsewhere: {}", lost.tasks);
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
      session_ = std::make_unique<StudySession>(options_, *evaluator_, *record_, *known_, deadline_,
                                                pool, *log_, total_);
      code = work(*session_);
    } catch (...) {
      const Failure failure = describe_failure(std::current_exception());
      print_err(failure.text);
      log_->error("{}", failure.text);
      code = failure.code;
    }
    if (!written_text().empty()) log_->info("{} on rank 0", written_text());
    log_->info("exit code {}", code);
    if ((session_ && session_->is_abandoned()) || !pool.close()) {
      // Of a queue that goes no further the rest is left.
      pool.leave_now(options_.is_part ? std::max(code, kExitResumable) : code);
    }
    return code;
  }

  const SessionOptions& options_;
  const ReadInput& read_;
  Transport& transport_;
  BatchJob job_;
  RunDeadline deadline_;
  bool has_references_ = true;
  std::unique_ptr<Evaluator> evaluator_;
  std::uint64_t total_ = 0;
  std::unique_ptr<StudyRecord> record_;  // rank 0
  std::unique_ptr<KnownRows> known_;     // rank 0
  std::shared_ptr<spdlog::logger> log_;  // rank 0
  std::unique_ptr<StudySession> session_;
};

}  // namespace

int pass_gate(Transport& transport, const std::function<int()>& step) {
  Failure failure;
  try {
    failure.code = step();
  } catch (const Interrupted&) {
    failure.code = kExitResumable;
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

std::string ranks_text(const Transport& transport) {
  const std::string revision = git_revision().empty() ? "" : " " + git_revision();
  return fmt::format("linkstudy {}{}, {} on {}, SIMD {}, kernels {}", program_version(), revision,
                     counted(transport.size(), "rank"), counted(transport.nodes(), "node"),
                     simd_text(), kernels_text());
}

int run_on_ranks(const std::function<int(Transport& transport)>& run) {
  const std::unique_ptr<Transport> transport = make_transport();
  try {
    if (transport->rank() == 0) mark_ready();
    return run(*transport);
  } catch (const std::exception& error) {
    // This rank cannot take part any more, and the others would wait for it.
    print_err(fmt::format("linkstudy: error: rank {}: {}\n", transport->rank(), error.what()));
    if (transport->size() > 1) transport->abort_all(kInternalError);
    return kInternalError;
  }
}

int run_session(Transport& transport, const RunDeadline& deadline, const SessionOptions& options,
                const ReadInput& read, const SessionWork& work) {
  return Launch(options, read, transport, deadline).run(work);
}

int run_session(const SessionOptions& options, const ReadInput& read, const SessionWork& work) {
  const Clock::time_point start = Clock::now();
  return run_on_ranks([&](Transport& transport) {
    const RunDeadline deadline =
        find_deadline(options.walltime_s, find_batch_job(read_environment), start);
    return run_session(transport, deadline, options, read, work);
  });
}

}  // namespace linkstudy

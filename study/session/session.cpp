#include "study/session/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "core/base/isa.h"
#include "study/config/case_selection.h"
#include "study/design/design.h"
#include "study/evaluate/form_packs.h"
#include "study/record/bytes.h"
#include "study/report/console.h"
#include "study/session/interrupted.h"
#include "study/store/store_error.h"
#include "study/tune/tuning_setup.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

// Points of a stretch: so many that what ranks wait for each other at its end is nothing beside it.
constexpr std::uint64_t kLeastStretch = 1 << 16;
constexpr std::uint64_t kPacksOfRank = 64;

std::vector<WholeEvaluation> evaluations_of(const TaskResult& task,
                                            const std::vector<Point>& pack) {
  if (!task.failed) return from_bytes<std::vector<WholeEvaluation>>(task.bytes);
  std::vector<WholeEvaluation> failed(pack.size());
  for (std::size_t i = 0; i < pack.size(); ++i) {
    Evaluation& evaluation = failed[i].evaluation;
    evaluation.point = pack[i];
    evaluation.status = task.lost ? Cause::rank_lost : Cause::exception;
    evaluation.message = task.bytes;
  }
  return failed;
}

bool same_values(const Point& a, const Point& b) {
  return to_bytes(a) == to_bytes(b);
}

std::size_t failure_limit(const RunOptions& run, std::uint64_t total) {
  if (!run.max_failures) return std::numeric_limits<std::size_t>::max();
  const double share = run.max_failures->is_percent ? static_cast<double>(total) / 100.0 : 1.0;
  return static_cast<std::size_t>(run.max_failures->value * share);
}

}  // namespace

std::string one_line(std::string text) {
  std::ranges::replace(text, '\n', ' ');
  return text;
}

std::uint64_t most_evaluations(const StudyInput& input, std::uint64_t total) {
  if (total > 0) return total;
  if (input.kind == FileKind::calibrate) {
    return static_cast<std::uint64_t>(input.fit.max_evaluations);
  }
  return most_tuning_evaluations(input);
}

std::string counts_text(const StudyRecord& record, std::uint64_t total) {
  const std::uint64_t finished = record.evaluations().size();
  const std::uint64_t failed = record.failure_count();
  if (total == 0) return fmt::format("{} done, {} failed", finished - failed, failed);
  return fmt::format("{} of {} done, {} failed, {} left", finished - failed, total, failed,
                     total - std::min(finished, total));
}

StudySession::StudySession(const SessionOptions& options, Evaluator& evaluator, StudyRecord& record,
                           KnownRows& known, const RunDeadline& deadline, Pool& pool,
                           spdlog::logger& log, std::uint64_t total)
    : evaluator_(evaluator),
      record_(record),
      known_(known),
      deadline_(deadline),
      pool_(pool),
      log_(log),
      total_(total),
      costs_(evaluator),
      failures_(record.failure_count()),
      progress_(*find_word<ProgressMode>(options.progress),
                most_evaluations(evaluator.input(), total), record.evaluations().size(),
                Clock::now()) {
  progress_.set_budget(total == 0);
}

void StudySession::evaluate(const std::vector<Point>& points) {
  check_failures();
  const std::vector<Point> missing = take_known(missing_of(points));
  if (missing.empty()) return;
  const auto& parameters = evaluator_.parameters();
  const int width = pack_width(evaluator_, missing, simd_level().lanes, pool_.ranks());
  run_packs(sorted(form_packs(missing, parameters, width, pool_.ranks())));
  // What failed outside the evaluations (no memory, a message over its limit) may do alone.
  run_packs(sorted(form_packs(missing_of(missing), parameters, 1, pool_.ranks())));
}

std::vector<std::vector<Point>> StudySession::sorted(std::vector<std::vector<Point>> packs) {
  if (packs.size() > 1) sort_by_cost(packs, costs_);
  return packs;
}

void StudySession::evaluate_design() {
  const DesignOptions& design = evaluator_.input().design;
  const std::vector<Axis> axes = axes_of(evaluator_.input());
  const std::uint64_t all = count_points(design, axes);
  const auto lanes = static_cast<std::uint64_t>(simd_level().lanes * pool_.ranks());
  const std::uint64_t length = std::max(kLeastStretch, lanes * kPacksOfRank);
  for (std::uint64_t begin = 0; begin < all; begin += length) {
    std::vector<Point> points;
    for (std::uint64_t id = begin; id < std::min(all, begin + length); ++id) {
      points.push_back(make_point(design, axes, id));
    }
    evaluate(points);
  }
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

std::vector<Point> StudySession::take_known(const std::vector<Point>& points) {
  std::vector<Point> others;
  for (const Point& point : points) {
    // The pool ends what is to end.
    const bool is_ending = stop_level() > 0 || deadline_.forbids_to_begin();
    std::optional<Evaluation> known = is_ending ? std::nullopt : known_.find(point);
    if (!known) {
      others.push_back(point);
      continue;
    }
    take(std::move(*known));
    progress_.update(record_.evaluations().size(), failures_, Clock::now());
    if (!stop_reason_.empty()) throw TooManyFailures(stop_reason_);
  }
  if (others.size() < points.size()) record_.journal().sync();
  return others;
}

void StudySession::run_packs(const std::vector<std::vector<Point>>& packs) {
  if (packs.empty()) return;
  has_cancelled_ = false;
  std::vector<std::string> tasks;
  points_before_ = {0};
  packs_taken_ = points_taken_ = 0;
  for (const std::vector<Point>& pack : packs) {
    tasks.push_back(to_bytes(pack));
    points_before_.push_back(points_before_.back() + pack.size());
  }
  const RunOutcome outcome = pool_.run(
      std::move(tasks), [&](const TaskResult& task) { take_pack(packs[task.index], task); });
  record_.journal().sync();
  end_run(outcome);
}

void StudySession::end_run(const RunOutcome& outcome) {
  abandoned_ = outcome.end == RunEnd::abandoned || outcome.end == RunEnd::no_rank;
  if (outcome.end == RunEnd::no_rank) print_err("linkstudy: error: no rank is left that works\n");
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
  for (WholeEvaluation& whole : evaluations_of(task, pack)) {
    Evaluation& evaluation = whole.evaluation;
    if (evaluation.status == Cause::cancelled) {
      has_cancelled_ = true;
      continue;
    }
    evaluation.message = one_line(std::move(evaluation.message));
    evaluation.wall_s = task.seconds / static_cast<double>(pack.size());
    evaluation.rank = task.rank;
    evaluation.attempts += known_.attempts(evaluation.point);
    known_.keep(evaluation);
    take(std::move(evaluation));
  }
  progress_.update(record_.evaluations().size(), failures_, Clock::now());
}

void StudySession::warn(const Evaluation& evaluation) {
  for (const std::string& text : evaluation.warnings) {
    if (!warnings_.add(text)) continue;
    progress_.clear();
    say_warning(fmt::format("evaluation {}: {}", evaluation.point.id, one_line(text)), log_);
  }
}

void StudySession::take(Evaluation taken) {
  warn(taken);
  taken.warnings = {};  // as long as all the rest of a row, and said
  const Evaluation& evaluation = record_.add(std::move(taken));
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

void StudySession::say_known() {
  const std::string text = known_.summary();
  if (text.empty()) return;
  print_err(text + "\n");
  log_.info("{}", one_line(text));
  record_.note({"known_rows", text});
}

void StudySession::finish_progress() {
  warnings_.log_counts(log_);
  if (total_ == 0) return;  // a tune ends below its budget: "25 %, 1 min left" would mislead
  progress_.finish(Clock::now());
}

}  // namespace linkstudy

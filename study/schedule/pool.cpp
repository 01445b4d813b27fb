#include "study/schedule/pool.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "study/schedule/stop_signals.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;

// Tasks longer than this are never queued behind another: an unlucky one would wait for it.
constexpr double kQueueBelowS = 10e-3;
// Work queued in front of a rank covers this much, some polls of both sides.
constexpr double kQueuedWorkS = 16e-3;
constexpr double kPollsOfQueue = 4.0;
// From so many on, the work of rank 0 is a small part of all.
constexpr int kManyRanks = 16;
constexpr double kMostQueued = 64.0;
constexpr milliseconds kTickInterval{100};
// Taken in before ticks and signals are looked at again.
constexpr int kMostMessages = 256;
// For ranks to answer that they leave, when somebody is in a hurry.
constexpr milliseconds kHurry{2000};
// For cancelled tasks to return: a launcher kills one second after its SIGTERM.
constexpr milliseconds kCancelPatience{500};
// At the end of the time nobody kills yet.
constexpr milliseconds kLatePatience{2000};
// Ranks lost with a task, until it is the task.
constexpr int kMostLosses = 3;

}  // namespace

struct Pool::Run {
  Run(std::uint64_t run_number, std::vector<std::string> all, const OnResult& receiver, int ranks)
      : number(run_number),
        tasks(std::move(all)),
        on_result(receiver),
        given(static_cast<std::size_t>(ranks)),
        is_answered(tasks.size(), false) {}

  std::uint64_t number;
  std::vector<std::string> tasks;  // emptied when answered
  const OnResult& on_result;
  std::vector<std::vector<std::size_t>> given;  // by rank: handed out and not answered
  std::vector<bool> is_answered;
  std::deque<std::size_t> returned;     // of lost ranks, to be handed out again
  std::map<std::size_t, int> losses{};  // ranks lost with a task
  std::size_t next = 0;                 // first task not handed out
  std::size_t answered = 0;             // results of this run
  bool stopping = false;                // hands out no more
  RunEnd reason = RunEnd::complete;

  void stop(RunEnd why) {
    if (!stopping) reason = why;
    stopping = true;
  }
};

Pool::Pool(Transport& transport, Work work, PoolOptions options)
    : transport_(transport),
      options_(std::move(options)),
      thread_(std::move(work), transport.rank()),
      outstanding_(static_cast<std::size_t>(transport.size()), 0),
      watch_(transport.size(), options_.task_limit_s, Clock::now()),
      left_(static_cast<std::size_t>(transport.size()), false) {}

Pool::~Pool() {
  if (transport_.rank() == 0 && !close()) transport_.abort_all(kExitResumable);
}

int Pool::find_stop_level() const {
  return std::max(stop_level(), forwarded_level_);
}

RunOutcome Pool::run(std::vector<std::string> tasks, const OnResult& on_result) {
  if (transport_.rank() != 0) throw std::logic_error("only rank 0 runs tasks; the others serve");
  if (finished_) throw std::logic_error("the pool has ended");
  Run run(++run_number_, std::move(tasks), on_result, transport_.size());
  cancelled_ = false;
  watch_.restart(Clock::now());
  auto next_tick = Clock::now() + kTickInterval;
  collect(run);
  for (int rank = 0; rank < transport_.size(); ++rank) feed(run, rank);
  for (;;) {
    const bool active = collect(run);
    cancel_if_due(run);
    if (const auto end = find_end(run)) return {*end, run.answered, run.reason};
    if (!active || Clock::now() >= next_tick) wait(run, next_tick);
  }
}

// Takes in what has arrived; true if there was anything.
bool Pool::collect(Run& run) {
  bool active = false;
  while (auto result = thread_.pop()) {
    active = true;
    deliver(run, std::move(*result));
  }
  if (is_alone()) return active;
  for (int i = 0; i < kMostMessages; ++i) {
    auto message = transport_.receive();
    if (!message) break;
    active = true;
    note_message(&run, std::move(*message));
  }
  return active;
}

void Pool::note_message(Run* run, Message message) {
  watch_.hear(message.from, message.tag != Tag::stuck);
  if (message.tag == Tag::bye) left_[static_cast<std::size_t>(message.from)] = true;
  if (message.tag == Tag::signal)
    forwarded_level_ = std::max(forwarded_level_, std::stoi(message.bytes));
  if (message.tag == Tag::result && run)
    deliver(*run, unpack_result(std::move(message.bytes), message.from));
}

// Feeds the rank first, so that it computes while on_result writes. Late results of a run that
// ended with an exception are dropped.
void Pool::deliver(Run& run, TaskResult result) {
  const auto rank = static_cast<std::size_t>(result.rank);
  if (outstanding_[rank] > 0) --outstanding_[rank];
  watch_.note_task(result.seconds);
  mean_seconds_ = mean_seconds_ < 0.0 ? result.seconds : 0.9 * mean_seconds_ + 0.1 * result.seconds;
  const bool current = result.run == run.number;
  if (current) std::erase(run.given[rank], result.index);
  feed(run, result.rank);
  if (current) answer(run, std::move(result));
}

// The first answer counts: a rank that was given up may have another.
void Pool::answer(Run& run, TaskResult result) {
  const auto index = static_cast<std::size_t>(result.index);
  if (run.is_answered[index]) return;
  run.is_answered[index] = true;
  run.tasks[index] = {};
  ++run.answered;
  run.on_result(std::move(result));
}

std::optional<std::size_t> Pool::next_task(Run& run) const {
  while (!run.returned.empty()) {
    const std::size_t index = run.returned.front();
    run.returned.pop_front();
    if (!run.is_answered[index]) return index;
  }
  if (run.next == run.tasks.size()) return std::nullopt;
  return run.next++;
}

void Pool::feed(Run& run, int rank) {
  note_stop_signal();
  if (find_stop_level() > 0) {
    run.stop(RunEnd::signal);
  } else if (options_.deadline && Clock::now() >= *options_.deadline) {
    run.stop(RunEnd::deadline);
  } else if (cancelled_) {
    run.stop(RunEnd::cancelled);
  }
  if (!gets_work(rank)) return;
  std::size_t& given = outstanding_[static_cast<std::size_t>(rank)];
  const std::size_t depth = find_depth(run);
  while (!run.stopping && given < depth) {
    const auto index = next_task(run);
    if (!index) return;
    Task task{run.number, *index, run.tasks[*index]};
    ++given;
    run.given[static_cast<std::size_t>(rank)].push_back(*index);
    if (rank == 0)
      thread_.push(std::move(task));
    else
      transport_.send(rank, Tag::task, pack_task(std::move(task)));
  }
}

bool Pool::gets_work(int rank) const {
  if (watch_.is_lost(rank)) return false;
  const bool has_others = watch_.lost_count() < transport_.size() - 1;
  const bool has_time = transport_.size() < kManyRanks || load_.leaves_time();
  return rank != 0 || !has_others || (options_.first_computes && has_time);
}

// One running task, and some queued when they are short and enough are left for every rank.
std::size_t Pool::find_depth(const Run& run) const {
  if (mean_seconds_ < 0.0 || mean_seconds_ > kQueueBelowS) return 1;
  const double wanted = std::ceil(kQueuedWorkS / std::max(mean_seconds_, 1e-9));
  const std::size_t fair = (run.tasks.size() - run.next) / (2 * outstanding_.size());
  return 1 + std::min(static_cast<std::size_t>(std::min(wanted, kMostQueued)), fair);
}

std::optional<RunEnd> Pool::find_end(const Run& run) {
  if (run.answered == run.tasks.size()) return RunEnd::complete;
  if (run.stopping && !is_in_flight(run)) return run.reason;
  if (watch_.lost_count() == transport_.size()) return RunEnd::no_rank;
  if (!cancel_until_ || Clock::now() < *cancel_until_) return std::nullopt;
  thread_.drop_queued();
  return RunEnd::abandoned;
}

bool Pool::is_in_flight(const Run& run) const {
  for (int rank = 0; rank < transport_.size(); ++rank) {
    if (!watch_.is_lost(rank) && !run.given[static_cast<std::size_t>(rank)].empty()) return true;
  }
  return false;
}

void Pool::note_stop_signal() {
  if (find_stop_level() == 0 || terminate_called_) return;
  terminate_called_ = true;
  if (options_.on_terminate) options_.on_terminate();
}

void Pool::cancel_if_due(Run& run) {
  const bool is_told = find_stop_level() >= kStopCancel;
  const bool is_late = !is_told && options_.cancel_at && Clock::now() >= *options_.cancel_at;
  if (cancel_until_ || (!is_told && !is_late)) return;
  note_stop_signal();
  run.stop(is_late ? RunEnd::deadline : RunEnd::signal);
  if (options_.cancel_work) options_.cancel_work();
  send_all(Tag::cancel, "");
  cancel_until_ = Clock::now() + (is_late ? kLatePatience : kCancelPatience);
}

void Pool::wait(Run& run, Clock::time_point& next_tick) {
  note_stop_signal();
  if (Clock::now() >= next_tick) {
    if (options_.on_tick) options_.on_tick();
    watch_ranks(run);
    load_.measure(Clock::now());
    if (outstanding_[0] == 0) feed(run, 0);  // it may have time again
    next_tick = Clock::now() + kTickInterval;
  }
  thread_.wait_for_result(find_pause(run));
}

void Pool::watch_ranks(Run& run) {
  call_ranks();
  for (const int rank : watch_.find_lost(Clock::now())) lose(run, rank);
}

void Pool::call_ranks() {
  watch_.hear(0, goes_on());
  if (!watch_.is_time_to_call(Clock::now())) return;
  for (int rank = 1; rank < transport_.size(); ++rank) {
    if (!watch_.is_lost(rank) && !has_left(rank)) transport_.send(rank, Tag::call, "");
  }
}

// Whether the compute thread of this rank is idle or has gone on since the last question.
bool Pool::goes_on() {
  const std::pair<std::uint64_t, double> before = beat_;
  beat_ = {thread_.begun(), options_.find_beat ? options_.find_beat() : 0.0};
  return thread_.idle() || !options_.find_beat || beat_ != before;
}

void Pool::say_lost(int rank, std::size_t tasks) {
  if (!options_.on_lost) return;
  options_.on_lost({rank, watch_.silence_s(rank), watch_.answers(rank), tasks});
}

void Pool::lose(Run& run, int rank) {
  std::vector<std::size_t> tasks;
  tasks.swap(run.given[static_cast<std::size_t>(rank)]);
  outstanding_[static_cast<std::size_t>(rank)] = 0;
  if (rank == 0) thread_.drop_queued();
  say_lost(rank, tasks.size());
  for (const std::size_t index : tasks) {
    if (++run.losses[index] < kMostLosses) {
      run.returned.push_back(index);
      continue;
    }
    TaskResult result{run.number, index, {}, true, 0.0, rank, true};
    result.bytes = "three ranks in turn showed no sign of life with this task";
    answer(run, std::move(result));
  }
  for (int other = 0; other < transport_.size(); ++other) feed(run, other);
}

// Short against a task, or the work that is queued while there is more to hand out, so that an
// answered rank is not kept waiting; alone there is only the stop level to look at.
microseconds Pool::find_pause(const Run& run) const {
  if (is_alone()) return milliseconds(20);
  const bool is_fed = run.next < run.tasks.size();
  const double behind = is_fed ? static_cast<double>(find_depth(run) - 1) : 0.0;
  const double work_s = mean_seconds_ * std::max(behind / kPollsOfQueue, 1.0 / 50.0);
  const double seconds = std::clamp(work_s, 100e-6, behind > 0.0 ? 4e-3 : 2e-3);
  return microseconds(static_cast<int>(seconds * 1e6));
}

void Pool::send_all(Tag tag, const std::string& bytes) {
  for (int rank = 1; rank < transport_.size(); ++rank) {
    if (!watch_.is_lost(rank)) transport_.send(rank, tag, bytes);
  }
}

bool Pool::has_left(int rank) const {
  return left_[static_cast<std::size_t>(rank)];
}

bool Pool::have_all_left() {
  for (int rank = 1; rank < transport_.size(); ++rank) {
    if (!has_left(rank) && !watch_.is_lost(rank)) return false;
  }
  return watch_.lost_count() > 0 || transport_.all_sent();
}

// Drains what is still under way, so that nothing is left unreceived when MPI ends. Waits as long
// as tasks run that a run left behind, but not at kStopCancel.
bool Pool::collect_byes() {
  std::optional<Clock::time_point> until;
  watch_.restart(Clock::now());
  for (;;) {
    while (auto message = transport_.receive()) note_message(nullptr, std::move(*message));
    if (have_all_left() && (thread_.idle() || leaving_)) return true;
    while (thread_.pop()) continue;
    call_ranks();
    for (int rank = 1; rank < transport_.size(); ++rank) {
      if (has_left(rank)) watch_.hear(rank, true);
    }
    const std::vector<int> lost = watch_.find_lost(Clock::now());
    for (const int rank : lost) say_lost(rank, 0);
    if (!lost.empty()) return false;
    if (!until && (leaving_ || find_stop_level() >= kStopCancel)) until = Clock::now() + kHurry;
    if (until && Clock::now() >= *until) return false;
    std::this_thread::sleep_for(microseconds(200));
  }
}

bool Pool::close() {
  if (finished_) return closed_;
  finished_ = true;
  if (watch_.lost_count() > 0) return false;
  thread_.drop_queued();
  send_all(Tag::stop, "");
  closed_ = collect_byes();
  return closed_;
}

void Pool::leave_now(int code) {
  leaving_ = true;
  send_all(Tag::abandon, std::to_string(code));
  if (!collect_byes() || watch_.lost_count() > 0) transport_.abort_all(code);
  transport_.leave_now(code);
}

}  // namespace linkstudy

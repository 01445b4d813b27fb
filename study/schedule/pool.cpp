#include "study/schedule/pool.h"

#include <algorithm>
#include <cmath>
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
constexpr double queue_below_s = 10e-3;
// Work queued in front of a rank covers this much, some polls of both sides.
constexpr double queued_work_s = 1e-3;
constexpr double most_queued = 64.0;
constexpr milliseconds tick_interval{100};
// Taken in before ticks and signals are looked at again.
constexpr int most_messages = 256;
// For ranks to answer that they leave, when somebody is in a hurry.
constexpr milliseconds hurry{2000};

}  // namespace

struct Pool::Run {
  std::uint64_t number;
  std::vector<std::string> tasks;
  const OnResult& on_result;
  std::size_t next = 0;      // first task not handed out
  std::size_t answered = 0;  // results of this run
  bool stopping = false;     // hands out no more
  RunEnd reason = RunEnd::complete;
};

Pool::Pool(Transport& transport, Work work, PoolOptions options)
    : transport_(transport),
      options_(std::move(options)),
      thread_(std::move(work), transport.rank()),
      outstanding_(static_cast<std::size_t>(transport.size()), 0) {}

Pool::~Pool() {
  if (transport_.rank() == 0) finish();
}

int Pool::find_stop_level() const {
  return std::max(stop_level(), forwarded_level_);
}

RunOutcome Pool::run(std::vector<std::string> tasks, const OnResult& on_result) {
  if (transport_.rank() != 0) throw std::logic_error("only rank 0 runs tasks; the others serve");
  if (finished_) throw std::logic_error("the pool has ended");
  Run run{++run_number_, std::move(tasks), on_result};
  cancelled_ = false;
  auto next_tick = Clock::now() + tick_interval;
  collect(run);
  for (int rank = 0; rank < transport_.size(); ++rank) feed(run, rank);
  for (;;) {
    const bool active = collect(run);
    if (const auto end = find_end(run)) return {*end, run.answered};
    if (!active || Clock::now() >= next_tick) wait(next_tick);
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
  for (int i = 0; i < most_messages; ++i) {
    auto message = transport_.receive();
    if (!message) break;
    active = true;
    note_message(&run, std::move(*message));
  }
  return active;
}

void Pool::note_message(Run* run, Message message) {
  if (message.tag == Tag::bye) ++byes_;
  if (message.tag == Tag::signal)
    forwarded_level_ = std::max(forwarded_level_, std::stoi(message.bytes));
  if (message.tag == Tag::result && run)
    deliver(*run, unpack_result(std::move(message.bytes), message.from));
}

// Feeds the rank first, so that it computes while on_result writes. Late results of a run that
// ended with an exception are dropped.
void Pool::deliver(Run& run, TaskResult result) {
  const auto rank = static_cast<std::size_t>(result.rank);
  --outstanding_[rank];
  mean_seconds_ = mean_seconds_ < 0.0 ? result.seconds : 0.9 * mean_seconds_ + 0.1 * result.seconds;
  const bool current = result.run == run.number;
  if (current) ++run.answered;
  feed(run, result.rank);
  if (current) run.on_result(std::move(result));
}

void Pool::feed(Run& run, int rank) {
  note_stop_signal();
  if (find_stop_level() > 0) {
    run.stopping = true;
    run.reason = RunEnd::signal;
  } else if (!run.stopping && options_.deadline && Clock::now() >= *options_.deadline) {
    run.stopping = true;
    run.reason = RunEnd::deadline;
  } else if (!run.stopping && cancelled_) {
    run.stopping = true;
    run.reason = RunEnd::cancelled;
  }
  std::size_t& given = outstanding_[static_cast<std::size_t>(rank)];
  const std::size_t depth = find_depth(run);
  while (!run.stopping && given < depth && run.next < run.tasks.size()) {
    const std::size_t index = run.next++;
    Task task{run.number, index, std::move(run.tasks[index])};
    ++given;
    if (rank == 0)
      thread_.push(std::move(task));
    else
      transport_.send(rank, Tag::task, pack_task(std::move(task)));
  }
}

// One running task, and some queued when they are short and enough are left for every rank.
std::size_t Pool::find_depth(const Run& run) const {
  if (mean_seconds_ < 0.0 || mean_seconds_ > queue_below_s) return 1;
  const double wanted = std::ceil(queued_work_s / std::max(mean_seconds_, 1e-9));
  const std::size_t fair = (run.tasks.size() - run.next) / (2 * outstanding_.size());
  return 1 + std::min(static_cast<std::size_t>(std::min(wanted, most_queued)), fair);
}

std::optional<RunEnd> Pool::find_end(const Run& run) {
  if (run.answered == run.tasks.size()) return RunEnd::complete;
  if (find_stop_level() >= 2) {
    note_stop_signal();
    thread_.drop_queued();
    return RunEnd::abandoned;
  }
  if (run.stopping && run.answered == run.next) return run.reason;
  return std::nullopt;
}

void Pool::note_stop_signal() {
  if (find_stop_level() == 0 || terminate_called_) return;
  terminate_called_ = true;
  if (options_.on_terminate) options_.on_terminate();
}

void Pool::wait(Clock::time_point& next_tick) {
  note_stop_signal();
  if (Clock::now() >= next_tick) {
    if (options_.on_tick) options_.on_tick();
    next_tick = Clock::now() + tick_interval;
  }
  thread_.wait_for_result(find_pause());
}

// Short against a task, so that an answered rank is not kept waiting; alone there is only the stop
// level to look at.
microseconds Pool::find_pause() const {
  if (is_alone()) return milliseconds(20);
  const double seconds = std::clamp(mean_seconds_ / 50.0, 100e-6, 2e-3);
  return microseconds(static_cast<int>(seconds * 1e6));
}

void Pool::send_all(Tag tag, const std::string& bytes) {
  for (int rank = 1; rank < transport_.size(); ++rank) transport_.send(rank, tag, bytes);
}

// Drains what is still under way, so that nothing is left unreceived when MPI ends. Waits as long
// as tasks run that a run left behind, but not after a second signal.
bool Pool::collect_byes() {
  std::optional<Clock::time_point> until;
  for (;;) {
    while (auto message = transport_.receive()) note_message(nullptr, std::move(*message));
    const bool all_left = byes_ == transport_.size() - 1 && transport_.all_sent();
    if (all_left && (thread_.idle() || leaving_)) return true;
    while (thread_.pop()) continue;
    if (!until && (leaving_ || find_stop_level() >= 2)) until = Clock::now() + hurry;
    if (until && Clock::now() >= *until) return false;
    std::this_thread::sleep_for(microseconds(200));
  }
}

void Pool::finish() {
  if (finished_) return;
  thread_.drop_queued();
  send_all(Tag::stop, "");
  if (!collect_byes()) transport_.abort_all(exit_resumable);
  finished_ = true;
}

void Pool::leave_now(int code) {
  leaving_ = true;
  send_all(Tag::abandon, std::to_string(code));
  if (!collect_byes()) transport_.abort_all(code);
  transport_.leave_now(code);
}

}  // namespace linkstudy

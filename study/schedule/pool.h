// Tasks are pulled: whoever is idle gets the next one, so uneven durations balance by themselves.
//
//   Pool pool(transport, work, options);          every rank
//   if (transport.rank() != 0) pool.serve();      until rank 0 is done
//   else for (rounds) pool.run(tasks, on_result);
//   return transport.agree_exit_code(code);       after the pool is gone
//
// Rank 0 computes too, in a second thread; its main thread is the only one that talks to MPI, by
// polling and sleeping. Among 16 ranks or more it computes only while handing out leaves it the
// time (manager_load.h). A rank is given tasks in advance only while they are so short (below 10
// ms) that the way of a message counts. Results arrive in any order, each once, on the main thread.
//
// Stop signals (stop_signals.h) may reach any rank; rank 0 coordinates. Level kStopFinish waits for
// what is in flight; kStopCancel and the time cancel_at have every rank call cancel_work, and wait
// half a second (at cancel_at two) for the answers. Ranks that die end the job (mpi_session.h);
// until the rest is killed, about one second later, on_terminate has its chance. Ranks that freeze
// are lost (rank_watch.h): their tasks go to others, a task that three ranks were lost with fails,
// and the job then ends by leave_now, since MPI itself would wait for them.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "study/schedule/compute_thread.h"
#include "study/schedule/manager_load.h"
#include "study/schedule/rank_watch.h"
#include "study/schedule/stop_signals.h"
#include "study/schedule/task.h"
#include "study/schedule/transport.h"

namespace linkstudy {

struct LostRank {
  int rank = 0;
  double silence_s = 0.0;
  bool answers = false;   // its main thread does; the other one does not go on
  std::size_t tasks = 0;  // that go elsewhere
};

struct PoolOptions {
  bool first_computes = true;  // rank 0, where there are others
  // No work is handed out from then on.
  std::optional<std::chrono::steady_clock::time_point> deadline;
  // What is in flight then is cancelled.
  std::optional<std::chrono::steady_clock::time_point> cancel_at;
  // Every rank, main thread: tasks that run here, and those behind them, are to return soon.
  std::function<void()> cancel_work;
  // Every rank, main thread: a number that changes while a task goes on. Without it a task that
  // hangs is not told from one that is long.
  std::function<double()> find_beat;
  // Longest time of one task, s; 0: no limit (rank_watch.h).
  double task_limit_s = 0.0;
  // Rank 0, main thread, when a rank is lost.
  std::function<void(const LostRank&)> on_lost;
  // Called once, on rank 0's main thread, as soon as a stop signal is seen: sync the journal.
  std::function<void()> on_terminate;
  // Called on rank 0's main thread during run, about every 0.1 s: redraw, sync.
  std::function<void()> on_tick;
};

enum class RunEnd {
  complete,
  cancelled,  // Pool::cancel was called
  deadline,
  signal,
  abandoned,  // cancelled, and not all have answered: tasks may still be running, see leave_now
  no_rank,    // all are lost
};

struct RunOutcome {
  RunEnd end = RunEnd::complete;
  std::size_t done = 0;              // results delivered, failed ones included
  RunEnd reason = RunEnd::complete;  // of an abandoned run: deadline or signal

  // The caller writes what it has and exits with kExitResumable.
  bool interrupted() const { return end >= RunEnd::deadline; }
};

class Pool {
 public:
  using OnResult = std::function<void(TaskResult result)>;

  Pool(Transport& transport, Work work, PoolOptions options = {});
  // Rank 0: close(), and where that is in vain all ranks end with kExitResumable.
  ~Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  int ranks() const { return transport_.size(); }
  // Rank 0: tasks handed out and not answered.
  std::size_t in_flight() const {
    return std::accumulate(outstanding_.begin(), outstanding_.end(), std::size_t{0});
  }

  // Rank 0. Calls on_result once per task, in order of arrival, unless the run ends early. What
  // on_result throws ends the run and goes on to the caller; the pool stays usable.
  RunOutcome run(std::vector<std::string> tasks, const OnResult& on_result);

  // Rank 0, from on_result or on_tick: hand out no more of this run, wait for what is in flight.
  void cancel() { cancelled_ = true; }

  // Other ranks. Returns when rank 0 is done; after an abandoned run it exits with rank 0's code.
  void serve();

  // Rank 0: tells the others that there is no more work and waits until they have left serve and
  // tasks that a run left behind have ended; at kStopCancel no more than two seconds. False where
  // that does not come about or a rank was lost: then leave_now is the only way out.
  bool close();

  // Rank 0, after an abandoned run or a close in vain, with everything written: every rank exits
  // with this code without waiting for tasks that are still running.
  [[noreturn]] void leave_now(int code);

 private:
  struct Run;

  bool is_alone() const { return transport_.size() == 1; }
  int find_stop_level() const;
  bool collect(Run& run);
  void deliver(Run& run, TaskResult result);
  void feed(Run& run, int rank);
  std::size_t find_depth(const Run& run) const;
  bool gets_work(int rank) const;
  std::optional<std::size_t> next_task(Run& run) const;
  void answer(Run& run, TaskResult result);
  std::optional<RunEnd> find_end(const Run& run);
  bool is_in_flight(const Run& run) const;
  void note_stop_signal();
  void cancel_if_due(Run& run);
  void wait(Run& run, std::chrono::steady_clock::time_point& next_tick);
  void watch_ranks(Run& run);
  void call_ranks();
  void lose(Run& run, int rank);
  void say_lost(int rank, std::size_t tasks);
  bool goes_on();
  std::chrono::microseconds find_pause(const Run& run) const;
  void send_all(Tag tag, const std::string& bytes);
  void note_message(Run* run, Message message);
  bool has_left(int rank) const;
  bool have_all_left();
  bool collect_byes();

  void send_results();
  void take_orders(bool& stopped, bool& active);
  void forward_signals();
  void say_bye();
  [[noreturn]] void leave_worker(int code);

  Transport& transport_;
  PoolOptions options_;
  ComputeThread thread_;
  std::vector<std::size_t> outstanding_;  // tasks given to a rank and not answered, (size)
  std::uint64_t run_number_ = 0;
  double mean_seconds_ = -1.0;  // of recent tasks, negative until the first
  ManagerLoad load_;
  int forwarded_level_ = 0;  // highest stop level of the other ranks; on those: level passed on
  RankWatch watch_;
  std::vector<bool> left_;  // ranks that have said bye, (size)
  std::pair<std::uint64_t, double> beat_{0, 0.0};
  std::optional<std::chrono::steady_clock::time_point> cancel_until_;
  bool terminate_called_ = false;
  bool cancelled_ = false;
  bool finished_ = false;
  bool closed_ = false;
  bool leaving_ = false;
};

}  // namespace linkstudy

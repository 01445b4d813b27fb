// The thread of a rank that computes, while the main thread talks to the other ranks. Tasks queue
// in front of it, results queue behind it; the stop signals are left to the main thread.
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "study/schedule/task.h"

namespace linkstudy {

class ComputeThread {
 public:
  ComputeThread(Work work, int rank);
  // Drops what is queued and waits for the task that is running.
  ~ComputeThread();
  ComputeThread(const ComputeThread&) = delete;
  ComputeThread& operator=(const ComputeThread&) = delete;

  void push(Task task);
  std::optional<TaskResult> pop();
  // Returns early when a result is there to pop.
  void wait_for_result(std::chrono::microseconds at_most);
  void drop_queued();
  // Nothing queued, running or waiting to be popped.
  bool idle() const;
  // Tasks begun so far.
  std::uint64_t begun() const;

 private:
  void loop();
  TaskResult compute(Task task) const;

  const Work work_;
  const int rank_;
  mutable std::mutex mutex_;
  std::condition_variable task_there_;
  std::condition_variable result_there_;
  std::deque<Task> tasks_;
  std::deque<TaskResult> results_;
  std::uint64_t begun_ = 0;
  bool running_ = false;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace linkstudy

#include "study/schedule/compute_thread.h"

#include <pthread.h>

#include <csignal>
#include <exception>
#include <utility>

namespace linkstudy {

ComputeThread::ComputeThread(Work work, int rank) : work_(std::move(work)), rank_(rank) {
  // A thread starts with the mask of its maker: signals should wake the main thread, not this one.
  sigset_t all, before;
  sigfillset(&all);
  for (const int fault : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}) sigdelset(&all, fault);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  thread_ = std::thread([this] { loop(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

ComputeThread::~ComputeThread() {
  {
    const std::lock_guard lock(mutex_);
    tasks_.clear();
    ending_ = true;
  }
  task_there_.notify_one();
  thread_.join();
}

void ComputeThread::push(Task task) {
  {
    const std::lock_guard lock(mutex_);
    tasks_.push_back(std::move(task));
  }
  task_there_.notify_one();
}

std::optional<TaskResult> ComputeThread::pop() {
  const std::lock_guard lock(mutex_);
  if (results_.empty()) return std::nullopt;
  std::optional<TaskResult> result(std::move(results_.front()));
  results_.pop_front();
  return result;
}

void ComputeThread::wait_for_result(std::chrono::microseconds at_most) {
  std::unique_lock lock(mutex_);
  result_there_.wait_for(lock, at_most, [this] { return !results_.empty(); });
}

void ComputeThread::drop_queued() {
  const std::lock_guard lock(mutex_);
  tasks_.clear();
}

bool ComputeThread::idle() const {
  const std::lock_guard lock(mutex_);
  return tasks_.empty() && results_.empty() && !running_;
}

std::uint64_t ComputeThread::begun() const {
  const std::lock_guard lock(mutex_);
  return begun_;
}

void ComputeThread::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    task_there_.wait(lock, [this] { return ending_ || !tasks_.empty(); });
    if (ending_) return;
    Task task = std::move(tasks_.front());
    tasks_.pop_front();
    running_ = true;
    ++begun_;
    lock.unlock();
    TaskResult result = compute(std::move(task));
    lock.lock();
    running_ = false;
    results_.push_back(std::move(result));
    result_there_.notify_one();
  }
}

TaskResult ComputeThread::compute(Task task) const {
  using Clock = std::chrono::steady_clock;
  TaskResult result{task.run, task.index, {}, false, 0.0, rank_};
  const auto start = Clock::now();
  try {
    result.bytes = work_(task.bytes);
  } catch (const std::exception& error) {
    result.bytes = error.what();
    result.failed = true;
  } catch (...) {
    result.bytes = "something was thrown that is no std::exception";
    result.failed = true;
  }
  result.seconds = std::chrono::duration<double>(Clock::now() - start).count();
  return result;
}

}  // namespace linkstudy

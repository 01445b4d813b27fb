// One process, no MPI: what holds for any number of ranks is tested again in tests/mpi.
// Truth: the tasks themselves, answered by a function the test knows.
#include "study/schedule/pool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <set>
#include <stdexcept>
#include <thread>

#include "study/schedule/stop_signals.h"

namespace linkstudy::pool_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

std::vector<std::string> count_up(int count) {
  std::vector<std::string> tasks;
  for (int i = 0; i < count; ++i) tasks.push_back(std::to_string(i));
  return tasks;
}

std::string square(const std::string& task) {
  const long number = std::stol(task);
  return std::to_string(number * number);
}

class LocalPool : public ::testing::Test {
 protected:
  void SetUp() override { reset_stop(); }
  void TearDown() override { reset_stop(); }
  LocalTransport transport_;
};

TEST_F(LocalPool, Answers_every_task_once_with_its_own_result) {
  Pool pool(transport_, square);
  std::vector<int> seen(2000, 0);
  const auto outcome = pool.run(count_up(2000), [&](TaskResult result) {
    ++seen[result.index];
    EXPECT_EQ(result.bytes, std::to_string(result.index * result.index));
    EXPECT_FALSE(result.failed);
    EXPECT_EQ(result.rank, 0);
  });
  EXPECT_EQ(outcome.end, RunEnd::complete);
  EXPECT_EQ(outcome.done, 2000u);
  EXPECT_FALSE(outcome.interrupted());
  EXPECT_EQ(seen, std::vector<int>(2000, 1));
}

TEST_F(LocalPool, Computes_beside_the_thread_that_takes_the_results) {
  std::set<std::thread::id> computing, receiving;
  Pool pool(transport_, [&](const std::string& task) {
    computing.insert(std::this_thread::get_id());
    return task;
  });
  pool.run(count_up(20), [&](const TaskResult&) { receiving.insert(std::this_thread::get_id()); });
  EXPECT_EQ(computing.size(), 1u);
  EXPECT_EQ(receiving, std::set{std::this_thread::get_id()});
  EXPECT_EQ(computing.count(std::this_thread::get_id()), 0u);
}

TEST_F(LocalPool, Turns_whatever_work_throws_into_failed_results) {
  Pool pool(transport_, [](const std::string& task) -> std::string {
    if (task == "1") throw std::runtime_error("link 'crank' has no mass");
    if (task == "2") throw 42;
    return "fine";
  });
  std::vector<TaskResult> results(4);
  const auto outcome =
      pool.run(count_up(4), [&](TaskResult result) { results[result.index] = result; });
  EXPECT_EQ(outcome.end, RunEnd::complete);
  EXPECT_EQ(results[0].bytes, "fine");
  EXPECT_TRUE(results[1].failed);
  EXPECT_EQ(results[1].bytes, "link 'crank' has no mass");
  EXPECT_TRUE(results[2].failed);
  EXPECT_FALSE(results[2].bytes.empty());
  EXPECT_FALSE(results[3].failed);
}

TEST_F(LocalPool, Runs_again_and_again_and_also_nothing) {
  Pool pool(transport_, square);
  std::size_t answered = 0;
  for (int round = 0; round < 50; ++round)
    answered += pool.run(count_up(round % 4), [](const TaskResult&) {}).done;
  EXPECT_EQ(answered, 12u * (0 + 1 + 2 + 3) + 0 + 1);
}

TEST_F(LocalPool, Carries_any_bytes_of_any_length) {
  Pool pool(transport_, [](const std::string& task) { return task + task; });
  const std::vector<std::string> tasks = {"", std::string("\0\xff\n", 3),
                                          std::string(9'000'001, 'x')};
  pool.run(tasks, [&](TaskResult result) {
    EXPECT_TRUE(result.bytes == tasks[result.index] + tasks[result.index]);
  });
}

TEST_F(LocalPool, Passes_on_what_the_receiver_throws_and_forgets_that_run) {
  Pool pool(transport_, square);
  EXPECT_THROW(
      pool.run(count_up(500), [](const TaskResult&) { throw std::runtime_error("disk full"); }),
      std::runtime_error);
  std::vector<int> seen(300, 0);
  const auto outcome = pool.run(count_up(300), [&](const TaskResult& result) {
    ++seen[result.index];
    EXPECT_EQ(result.bytes, std::to_string(result.index * result.index));
  });
  EXPECT_EQ(outcome.done, 300u);
  EXPECT_EQ(seen, std::vector<int>(300, 1));
}

TEST_F(LocalPool, Hands_out_nothing_after_its_deadline) {
  PoolOptions options;
  options.deadline = steady_clock::now() + milliseconds(60);
  std::atomic<int> started = 0;
  Pool pool(
      transport_,
      [&](const std::string& task) {
        ++started;
        std::this_thread::sleep_for(milliseconds(15));
        return task;
      },
      options);
  const auto outcome = pool.run(count_up(1000), [](const TaskResult&) {});
  EXPECT_EQ(outcome.end, RunEnd::deadline);
  EXPECT_TRUE(outcome.interrupted());
  EXPECT_EQ(outcome.done, static_cast<std::size_t>(started));
  EXPECT_GE(outcome.done, 1u);
  EXPECT_LE(outcome.done, 5u);  // 60 ms hold four tasks; one more may have been under way
}

TEST_F(LocalPool, Stops_early_when_told_to_and_calls_that_no_interruption) {
  Pool pool(transport_, [](const std::string& task) {
    std::this_thread::sleep_for(milliseconds(1));
    return task;
  });
  std::size_t delivered = 0, handed_out = 0;
  const auto outcome = pool.run(count_up(1000), [&](const TaskResult&) {
    if (++delivered != 10) return;
    pool.cancel();
    handed_out = delivered + pool.in_flight();
  });
  EXPECT_EQ(outcome.end, RunEnd::cancelled);
  EXPECT_FALSE(outcome.interrupted());
  EXPECT_EQ(outcome.done, delivered);
  EXPECT_EQ(delivered, handed_out);
  EXPECT_LE(handed_out, 10u + 1u + 16u);  // tasks of 1 ms at least: 16 ms of them are queued
  EXPECT_EQ(pool.run(count_up(5), [](const TaskResult&) {}).done, 5u);
}

class SignalledPool : public LocalPool, public ::testing::WithParamInterface<int> {};

TEST_P(SignalledPool, Waits_for_the_running_task_and_ends_interrupted) {
  const StopSignals signals;
  int terminated = 0;
  PoolOptions options;
  options.on_terminate = [&] { ++terminated; };
  std::atomic<int> started = 0;
  Pool pool(
      transport_,
      [&](const std::string& task) {
        if (++started == 3) kill(getpid(), GetParam());
        std::this_thread::sleep_for(milliseconds(30));
        return task;
      },
      options);
  std::size_t delivered = 0;
  const auto outcome = pool.run(count_up(100), [&](const TaskResult&) { ++delivered; });
  EXPECT_EQ(outcome.end, RunEnd::signal);
  EXPECT_TRUE(outcome.interrupted());
  EXPECT_EQ(outcome.done, 3u);
  EXPECT_EQ(delivered, 3u);
  EXPECT_EQ(started, 3);
  EXPECT_EQ(terminated, 1);
  EXPECT_EQ(last_stop_signal(), GetParam());
  EXPECT_EQ(pool.run(count_up(5), [](const TaskResult&) {}).done, 0u);
}

INSTANTIATE_TEST_SUITE_P(Each, SignalledPool, ::testing::Values(SIGUSR1, SIGINT));

// Work that ends within a millisecond of being told to, and else takes minutes.
class Interruptible {
 public:
  explicit Interruptible(PoolOptions& options) {
    options.cancel_work = [this] { cancelled_ = true; };
  }
  std::string operator()() const {
    const auto give_up = steady_clock::now() + std::chrono::minutes(5);
    while (!cancelled_ && steady_clock::now() < give_up) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return cancelled_ ? "cancelled" : "whole";
  }

 private:
  std::atomic<bool> cancelled_ = false;
};

class CancellingPool : public LocalPool, public ::testing::WithParamInterface<int> {};

TEST_P(CancellingPool, Cancels_the_running_task_and_ends_interrupted) {
  const StopSignals signals;
  PoolOptions options;
  int terminated = 0;
  options.on_terminate = [&] { ++terminated; };
  const Interruptible wait_long(options);
  Pool pool(
      transport_,
      [&](const std::string&) {
        kill(getpid(), GetParam());
        return wait_long();
      },
      options);
  std::vector<std::string> answers;
  const auto outcome =
      pool.run(count_up(10), [&](const TaskResult& result) { answers.push_back(result.bytes); });
  EXPECT_EQ(outcome.end, RunEnd::signal);
  EXPECT_EQ(answers, std::vector<std::string>{"cancelled"});
  EXPECT_EQ(terminated, 1);
  EXPECT_TRUE(pool.close());
}

INSTANTIATE_TEST_SUITE_P(Each, CancellingPool, ::testing::Values(SIGTERM, SIGHUP, SIGUSR2));

TEST_F(LocalPool, Cancels_what_is_in_flight_at_the_end_of_its_time) {
  PoolOptions options;
  options.cancel_at = steady_clock::now() + milliseconds(100);
  const Interruptible wait_long(options);
  Pool pool(
      transport_, [&](const std::string&) { return wait_long(); }, options);
  const auto outcome = pool.run(
      count_up(10), [](const TaskResult& result) { EXPECT_EQ(result.bytes, "cancelled"); });
  EXPECT_EQ(outcome.end, RunEnd::deadline);
  EXPECT_TRUE(outcome.interrupted());
  EXPECT_EQ(outcome.done, 1u);
}

TEST_F(LocalPool, Is_complete_when_a_signal_comes_during_its_last_task) {
  const StopSignals signals;
  Pool pool(transport_, [](const std::string& task) {
    kill(getpid(), SIGUSR1);
    return task;
  });
  EXPECT_EQ(pool.run(count_up(1), [](const TaskResult&) {}).end, RunEnd::complete);
}

TEST_F(LocalPool, Returns_at_once_on_a_second_signal_and_exits_past_the_running_task) {
  const auto study = [this] {
    const StopSignals signals;
    Pool pool(transport_, [](const std::string& task) {
      if (task == "1") {
        kill(getpid(), SIGTERM);
        std::this_thread::sleep_for(milliseconds(200));
        kill(getpid(), SIGTERM);
        std::this_thread::sleep_for(std::chrono::minutes(5));
      }
      return task;
    });
    const auto outcome = pool.run(count_up(10), [](const TaskResult&) {});
    if (outcome.end != RunEnd::abandoned || outcome.done != 1) _exit(1);
    pool.leave_now(kExitResumable);
  };
  const auto start = steady_clock::now();
  EXPECT_EXIT(study(), ::testing::ExitedWithCode(75), "");
  EXPECT_LT(steady_clock::now() - start, std::chrono::seconds(60));
}

TEST_F(LocalPool, Ticks_while_a_long_task_runs) {
  int ticks = 0;
  PoolOptions options;
  options.on_tick = [&] { ++ticks; };
  Pool pool(
      transport_,
      [](const std::string& task) {
        std::this_thread::sleep_for(milliseconds(550));
        return task;
      },
      options);
  pool.run(count_up(1), [](const TaskResult&) {});
  EXPECT_GE(ticks, 2);
  EXPECT_LE(ticks, 5);
}

TEST_F(LocalPool, Takes_a_million_tasks_without_quadratic_time) {
  Pool pool(transport_, [](const std::string& task) { return task; });
  std::size_t sum = 0;
  const auto outcome = pool.run(std::vector<std::string>(1'000'000, "x"),
                                [&](const TaskResult& result) { sum += result.index; });
  EXPECT_EQ(outcome.done, 1'000'000u);
  EXPECT_EQ(sum, 499'999'500'000u);
}

TEST_F(LocalPool, Serves_nobody) {
  Pool pool(transport_, square);
  EXPECT_THROW(pool.serve(), std::logic_error);
}

}  // namespace
}  // namespace linkstudy::pool_test

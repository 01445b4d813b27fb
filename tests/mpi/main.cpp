// The pool over real processes. Run as  mpirun -n N test_mpi CHECK ; every check is a sentence that
// rank 0 holds or prints why not. Exit code: that of agree_exit_code, the same on every rank.
#include <fmt/core.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "study/schedule/launcher.h"
#include "study/schedule/pool.h"
#include "study/schedule/stop_signals.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

class Failure : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

void expect(bool holds, const std::string& sentence) {
  if (!holds) throw Failure("does not hold: " + sentence);
}

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Every rank makes the pool; rank 0 goes through the check, the others serve.
void with_pool(Transport& transport, const Work& work, const PoolOptions& options,
               const std::function<void(Pool&)>& check) {
  Pool pool(transport, work, options);
  if (transport.rank() == 0)
    check(pool);
  else
    pool.serve();
}

std::vector<std::string> count_up(std::size_t count) {
  std::vector<std::string> tasks;
  for (std::size_t i = 0; i < count; ++i) tasks.push_back(std::to_string(i));
  return tasks;
}

// Bytes that depend on the task in every place, of a length that differs by task.
std::string expand(const std::string& task) {
  const auto number = static_cast<std::size_t>(std::stoul(task));
  std::string bytes(number % 311, '\0');
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<char>(number * 31 + i * 7);
  return task + ':' + bytes;
}

void answers_every_task_once_with_the_right_bytes(Transport& transport) {
  with_pool(transport, expand, {}, [&](Pool& pool) {
    for (const std::size_t count : {0u, 1u, 2u, 5u, 5000u}) {
      std::vector<int> seen(count, 0);
      const auto outcome = pool.run(count_up(count), [&](const TaskResult& result) {
        ++seen.at(result.index);
        expect(result.bytes == expand(std::to_string(result.index)), "bytes are those of the task");
        expect(result.rank >= 0 && result.rank < transport.size(), "the rank exists");
      });
      expect(outcome.end == RunEnd::complete && outcome.done == count, "the run is complete");
      expect(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }),
             "each task is answered once");
    }
  });
}

// One rank is held up by a long task in the first place. A static split would leave it a share of
// the short ones; a pull gives them to the others, who are done before the long one ends.
void gives_short_tasks_to_whoever_is_idle(Transport& transport) {
  const Work work = [](const std::string& task) {
    std::this_thread::sleep_for(milliseconds(task == "0" ? 600 : 2));
    return task;
  };
  with_pool(transport, work, {}, [&](Pool& pool) {
    std::map<int, int> shares;
    int rank_of_long = -1;
    const auto start = Clock::now();
    const auto size = static_cast<std::size_t>(transport.size());
    const std::size_t count = 60 * size;
    pool.run(count_up(count), [&](const TaskResult& result) {
      ++shares[result.rank];
      if (result.index == 0) rank_of_long = result.rank;
    });
    expect(rank_of_long >= 0 && shares.size() == size, "every rank computes");
    if (size == 1) return;
    expect(shares[rank_of_long] <= 3, "the rank with the long task gets no share of the rest");
    // Dealt out beforehand, it would take 600 ms and then 59 tasks of 2 ms.
    expect(seconds_since(start) < 0.6 + 0.5 * 59 * 2e-3, "nobody waits behind the long task");
  });
}

// Durations from 0 to 12 ms; what is lost at the end is at most about one task.
void balances_uneven_durations(Transport& transport) {
  const Work work = [](const std::string& task) {
    const auto number = std::stoul(task);
    std::this_thread::sleep_for(milliseconds(number * 7919 % 13));
    return task;
  };
  with_pool(transport, work, {}, [&](Pool& pool) {
    std::vector<double> busy(static_cast<std::size_t>(transport.size()), 0.0);
    const auto start = Clock::now();
    pool.run(count_up(300), [&](const TaskResult& result) {
      busy[static_cast<std::size_t>(result.rank)] += result.seconds;
    });
    const double wall = seconds_since(start);
    const double total = std::accumulate(busy.begin(), busy.end(), 0.0);
    const double efficiency = total / wall / transport.size();
    // Tasks sleep, so this holds however few processors there are; 25 % is room for their load.
    expect(efficiency > 0.75, fmt::format("ranks are busy {:.0f} % of the time", 100 * efficiency));
  });
}

void turns_exceptions_into_failed_results(Transport& transport) {
  const Work work = [](const std::string& task) -> std::string {
    const auto number = std::stoul(task);
    if (number % 3 == 1) throw std::runtime_error("no start for case " + task);
    if (number % 3 == 2) throw number;
    return task;
  };
  with_pool(transport, work, {}, [&](Pool& pool) {
    const auto outcome = pool.run(count_up(300), [&](const TaskResult& result) {
      const auto text = std::to_string(result.index);
      expect(result.failed == (result.index % 3 != 0), "exactly the tasks that throw fail");
      if (result.index % 3 == 0) expect(result.bytes == text, "the others answer");
      if (result.index % 3 == 1)
        expect(result.bytes == "no start for case " + text, "text is kept");
    });
    expect(outcome.done == 300, "the run goes on");
  });
}

void runs_many_rounds(Transport& transport) {
  with_pool(transport, expand, {}, [&](Pool& pool) {
    for (std::size_t round = 0; round < 200; ++round) {
      std::size_t sum = 0;
      pool.run(count_up(round % 9), [&](const TaskResult& result) {
        expect(result.bytes == expand(std::to_string(result.index)), "no round answers another");
        sum += result.index + 1;
      });
      const std::size_t n = round % 9;
      expect(sum == n * (n + 1) / 2, "each round answers its own tasks");
    }
  });
}

void forgets_a_run_that_the_receiver_broke_off(Transport& transport) {
  with_pool(transport, expand, {}, [&](Pool& pool) {
    for (int round = 0; round < 20; ++round) {
      bool thrown = false;
      try {
        pool.run(count_up(500), [](const TaskResult& result) {
          if (result.index > 40) throw std::runtime_error("disk full");
        });
      } catch (const std::runtime_error&) {
        thrown = true;
      }
      expect(thrown, "the exception comes through");
      std::vector<int> seen(100, 0);
      pool.run(count_up(100), [&](const TaskResult& result) { ++seen.at(result.index); });
      expect(seen == std::vector<int>(100, 1), "the next run sees its own results only");
    }
  });
}

void carries_megabytes_both_ways(Transport& transport) {
  const Work work = [](const std::string& task) {
    return std::string(task.rbegin(), task.rend()) + task;
  };
  with_pool(transport, work, {}, [&](Pool& pool) {
    std::vector<std::string> tasks;
    for (std::size_t i = 0; i < 24; ++i) {
      tasks.emplace_back(1'000'003 + 4099 * i, static_cast<char>('a' + i));
      tasks.back()[i] = '!';
    }
    std::size_t answered = 0;
    pool.run(tasks, [&](const TaskResult& result) {
      expect(result.bytes == work(tasks[result.index]), "every byte arrives");
      ++answered;
    });
    expect(answered == tasks.size(), "every message arrives");
  });
}

void broadcasts_and_agrees(Transport& transport) {
  for (const std::size_t length : {0u, 1u, 5'000'000u}) {
    std::string bytes = transport.rank() == 0 ? std::string(length, 'q') : "something else";
    transport.broadcast(bytes);
    expect(bytes == std::string(length, 'q'), "every rank has the bytes of rank 0");
  }
  const int last = transport.size() - 1;
  expect(transport.agree_exit_code(transport.rank() == last ? 3 : 0) == 3,
         "one code counts for all");
  expect(transport.agree_exit_code(0) == 0, "no code is made up");
  expect(transport.nodes() == 1 && !transport.host().empty(), "the ranks know their node");
}

void stops_handing_out_at_the_deadline(Transport& transport) {
  PoolOptions options;
  options.deadline = Clock::now() + milliseconds(150);
  const Work work = [](const std::string& task) {
    std::this_thread::sleep_for(milliseconds(20));
    return task;
  };
  with_pool(transport, work, options, [&](Pool& pool) {
    const auto outcome = pool.run(count_up(10'000), [](const TaskResult&) {});
    expect(outcome.end == RunEnd::deadline && outcome.interrupted(),
           "the run ends at its deadline");
    expect(outcome.done <= 9u * static_cast<std::size_t>(transport.size()),
           "little is started late");
  });
}

int run_checks(Transport& transport) {
  const std::pair<const char*, void (*)(Transport&)> checks[] = {
      {"answers every task once with the right bytes",
       answers_every_task_once_with_the_right_bytes},
      {"gives short tasks to whoever is idle", gives_short_tasks_to_whoever_is_idle},
      {"balances uneven durations", balances_uneven_durations},
      {"turns exceptions into failed results", turns_exceptions_into_failed_results},
      {"runs many rounds", runs_many_rounds},
      {"forgets a run that the receiver broke off", forgets_a_run_that_the_receiver_broke_off},
      {"carries megabytes both ways", carries_megabytes_both_ways},
      {"broadcasts and agrees", broadcasts_and_agrees},
      {"stops handing out at the deadline", stops_handing_out_at_the_deadline},
  };
  int failures = 0;
  for (const auto& [sentence, check] : checks) {
    int failed = 0;
    try {
      check(transport);
    } catch (const std::exception& error) {
      failed = 1;
      fmt::print(stderr, "rank {}: {}: {}\n", transport.rank(), sentence, error.what());
    }
    failed = transport.agree_exit_code(failed);
    failures += failed;
    if (transport.rank() == 0) fmt::print("{} {}\n", failed ? "FAILED" : "ok    ", sentence);
  }
  return failures == 0 ? 0 : 1;
}

void touch(const std::string& path) {
  std::ofstream(path) << "x";
}

// A study of 20 ms tasks that is stopped. TARGET: the rank that sends itself SIGNAL in its fifth
// task, or -1 when a signal comes from outside; MARKER is written when work is under way, and
// MARKER.synced where a journal would be synced.
int run_until_stopped(Transport& transport, int target, int signal, const std::string& marker) {
  int terminated = 0, tasks_here = 0;
  std::vector<int> seen(100'000, 0);
  PoolOptions options;
  options.on_terminate = [&] {
    ++terminated;
    touch(marker + ".synced");
  };
  const Work work = [&](const std::string& task) {
    if (++tasks_here == 5 && target == transport.rank()) kill(getpid(), signal);
    std::this_thread::sleep_for(milliseconds(20));
    return task;
  };
  int code = 0;
  with_pool(transport, work, options, [&](Pool& pool) {
    std::size_t highest = 0;
    const auto outcome = pool.run(count_up(seen.size()), [&](const TaskResult& result) {
      ++seen[result.index];
      highest = std::max<std::size_t>(highest, result.index);
      if (result.index == 20) touch(marker);
    });
    const auto answered = std::accumulate(seen.begin(), seen.end(), std::size_t{0});
    expect(outcome.end == RunEnd::signal, "the run ends by a signal");
    expect(terminated == 1, "the journal is synced once");
    // Nothing was lost between hand-out and answer: ids are given in order, so they have no gap.
    expect(outcome.done == answered && answered == highest + 1, "all that was begun is answered");
    expect(*std::max_element(seen.begin(), seen.end()) == 1, "nothing is answered twice");
    code = outcome.interrupted() ? kExitResumable : 1;
  });
  return transport.agree_exit_code(code);
}

// Every rank computes for minutes; the second signal must not wait for that.
int run_until_abandoned(Transport& transport, const std::string& marker) {
  const Work work = [&](const std::string& task) {
    if (task != "0") std::this_thread::sleep_for(std::chrono::minutes(5));
    return std::string(3'000'000, 'r');
  };
  Pool pool(transport, work);
  if (transport.rank() != 0) {
    pool.serve();
    return 1;  // never reached: the rank has left
  }
  const auto size = static_cast<std::size_t>(transport.size());
  const auto outcome = pool.run(count_up(3 * size), [&](const TaskResult&) { touch(marker); });
  expect(outcome.end == RunEnd::abandoned && outcome.done == 1, "it returns with what has arrived");
  pool.leave_now(kExitResumable);
}

// Tasks of minutes that end when told to: the signal must reach every rank, and nothing else is
// waited for.
int run_until_cancelled(Transport& transport, const std::string& marker) {
  std::atomic<bool> cancelled = false;
  PoolOptions options;
  options.cancel_work = [&] { cancelled = true; };
  const Work work = [&](const std::string& task) {
    const auto start = Clock::now();
    while (task != "0" && !cancelled && seconds_since(start) < 300.0) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return std::string(cancelled ? "cancelled" : "whole");
  };
  const auto size = static_cast<std::size_t>(transport.size());
  with_pool(transport, work, options, [&](Pool& pool) {
    std::map<int, int> cancelled_tasks;  // by rank
    const auto outcome = pool.run(count_up(1000 * size), [&](const TaskResult& result) {
      if (result.index == 0) return touch(marker);
      expect(result.bytes == "cancelled", "no task is waited for");
      ++cancelled_tasks[result.rank];
    });
    expect(outcome.end == RunEnd::signal, "the run ends by a signal");
    expect(cancelled_tasks.size() == size, "every rank has answered");
  });
  return transport.agree_exit_code(kExitResumable);
}

// Prints throughput; no test, because times are no truth.
int measure(Transport& transport) {
  const auto spin = [](double seconds) {
    const auto start = Clock::now();
    while (seconds_since(start) < seconds) continue;
  };
  const Work work = [&](const std::string& task) {
    if (task == "sleep") std::this_thread::sleep_for(milliseconds(2));
    if (task == "spin") spin(2e-3);
    return task;
  };
  with_pool(transport, work, {}, [&](Pool& pool) {
    for (const auto& [task, count] : {std::pair{"", 200'000}, {"sleep", 2000}, {"spin", 2000}}) {
      double busy = 0.0;
      const auto start = Clock::now();
      pool.run(std::vector<std::string>(static_cast<std::size_t>(count), task),
               [&](const TaskResult& result) { busy += result.seconds; });
      const double wall = seconds_since(start);
      fmt::print("{} ranks, tasks '{}': {:.0f} tasks/s, ranks in work {:.1f} % of the time\n",
                 transport.size(), task, count / wall, 100.0 * busy / wall / transport.size());
    }
  });
  return transport.agree_exit_code(0);
}

int run_command(Transport& transport, const std::vector<std::string>& words) {
  if (words.size() == 1 && words[0] == "checks") return run_checks(transport);
  if (words.size() == 1 && words[0] == "measure") return measure(transport);
  if (words.size() == 4 && words[0] == "stop")
    return run_until_stopped(transport, std::stoi(words[1]), std::stoi(words[2]), words[3]);
  if (words.size() == 2 && words[0] == "abandon") return run_until_abandoned(transport, words[1]);
  if (words.size() == 2 && words[0] == "cancel") return run_until_cancelled(transport, words[1]);
  fmt::print(stderr,
             "usage: test_mpi checks | measure | stop RANK SIGNAL MARKER | abandon MARKER | "
             "cancel MARKER\n");
  return 2;
}

}  // namespace
}  // namespace linkstudy

int main(int argc, char** argv) {
  using namespace linkstudy;
  const StopSignals signals;
  try {
    const auto transport = make_transport();
    try {
      return run_command(*transport, {argv + 1, argv + argc});
    } catch (const std::exception& error) {
      fmt::print(stderr, "rank {}: {}\n", transport->rank(), error.what());
      return transport->agree_exit_code(1);
    }
  } catch (const LaunchError& error) {
    if (error.is_first()) fmt::print(stderr, "error: {}\n", error.what());
    return 2;
  }
}

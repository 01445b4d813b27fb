// What handing out tasks costs: tasks of no length, and of one millisecond, over the pool's own
// messages. Run as  mpirun -n N bench_dispatch ; rank 0 prints a row a measurement:
//   tasks/s of empty tasks; busy: the part of its time that rank 0's main thread computes
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "study/plan/pull_schedule.h"
#include "study/schedule/pool.h"
#include "study/schedule/stop_signals.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

struct Measured {
  double wall_s = 0.0;
  double busy_s = 0.0;  // CPU of this thread
};

double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Measured run(Pool& pool, std::size_t count, const std::string& task) {
  const auto begin = Clock::now();
  const double cpu = thread_cpu_s();
  std::size_t taken = 0;
  pool.run(std::vector<std::string>(count, task), [&](const TaskResult&) { ++taken; });
  const std::chrono::duration<double> wall = Clock::now() - begin;
  if (taken != count) throw std::logic_error("results are missing");
  return {wall.count(), thread_cpu_s() - cpu};
}

std::string sleep_for(const std::string& task) {
  const int microseconds = std::stoi(task);
  if (microseconds > 0) std::this_thread::sleep_for(std::chrono::microseconds(microseconds));
  return {};
}

// Tasks of a second, ten for each rank, through a manager that takes so long for each.
void print_reach(double service_s) {
  for (const int ranks : {100, 1000, 10000, 100000}) {
    const std::vector<double> tasks(static_cast<std::size_t>(ranks) * 10, 1.0);
    const plan::PullEnd end = plan::pull(tasks, ranks, service_s);
    fmt::print("simulated: {:>6} ranks, tasks of 1 s: ranks {:.1f} % busy, manager {:.1f} %\n",
               ranks, 100.0 * end.busy,
               100.0 * service_s * static_cast<double>(tasks.size()) / end.wall_s);
  }
}

double median(std::vector<double> all) {
  std::ranges::sort(all);
  return all.at(all.size() / 2);
}

// The time of the manager for each empty task.
double print_empty(Pool& pool, const char* who) {
  constexpr std::size_t kCount = 200000;
  run(pool, 1000, "0");  // mean time of a task, connections
  std::vector<double> rates, each_s;
  for (int i = 0; i < 5; ++i) {
    const Measured empty = run(pool, kCount, "0");
    rates.push_back(kCount / empty.wall_s);
    each_s.push_back(empty.busy_s / kCount);
  }
  fmt::print("empty tasks, {}: {:.0f} tasks/s, {:.2f} us of the manager for each\n", who,
             median(rates), 1e6 * median(each_s));
  return median(each_s);
}

void print_millisecond(Pool& pool, int workers) {
  const std::size_t count = 2000 * static_cast<std::size_t>(workers);
  const Measured one = run(pool, count, "1000");
  fmt::print("tasks of 1 ms: {:.0f} tasks/s, ranks {:.1f} % busy, manager {:.2f} % busy\n",
             static_cast<double>(count) / one.wall_s,
             100.0 * 1e-3 * static_cast<double>(count) / (one.wall_s * workers),
             100.0 * one.busy_s / one.wall_s);
}

// The others alone, and all.
template <class Lead>
void with_pool(Transport& transport, bool first_computes, const Lead& lead) {
  PoolOptions options;
  options.first_computes = first_computes;
  Pool pool(transport, sleep_for, options);
  if (transport.rank() == 0)
    lead(pool);
  else
    pool.serve();
}

int run_bench() {
  const auto transport = make_transport();
  const int ranks = transport->size();
  with_pool(*transport, true, [&](Pool& pool) {
    print_empty(pool, "rank 0 computes too");
    print_millisecond(pool, ranks);
  });
  if (ranks > 1) {
    with_pool(*transport, false, [&](Pool& pool) {
      const double service_s = print_empty(pool, "the others alone");
      print_millisecond(pool, ranks - 1);
      print_reach(service_s);
    });
  }
  return transport->agree_exit_code(0);
}

}  // namespace
}  // namespace linkstudy

int main() {
  const linkstudy::StopSignals signals;
  return linkstudy::run_bench();
}

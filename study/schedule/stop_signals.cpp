#include "study/schedule/stop_signals.h"

#include <csignal>
#include <ctime>

#include <atomic>
#include <cerrno>
#include <cstdint>

namespace linkstudy {
namespace {

constexpr std::int64_t kOnePressNs = 100'000'000;

// Between SIGCONT and SIGTERM lies mpirun's odls_base_sigkill_timeout, by default one second.
constexpr std::int64_t kEndingNs = 15'000'000'000;
constexpr std::int64_t kLongAgoNs = -kEndingNs;

std::atomic<int> level{0};
std::atomic<int> last_signal{0};
std::atomic<std::int64_t> last_time_ns{kLongAgoNs};
std::atomic<std::int64_t> continue_time_ns{kLongAgoNs};
std::atomic<bool> dying{false};
static_assert(std::atomic<int>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free);

// Only calls that are allowed in a signal handler: lock-free atomics and clock_gettime.
std::int64_t find_time_ns() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec;
}

void note_continue(int) {
  const int saved = errno;
  continue_time_ns.store(find_time_ns());
  errno = saved;
}

void raise_level(int least) {
  for (int now = level.load(); now < least && !level.compare_exchange_weak(now, least);) continue;
}

bool cancels(int number) {
  return number == SIGTERM || number == SIGHUP || number == SIGUSR2;
}

void count_signal(int number) {
  const int saved = errno;
  const std::int64_t now_ns = find_time_ns();
  const std::int64_t before = last_time_ns.exchange(now_ns);
  if (cancels(number)) {
    raise_level(kStopCancel);
  } else if (level.load() == 0 || now_ns - before >= kOnePressNs) {
    raise_level(level.load() + 1);
  }
  if (number == SIGTERM && now_ns - continue_time_ns.load() < kEndingNs) dying.store(true);
  last_signal.store(number);
  errno = saved;
}

bool is_ignored(int number) {
  struct sigaction present {};
  sigaction(number, nullptr, &present);
  return present.sa_handler == SIG_IGN;
}

}  // namespace

StopSignals::StopSignals() {
  reset_stop();
  struct sigaction action {};
  action.sa_handler = count_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  constexpr int stops[] = {SIGTERM, SIGHUP, SIGINT, SIGUSR1, SIGUSR2};
  for (const int number : stops) sigaddset(&action.sa_mask, number);
  for (const int number : stops) {
    if (number != SIGHUP || !is_ignored(SIGHUP)) sigaction(number, &action, nullptr);
  }
  action.sa_handler = note_continue;
  sigaction(SIGCONT, &action, nullptr);
}

int stop_level() {
  return level.load();
}

bool job_is_dying() {
  return dying.load();
}

int last_stop_signal() {
  return last_signal.load();
}

void request_stop() {
  raise_level(level.load() + 1);
}

void reset_stop() {
  level.store(0);
  last_signal.store(0);
  last_time_ns.store(kLongAgoNs);
  continue_time_ns.store(kLongAgoNs);
  dying.store(false);
}

}  // namespace linkstudy

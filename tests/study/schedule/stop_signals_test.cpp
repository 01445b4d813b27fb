#include "study/schedule/stop_signals.h"

#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

namespace linkstudy::stop_signals_test {
namespace {

TEST(Stop_signals, Raise_the_level_instead_of_killing) {
  for (const int number : {SIGUSR1, SIGINT}) {
    const StopSignals signals;
    EXPECT_EQ(stop_level(), 0);
    raise(number);
    EXPECT_EQ(stop_level(), kStopFinish);
    EXPECT_EQ(last_stop_signal(), number);
  }
  reset_stop();
}

TEST(Stop_signals, That_a_kill_follows_cancel_at_once) {
  for (const int number : {SIGTERM, SIGHUP, SIGUSR2}) {
    const StopSignals signals;
    raise(number);
    EXPECT_EQ(stop_level(), kStopCancel);
    raise(number);
    EXPECT_EQ(stop_level(), kStopCancel);
    EXPECT_EQ(last_stop_signal(), number);
  }
  reset_stop();
}

TEST(Stop_signals, Of_a_lost_terminal_stay_ignored_under_nohup) {
  const auto before = signal(SIGHUP, SIG_IGN);
  const StopSignals signals;
  raise(SIGHUP);
  EXPECT_EQ(stop_level(), 0);
  signal(SIGHUP, before);
}

TEST(Stop_signals, Passed_on_by_several_senders_at_once_count_once) {
  const StopSignals signals;
  raise(SIGINT);
  raise(SIGUSR1);
  raise(SIGINT);
  EXPECT_EQ(stop_level(), 1);
  std::this_thread::sleep_for(std::chrono::milliseconds(150));
  raise(SIGINT);
  EXPECT_EQ(stop_level(), 2);
  reset_stop();
}

TEST(Stop_signals, Leave_a_continue_signal_harmless) {
  const StopSignals signals;
  raise(SIGCONT);
  EXPECT_EQ(stop_level(), 0);
  EXPECT_FALSE(job_is_dying());
}

TEST(Stop_signals, Tell_a_dying_job_by_the_continue_signal_ahead_of_the_end) {
  const StopSignals signals;
  raise(SIGTERM);
  EXPECT_FALSE(job_is_dying());
  raise(SIGCONT);
  raise(SIGUSR1);
  EXPECT_FALSE(job_is_dying());
  raise(SIGTERM);
  EXPECT_TRUE(job_is_dying());
  reset_stop();
}

TEST(Stop_requests, Count_like_signals) {
  reset_stop();
  request_stop();
  EXPECT_EQ(stop_level(), 1);
  request_stop();
  EXPECT_EQ(stop_level(), 2);
  reset_stop();
  EXPECT_EQ(stop_level(), 0);
}

}  // namespace
}  // namespace linkstudy::stop_signals_test

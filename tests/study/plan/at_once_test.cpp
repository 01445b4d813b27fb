#include "study/plan/at_once.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <set>
#include <stdexcept>
#include <thread>

namespace linkstudy::plan::at_once_test {
namespace {

using Clock = std::chrono::steady_clock;

TEST(AtOnce, Every_process_measures_by_itself_and_leaves_nothing_here) {
  int changed = 0;
  const std::vector<double> values = measure_at_once(3, [&] {
    ++changed;
    return static_cast<double>(getpid());
  });
  const std::set<double> processes(values.begin(), values.end());
  EXPECT_EQ(processes.size(), 3u);
  EXPECT_EQ(processes.count(static_cast<double>(getpid())), 0u);
  EXPECT_EQ(changed, 0);
}

// Three that wait for 0.4 s each, one after the other, would take 1.2 s.
TEST(AtOnce, Processes_run_at_the_same_time) {
  const auto begin = Clock::now();
  measure_at_once(3, [] {
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    return 1.0;
  });
  EXPECT_LT(Clock::now() - begin, std::chrono::milliseconds(1100));
}

TEST(AtOnce, What_fails_has_no_value_and_ends_nothing) {
  EXPECT_THAT(measure_at_once(2, []() -> double { throw std::runtime_error("no"); }),
              ::testing::IsEmpty());
}

}  // namespace
}  // namespace linkstudy::plan::at_once_test

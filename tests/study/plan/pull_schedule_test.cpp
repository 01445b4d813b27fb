// How long pulled tasks take: closed forms, and the bounds of list scheduling [Graham 1969].
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "study/plan/pull_schedule.h"

namespace linkstudy::plan::pull_schedule_test {
namespace {

TEST(PullSchedule, Equal_tasks_take_full_rounds) {
  for (const int ranks : {1, 2, 3, 7, 20}) {
    for (const std::size_t count : {1u, 6u, 7u, 8u}) {
      const PullEnd end = pull(std::vector<double>(count, 0.5), ranks);
      const double rounds = std::ceil(static_cast<double>(count) / ranks);
      EXPECT_DOUBLE_EQ(end.wall_s, 0.5 * rounds) << count << " tasks on " << ranks;
      EXPECT_DOUBLE_EQ(end.busy, static_cast<double>(count) / (rounds * ranks));
    }
  }
}

TEST(PullSchedule, Whoever_is_idle_gets_the_next) {
  // 4 | 1 1 1, and the last waits for neither: 3 goes to the second rank at t = 3.
  EXPECT_DOUBLE_EQ(pull(std::vector{4.0, 1.0, 1.0, 1.0, 3.0}, 2).wall_s, 6.0);
  EXPECT_DOUBLE_EQ(pull(std::vector<double>{}, 4).wall_s, 0.0);
}

// A manager that is never idle: task i starts at (i + 1) s. One that has time delays every task.
TEST(PullSchedule, The_manager_serves_one_after_the_other) {
  EXPECT_DOUBLE_EQ(pull(std::vector<double>(100, 0.5), 1000, 0.25).wall_s, 100 * 0.25 + 0.5);
  EXPECT_DOUBLE_EQ(pull(std::vector<double>(10, 2.0), 1, 0.25).wall_s, 10 * 2.25);
  const PullEnd end = pull(std::vector<double>(40000, 1.0), 10000, 2e-6);
  EXPECT_GT(end.busy, 0.98);
  EXPECT_LT(end.busy, 1.0);
}

TEST(PullSchedule, No_sooner_than_the_work_allows_and_no_later_than_its_longest_task_more) {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> seconds(0.0, 1.0);
  for (int trial = 0; trial < 300; ++trial) {
    std::vector<double> tasks(1 + random() % 60);
    for (double& task : tasks) task = seconds(random);
    const int ranks = 1 + static_cast<int>(random() % 12);
    const double longest = *std::ranges::max_element(tasks);
    const double share = std::accumulate(tasks.begin(), tasks.end(), 0.0) / ranks;
    const PullEnd end = pull(tasks, ranks);
    EXPECT_GE(end.wall_s, std::max(longest, share) * (1.0 - 1e-12));
    EXPECT_LE(end.wall_s, (share + longest * (1.0 - 1.0 / ranks)) * (1.0 + 1e-12));
    EXPECT_NEAR(end.busy, share / end.wall_s, 1e-12);
  }
}

}  // namespace
}  // namespace linkstudy::plan::pull_schedule_test

// Truth: the rule as the header states it, on a clock of the test's own.
#include "study/schedule/rank_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace linkstudy::rank_watch_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

class Watched : public ::testing::Test {
 protected:
  // Looks every 100 ms for so long; ranks in `answering` are heard each time. What was lost.
  std::vector<int> watch(RankWatch& watch, seconds time, const std::vector<int>& answering,
                         bool goes_on = true) {
    std::vector<int> lost;
    for (milliseconds passed{0}; passed < time; passed += milliseconds(100)) {
      now_ += milliseconds(100);
      for (const int rank : answering) watch.hear(rank, goes_on);
      for (const int rank : watch.find_lost(now_)) lost.push_back(rank);
    }
    return lost;
  }

  RankWatch::Time now_{};
};

TEST_F(Watched, Silence_of_a_minute_loses_a_rank_and_an_answer_keeps_it) {
  RankWatch ranks(3, 0.0, now_);
  EXPECT_THAT(watch(ranks, seconds(59), {0, 1}), IsEmpty());
  EXPECT_THAT(watch(ranks, seconds(2), {0, 1}), ElementsAre(2));
  EXPECT_TRUE(ranks.is_lost(2));
  EXPECT_FALSE(ranks.answers(2));
  EXPECT_NEAR(ranks.silence_s(2), 60.0, 0.2);
  EXPECT_THAT(watch(ranks, seconds(3600), {0, 1}), IsEmpty()) << "lost once";
  EXPECT_EQ(ranks.lost_count(), 1);
}

TEST_F(Watched, A_limit_of_the_tasks_shortens_the_patience_and_never_lengthens_it) {
  EXPECT_DOUBLE_EQ(RankWatch(2, 2.0, now_).silent_limit_s(), 7.0);
  EXPECT_DOUBLE_EQ(RankWatch(2, 1e6, now_).silent_limit_s(), 60.0);
  RankWatch ranks(2, 2.0, now_);
  EXPECT_THAT(watch(ranks, seconds(8), {0}), ElementsAre(1));
}

TEST_F(Watched, A_rank_that_answers_is_slow_until_its_work_stands_still_for_long) {
  RankWatch ranks(2, 0.0, now_);
  EXPECT_THAT(watch(ranks, seconds(599), {0, 1}, false), IsEmpty());
  EXPECT_THAT(watch(ranks, seconds(599), {0, 1}, true), IsEmpty()) << "it went on";
  EXPECT_THAT(watch(ranks, seconds(602), {0, 1}, false), ElementsAre(0, 1));
  EXPECT_TRUE(ranks.answers(1));
}

TEST_F(Watched, Long_tasks_lengthen_the_patience_with_work_that_stands_still) {
  RankWatch ranks(2, 0.0, now_);
  ranks.note_task(100.0);
  ranks.note_task(3.0);
  EXPECT_DOUBLE_EQ(ranks.stuck_limit_s(), 2000.0);
}

// Suspended for an hour: what the others said in that time is still under way.
TEST_F(Watched, Time_in_which_rank_0_stood_still_counts_for_nobody) {
  RankWatch ranks(2, 0.0, now_);
  now_ += seconds(3600);
  EXPECT_THAT(ranks.find_lost(now_), IsEmpty());
  EXPECT_THAT(watch(ranks, seconds(58), {}), IsEmpty());
}

TEST_F(Watched, Ranks_are_called_once_a_second) {
  RankWatch ranks(2, 0.0, now_);
  int calls = 0;
  for (int i = 0; i < 100; ++i) {
    now_ += milliseconds(100);
    calls += ranks.is_time_to_call(now_) ? 1 : 0;
  }
  EXPECT_EQ(calls, 10);
}

}  // namespace
}  // namespace linkstudy::rank_watch_test

#include "study/schedule/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace linkstudy::progress_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Progress::Time start{};

TEST(Duration_text, Has_two_units_at_most) {
  EXPECT_EQ(duration_text(0.04), "0.0s");
  EXPECT_EQ(duration_text(9.94), "9.9s");
  EXPECT_EQ(duration_text(9.96), "10s");
  EXPECT_EQ(duration_text(59.6), "1m00s");
  EXPECT_EQ(duration_text(168.0), "2m48s");
  EXPECT_EQ(duration_text(3 * 3600.0 + 5 * 60.0), "3h05m");
  EXPECT_EQ(duration_text(2 * 86400.0 + 4 * 3600.0), "2d04h");
  EXPECT_EQ(duration_text(-1.0), "?");
  EXPECT_EQ(duration_text(1.0 / 0.0), "?");
}

TEST(Progress_line, Tells_rate_and_time_left_from_this_start_alone) {
  // 200 of 400 done before; 100 more in 50 s is 2/s; 100 left take 50 s.
  EXPECT_EQ(progress_line({400, 300, 3, 200, 50.0}), "300 of 400 (75%), 3 failed, 2/s, 50s left");
}

TEST(Progress_line, Promises_nothing_before_the_first_result) {
  EXPECT_EQ(progress_line({400, 200, 0, 200, 50.0}), "200 of 400 (50%)");
  EXPECT_EQ(progress_line({0, 0, 0, 0, 1.0}), "0 of 0 (100%), 1.0s");
}

TEST(Progress_line, Says_100_percent_only_when_all_are_done) {
  EXPECT_EQ(progress_line({1000, 999, 0, 999, 1.0}), "999 of 1000 (99%)");
  EXPECT_EQ(progress_line({1000, 1000, 0, 0, 4.0}), "1000 of 1000 (100%), 250/s, 4.0s");
}

TEST(Progress_line, Counts_slow_studies_by_the_hour) {
  EXPECT_EQ(progress_line({10, 1, 0, 0, 360.0}), "1 of 10 (10%), 10/h, 54m00s left");
}

TEST(Progress, Of_a_budget_foretells_no_end) {
  const ProgressState state{600, 134, 5, 0, 10.0, 1, true};
  EXPECT_EQ(progress_line(state), "134 of at most 600, 5 failed, 1 running, 13.4/s, 10s");
  EXPECT_EQ(progress_bar(state, 79), "134 of at most 600  5 failed  1 running  13.4/s  10s");
}

TEST(Progress_bar, Fills_in_proportion_and_keeps_its_columns) {
  const std::string none = progress_bar({1000, 0, 0, 0, 0.0}, 80);
  const std::string half = progress_bar({1000, 500, 0, 0, 5.0}, 80);
  const std::string all = progress_bar({1000, 1000, 0, 0, 9.0}, 80);
  EXPECT_EQ(std::count(none.begin(), none.end(), '#'), 0);
  EXPECT_EQ(std::count(half.begin(), half.end(), '#'), std::count(half.begin(), half.end(), '-'));
  EXPECT_EQ(std::count(all.begin(), all.end(), '-'), 0);
  EXPECT_EQ(none.find('%'), half.find('%'));
  EXPECT_EQ(all.find('%'), half.find('%'));
  EXPECT_THAT(half, ::testing::EndsWith("500/1000  50%  100/s  5.0s left"));
}

TEST(Progress_bar, Is_cut_to_the_terminal) {
  EXPECT_EQ(progress_bar({1000, 500, 7, 0, 5.0}, 30).size(), 30u);
}

TEST(Progress, In_a_log_writes_at_most_every_ten_seconds_and_a_last_line) {
  std::ostringstream log;
  Progress progress(ProgressMode::line, 100, 0, start, log, 80);
  for (int i = 1; i <= 99; ++i)
    progress.update(static_cast<std::size_t>(i), 0, start + milliseconds(250 * i));
  progress.update(100, 0, start + seconds(25));
  progress.finish(start + seconds(25));
  const std::string text = log.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3);  // at 10 s, at 20 s, and the last
  EXPECT_THAT(text, ::testing::EndsWith("100 of 100 (100%), 4/s, 25s\n"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("\r")));
}

TEST(Progress, On_a_terminal_redraws_one_line_at_most_ten_times_a_second) {
  std::ostringstream terminal;
  Progress progress(ProgressMode::bar, 1000, 0, start, terminal, 80);
  for (int i = 1; i <= 1000; ++i)
    progress.update(static_cast<std::size_t>(i), 0, start + milliseconds(i));
  progress.finish(start + seconds(1));
  const std::string text = terminal.str();
  const auto redraws = std::count(text.begin(), text.end(), '\r');
  EXPECT_GE(redraws, 9);
  EXPECT_LE(redraws, 12);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST(Progress, Tells_how_many_are_running) {
  ProgressState state{400, 300, 3, 200, 50.0};
  state.running = 15;
  EXPECT_EQ(progress_line(state), "300 of 400 (75%), 3 failed, 15 running, 2/s, 50s left");
  EXPECT_THAT(progress_bar(state, 100), ::testing::HasSubstr("3 failed  15 running  2/s"));
}

TEST(Progress, Keeps_its_clock_running_without_results) {
  std::ostringstream log;
  Progress progress(ProgressMode::line, 10, 0, start, log, 80);
  progress.update(5, 0, start + seconds(1));
  progress.tick(start + seconds(10));
  EXPECT_EQ(log.str(), "5 of 10 (50%), 0.5/s, 10s left\n");
}

TEST(Progress, Can_be_silent) {
  std::ostringstream log;
  Progress progress(ProgressMode::none, 10, 0, start, log, 80);
  progress.update(5, 0, start + seconds(100));
  progress.finish(start + seconds(200));
  EXPECT_EQ(log.str(), "");
}

TEST(Progress_mode, Is_found_by_its_name) {
  EXPECT_EQ(find_word<ProgressMode>("auto"), ProgressMode::automatic);
  EXPECT_EQ(find_word<ProgressMode>("bar"), ProgressMode::bar);
  EXPECT_EQ(find_word<ProgressMode>("line"), ProgressMode::line);
  EXPECT_EQ(find_word<ProgressMode>("none"), ProgressMode::none);
  EXPECT_EQ(find_word<ProgressMode>("Bar"), std::nullopt);
}

}  // namespace
}  // namespace linkstudy::progress_test

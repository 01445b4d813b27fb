#include "study/schedule/run_progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

namespace linkstudy::run_progress_test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::Not;

const RunProgress::Time start{};

long count_lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

TEST(Run_progress_line, Tells_model_time_share_and_wall_time_left) {
  // 3 of 15 s in 10 s of wall time: the other 12 take 40 s.
  EXPECT_EQ(run_progress_line({15.0, 3.0, 10.0}), "3 of 15 s (20%), 40s left");
  EXPECT_EQ(run_progress_line({15.0, 0.0, 10.0}), "0 of 15 s (0%)");
  EXPECT_EQ(run_progress_line({15.0, 14.999, 10.0}).substr(0, 17), "15 of 15 s (99%),");
  EXPECT_EQ(run_progress_line({15.0, 15.0, 12.0}), "15 of 15 s (100%), 12s");
  EXPECT_EQ(run_progress_line({0.2, 200000 * 1e-6 - 1e-16, 1.0}), "0.2 of 0.2 s (100%), 1.0s");
}

TEST(Run_progress_bar, Fills_in_proportion_and_is_cut_to_the_terminal) {
  const std::string half = run_progress_bar({2.0, 1.0, 3.0}, 80);
  EXPECT_EQ(std::count(half.begin(), half.end(), '#'), std::count(half.begin(), half.end(), '-'));
  EXPECT_THAT(half, HasSubstr("1 of 2 s   50%  3.0s left"));
  EXPECT_EQ(run_progress_bar({2.0, 1.0, 3.0}, 10).size(), 10U);
}

TEST(Run_progress, Says_nothing_in_a_log_about_a_short_run) {
  std::ostringstream stream;
  RunProgress progress(ProgressMode::line, 10.0, start, stream, 80);
  for (int i = 1; i <= 25; ++i) progress.update(0.4 * i, start + milliseconds(100 * i));
  progress.finish(10.0, start + milliseconds(2600));
  EXPECT_EQ(stream.str(), "");
}

TEST(Run_progress, Writes_a_line_for_every_tenth_of_a_run_of_minutes) {
  std::ostringstream stream;
  RunProgress progress(ProgressMode::line, 100.0, start, stream, 80);
  for (int i = 1; i <= 1000; ++i) progress.update(0.1 * i, start + milliseconds(100 * i));
  progress.finish(100.0, start + seconds(100));
  EXPECT_EQ(count_lines(stream.str()), 10);
  EXPECT_THAT(stream.str(), HasSubstr("(50%), 50s left\n"));
}

TEST(Run_progress, Writes_a_line_every_30_s_of_a_run_of_days) {
  std::ostringstream stream;
  RunProgress progress(ProgressMode::line, 1.0, start, stream, 80);
  for (int i = 1; i <= 3000; ++i) progress.update(1e-6 * i, start + milliseconds(100 * i));
  EXPECT_EQ(count_lines(stream.str()), 10);
}

TEST(Run_progress, Redraws_a_bar_in_place_and_leaves_its_line_once) {
  std::ostringstream stream;
  RunProgress progress(ProgressMode::bar, 1.0, start, stream, 80);
  for (int i = 1; i <= 100; ++i) progress.update(0.01 * i, start + milliseconds(10 * i));
  EXPECT_EQ(count_lines(stream.str()), 0);
  const std::string text = stream.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\r'), 10);
  progress.finish(1.0, start + seconds(1));
  EXPECT_EQ(count_lines(stream.str()), 1);
  EXPECT_THAT(stream.str(), HasSubstr("100%"));
}

TEST(Run_progress, Draws_no_bar_for_a_run_of_an_instant) {
  std::ostringstream stream;
  RunProgress progress(ProgressMode::bar, 1.0, start, stream, 80);
  progress.update(0.5, start + milliseconds(50));
  progress.finish(1.0, start + milliseconds(90));
  EXPECT_EQ(stream.str(), "");
}

TEST(Run_progress, Is_silent_when_told_so) {
  std::ostringstream stream;
  RunProgress progress(ProgressMode::none, 1.0, start, stream, 80);
  progress.update(0.5, start + seconds(100));
  progress.finish(1.0, start + seconds(200));
  EXPECT_EQ(stream.str(), "");
}

TEST(Run_watch, Follows_what_the_run_stores_and_ends_with_it) {
  std::atomic<double> reached{0.0};
  ::testing::internal::CaptureStderr();
  {
    const RunWatch watch(ProgressMode::bar, 4.0, reached);
    reached = 1.0;
    std::this_thread::sleep_for(milliseconds(350));
    reached = 4.0;
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_THAT(text, HasSubstr("1 of 4 s   25%"));
  EXPECT_THAT(text, HasSubstr("4 of 4 s  100%"));
  EXPECT_EQ(text.back(), '\n');
}

TEST(Run_watch, Of_mode_none_writes_nothing) {
  std::atomic<double> reached{1.0};
  ::testing::internal::CaptureStderr();
  {
    const RunWatch watch(ProgressMode::none, 4.0, reached);
    std::this_thread::sleep_for(milliseconds(150));
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace linkstudy::run_progress_test

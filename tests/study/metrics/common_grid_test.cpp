#include "study/metrics/common_grid.h"

#include <gtest/gtest.h>

namespace linkstudy {
namespace {

TEST(CommonGrid, Equal_steps_meet_at_every_step) {
  const auto grid = find_common_grid(1e-4, 1e-4);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->stride, 1);
  EXPECT_EQ(grid->reference_stride, 1);
}

TEST(CommonGrid, Half_the_step_meets_every_second_time) {
  const auto grid = find_common_grid(5e-5, 1e-4);
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->stride, 2);
  EXPECT_EQ(grid->reference_stride, 1);
}

TEST(CommonGrid, Steps_of_three_and_two_meet_at_six) {
  const auto grid = find_common_grid(15.0 / 50000, 15.0 / 75000);  // 3e-4, 2e-4
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->stride, 2);
  EXPECT_EQ(grid->reference_stride, 3);
}

TEST(CommonGrid, Steps_without_a_simple_ratio_share_no_grid) {
  EXPECT_FALSE(find_common_grid(15.0 / 150001, 1e-4));
  EXPECT_FALSE(find_common_grid(1e-4, 3.14159265358979e-4));
  EXPECT_FALSE(find_common_grid(1e-4, 1e-4 * (1.0 + 1e-6)));
  EXPECT_FALSE(find_common_grid(1.0, 1e-4));  // 10000 to 1 is past the limit
}

TEST(SampleWindow, Holds_both_ends_of_the_window) {
  const StepGrid grid{150000, 1e-4};
  const Sampling sampling = sample_window(grid, 1, TimeWindow{0.5, 15.0});
  EXPECT_EQ(sampling.begin, 5000);
  EXPECT_EQ(sampling.end, 150000);
}

TEST(SampleWindow, Takes_the_start_only_where_the_window_says_so) {
  const StepGrid grid{100, 0.01};
  EXPECT_EQ(sample_window(grid, 1, std::nullopt).begin, 1);
  EXPECT_EQ(sample_window(grid, 1, std::nullopt).end, 100);
  EXPECT_EQ(sample_window(grid, 1, TimeWindow{0.0, 0.5}).begin, 0);
  EXPECT_EQ(sample_window(grid, 1, TimeWindow{0.0, 0.5}).end, 50);
}

TEST(SampleWindow, Keeps_to_the_common_instants_inside_it) {
  const StepGrid grid{100, 0.01};
  const Sampling sampling = sample_window(grid, 7, TimeWindow{0.1, 0.5});
  EXPECT_EQ(sampling.begin, 14);  // 0.14 s is the first multiple of 0.07 s from 0.1 s on
  EXPECT_EQ(sampling.end, 49);
  EXPECT_EQ(sample_window(grid, 7, std::nullopt).end, 98);
}

}  // namespace
}  // namespace linkstudy

#include "study/metrics/common_grid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkstudy::common_grid_test {
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

TEST(WindowEnds, Are_what_a_window_has_beyond_its_samples) {
  const StepGrid grid{100, 0.01};
  const auto ends_of = [&](const TimeWindow& window) {
    return find_window_ends(grid, sample_window(grid, 1, window), window);
  };
  EXPECT_NEAR(ends_of({0.103, 0.508}).before, 0.7, 1e-9);
  EXPECT_NEAR(ends_of({0.103, 0.508}).after, 0.8, 1e-9);
  // 0.1 / 0.01 is no integer in floating point, and still the end lies on its sample.
  EXPECT_EQ(ends_of({0.1, 0.7}).before, 0.0);
  EXPECT_EQ(ends_of({0.1, 0.7}).after, 0.0);
  EXPECT_EQ(find_window_ends(grid, {0, 100, 1}, std::nullopt).before, 0.0);
}

// Mean of a course over a window by the weights of its samples.
double mean_of(double (*course)(double), const StepGrid& grid, const TimeWindow& window) {
  const Sampling sampling = sample_window(grid, 1, window);
  const WindowEnds ends = find_window_ends(grid, sampling, window);
  double sum = 0.0;
  for (long step = sampling.begin; step <= sampling.end; ++step) {
    sum += time_weight(sampling, ends, step) * course(static_cast<double>(step) * grid.h);
  }
  return sum / total_weight(sampling, ends);
}

TEST(TimeWeights, Give_means_of_second_order_wherever_the_window_ends) {
  const auto wave = [](double t) { return std::sin(3.0 * t); };
  for (const TimeWindow& window :
       {TimeWindow{0.0, 2.0}, TimeWindow{0.1, 1.9}, TimeWindow{0.1234, 1.777}}) {
    const double exact = (std::cos(3.0 * window.first) - std::cos(3.0 * window.last)) / 3.0 /
                         (window.last - window.first);
    for (long count = 40; count <= 5120; count *= 2) {
      const double h = 2.0 / static_cast<double>(count);
      // Inside: (b - a) h^2 max |f''| / 12; each end: h^2 max |f'| / 2.
      const double length = window.last - window.first;
      const double bound = h * h * (9.0 / 12.0 + 3.0 / length);
      EXPECT_LE(std::abs(mean_of(wave, {count, h}, window) - exact), bound) << count;
    }
  }
}

TEST(TimeWeights, Of_one_sample_give_its_value) {
  const auto line = [](double t) { return t; };
  EXPECT_DOUBLE_EQ(mean_of(line, {10, 0.1}, {0.25, 0.33}), 0.3);
  EXPECT_EQ(time_weight({4, 4, 1}, {}, 4), 1.0);
  EXPECT_EQ(total_weight({4, 4, 1}, {}), 1.0);
}

}  // namespace
}  // namespace linkstudy::common_grid_test

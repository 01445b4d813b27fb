// Time histories from level to level, with closed forms.
#include "study/converge/series_difference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <numbers>

#include "study/converge/needed_size.h"

namespace linkstudy::convergence::series_difference_test {
namespace {

struct Sampled {
  std::vector<double> time, values;
};

template <class Function>
Sampled sampled(double step, double end, Function f) {
  Sampled result;
  for (int i = 0; static_cast<double>(i) * step <= end * (1.0 + 1e-12); ++i) {
    result.time.push_back(static_cast<double>(i) * step);
    result.values.push_back(f(result.time.back()));
  }
  return result;
}

// x(t; h) = cos t + a h^p sin 3 t over one period, kept every 0.01 s of whatever step.
class PlantedHistories : public ::testing::Test {
 protected:
  static constexpr double kEnd = 6.28;

  std::optional<SeriesLadder> ladder(const std::vector<double>& h, double p, ErrorNorm norm,
                                     bool turns = false) {
    std::vector<History> histories;
    for (std::size_t i = 0; i < h.size(); ++i) {
      const double a = std::pow(h[i], p) * (turns && i % 2 == 1 ? -1.0 : 1.0);
      const auto f = [a](double t) { return std::cos(t) + a * std::sin(3.0 * t); };
      const Sampled& one = kept_.emplace_back(sampled(0.01, kEnd, f));
      histories.push_back({one.time, one.values});
    }
    const Sampled& limit =
        kept_.emplace_back(sampled(0.01, kEnd, [](double t) { return std::cos(t); }));
    return make_series_ladder(h, histories, norm, {}, History{limit.time, limit.values});
  }

  std::deque<Sampled> kept_;
};

TEST_F(PlantedHistories, Show_their_order_in_either_norm) {
  for (const ErrorNorm norm : {ErrorNorm::max, ErrorNorm::rms}) {
    const auto found = ladder({0.4, 0.2, 0.1, 0.05}, 3.0, norm);
    ASSERT_TRUE(found.has_value());
    const Refinement judged = judge_refinement(found->ladder, {.formal_order = 4.0});
    EXPECT_EQ(judged.behaviour, Behaviour::monotone);
    EXPECT_NEAR(judged.order, 3.0, 1e-10);  // every difference is the same shape
    EXPECT_TRUE(std::isnan(judged.extrapolated));
    // Its amplitude is what is left: h^3 sin 3 t, of which the greatest sample is 1 to 1.1e-4 and
    // the mean square 1/2 to 1e-3 of the period.
    const double rest = norm == ErrorNorm::max ? 1.0 : std::sqrt(0.5);
    EXPECT_NEAR(judged.uncertainty / 1.25, std::pow(0.05, 3) * rest, 2e-3 * std::pow(0.05, 3));
    EXPECT_NEAR(judged.rows.back().error, std::pow(0.05, 3) * rest, 2e-3 * std::pow(0.05, 3));
    EXPECT_NEAR(judged.rows.back().error_order, 3.0, 1e-10);
  }
}

TEST_F(PlantedHistories, That_swing_about_their_limit_oscillate) {
  const auto found = ladder({0.4, 0.2, 0.1, 0.05}, 1.0, ErrorNorm::rms, true);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(judge_refinement(found->ladder).behaviour, Behaviour::oscillatory);
}

TEST_F(PlantedHistories, Are_compared_beside_a_level_that_failed) {
  const auto whole = ladder({0.4, 0.1, 0.05}, 3.0, ErrorNorm::max);
  std::vector<History> histories(4);
  for (const auto& [level, kept] : {std::pair{0, 0}, std::pair{2, 1}, std::pair{3, 2}}) {
    const auto& one = kept_[static_cast<std::size_t>(kept)];
    histories[static_cast<std::size_t>(level)] = {one.time, one.values};
  }
  const auto found = make_series_ladder({0.4, 0.2, 0.1, 0.05}, histories, ErrorNorm::max, {});
  ASSERT_TRUE(found.has_value());
  const Refinement judged = judge_refinement(found->ladder);
  EXPECT_TRUE(std::isnan(judged.rows[1].value));
  EXPECT_NEAR(judged.order, judge_refinement(whole->ladder).order, 1e-12);
  EXPECT_NEAR(judged.order, 3.0, 1e-10);
}

TEST(CommonInstants, Are_those_of_all_levels_in_the_window_and_of_no_interpolation) {
  const auto nothing = [](double) { return 0.0; };
  const Sampled a = sampled(3e-4, 0.03, nothing), b = sampled(2e-4, 0.03, nothing);
  const std::vector<double> all = find_common_instants({a.time, b.time}, {});
  ASSERT_EQ(all.size(), 51U);  // every 6e-4
  EXPECT_NEAR(all[1], 6e-4, 1e-18);
  EXPECT_EQ(find_common_instants({a.time, b.time}, TimeWindow{0.0059, 0.0121}).size(), 11U);
  const Sampled c = sampled(std::numbers::pi * 1e-4, 0.03, nothing);
  EXPECT_EQ(find_common_instants({a.time, c.time}, {}).size(), 1U);  // the start
  EXPECT_FALSE(
      make_series_ladder({2.0, 1.0}, {{a.time, a.values}, {c.time, c.values}}, ErrorNorm::max, {})
          .has_value());
}

TEST(NeededSize, Lies_on_the_power_law_between_two_levels) {
  const std::vector<Level> errors = {{0.4, 0.16}, {0.2, 0.04}, {0.1, 0.01}};
  const NeededSize needed = find_needed_size(errors, 0.02, 2.0);
  EXPECT_EQ(needed.by, NeededBy::levels);
  EXPECT_NEAR(needed.h, std::sqrt(0.02), 1e-15);
}

TEST(NeededSize, Is_extrapolated_by_the_order_and_not_at_all_without_one) {
  const std::vector<Level> errors = {{0.4, 0.16}, {0.2, 0.04}, {0.1, 0.01}};
  EXPECT_NEAR(find_needed_size(errors, 1e-4, 2.0).h, 0.01, 1e-15);
  EXPECT_EQ(find_needed_size(errors, 1e-4, 2.0).by, NeededBy::extrapolation);
  EXPECT_EQ(find_needed_size(errors, 1e-4, std::nan("")).by, NeededBy::nothing);
  EXPECT_EQ(find_needed_size(errors, 1.0, 2.0).by, NeededBy::coarsest);
}

TEST(NeededSize, Heeds_finer_levels_that_are_worse_and_levels_that_failed) {
  const NeededSize turned = find_needed_size(
      std::vector<Level>{{0.4, 0.1}, {0.2, 0.01}, {0.1, 0.3}, {0.05, 0.02}}, 0.05, 1.0);
  EXPECT_GT(turned.h, 0.05);
  EXPECT_LT(turned.h, 0.1);
  const NeededSize failed = find_needed_size(
      std::vector<Level>{{0.4, std::nan("")}, {0.2, 0.01}, {0.1, 0.001}}, 0.05, 1.0);
  EXPECT_EQ(failed.h, 0.2);
  EXPECT_EQ(failed.by, NeededBy::levels);
}

}  // namespace
}  // namespace linkstudy::convergence::series_difference_test

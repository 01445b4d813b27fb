// Ladders with published or closed-form answers; coarse, fine and mixed orders of input.
#include "study/converge/refinement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "study/converge/observed_order.h"

namespace linkstudy::convergence::refinement_test {
namespace {

using ::testing::HasSubstr;

// Levels r^-i with these values, finest first.
std::vector<Level> halved(const std::vector<double>& finest_first, double ratio = 2.0) {
  std::vector<Level> levels;
  for (std::size_t i = 0; i < finest_first.size(); ++i) {
    levels.push_back({std::pow(ratio, static_cast<double>(i)), finest_first[i]});
  }
  return levels;
}

std::vector<Level> coarse_first(std::vector<double> values) {
  return halved({values.rbegin(), values.rend()});
}

template <class Function>
std::vector<Level> sampled(const std::vector<double>& sizes, Function f) {
  std::vector<Level> levels;
  for (const double h : sizes) levels.push_back({h, f(h)});
  return levels;
}

Refinement judged(std::vector<Level> levels, const RefinementOptions& options = {}) {
  return judge_refinement(make_ladder(std::move(levels)), options);
}

std::string all_remarks(const Refinement& result) {
  std::string all;
  for (const std::string& remark : result.remarks) all += remark + "\n";
  return all;
}

// NASA's tutorial on grid convergence; every digit it prints.
TEST(Refinement, Agrees_with_the_example_of_NASA) {
  const Refinement result = judged(halved({0.97050, 0.96854, 0.96178}));
  EXPECT_EQ(result.behaviour, Behaviour::monotone);
  EXPECT_NEAR(result.order, 1.78616959, 5e-9);
  EXPECT_NEAR(result.extrapolated, 0.971300333, 5e-10);
  EXPECT_NEAR(100.0 * result.gci, 0.103083, 5e-7);
  EXPECT_NEAR(result.rows.back().asymptotic_ratio, 1.002024, 5e-7);
  // GCI23 is that of the middle level with the same order.
  const RefinementRow& fine = result.rows.back();
  const double gci23 = fine.asymptotic_ratio * std::pow(2.0, fine.order) * fine.gci;
  EXPECT_NEAR(100.0 * gci23, 0.356249, 5e-7);
}

// N cells in the plane: h = N^-1/2.
std::vector<Level> celik(const std::vector<double>& cells, const std::vector<double>& values) {
  std::vector<Level> levels;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    levels.push_back({1.0 / std::sqrt(cells[i]), values[i]});
  }
  return levels;
}

// Celik et al. 2008, table 1, computed in double precision from its inputs; in any order.
TEST(Refinement, Agrees_with_Celik_on_unequal_ratios_in_any_order) {
  std::vector<double> cells = {18000, 8000, 4500};
  std::vector<double> values = {6.063, 5.972, 5.863};
  std::vector<int> order = {0, 1, 2};
  do {
    const auto at = [&](const std::vector<double>& of) {
      return std::vector<double>{of[static_cast<std::size_t>(order[0])],
                                 of[static_cast<std::size_t>(order[1])],
                                 of[static_cast<std::size_t>(order[2])]};
    };
    const Refinement result = judged(celik(at(cells), at(values)));
    EXPECT_EQ(result.behaviour, Behaviour::monotone);
    EXPECT_NEAR(result.order, 1.533969021, 5e-10);
    EXPECT_NEAR(result.extrapolated, 6.168495572, 5e-10);
    EXPECT_NEAR(100.0 * result.gci, 2.174987, 5e-7);
    EXPECT_NEAR(result.rows.back().asymptotic_ratio, 1.015237776, 5e-10);
    const double gci32 =
        result.rows.back().asymptotic_ratio * std::pow(1.5, result.order) * result.gci;
    EXPECT_NEAR(100.0 * gci32, 4.112851, 5e-7);
  } while (std::ranges::next_permutation(order).found);
}

TEST(Refinement, Agrees_with_Celik_where_the_plain_logarithm_is_wrong) {
  const Refinement result = judged(celik({18000, 4500, 980}, {10.7880, 10.7250, 10.6050}));
  EXPECT_NEAR(result.order, 0.751900518, 5e-10);
  EXPECT_NEAR(result.extrapolated, 10.880103946, 5e-10);
  EXPECT_NEAR(100.0 * result.gci, 1.067204, 5e-7);
  const double gci32 =
      result.rows.back().asymptotic_ratio * std::pow(2.0, result.order) * result.gci;
  EXPECT_NEAR(100.0 * gci32, 1.807738, 5e-7);
  EXPECT_NEAR(std::log(0.12 / 0.063) / std::log(2.0), 0.93, 5e-3);  // the wrong one
}

TEST(Refinement, Gives_no_order_where_Celik_finds_oscillation) {
  const Refinement result = judged(celik({18000, 4500, 980}, {6.0042, 5.9624, 6.0909}));
  EXPECT_EQ(result.behaviour, Behaviour::oscillatory);
  EXPECT_TRUE(std::isnan(result.order));
  EXPECT_TRUE(std::isnan(result.gci));
  EXPECT_FALSE(result.is_settled());
}

TEST(Refinement, Finds_the_limit_of_one_plus_h_squared) {
  const Refinement result = judged(sampled({0.05, 0.1, 0.2}, [](double h) { return 1.0 + h * h; }));
  EXPECT_NEAR(result.order, 2.0, 1e-11);  // rounding of the differences: eps / 0.0075
  EXPECT_NEAR(result.extrapolated, 1.0, 1e-13);
  EXPECT_NEAR(100.0 * result.gci, 0.311720698, 5e-10);
  const RefinementRow& fine = result.rows.back();
  EXPECT_NEAR(fine.asymptotic_ratio, 0.992574257, 5e-10);
  EXPECT_NEAR(100.0 * fine.asymptotic_ratio * std::pow(2.0, fine.order) * fine.gci, 1.237623762,
              5e-9);
}

TEST(Refinement, Gives_growing_errors_no_order) {
  const Refinement result = judged(coarse_first({1.1497, 1.4641, 1.946, 2.6597, 3.6943}));
  EXPECT_EQ(result.behaviour, Behaviour::divergent);
  for (const RefinementRow& row : result.rows) EXPECT_TRUE(std::isnan(row.order));
  EXPECT_TRUE(std::isnan(result.extrapolated));
  EXPECT_FALSE(result.is_settled());
}

TEST(Refinement, Finds_half_an_order_in_every_triple_and_every_pair_of_errors) {
  const std::vector<double> errors = {0.023766, 0.016805, 0.011883, 0.0084024, 0.0059414};
  const Refinement result = judge_refinement(make_ladder(coarse_first(errors), 0.0));
  EXPECT_EQ(result.behaviour, Behaviour::monotone);
  // Five printed digits: 5e-7 of differences of 2.5e-3, over ln 2.
  for (std::size_t i = 2; i < 5; ++i) EXPECT_NEAR(result.rows[i].order, 0.5, 1e-3) << i;
  for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(result.rows[i].error_order, 0.5, 2e-4) << i;
  ASSERT_TRUE(result.fit.has_value());
  EXPECT_EQ(result.fit->count, 5U);
  EXPECT_NEAR(result.fit->order, 0.5, 1e-3);
}

TEST(Refinement, Names_the_floor_and_gives_it_no_order) {
  const std::vector<double> errors = {1.0082e-15, 1.2286e-14, 7.7143e-14, 1.3192e-13, 9.8365e-13};
  const Refinement result = judge_refinement(make_ladder(coarse_first(errors), 0.0, 1.0));
  EXPECT_EQ(result.behaviour, Behaviour::floor);
  for (const RefinementRow& row : result.rows) {
    EXPECT_TRUE(std::isnan(row.order));
    EXPECT_TRUE(std::isnan(row.error_order));
  }
  EXPECT_TRUE(result.is_settled());
  EXPECT_THAT(all_remarks(result), HasSubstr("rounding"));
}

// An order-4 ladder that runs into noise of 1e-12: what is above it must not suffer.
TEST(Refinement, Leaves_noise_of_the_finest_levels_out_of_the_order) {
  std::mt19937_64 generator(5);
  std::uniform_real_distribution<double> noise(-1e-12, 1e-12);
  int named = 0;
  for (int run = 0; run < 200; ++run) {
    std::vector<double> sizes;
    for (int i = 0; i < 9; ++i) sizes.push_back(std::pow(0.5, i));
    const Refinement result = judged(
        sampled(sizes, [&](double h) { return 3.0 + 1e-4 * std::pow(h, 4) + noise(generator); }),
        {.formal_order = 4.0, .floor = 1e-15});
    ASSERT_EQ(result.behaviour, Behaviour::monotone) << run;
    // A tiny change is used where its order is within a tenth of the one before, which may be one.
    ASSERT_NEAR(result.order, 4.0, 0.8) << run;
    named += all_remarks(result).find("rounding or noise") != std::string::npos ? 1 : 0;
  }
  EXPECT_GE(named, 170);  // the last change is below its noise, and looks right by luck
}

TEST(Refinement, Calls_scatter_noise_and_gives_it_no_order) {
  std::mt19937_64 generator(11);
  std::normal_distribution<double> scatter(0.0, 1.0);
  int noise = 0, settled = 0;
  for (int run = 0; run < 500; ++run) {
    std::vector<double> sizes;
    for (int i = 0; i < 7; ++i) sizes.push_back(std::pow(0.5, i));
    const Refinement result =
        judged(sampled(sizes, [&](double) { return 100.0 + scatter(generator); }));
    noise += result.behaviour == Behaviour::noise ? 1 : 0;
    settled += result.is_settled() ? 1 : 0;
  }
  EXPECT_GE(noise, 475);
  EXPECT_LE(settled, 15);  // by chance two triples agree
}

TEST(Refinement, Says_that_an_oscillation_shrinks) {
  const std::vector<double> sizes = {1.0, 0.5, 0.25, 0.125};
  double sign = 1.0;
  const Refinement result = judged(sampled(sizes, [&](double h) {
    sign = -sign;
    return 1.0 + sign * h * h;
  }));
  EXPECT_EQ(result.behaviour, Behaviour::oscillatory);
  // Differences are h^2 + (2 h)^2 = 5 h^2.
  EXPECT_NEAR(result.difference_order, 2.0, 1e-12);
}

TEST(Refinement, Takes_factor_three_and_the_formal_order_where_the_observed_is_too_good) {
  const auto f = [](double h) { return 1.0 + std::pow(h, 5); };
  const Refinement result = judged(sampled({0.1, 0.2, 0.4}, f), {.formal_order = 2.0});
  EXPECT_NEAR(result.order, 5.0, 1e-9);
  EXPECT_EQ(result.safety_factor, 3.0);
  EXPECT_NEAR(result.uncertainty, 3.0 * std::abs(f(0.2) - f(0.1)) / 3.0, 1e-12);
  EXPECT_THAT(all_remarks(result), HasSubstr("more than twice"));
}

TEST(Refinement, Of_two_levels_uses_the_formal_order_with_factor_three_and_is_not_settled) {
  const Refinement result = judged({{0.1, 1.01}, {0.2, 1.04}}, {.formal_order = 2.0});
  EXPECT_EQ(result.behaviour, Behaviour::untold);
  EXPECT_TRUE(std::isnan(result.order));
  EXPECT_NEAR(result.extrapolated, 1.0, 1e-12);
  EXPECT_NEAR(result.gci, 3.0 * 0.03 / 3.0 / 1.01, 1e-12);
  EXPECT_FALSE(result.is_settled());
  EXPECT_TRUE(std::isnan(judged({{0.1, 1.01}, {0.2, 1.04}}).gci));
}

TEST(Refinement, Goes_on_without_levels_that_failed) {
  const Refinement result = judged({{0.4, 1.16}, {0.2, std::nan("")}, {0.1, 1.01}, {0.05, 1.0025}},
                                   {.formal_order = 2.0});
  EXPECT_EQ(result.behaviour, Behaviour::monotone);
  EXPECT_NEAR(result.order, 2.0, 1e-9);  // ratios 4 and 2
  EXPECT_TRUE(std::isnan(result.rows[1].change));
  EXPECT_THAT(all_remarks(result), HasSubstr("1 of 4 levels have no value"));
}

TEST(Refinement, Warns_of_levels_that_are_too_close) {
  const Refinement result = judged(sampled({1.0, 1.2, 1.44}, [](double h) { return 1.0 + h * h; }));
  EXPECT_NEAR(result.order, 2.0, 1e-9);
  EXPECT_THAT(all_remarks(result), HasSubstr("ratio of 1.2 is below 1.3"));
}

TEST(Refinement, Says_that_another_error_takes_over) {
  // Of a spring: 1 / c falls, c^2 rises.
  std::vector<double> sizes;
  for (int i = 0; i < 7; ++i) sizes.push_back(std::pow(0.25, i));
  const Refinement result =
      judged(sampled(sizes, [](double h) { return 10.0 + h + 1e-6 / (h * h); }));
  EXPECT_EQ(result.behaviour, Behaviour::divergent);
  EXPECT_FALSE(result.is_settled());
}

TEST(ObservedOrder, Comes_back_from_any_planted_order_and_ratios) {
  std::mt19937_64 generator(3);
  std::uniform_real_distribution<double> order(0.1, 8.0), ratio(1.3, 4.0), sign(-1.0, 1.0);
  for (int run = 0; run < 2000; ++run) {
    const double p = order(generator);
    const double r21 = ratio(generator), r32 = ratio(generator);
    const double a = sign(generator) < 0.0 ? -1.0 : 1.0;
    const double e21 = a * std::expm1(p * std::log(r21));
    const double e32 = a * std::pow(r21, p) * std::expm1(p * std::log(r32));
    const auto found = order_of_differences(e21, e32, r21, r32);
    ASSERT_TRUE(found.has_value());
    ASSERT_NEAR(*found, p, 1e-11 * (1.0 + p));  // rounding of powers to 4^16
    ASSERT_FALSE(order_of_differences(e21, -e32, r21, r32).has_value());
  }
}

TEST(OrderFit, Finds_planted_numbers_through_noise) {
  std::mt19937_64 generator(9);
  std::normal_distribution<double> noise(0.0, 1e-5);
  std::vector<Level> levels;
  for (int i = 0; i < 12; ++i) {
    const double h = 0.3 * std::pow(0.75, i);
    levels.push_back({h, 2.0 - 0.7 * std::pow(h, 1.5) + noise(generator)});
  }
  const auto fit = fit_order(levels);
  ASSERT_TRUE(fit.has_value());
  // Four deviations as the linearised covariance gives them: 6e-6, 3e-4 of p.
  EXPECT_NEAR(fit->limit, 2.0, 5e-5);
  EXPECT_NEAR(fit->order, 1.5, 5e-3);
  EXPECT_NEAR(fit->deviation, 1e-5, 0.6e-5);  // chi of 9 degrees of freedom, 99.9 %
}

TEST(OrderFit, Of_three_levels_is_what_their_triple_says) {
  const std::vector<Level> levels = celik({18000, 4500, 980}, {10.7880, 10.7250, 10.6050});
  const auto fit = fit_order(levels);
  ASSERT_TRUE(fit.has_value());
  EXPECT_NEAR(fit->order, 0.751900518, 1e-6);  // a minimum is found to sqrt(eps)
  EXPECT_NEAR(fit->limit, 10.880103946, 1e-6);
  EXPECT_EQ(fit->deviation, 0.0);
}

}  // namespace
}  // namespace linkstudy::convergence::refinement_test

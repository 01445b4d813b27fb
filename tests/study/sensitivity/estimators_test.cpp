// Estimators against functions whose indices are known in closed form, and a published worked
// example of elementary effects.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "study/design/samples.h"
#include "study/sensitivity/bootstrap.h"
#include "study/sensitivity/elementary_effects.h"
#include "study/sensitivity/failure_region.h"
#include "study/sensitivity/variance_indices.h"

namespace linkstudy::testing::estimators_test {
namespace {

using namespace linkstudy::sensitivity;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Unit = std::vector<double>;

std::vector<std::size_t> all_of(std::size_t n) {
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

// Values of n blocks of a saltelli design.
template <class Function>
Eigen::MatrixXd blocks_of(std::size_t n, std::size_t k, std::uint64_t seed, Function f) {
  const DesignOptions design{.type = Design::saltelli, .samples = n, .seed = seed};
  Eigen::MatrixXd blocks(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(k + 2));
  for (std::size_t id = 0; id < n * (k + 2); ++id) {
    blocks(static_cast<Eigen::Index>(id / (k + 2)), static_cast<Eigen::Index>(id % (k + 2))) =
        f(saltelli_point(design, k, id));
  }
  return blocks;
}

// Ishigami and Homma (1990), a = 7, b = 0.1, on (-pi, pi)^3.
double ishigami(const Unit& u) {
  const auto x = [&](std::size_t i) { return std::numbers::pi * (2.0 * u[i] - 1.0); };
  return std::sin(x(0)) + 7.0 * std::pow(std::sin(x(1)), 2) +
         0.1 * std::pow(x(2), 4) * std::sin(x(0));
}

const std::vector<double> kIshigamiFirst = {0.3139051911478115, 0.4424111447900409, 0.0};
const std::vector<double> kIshigamiTotal = {0.5575888552099592, 0.4424111447900409,
                                            0.2436836640621477};

// At 4096 blocks errors of a quasi-random design are well below 0.01; a random one has 0.02.
TEST(VarianceIndices, Are_those_of_the_ishigami_function) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const VarianceIndices found =
        estimate_indices(blocks_of(4096, 3, seed, ishigami), all_of(4096));
    EXPECT_NEAR(found.mean, 3.5, 0.01);
    EXPECT_NEAR(found.variance, 13.844587940719254, 0.05);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.first[i], kIshigamiFirst[i], 0.01) << i;
      EXPECT_NEAR(found.total[i], kIshigamiTotal[i], 0.01) << i;
    }
  }
}

// A large mean must not add to the scatter.
TEST(VarianceIndices, Do_not_depend_on_an_offset) {
  const auto lifted = [](const Unit& u) { return 1.0e6 + ishigami(u); };
  const VarianceIndices found = estimate_indices(blocks_of(4096, 3, 1, lifted), all_of(4096));
  const VarianceIndices plain = estimate_indices(blocks_of(4096, 3, 1, ishigami), all_of(4096));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found.first[i], plain.first[i], 1e-8);
    EXPECT_NEAR(found.total[i], plain.total[i], 1e-8);
  }
}

// Sobol's g function, a = (0, 1, 4.5, 9, 99, 99, 99, 99): V_i = 1 / (3 (1 + a_i)^2).
TEST(VarianceIndices, Are_those_of_the_g_function_in_eight_parameters) {
  const std::vector<double> a = {0, 1, 4.5, 9, 99, 99, 99, 99};
  const auto g = [&](const Unit& u) {
    double product = 1.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      product *= (std::abs(4.0 * u[i] - 2.0) + a[i]) / (1.0 + a[i]);
    }
    return product;
  };
  const VarianceIndices found = estimate_indices(blocks_of(8192, 8, 4, g), all_of(8192));
  EXPECT_NEAR(found.variance, 0.4654244319022067, 0.005);
  const std::vector<double> first = {0.7161921688790331, 0.1790480422197583, 0.02367577417781928,
                                     0.007161921688790333};
  const std::vector<double> total = {0.7871441266592749, 0.2421981928182384, 0.03431691015408283,
                                     0.01046038706523953};
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_NEAR(found.first[i], first[i], 0.012) << i;
    EXPECT_NEAR(found.total[i], total[i], 0.012) << i;
  }
  for (std::size_t i = 4; i < 8; ++i) {
    EXPECT_NEAR(found.first[i], 7.16192168879e-5, 0.001);
    EXPECT_NEAR(found.total[i], 1.0494905192e-4, 2e-5);
  }
}

TEST(VarianceIndices, Of_what_does_not_vary_there_are_none) {
  const auto found =
      estimate_indices(blocks_of(8, 2, 1, [](const Unit&) { return 4.0; }), all_of(8));
  EXPECT_EQ(found.variance, 0.0);
  EXPECT_TRUE(std::isnan(found.first[0]) && std::isnan(found.total[1]));
}

// Saltelli et al., Global Sensitivity Analysis: The Primer (2008), chapter 3: six trajectories of
// two parameters on four levels.
TEST(ElementaryEffects, Are_those_of_the_worked_example) {
  const double third = 1.0 / 3.0, two = 2.0 / 3.0;
  const std::vector<std::vector<Unit>> points = {
      {{0, third}, {0, 1}, {two, 1}},           {{0, third}, {two, third}, {two, 1}},
      {{two, 0}, {two, two}, {0, two}},         {{third, 1}, {1, 1}, {1, third}},
      {{third, 1}, {third, third}, {1, third}}, {{third, two}, {third, 0}, {1, 0}}};
  const std::vector<std::vector<double>> values = {{.97, .71, 2.39},   {.97, 2.30, 2.39},
                                                   {1.87, 2.40, .87},  {2.15, 1.71, 1.54},
                                                   {2.15, 2.17, 1.54}, {2.20, 1.87, 1.0}};
  std::vector<std::vector<double>> effects(2);
  for (std::size_t t = 0; t < points.size(); ++t) {
    const std::vector<double> own = elementary_effects(points[t], values[t]);
    for (std::size_t i = 0; i < 2; ++i) effects[i].push_back(own[i]);
  }
  const EffectMeasures first = measure_effects(effects[0], all_of(6));
  const EffectMeasures second = measure_effects(effects[1], all_of(6));
  // Printed to two digits.
  EXPECT_NEAR(first.mu, 0.65, 0.005);
  EXPECT_NEAR(second.mu, 0.21, 0.005);
  EXPECT_NEAR(first.mu_star, 1.62, 0.006);
  EXPECT_NEAR(second.mu_star, 0.35, 0.006);
  EXPECT_NEAR(first.sigma, 1.794107, 2e-6);
  EXPECT_NEAR(second.sigma, 0.411995, 2e-6);
}

// Of a linear function they are its slopes over the ranges, along every trajectory.
TEST(ElementaryEffects, Of_a_linear_function_are_its_slopes) {
  const DesignOptions design{.type = Design::morris, .trajectories = 5, .levels = 6, .seed = 3};
  for (std::uint64_t t = 0; t < 5; ++t) {
    std::vector<Unit> points;
    std::vector<double> values;
    for (std::uint64_t s = 0; s < 4; ++s) {
      points.push_back(morris_point(design, 3, 4 * t + s));
      values.push_back(1.0 + 2.0 * points.back()[0] - 3.0 * points.back()[1]);
    }
    const std::vector<double> own = elementary_effects(points, values);
    EXPECT_NEAR(own[0], 2.0, 1e-12);
    EXPECT_NEAR(own[1], -3.0, 1e-12);
    EXPECT_NEAR(own[2], 0.0, 1e-12);
  }
}

// The mean of n normal numbers of known deviation: its interval is +- 1.96 / sqrt(n).
TEST(Bootstrap, Intervals_of_a_mean_are_as_wide_as_theory_says) {
  constexpr std::size_t n = 400;
  std::vector<double> sample;
  for (std::size_t i = 0; i < n; ++i) {  // quantiles of a uniform distribution of deviation 1
    const double u = (static_cast<double>(i) + 0.5) / n;
    sample.push_back(std::sqrt(12.0) * (u - 0.5));
  }
  const auto mean = [&](std::span<const std::size_t> rows) {
    double sum = 0.0;
    for (const std::size_t row : rows) sum += sample[row];
    return std::vector<double>{sum / static_cast<double>(rows.size()), 7.0};
  };
  const std::vector<Interval> found = bootstrap_intervals(n, 1, mean);
  ASSERT_THAT(found, SizeIs(2));
  EXPECT_NEAR(found[0].low, -1.96 / 20.0, 0.15 * 1.96 / 20.0);
  EXPECT_NEAR(found[0].high, 1.96 / 20.0, 0.15 * 1.96 / 20.0);
  EXPECT_EQ(found[1].low, 7.0);
  EXPECT_EQ(found[1].high, 7.0);
  const std::vector<Interval> again = bootstrap_intervals(n, 1, mean);
  EXPECT_EQ(again[0].low, found[0].low);
  EXPECT_NE(bootstrap_intervals(n, 2, mean)[0].low, found[0].low);
}

// Intervals that hold 95 % hold the truth nearly always: of 40 samples of the Ishigami function,
// two should miss; eight would happen once in a thousand times.
TEST(Bootstrap, Intervals_of_indices_hold_the_true_ones) {
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Eigen::MatrixXd blocks = blocks_of(128, 3, seed, ishigami);
    const auto intervals = bootstrap_intervals(128, seed, [&](std::span<const std::size_t> rows) {
      return estimate_indices(blocks, rows).first;
    });
    if (!intervals[0].contains(kIshigamiFirst[0])) ++missed;
  }
  EXPECT_LT(missed, 8);
}

TEST(Bootstrap, Blocks_that_would_settle_grow_with_the_square_of_what_is_missing) {
  // 0.02 with an interval down to -0.02: as wide as 0.02 after four times as many.
  EXPECT_EQ(blocks_to_settle(0.02, {-0.02, 0.05}, 100, 0.01), 400.0);
  EXPECT_EQ(blocks_to_settle(-0.02, {-0.05, 0.02}, 100, 0.01), 400.0);
  EXPECT_EQ(blocks_to_settle(0.0, {-0.02, 0.02}, 100, 0.01), 400.0);
}

TEST(Bootstrap, Quantiles_lie_straight_between_sorted_numbers) {
  const std::vector<double> sorted = {1.0, 2.0, 4.0};
  EXPECT_EQ(sorted_quantile(sorted, 0.0), 1.0);
  EXPECT_EQ(sorted_quantile(sorted, 0.5), 2.0);
  EXPECT_EQ(sorted_quantile(sorted, 0.75), 3.0);
  EXPECT_EQ(sorted_quantile(sorted, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(sorted_quantile({}, 0.5)));
}

Evaluation evaluation(std::uint64_t id, double x, double y, Cause status) {
  Evaluation one;
  one.point = {id, {x, "word", y}};
  one.status = status;
  return one;
}

TEST(FailureRegion, Tells_where_failures_lie_and_how_far_apart_from_the_rest) {
  std::map<std::uint64_t, Evaluation> all;
  for (std::uint64_t id = 0; id < 10; ++id) {
    const auto x = static_cast<double>(id);
    all[id] = evaluation(id, x, id % 2 == 0 ? 1.0 : 2.0, x >= 7.0 ? Cause::diverged : Cause::ok);
  }
  const std::vector<FailureRegion> found = find_failure_regions(all);
  ASSERT_THAT(found, SizeIs(2));  // words have no region
  EXPECT_EQ(found[0].cause, Cause::diverged);
  EXPECT_EQ(found[0].parameter, 0u);
  EXPECT_EQ(found[1].parameter, 2u);
  EXPECT_EQ(found[0].count, 3u);
  EXPECT_EQ(found[0].ok, 7u);
  EXPECT_EQ(found[0].failed.low, 7.0);
  EXPECT_EQ(found[0].failed.median, 8.0);
  EXPECT_EQ(found[0].failed.high, 9.0);
  EXPECT_EQ(found[0].ran.high, 6.0);
  EXPECT_EQ(found[0].separation, 1.0);
  // 2 of 3 beside 3 of 7 have y = 2.
  EXPECT_NEAR(found[1].separation, 2.0 / 3.0 - 3.0 / 7.0, 1e-15);
  all.erase(7), all.erase(8), all.erase(9);
  EXPECT_THAT(find_failure_regions(all), IsEmpty());
}

}  // namespace
}  // namespace linkstudy::testing::estimators_test

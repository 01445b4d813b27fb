// Quantile functions against closed forms: distribution functions by erfc of the standard library,
// written-out triangles, published quantiles of the normal distribution.
#include "study/design/distribution.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace linkstudy::testing::distribution_test {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// P(x > t) and P(x < t) of N(0, 1).
double above(double t) {
  return 0.5 * std::erfc(t / std::sqrt(2.0));
}
double below(double t) {
  return above(-t);
}

Distribution normal(double mean, double deviation, double low = -kInfinity,
                    double high = kInfinity) {
  return {Law::normal, low, high, mean, deviation};
}

TEST(Distribution, A_linear_range_has_its_ends_and_its_middle) {
  const Distribution d{Law::lin, -3.0, 5.0};
  EXPECT_EQ(quantile(d, 0.0), -3.0);
  EXPECT_EQ(quantile(d, 1.0), 5.0);
  EXPECT_DOUBLE_EQ(quantile(d, 0.25), -1.0);
}

TEST(Distribution, A_logarithmic_range_is_uniform_in_decades) {
  const Distribution d{Law::log, 3.0e3, 7.0e8};
  EXPECT_EQ(quantile(d, 0.0), 3.0e3);
  EXPECT_EQ(quantile(d, 1.0), 7.0e8);
  EXPECT_NEAR(quantile(d, 0.5), std::sqrt(3.0e3 * 7.0e8), 1e-8 * std::sqrt(3.0e3 * 7.0e8));
  for (const double u : {0.1, 0.3, 0.9}) {
    EXPECT_NEAR(std::log(quantile(d, u) / 3.0e3) / std::log(7.0e8 / 3.0e3), u, 1e-14);
  }
}

// NIST/SEMATECH e-Handbook of Statistical Methods, 1.3.6.7.1, to the digits of Abramowitz and
// Stegun, table 26.5.
TEST(Distribution, A_normal_one_has_the_published_quantiles) {
  const Distribution d = normal(10.0, 2.0);
  EXPECT_EQ(quantile(d, 0.5), 10.0);
  EXPECT_NEAR(quantile(d, 0.975), 10.0 + 2.0 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(quantile(d, 0.95), 10.0 + 2.0 * 1.6448536269514722, 1e-12);
  EXPECT_NEAR(quantile(d, 0.001), 10.0 - 2.0 * 3.090232306167813, 1e-12);
}

TEST(Distribution, The_extreme_samples_of_a_normal_one_are_as_far_out_as_the_reference_says) {
  const double least = quantile(normal(0.0, 1.0), kLeastUnit);
  EXPECT_NEAR(below(least) / kLeastUnit, 1.0, 1e-9);
  EXPECT_NEAR(least, -8.2, 0.05);
  EXPECT_NEAR(quantile(normal(0.0, 1.0), 1.0 - kLeastUnit), -least, 1e-9);
}

TEST(Distribution, A_truncated_normal_one_shares_what_lies_between_its_bounds) {
  for (const auto& [low, high] : {std::pair{-0.5, 2.0}, {-kInfinity, 0.3}, {0.1, kInfinity}}) {
    const Distribution d = normal(0.0, 1.0, low, high);
    const double share = below(high) - below(low);
    EXPECT_NEAR(share_within_bounds(d), share, 1e-15);
    for (const double u : {1e-6, 0.2, 0.5, 0.999999}) {
      const double x = quantile(d, u);
      EXPECT_NEAR((below(x) - below(low)) / share, u, 1e-13) << low << " " << u;
      EXPECT_TRUE(low <= x && x <= high);
    }
  }
}

// By the difference of distribution functions nothing would be left at 9 deviations.
TEST(Distribution, A_tail_keeps_its_digits_on_either_side) {
  const double share = above(9.0);
  for (const double u : {0.01, 0.5, 0.9}) {
    const double x = quantile(normal(0.0, 1.0, 9.0), u);
    EXPECT_NEAR((share - above(x)) / share, u, 1e-11);
    EXPECT_NEAR(quantile(normal(0.0, 1.0, -kInfinity, -9.0), 1.0 - u), -x, 1e-9);
  }
}

TEST(Distribution, A_triangle_has_the_squares_that_its_area_says) {
  const double a = 1.0, c = 2.0, b = 5.0;
  const Distribution d{Law::triangular, a, b, 0.0, 1.0, c};
  const double at_mode = (c - a) / (b - a);
  EXPECT_DOUBLE_EQ(quantile(d, at_mode), c);
  EXPECT_DOUBLE_EQ(quantile(d, 0.1), a + std::sqrt(0.1 * (b - a) * (c - a)));
  EXPECT_DOUBLE_EQ(quantile(d, 0.8), b - std::sqrt(0.2 * (b - a) * (b - c)));
  const Distribution right{Law::triangular, 0.0, 1.0, 0.0, 1.0, 1.0};  // density 2x
  EXPECT_DOUBLE_EQ(quantile(right, 0.25), 0.5);
}

}  // namespace
}  // namespace linkstudy::testing::distribution_test

// The engine's own elementary functions against the 64-bit significands of the C library's long
// double.
#include "core/base/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/support/random.h"

namespace linkstudy::testing::elementary_test {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the reference needs guard bits");

// Distance from the exact value in units in the last place of a double of that size.
double ulps(double actual, long double exact) {
  const double size = std::fabs(static_cast<double>(exact));
  const double unit = std::nextafter(size, std::numeric_limits<double>::infinity()) - size;
  return static_cast<double>(std::fabs(actual - exact) / unit);
}

double worst_ulps(double x) {
  const SinCos<double> y = sincos(x);
  const long double exact = x;
  return std::max(ulps(y.sin, std::sin(exact)), ulps(y.cos, std::cos(exact)));
}

constexpr double kDocumented = 1.5;

}  // namespace

TEST(Elementary, Sine_and_cosine_of_random_angles_stay_within_the_documented_error) {
  Random random(1);
  for (const double reach : {1e-3, 0.7854, 4.0, 100.0, 1e4, 1e6}) {
    double worst = 0.0;
    for (int k = 0; k < 200000; ++k) worst = std::max(worst, worst_ulps(random.within(reach)));
    EXPECT_LT(worst, kDocumented) << "|x| < " << reach;
  }
}

TEST(Elementary, The_angle_of_a_quadrant_stays_within_the_documented_error) {
  Random random(7);
  double worst = 0.0;
  for (const double reach : {1e-300, 1e-9, 0.1, 1.0, 3.0, 1e3, 1e12}) {
    for (int k = 0; k < 100000; ++k) {
      const double y = reach * std::fabs(random.within(1.0)), x = std::fabs(random.within(1.0));
      if (x == 0.0) continue;
      const long double exact = std::atan2(static_cast<long double>(y), x);
      worst = std::max(worst, ulps(quadrant_angle(y, x), exact));
    }
  }
  EXPECT_LT(worst, 2.0);
  EXPECT_EQ(quadrant_angle(0.0, 1.0), 0.0);
  EXPECT_EQ(quadrant_angle(1.0, 0.0), M_PI / 2);
  EXPECT_EQ(quadrant_angle(1.0, 1.0), M_PI / 4);
}

TEST(Elementary, The_exponential_stays_within_the_documented_error_over_its_whole_range) {
  Random random(2);
  double worst = 0.0;
  for (const double reach : {1e-12, 1e-3, 0.4, 1.0, 30.0, 707.9}) {
    for (int k = 0; k < 200000; ++k) {
      const double x = random.within(reach);
      worst = std::max(worst, ulps(linkstudy::exp(x), std::exp(static_cast<long double>(x))));
    }
  }
  EXPECT_LT(worst, 1.0);
}

TEST(Elementary, The_exponential_ends_in_zero_infinity_and_no_number) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(linkstudy::exp(0.0), 1.0);
  const double most = 709.78271289338397;
  EXPECT_LT(ulps(linkstudy::exp(most), std::exp(static_cast<long double>(most))), 1.0);
  EXPECT_EQ(linkstudy::exp(709.79), infinity);
  EXPECT_EQ(linkstudy::exp(infinity), infinity);
  EXPECT_EQ(linkstudy::exp(-708.01), 0.0);
  EXPECT_EQ(linkstudy::exp(-infinity), 0.0);
  EXPECT_TRUE(std::isnan(linkstudy::exp(std::nan(""))));
}

TEST(Elementary,
     The_logarithm_stays_within_the_documented_error_from_the_least_number_to_the_most) {
  Random random(3);
  double worst = 0.0;
  const auto look = [&](double x) {
    worst = std::max(worst, ulps(linkstudy::log(x), std::log(static_cast<long double>(x))));
  };
  for (int k = 0; k < 400000; ++k) {
    look(std::ldexp(1.5 + random.within(0.5), random.below(2046) - 1022));
    look(1.0 + random.within(0.5));
    look(1.0 + random.within(1e-4));
    look(1.4142135623730951 + random.within(1e-3));  // both sides of the fraction's change
    look(0.70710678118654757 + random.within(1e-3));
  }
  EXPECT_LT(worst, 1.0);
}

TEST(Elementary, The_logarithm_is_exact_at_one_and_symmetric_over_powers_of_two) {
  EXPECT_EQ(linkstudy::log(1.0), 0.0);
  for (int k = 1; k < 1022; ++k) {
    EXPECT_EQ(linkstudy::log(std::ldexp(1.0, k)), -linkstudy::log(std::ldexp(1.0, -k))) << k;
  }
}

TEST(Elementary, The_logarithm_ends_in_infinities_and_no_number) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(linkstudy::log(0.0), -infinity);
  EXPECT_EQ(linkstudy::log(-0.0), -infinity);
  EXPECT_EQ(linkstudy::log(infinity), infinity);
  for (const double x : {-1e-300, -1.0, -infinity, std::nan("")}) {
    EXPECT_TRUE(std::isnan(linkstudy::log(x))) << x;
  }
  const double least = std::numeric_limits<double>::min();
  EXPECT_LT(ulps(linkstudy::log(least), std::log(static_cast<long double>(least))), 1.0);
  const double most = std::numeric_limits<double>::max();
  EXPECT_LT(ulps(linkstudy::log(most), std::log(static_cast<long double>(most))), 1.0);
}

TEST(Elementary, A_power_is_as_exact_as_its_logarithm_is_small) {
  Random random(4);
  for (int k = 0; k < 200000; ++k) {
    const double x = std::ldexp(1.5 + random.within(0.5), random.below(60) - 50);
    const double n = 1.75 + random.within(1.75);
    const long double exact = std::pow(static_cast<long double>(x), static_cast<long double>(n));
    const double bound = (1.0 + std::fabs(n * std::log(x))) * 0x1p-52;
    ASSERT_LE(std::fabs(static_cast<double>(linkstudy::power(x, n) / exact - 1.0L)), bound)
        << x << "^" << n;
  }
}

TEST(Elementary, No_power_of_zero_or_less_is_anything_but_zero) {
  for (const double x : {0.0, -0.0, -1e-9, -3.0, std::nan("")}) {
    for (const double n : {0.5, 1.0, 1.5, 2.2}) EXPECT_EQ(linkstudy::power(x, n), 0.0) << x;
  }
  EXPECT_EQ(linkstudy::power(1.0, 2.2), 1.0);
}

TEST(Elementary, Sine_and_cosine_beside_multiples_of_a_quarter_turn_lose_no_digits) {
  double worst = 0.0;
  for (long k = -636000; k <= 636000; k += (std::labs(k) < 2000 ? 1 : 97)) {
    const double x = static_cast<double>(static_cast<long double>(k) * 1.57079632679489661923L);
    double left = x, right = x;
    for (int j = 0; j < 3; ++j) {
      worst = std::max({worst, worst_ulps(left), worst_ulps(right)});
      left = std::nextafter(left, -1e9);
      right = std::nextafter(right, 1e9);
    }
  }
  EXPECT_LT(worst, kDocumented);
}

TEST(Elementary, Sine_and_cosine_beside_odd_eighths_of_a_turn_change_the_quadrant_cleanly) {
  double worst = 0.0;
  for (long k = -4001; k <= 4001; k += 2) {
    const double x = static_cast<double>(static_cast<long double>(k) * 0.785398163397448309616L);
    for (const double y : {std::nextafter(x, -1e9), x, std::nextafter(x, 1e9)}) {
      worst = std::max(worst, worst_ulps(y));
    }
  }
  EXPECT_LT(worst, kDocumented);
}

TEST(Elementary, Sine_is_odd_and_cosine_even_to_the_last_bit) {
  Random random(2);
  for (int k = 0; k < 100000; ++k) {
    const double x = random.within(1e5);
    const SinCos<double> plus = sincos(x), minus = sincos(-x);
    ASSERT_EQ(plus.sin, -minus.sin) << x;
    ASSERT_EQ(plus.cos, minus.cos) << x;
  }
}

TEST(Elementary, Zero_has_the_exact_sine_and_cosine) {
  EXPECT_EQ(sincos(0.0).sin, 0.0);
  EXPECT_EQ(sincos(0.0).cos, 1.0);
}

TEST(Elementary, An_infinite_or_undefined_angle_gives_no_finite_number) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {inf, -inf, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_FALSE(std::isfinite(sincos(x).sin));
    EXPECT_FALSE(std::isfinite(sincos(x).cos));
  }
}

}  // namespace linkstudy::testing::elementary_test

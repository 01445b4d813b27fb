// Truth: decimal literals, which the compiler rounds correctly, and the formulas in the header.
#include "study/record/sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace linkstudy::sequence_test {
namespace {

using Numbers = std::vector<double>;

TEST(Linspace, Has_the_bits_of_the_decimals_a_person_would_write) {
  EXPECT_EQ(linspace(0.0, 1.0, 11),
            (Numbers{0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}));
  EXPECT_EQ(linspace(5.0, 1.0, 5), (Numbers{5.0, 4.0, 3.0, 2.0, 1.0}));
}

TEST(Linspace, Keeps_awkward_ends_bit_for_bit) {
  const double from = 0.1 + 0.2, to = std::nextafter(1.7, 2.0);
  for (const std::size_t count : {2u, 3u, 7u, 1000u}) {
    EXPECT_EQ(linspace(from, to, count).front(), from);
    EXPECT_EQ(linspace(from, to, count).back(), to);
    EXPECT_EQ(linspace(from, to, count).size(), count);
  }
}

TEST(Linspace, Does_not_overflow_between_huge_ends) {
  const double huge = std::numeric_limits<double>::max();
  EXPECT_EQ(linspace(-huge, huge, 3), (Numbers{-huge, 0.0, huge}));
  EXPECT_TRUE(std::isfinite(linspace(huge, huge / 2, 4)[1]));
}

TEST(Logspace, Meets_every_whole_decade_exactly) {
  EXPECT_EQ(logspace(1e4, 1e8, 5), (Numbers{1e4, 1e5, 1e6, 1e7, 1e8}));
  EXPECT_EQ(logspace(1e-6, 1e-2, 5), (Numbers{1e-6, 1e-5, 1e-4, 1e-3, 1e-2}));
  EXPECT_EQ(logspace(2e-3, 2e-7, 5), (Numbers{2e-3, 2e-4, 2e-5, 2e-6, 2e-7}));
  const Numbers halves = logspace(1e3, 1e8, 11);
  for (std::size_t i = 0; i < 6; ++i)
    EXPECT_EQ(halves[2 * i], (Numbers{1e3, 1e4, 1e5, 1e6, 1e7, 1e8})[i]);
  EXPECT_DOUBLE_EQ(halves[1], 3162.2776601683793);  // 1e3 sqrt(10)
}

TEST(Logspace, Has_equal_ratios_and_exact_ends_when_the_span_is_no_whole_decade) {
  const Numbers values = logspace(3.7, 91.3, 9);
  EXPECT_EQ(values.front(), 3.7);
  EXPECT_EQ(values.back(), 91.3);
  const double ratio = std::pow(91.3 / 3.7, 1.0 / 8.0);
  // Three roundings of half a unit in the last place each.
  for (std::size_t i = 1; i < values.size(); ++i)
    EXPECT_NEAR(values[i] / values[i - 1] / ratio, 1.0, 1e-15 * 4);
  EXPECT_EQ(logspace(1.0, 16.0, 5), (Numbers{1.0, 2.0, 4.0, 8.0, 16.0}));
}

TEST(Logspace, Spans_the_whole_range_of_a_double) {
  const Numbers values = logspace(1e-300, 3e300, 4);
  for (std::size_t i = 1; i < values.size(); ++i) EXPECT_GT(values[i], values[i - 1]);
  EXPECT_EQ(values.back(), 3e300);
}

TEST(Ladder, Multiplies_by_its_ratio) {
  EXPECT_EQ(ladder(1e-3, 0.5, 4), (Numbers{1e-3, 5e-4, 2.5e-4, 1.25e-4}));
  EXPECT_EQ(ladder(1e-6, 10.0, 4), (Numbers{1e-6, 1e-5, 1e-4, 1e-3}));
  EXPECT_EQ(ladder(3e-2, 0.1, 4), (Numbers{3e-2, 3e-3, 3e-4, 3e-5}));
  EXPECT_EQ(ladder(-1.0, 3.0, 3), (Numbers{-1.0, -3.0, -9.0}));
  EXPECT_EQ(ladder(7.0, 2.0, 1), (Numbers{7.0}));
}

TEST(Shift_decimal, Moves_the_point_and_nothing_else) {
  EXPECT_EQ(shift_decimal(1.23456789e-5, 7), 123.456789);
  EXPECT_EQ(shift_decimal(-4.2, -3), -0.0042);
  EXPECT_EQ(shift_decimal(1e300, 20), std::numeric_limits<double>::infinity());
  EXPECT_EQ(shift_decimal(-1e-300, -100), 0.0);
  EXPECT_EQ(shift_decimal(0.0, 5), 0.0);
}

TEST(Sequences, Refuse_what_they_cannot_hold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_THROW(linspace(0, 1, 0), std::invalid_argument);
  EXPECT_THROW(linspace(0, 1, 1), std::invalid_argument);
  EXPECT_THROW(linspace(nan, 1, 3), std::invalid_argument);
  EXPECT_THROW(linspace(0, infinity, 3), std::invalid_argument);
  EXPECT_THROW(linspace(0, 1, kMaxPoints + 1), std::invalid_argument);
  EXPECT_THROW(logspace(0, 1, 3), std::invalid_argument);
  EXPECT_THROW(logspace(-1, -10, 3), std::invalid_argument);
  EXPECT_THROW(ladder(0, 2, 3), std::invalid_argument);
  EXPECT_THROW(ladder(1, 1, 3), std::invalid_argument);
  EXPECT_THROW(ladder(1, -2, 3), std::invalid_argument);
  EXPECT_THROW(ladder(1, 2, 0), std::invalid_argument);
  EXPECT_THROW(ladder(1, 10, 400), std::invalid_argument);
  EXPECT_THROW(ladder(1, 0.5, 1200), std::invalid_argument);
}

TEST(Sequences, Of_one_value_are_that_value) {
  EXPECT_EQ(linspace(2.5, 2.5, 1), Numbers{2.5});
  EXPECT_EQ(logspace(2.5, 2.5, 1), Numbers{2.5});
  EXPECT_EQ(logspace(2.5, 2.5, 3), (Numbers{2.5, 2.5, 2.5}));
}

}  // namespace
}  // namespace linkstudy::sequence_test

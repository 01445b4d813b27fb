// Roots of functions with known zeros.
#include "core/numerics/bracketed_root.h"

#include <gtest/gtest.h>

#include <cmath>

namespace linkstudy::testing::bracketed_root_test {

TEST(BracketedRoot, It_is_found_to_rounding_with_the_signs_of_the_ends_kept) {
  int calls = 0;
  const auto f = [&calls](double x) {
    ++calls;
    return std::cos(x) - x;
  };
  const Bracket b = bracket_root(f, 0.0, 2.0, f(0.0), f(2.0));
  EXPECT_NEAR(b.first, 0.7390851332151607, 2e-15);
  EXPECT_NEAR(b.second, 0.7390851332151607, 2e-15);
  EXPECT_GE(f(b.first), 0.0);
  EXPECT_LE(f(b.second), 0.0);
  EXPECT_LT(calls, 20);
}

TEST(BracketedRoot, Flat_and_steep_crossings_are_found_too) {
  const auto flat = [](double x) { return std::pow(x - 5.3, 3); };
  EXPECT_NEAR(bracket_root(flat, 5.0, 6.0, flat(5.0), flat(6.0)).first, 5.3, 1e-5);
  const auto jump = [](double x) { return x < 5.3 ? -1e-9 : 1e5; };
  const Bracket b = bracket_root(jump, 5.0, 6.0, -1e-9, 1e5);
  EXPECT_NEAR(b.first, 5.3, 1e-14);
  EXPECT_NEAR(b.second, 5.3, 1e-14);
}

TEST(BracketedRoot, A_zero_at_an_end_is_that_end_and_equal_signs_are_left_alone) {
  const auto f = [](double x) { return x * x - 4.0; };
  EXPECT_EQ(bracket_root(f, 2.0, 3.0, f(2.0), f(3.0)).second, 2.0);
  EXPECT_EQ(bracket_root(f, 1.0, 2.0, f(1.0), f(2.0)).first, 2.0);
  const Bracket none = bracket_root(f, 3.0, 5.0, f(3.0), f(5.0));
  EXPECT_EQ(none.first, 3.0);
  EXPECT_EQ(none.second, 5.0);
}

}  // namespace linkstudy::testing::bracketed_root_test

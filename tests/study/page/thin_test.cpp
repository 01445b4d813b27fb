// Samples that a drawing keeps of a long history.
#include "study/page/thin.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "study/record/base64.h"

namespace linkstudy::testing::thin_test {
namespace {

std::vector<double> noise_with_peaks(std::size_t n, std::size_t low, std::size_t high) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::vector<double> values(n);
  for (double& value : values) value = unit(random);
  values[low] = -50.0;
  values[high] = 80.0;
  return values;
}

TEST(Thin, Short_histories_stay_whole) {
  EXPECT_EQ(thin_rows(std::vector{3.0, 1.0, 2.0}, 3), (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_TRUE(thin_rows({}, 10).empty());
}

TEST(Thin, Ends_and_extremes_stay_wherever_they_lie) {
  for (std::size_t at = 1; at < 9000; at += 731) {
    const std::vector<double> values = noise_with_peaks(10000, at, 9999 - at);
    const std::vector<std::uint32_t> rows = thin_rows(values, 500);
    EXPECT_TRUE(std::ranges::is_sorted(rows));
    EXPECT_EQ(std::ranges::adjacent_find(rows), rows.end()) << "a row twice";
    EXPECT_LE(rows.size(), 502U);
    EXPECT_EQ(rows.front(), 0U);
    EXPECT_EQ(rows.back(), 9999U);
    EXPECT_TRUE(std::ranges::binary_search(rows, at));
    EXPECT_TRUE(std::ranges::binary_search(rows, 9999 - at));
  }
}

TEST(Thin, The_extremes_of_every_stretch_stay) {
  const std::vector<double> values = noise_with_peaks(12000, 5, 6);
  const std::vector<std::uint32_t> rows = thin_rows(values, 400);
  for (std::size_t begin = 0; begin < values.size(); begin += 60) {
    const auto first = values.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto [least, greatest] = std::minmax_element(first, first + 60);
    EXPECT_TRUE(std::ranges::binary_search(rows, least - values.begin()));
    EXPECT_TRUE(std::ranges::binary_search(rows, greatest - values.begin()));
  }
}

TEST(Thin, Missing_values_hide_no_extreme) {
  std::vector<double> values(1000, std::numeric_limits<double>::quiet_NaN());
  values[503] = 2.0;
  values[504] = 1.0;
  const std::vector<std::uint32_t> rows = thin_rows(values, 20);
  EXPECT_TRUE(std::ranges::binary_search(rows, 503U));
  EXPECT_TRUE(std::ranges::binary_search(rows, 504U));
}

TEST(EvenRows, Hold_both_ends_and_no_more_than_one_beyond_what_is_wanted) {
  EXPECT_TRUE(even_rows(0, 5).empty());
  EXPECT_EQ(even_rows(4, 5), (std::vector<std::size_t>{0, 1, 2, 3}));
  EXPECT_EQ(even_rows(11, 5), (std::vector<std::size_t>{0, 3, 6, 9, 10}));
  EXPECT_EQ(even_rows(10, 5), (std::vector<std::size_t>{0, 2, 4, 6, 8, 9}));
}

TEST(Base64, Is_that_of_rfc_4648) {  // its section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

TEST(Base64, Numbers_are_little_endian_and_of_32_bits) {
  EXPECT_EQ(base64_floats(std::vector{1.0, -2.0}),
            base64(std::string("\0\0\x80\x3f\0\0\0\xc0", 8)));
  EXPECT_EQ(base64_indices(std::vector<std::uint32_t>{258}), base64(std::string("\2\1\0\0", 4)));
  EXPECT_EQ(base64_floats(std::vector{1e300}), base64(std::string("\0\0\x80\x7f", 4)));
}

}  // namespace
}  // namespace linkstudy::testing::thin_test

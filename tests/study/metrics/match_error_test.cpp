#include "study/metrics/match_error.h"

#include <gmock/gmock.h>

#include <cmath>

#include "study/metrics/invalid_point.h"

namespace linkstudy::match_error_test {
namespace {

// A reference of three components over 101 steps of 0.01 s: 3 sin t, 4 sin t and 1e-3, so that the
// largest is known in closed form.
Series make_reference() {
  Series series;
  const char* names[] = {"closure.S.force.x", "closure.S.force.y", "closure.S.force.z"};
  for (int i = 0; i < 3; ++i) {
    series.channels.push_back({names[i], "N", Quantity::closure_force, 0, i});
  }
  series.sampling = {0, 100, 1};
  for (int step = 0; step <= 100; ++step) {
    const double s = std::sin(0.01 * step);
    series.values.insert(series.values.end(), {3.0 * s, 4.0 * s, 1e-3});
  }
  return series;
}

constexpr StepGrid kGrid{100, 0.01};

class MatchErrors : public ::testing::Test {
 protected:
  // Errors when every sample differs from the reference by `offset`.
  std::vector<double> reduce(double offset) const {
    const Series reference = make_reference();
    const MatchError error(match_, reference.channels, kGrid, reference, kGrid);
    Comparison comparison = error.make_comparison();
    comparison.seen = comparison.sampling.count();
    comparison.max_error.assign(3, offset);
    comparison.square_error.assign(3, offset * offset * total_weight(comparison.sampling, {}));
    return error.reduce(comparison);
  }

  MatchInput match_;
};

TEST_F(MatchErrors, Are_relative_to_the_largest_value_of_each_component) {
  match_.floor = 0.0;
  const std::vector<double> errors = reduce(0.1);
  ASSERT_EQ(errors.size(), 6u);
  EXPECT_NEAR(errors[0], 0.1 / (3.0 * std::sin(1.0)), 1e-15);
  EXPECT_NEAR(errors[1], 0.1 / (4.0 * std::sin(1.0)), 1e-15);
  EXPECT_NEAR(errors[2], 100.0, 1e-12);
  EXPECT_NEAR(errors[5], 100.0, 1e-10);  // the third is constant: its rms is its size
}

TEST_F(MatchErrors, Scale_a_component_that_is_nearly_zero_by_the_floor) {
  match_.floor = 0.05;
  const std::vector<double> errors = reduce(0.1);
  EXPECT_NEAR(errors[2], 0.1 / (0.05 * 4.0 * std::sin(1.0)), 1e-13);
  EXPECT_NEAR(errors[5], errors[4] / 0.05, 1e-12);
  EXPECT_NEAR(errors[4], errors[3] * 3.0 / 4.0, 1e-15);
}

TEST_F(MatchErrors, Of_scale_vector_are_relative_to_the_longest_vector) {
  match_.scale = ErrorScale::vector;
  const std::vector<double> errors = reduce(0.1);
  const double longest = std::sqrt(25.0 * std::sin(1.0) * std::sin(1.0) + 1e-6);
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(errors[static_cast<std::size_t>(i)], 0.1 / longest, 1e-15);
  EXPECT_EQ(errors[3], errors[5]);
}

TEST_F(MatchErrors, See_only_the_window) {
  match_.window = TimeWindow{0.0, 0.5};
  match_.floor = 0.0;
  EXPECT_NEAR(reduce(0.1)[0], 0.1 / (3.0 * std::sin(0.5)), 1e-15);
}

TEST_F(MatchErrors, Are_zero_or_infinite_where_the_reference_is_zero) {
  Series reference = make_reference();
  reference.values.assign(reference.values.size(), 0.0);
  const MatchError error(match_, reference.channels, kGrid, reference, kGrid);
  Comparison comparison = error.make_comparison();
  comparison.seen = 100;
  comparison.max_error = {0.0, 1e-9, 0.0};
  comparison.square_error = {0.0, 1e-18, 0.0};
  const std::vector<double> errors = error.reduce(comparison);
  EXPECT_EQ(errors[0], 0.0);
  EXPECT_TRUE(std::isinf(errors[1]));
}

TEST_F(MatchErrors, Pick_the_common_instants_of_a_coarser_case) {
  const Series reference = make_reference();
  match_.window = TimeWindow{0.04, 1.0};
  const MatchError error(match_, reference.channels, StepGrid{50, 0.02}, reference, kGrid);
  const Comparison comparison = error.make_comparison();
  ASSERT_EQ(comparison.sampling.begin, 2);
  EXPECT_EQ(comparison.sampling.count(), 49);
  EXPECT_EQ(comparison.reference[0], 3.0 * std::sin(0.01 * 4));
  EXPECT_EQ(comparison.reference[3], 3.0 * std::sin(0.01 * 6));
}

TEST_F(MatchErrors, Say_what_cannot_be_compared) {
  const Series reference = make_reference();
  EXPECT_THROW(MatchError(match_, reference.channels, StepGrid{97, 1.0 / 97.003}, reference, kGrid),
               InvalidPoint);
  EXPECT_THROW(MatchError(match_, reference.channels, StepGrid{200, 0.01}, reference, kGrid),
               InvalidPoint);
  match_.window = TimeWindow{0.011, 0.019};
  EXPECT_THROW(MatchError(match_, reference.channels, kGrid, reference, kGrid), InvalidPoint);
}

}  // namespace
}  // namespace linkstudy::match_error_test

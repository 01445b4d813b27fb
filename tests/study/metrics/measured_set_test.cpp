#include "study/metrics/measured_set.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/metrics/invalid_point.h"

namespace linkstudy::measured_set_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr StepGrid kGrid{100, 0.01};
constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

const std::vector<Channel> kChannels = {{"joint.A.q", "rad", Quantity::q},
                                        {"closure.S.force.x", "N", Quantity::closure_force}};

// q = t^2 and F = 3 t at the steps that are kept.
Series sampled(const Sampling& sampling) {
  Series series{kChannels, sampling, {}};
  for (long step = sampling.begin; step <= sampling.end; step += sampling.stride) {
    const double t = 0.01 * static_cast<double>(step);
    series.values.insert(series.values.end(), {t * t, 3.0 * t});
  }
  return series;
}

MeasuredData data(std::vector<double> times, std::vector<double> q, std::vector<double> force) {
  return {std::move(times),
          {{"joint.A.q", {}, {}, std::move(q)}, {"closure.S.force.x", {}, {}, std::move(force)}},
          ""};
}

MeasuredSet make(const MeasuredInput& input, const MeasuredData& data) {
  Diagnostics diagnostics;
  MeasuredSet set = make_measured_set(input, data, kChannels, diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  return set;
}

SigmaInput sigma(const std::string& signal, const std::string& text) {
  return {signal, Tree::make_text(text), {}};
}

TEST(MeasuredSet, leaves_out_missing_samples_and_those_outside_the_window) {
  MeasuredInput input;
  input.window = TimeWindow{0.2, 0.5};
  const MeasuredSet set =
      make(input, data({0.1, 0.2, 0.4, 0.5, 0.6}, {1, kMissing, 3, 4, 5}, {1, 2, 3, kMissing, 5}));
  EXPECT_THAT(set.signals[0].times, ElementsAre(0.4, 0.5));
  EXPECT_THAT(set.signals[1].values, ElementsAre(2.0, 3.0));
  EXPECT_EQ(4u, set.sample_count());
}

// Between steps a straight line: (0.12^2 + 0.13^2) / 2 at 0.125 s; on steps the value itself.
TEST(MeasuredSet, takes_simulated_values_from_the_line_between_two_steps) {
  const MeasuredSet set = make({}, data({0.12, 0.125}, {0.0, 0.0}, {0.0, 0.36}));
  for (const bool is_dense : {false, true}) {
    const InstantSampler sampler(set, 0.0, kGrid, is_dense);
    EXPECT_THAT(sampler.residuals(set, sampled(sampler.sampling())),
                ElementsAre(DoubleNear(0.0144, 1e-15), DoubleNear(0.01565, 1e-15),
                            DoubleNear(0.36, 1e-15), DoubleNear(0.015, 1e-15)));
  }
}

TEST(MeasuredSet, keeps_no_more_steps_than_its_instants_need) {
  const MeasuredSet set = make({}, data({0.10, 0.16, 0.30}, {0, 0, 0}, {0, kMissing, 0}));
  const Sampling sampling = InstantSampler(set, 0.04, kGrid, false).sampling();
  EXPECT_EQ(14, sampling.begin);
  EXPECT_EQ(34, sampling.end);
  EXPECT_EQ(2, sampling.stride);
}

TEST(MeasuredSet, divides_by_the_sigma_that_names_a_channel_most_exactly) {
  MeasuredInput input;
  input.sigma = {sigma("closure.S.force", "5 N"), sigma("closure.S.force.x", "500 mN"),
                 sigma("joint.A.q", "1 deg")};
  const MeasuredSet set = make(input, data({0.5}, {0.0}, {1.0}));
  EXPECT_EQ(0.5, set.signals[1].sigma);
  EXPECT_DOUBLE_EQ(std::acos(-1.0) / 180.0, set.signals[0].sigma);
  const InstantSampler sampler(set, 0.0, kGrid, false);
  EXPECT_THAT(sampler.residuals(set, sampled(sampler.sampling())).at(1), DoubleNear(1.0, 1e-14));
}

TEST(MeasuredSet, must_be_reached_by_the_run) {
  const MeasuredSet set = make({}, data({0.5, 1.0}, {0, 0}, {0, 0}));
  EXPECT_NO_THROW(InstantSampler(set, 0.0, kGrid, false));
  EXPECT_THROW(InstantSampler(set, 0.001, kGrid, false), InvalidPoint);
  EXPECT_THROW(InstantSampler(set, -0.51, kGrid, false), InvalidPoint);
  Diagnostics diagnostics;
  check_instants({}, set, 0.9, diagnostics);
  EXPECT_THAT(to_string(diagnostics), HasSubstr("the data reach from 0.5 s to 1 s"));
  const OffsetRange range = offset_range(set, 1.02);
  EXPECT_DOUBLE_EQ(-0.05, range.low);
  EXPECT_NEAR(0.02, range.high, 1e-15);
}

TEST(MeasuredSet, needs_weights_where_units_differ) {
  const MeasuredSet set = make({}, data({0.5}, {0.0}, {1.0}));
  Diagnostics diagnostics;
  require_one_unit({&set}, diagnostics);
  EXPECT_THAT(to_string(diagnostics), HasSubstr("has no sigma"));
}

TEST(MeasuredSet, refuses_channels_that_are_not_there_and_units_of_another_kind) {
  MeasuredData wrong = data({0.5}, {0.0}, {1.0});
  wrong.channels[0].channel = "joint.B.q";
  wrong.channels[1].unit = parse_unit("mm");
  Diagnostics diagnostics;
  make_measured_set({}, wrong, kChannels, diagnostics);
  EXPECT_THAT(to_string(diagnostics), HasSubstr("there is no channel 'joint.B.q'"));
  EXPECT_THAT(to_string(diagnostics), HasSubstr("is in N, and its column in m"));
}

}  // namespace
}  // namespace linkstudy::measured_set_test

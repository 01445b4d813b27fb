// Errors against measured samples: by hand, against those of a run that kept the same samples, and
// what data and matches must have of each other.
#include "study/metrics/measured_match.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "study/metrics/invalid_point.h"

namespace linkstudy::measured_match_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr StepGrid kSteps{100, 0.01};
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr double kRounding = 1e-14;  // of a few operations on numbers below 2

const std::vector<Channel> kForce = {{"closure.S.force.x", "N", Quantity::closure_force, 0, 0},
                                     {"closure.S.force.y", "N", Quantity::closure_force, 0, 1}};

// 3 t and t^2 at the steps that are kept.
Series course(const Sampling& sampling) {
  Series series{kForce, sampling, {}};
  for (long step = sampling.begin; step <= sampling.end; step += sampling.stride) {
    const double t = 0.01 * static_cast<double>(step);
    series.values.insert(series.values.end(), {3.0 * t, t * t});
  }
  return series;
}

class MeasuredMatches : public ::testing::Test {
 protected:
  MeasuredMatches() {
    input_.match.emplace_back();
    match().signal = match().reference_signal = "closure.S.force";
    match().floor = 0.0;
    measured_.file = "force.csv";
  }

  MatchInput& match() { return input_.match.front(); }

  void set_data(std::vector<double> times, std::vector<double> x, std::vector<double> y,
                const std::string& signal = "closure.S.force") {
    measured_.data = std::make_shared<MeasuredData>(
        MeasuredData{std::move(times),
                     {{signal + ".x", {}, {}, std::move(x)}, {signal + ".y", {}, {}, std::move(y)}},
                     ""});
  }

  MeasuredReference make(const std::vector<Channel>& channels = kForce) {
    StudySignals signals;
    signals.match = {channels};
    return make_measured_reference(input_, measured_, signals, diagnostics_);
  }

  std::vector<double> errors() {
    const MeasuredReference reference = make();
    EXPECT_TRUE(diagnostics_.empty()) << to_string(diagnostics_);
    const MeasuredMatch errors(reference, 0, kSteps);
    return errors.reduce(course(errors.sampling()));
  }

  StudyInput input_;
  MeasuredInput measured_;
  Diagnostics diagnostics_;
};

// x: errors 0.1, 0.125, 0.5 at 0.1, 0.125, 0.5 s, which weigh 0.0125, 0.2, 0.1875 s.
// y: at 0.125 s the line between the steps has (0.12^2 + 0.13^2) / 2 = 0.01565.
TEST_F(MeasuredMatches, Weigh_each_component_by_its_own_instants) {
  set_data({0.1, 0.125, 0.2, 0.5}, {0.2, 0.5, kNothing, 1.0}, {kNothing, 0.02, 0.05, kNothing});
  const double y_error = std::sqrt((0.00435 * 0.00435 + 0.01 * 0.01) / 2.0);
  EXPECT_THAT(errors(), ElementsAre(DoubleNear(0.5, kRounding), DoubleNear(0.2, kRounding),
                                    DoubleNear(std::sqrt(0.1253125 / 0.595), kRounding),
                                    DoubleNear(y_error / std::sqrt(0.00145), kRounding)));
  match().scale = ErrorScale::vector;  // longest: 1 at 0.5 s, where x alone was measured
  const double scale = std::sqrt(0.595 + 0.00145);
  EXPECT_THAT(errors(), ElementsAre(DoubleNear(0.5, kRounding), DoubleNear(0.01, kRounding),
                                    DoubleNear(std::sqrt(0.1253125) / scale, kRounding),
                                    DoubleNear(y_error / scale, kRounding)));
}

// A run that kept the same numbers at every second step is the same reference.
TEST_F(MeasuredMatches, Have_the_errors_of_a_run_with_the_same_samples) {
  constexpr StepGrid kCoarse{50, 0.02};
  Series kept{kForce, {0, 50, 1}, {}};
  std::vector<double> times, x, y;
  for (int i = 0; i <= 50; ++i) {
    times.push_back(0.02 * i);
    x.push_back(std::sin(3.0 * times.back()));
    y.push_back(0.1 + std::cos(5.0 * times.back()));
    kept.values.insert(kept.values.end(), {x.back(), y.back()});
  }
  set_data(times, x, y);
  for (const bool has_window : {false, true}) {
    if (has_window) match().window = TimeWindow{0.1 + 0.2, 0.7, {}};
    for (const ErrorScale scale : {ErrorScale::component, ErrorScale::vector}) {
      match().scale = scale;
      const MatchError by_run(match(), kForce, kSteps, kept, kCoarse);
      Comparison seen = by_run.make_comparison();
      const Series simulated = course(seen.sampling);
      seen.max_error.assign(2, 0.0);
      seen.square_error.assign(2, 0.0);
      for (long k = 0; k < seen.sampling.count(); ++k) {
        const long step = seen.sampling.begin + k * seen.sampling.stride;
        for (std::size_t c = 0; c < 2; ++c) {
          const std::size_t at = 2 * static_cast<std::size_t>(k) + c;
          const double error = std::abs(simulated.values[at] - seen.reference[at]);
          seen.max_error[c] = std::max(seen.max_error[c], error);
          seen.square_error[c] += time_weight(seen.sampling, {}, step) * error * error;
        }
      }
      const std::vector<double> expected = by_run.reduce(seen);
      const std::vector<double> found = errors();
      ASSERT_EQ(4u, found.size());
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(expected[i], found[i], 1e-13) << i;
    }
  }
}

TEST_F(MeasuredMatches, Turn_signs_and_shift_instants_where_they_are_asked_to) {
  match().reference_signal = "rig.force";
  match().reference_sign = -1.0;
  measured_.time_offset = 0.2;
  set_data({-0.2, 0.0, 0.1}, {7.0, -0.6, -0.8}, {7.0, -0.04, -0.09}, "rig.force");
  // The first is the start of the run and does not count; then 0.6 and 0.8 at 0.2 and 0.3 s.
  EXPECT_THAT(errors(), ElementsAre(DoubleNear(0.1 / 0.8, kRounding), DoubleNear(0.0, kRounding),
                                    DoubleNear(std::sqrt(0.01 / (0.36 + 0.64)), kRounding),
                                    DoubleNear(0.0, kRounding)));
  const MeasuredReference reference = make();
  ASSERT_EQ(3u, reference.traces.size());
  EXPECT_EQ("rig.force.y", reference.traces[2].name);
  EXPECT_EQ("N", reference.traces[2].unit);
  EXPECT_THAT(reference.traces[0].values, ElementsAre(DoubleNear(0.2, 1e-15), 0.1 + 0.2));
  EXPECT_THAT(reference.traces[1].values, ElementsAre(-0.6, -0.8));  // as measured
}

TEST_F(MeasuredMatches, Are_infinite_where_something_differs_from_a_zero) {
  match().window = TimeWindow{0.0, 1.0, {}};
  set_data({0.0, 0.5}, {0.0, 0.0}, {0.0, 0.25});
  EXPECT_THAT(errors(), ElementsAre(std::numeric_limits<double>::infinity(), 0.0,
                                    std::numeric_limits<double>::infinity(), 0.0));
}

TEST_F(MeasuredMatches, Say_which_components_were_measured) {
  set_data({0.1}, {1.0}, {1.0});
  std::vector<Channel> three = kForce;
  three.push_back({"closure.S.force.z", "N", Quantity::closure_force, 0, 2});
  make(three);
  EXPECT_THAT(to_string(diagnostics_),
              HasSubstr("'closure.S.force' compares closure.S.force.z, which 'force.csv' does not "
                        "have as a column"));
  EXPECT_THAT(to_string(diagnostics_),
              HasSubstr("measured are: closure.S.force.x, closure.S.force.y"));
}

TEST_F(MeasuredMatches, Refuse_columns_that_nothing_compares_and_windows_without_a_sample) {
  set_data({0.1, 0.2}, {1.0, 1.0}, {1.0, kNothing});
  match().signal = match().reference_signal = "closure.S.force.y";
  match().window = TimeWindow{0.15, 0.25, {}};
  make({kForce[1]});
  EXPECT_EQ(2u, diagnostics_.size());
  EXPECT_THAT(to_string(diagnostics_), HasSubstr("no [[match]] compares 'closure.S.force.x'"));
  EXPECT_THAT(to_string(diagnostics_),
              HasSubstr("'closure.S.force.y' was not measured inside the window"));
}

TEST_F(MeasuredMatches, Refuse_a_column_of_another_dimension) {
  set_data({0.1}, {1.0}, {1.0});
  auto data = std::make_shared<MeasuredData>(*measured_.data);
  data->channels[0].unit = parse_unit("mm");
  measured_.data = data;
  make();
  EXPECT_THAT(to_string(diagnostics_), HasSubstr("'closure.S.force.x' is in N"));
}

TEST_F(MeasuredMatches, Throw_where_a_run_does_not_reach_an_instant) {
  set_data({0.5, 1.001}, {1.0, 1.0}, {1.0, 1.0});
  const MeasuredReference reference = make();
  EXPECT_THROW(MeasuredMatch(reference, 0, kSteps), InvalidPoint);
}

}  // namespace
}  // namespace linkstudy::measured_match_test

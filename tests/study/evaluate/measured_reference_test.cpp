// Studies of a falling mass, v = -g t, compared with measured data: units, offsets, load cases,
// instants between steps, and what cannot be compared.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "falling_mass.h"

namespace linkstudy::measured_reference_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class MeasuredFall : public FallingMassFolder {
 protected:
  std::unique_ptr<Evaluator> make(const std::string& text) {
    return FallingMassFolder::make(
        "vary = [{ parameter = \"simulation.step\", values = [0.08, 0.04, 0.02] }]\n" + text);
  }

  std::string said(const std::string& text) {
    diagnostics_ = {};
    EXPECT_FALSE(make(text)) << text;
    return to_string(diagnostics_);
  }
};

std::string match(const char* signal, const char* more = "") {
  return fmt::format("[[match]]\nsignal = \"{}\"\ntolerance = 0.1\n{}\n", signal, more);
}

constexpr const char* kSpeed =
    "reference = { file = \"v.csv\", columns = { time = \"t [ms]\", \"joint.P.v\" = \"v [mm/s]\" } "
    "}\n";

// v - 1 m/s at instants on no step; a line has no error between two of them.
TEST_F(MeasuredFall, Differs_by_what_was_added_to_its_speed_in_the_units_of_the_heads) {
  write("v.csv", "t [ms],note,v [mm/s]\n0,,5\n130,,-2170\n510,x,\n1010,,-10090\n1990,,-18910\n");
  const auto evaluator = make(kSpeed + match("joint.P.v"));
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  EXPECT_FALSE(evaluator->has_reference(0));  // none that is run
  const double mean = (0.44 * 2.17 * 2.17 + 0.93 * 10.09 * 10.09 + 0.49 * 18.91 * 18.91) / 1.86;
  for (const double step : {0.08, 0.04, 0.02}) {
    const Evaluation found = evaluate(*evaluator, step);
    ASSERT_EQ(Cause::ok, found.status) << found.message;
    EXPECT_NEAR(1.0 / 18.91, found.responses[0], 1e-12);
    EXPECT_NEAR(1.0 / std::sqrt(mean), found.responses[1], 1e-12);
  }
  const std::vector<CaseTraces> kept = evaluator->reference_traces();
  ASSERT_EQ(1u, kept.size());
  EXPECT_THAT(kept[0].traces[0].values, ElementsAre(0.13, 1.01, 1.99));
  EXPECT_THAT(kept[0].traces[1].values, ElementsAre(-2.17, -10.09, -18.91));
}

// The path is a parabola: halfway between two steps the line is g h^2 / 8 off.
TEST_F(MeasuredFall, Takes_a_curve_between_steps_from_the_line_between_them) {
  write("q.csv",
        fmt::format("t;q [m]\n0.6;{:.17g}\n0.68;{:.17g}\n", -kGravity * 0.18, -kGravity * 0.2312));
  const auto evaluator = make(
      "reference = { file = \"q.csv\", columns = { time = \"t\", \"joint.P.q\" = \"q [m]\" } }\n" +
      match("joint.P.q"));
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  const double scale = kGravity * 0.2312;
  EXPECT_NEAR(kGravity * 0.08 * 0.08 / 8.0 / scale, evaluate(*evaluator, 0.08).responses[0], 1e-12);
  EXPECT_NEAR(0.0, evaluate(*evaluator, 0.04).responses[0], 1e-12);  // both are steps
}

TEST_F(MeasuredFall, Compares_load_cases_with_their_own_data_and_others_with_the_common_run) {
  write("v.csv", "t [ms],v [mm/s]\n1000,-8000\n");
  const std::string own = std::string(kSpeed).substr(0, std::string(kSpeed).size() - 1);
  const auto evaluator =
      make("reference = { set = { gravity = [0, 0, -8] } }\n" +
           match("joint.P.v", "window = [0.96, 1.04]") + "[[load_case]]\nname = \"data\"\n" + own +
           "\n[[load_case]]\nname = \"run\"\n");
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  EXPECT_FALSE(evaluator->has_reference(0));
  EXPECT_TRUE(evaluator->has_reference(1));
  const Evaluation found = evaluate(*evaluator, 0.02);
  ASSERT_EQ(Cause::ok, found.status) << found.message;
  const std::size_t width = found.responses.size() / 2;
  EXPECT_NEAR(1.0 / 8.0, found.responses[0], 1e-12);
  EXPECT_NEAR(1.0 / 8.0, found.responses[width], 1e-12);  // 9 t against 8 t
}

TEST_F(MeasuredFall, Judges_its_instants_before_it_runs) {
  write("v.csv", "t [ms],v [mm/s]\n100,1\n2100,1\n");
  EXPECT_THAT(said(kSpeed + match("joint.P.v")),
              HasSubstr("study.toml:7:10: error: 'joint.P.v' was measured from 0.1 s to 2.1 s, and "
                        "the run reaches from 0 to 2 s"));
  EXPECT_TRUE(make(kSpeed + match("joint.P.v", "window = [0, 1]")));
  EXPECT_THAT(said(kSpeed + match("joint.P.v", "window = [0.2, 2.0]")),
              HasSubstr("study.toml:9:10: error: 'joint.P.v' was not measured inside the window"));
  EXPECT_THAT(said(kSpeed + match("joint.P.v", "window = [0, 3]")),
              HasSubstr("the window of this signal ends at 3 s, after the run (2 s)"));
  write("v.csv", "t [ms],v [mm/s]\n-100,1\n1000,1\n");
  EXPECT_THAT(said(kSpeed + match("joint.P.v")), HasSubstr("was measured from -0.1 s to 1 s"));
}

TEST_F(MeasuredFall, Refuses_what_it_cannot_compare) {
  write("v.csv", "t [ms],v [mm/s]\n100,1\n");
  EXPECT_THAT(said(kSpeed + match("joint.P.q")),
              HasSubstr("'joint.P.q' compares joint.P.q, which 'v.csv' does not have as a column"));
  EXPECT_THAT(said(std::string(kSpeed)), HasSubstr("no [[match]] compares 'joint.P.v'"));
  EXPECT_THAT(said(kSpeed + match("joint.P.q", "reference_signal = \"joint.P.v\"")),
              HasSubstr("'joint.P.q' is in m, and its column in"));
}

}  // namespace
}  // namespace linkstudy::measured_reference_test

// Means over time of a falling mass, v = -g t, against their closed forms; and studies whose runs
// cannot be seen where they look.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "falling_mass.h"
#include "study/evaluate/check_times.h"

namespace linkstudy::means_and_times_test {
namespace {

using ::testing::HasSubstr;

constexpr double kEnd = 2.0;  // s

class FallingMass : public FallingMassFolder {
 protected:
  static std::vector<double> evaluate(Evaluator& evaluator, double step) {
    return FallingMassFolder::evaluate(evaluator, step).responses;
  }

  std::string said(const std::string& text) {
    EXPECT_FALSE(make(text)) << text;
    return to_string(diagnostics_);
  }
};

std::string steps(const std::string& values) {
  return fmt::format("[[vary]]\nparameter = \"simulation.step\"\nvalues = {}\n", values);
}

std::string response(const char* name, const char* reduce, const char* window = "") {
  return fmt::format("[[response]]\nname = \"{}\"\nsignal = \"joint.P.v\"\nreduce = \"{}\"\n{}\n",
                     name, reduce, window);
}

constexpr const char* kSteps = "[0.08, 0.04, 0.02, 0.01, 0.005]";

TEST_F(FallingMass, Has_mean_and_rms_of_second_order_in_the_step) {
  const auto evaluator = make(steps(kSteps) + response("mean", "mean") + response("rms", "rms") +
                              response("part", "mean", "window = [0.513, 1.777]"));
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  for (double h = 0.08; h > 0.004; h /= 2.0) {
    const std::vector<double> numbers = evaluate(*evaluator, h);
    // The trapezoidal rule is exact on lines and h^2 / 6 too large on t^2.
    EXPECT_NEAR(numbers[0], -kGravity * kEnd / 2.0, 1e-11);
    EXPECT_NEAR(numbers[1], kGravity * std::sqrt(kEnd * kEnd / 3.0 + h * h / 6.0), 1e-11);
    // Pieces beyond the samples are rectangles: each off by h^2 g / 2 at most.
    EXPECT_NEAR(numbers[2], -kGravity * (0.513 + 1.777) / 2.0,
                kGravity * h * h / 2.0 / (1.777 - 0.513) + 1e-12);
  }
}

TEST_F(FallingMass, Has_the_same_means_with_steps_of_the_integrator_s_own) {
  const auto evaluator = make("base = { set = { \"simulation.integrator\" = \"adaptive\" } }\n" +
                              steps(kSteps) + response("mean", "mean") + response("rms", "rms"));
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  const std::vector<double> numbers = evaluate(*evaluator, 0.02);
  EXPECT_NEAR(numbers[0], -kGravity * kEnd / 2.0, 1e-7);  // its tolerance is 1e-8
  EXPECT_NEAR(numbers[1], kGravity * std::sqrt(kEnd * kEnd / 3.0 + 0.02 * 0.02 / 6.0), 1e-7);
}

// Against a mass that keeps its speed u: x - r = -g t - u.
TEST_F(FallingMass, Has_an_rms_error_of_second_order_in_the_step) {
  const auto evaluator =
      make("reference = { set = { gravity = [0, 0, 0], \"joint.P.initial.velocity\" = [3.0] } }\n" +
           steps(kSteps) + "[[match]]\nsignal = \"joint.P.v\"\ntolerance = 0.1\nwindow = [0, 2]\n");
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  for (double h = 0.08; h > 0.004; h /= 2.0) {
    const double d = std::max(h, 0.08);  // the common grid is the reference's
    const double square =
        kGravity * kGravity * (kEnd * kEnd / 3.0 + d * d / 6.0) + kGravity * kEnd * 3.0 + 9.0;
    EXPECT_NEAR(evaluate(*evaluator, h)[1], std::sqrt(square) / 3.0, 1e-11) << h;
  }
}

constexpr const char* kMatch = "[[match]]\nsignal = \"joint.P.v\"\ntolerance = 0.1\n";

TEST_F(FallingMass, A_window_without_an_instant_is_an_error_of_the_window) {
  EXPECT_THAT(said("reference = {}\n" + steps("[0.08]") + kMatch + "window = [0.1, 0.11]\n"),
              HasSubstr("study.toml:11:10: error: the window [0.1, 0.11] s holds no instant: the "
                        "run and its reference meet 0.08 s apart"));
  diagnostics_ = {};
  EXPECT_THAT(said(steps("[0.08, 0.01]") + response("m", "mean", "window = [0.1, 0.11]")),
              HasSubstr("holds no instant: the steps of the run lie 0.08 s apart"));
}

TEST_F(FallingMass, Steps_without_a_common_grid_are_an_error_of_the_step) {
  const std::string text = said("reference = {}\n" + steps("[0.08, 0.0019841269841]") + kMatch);
  EXPECT_THAT(text, HasSubstr("study.toml:6:13: error: the steps"));
  EXPECT_THAT(text, HasSubstr("have no common time grid"));
}

TEST_F(FallingMass, Windows_are_judged_in_the_cases_that_occur) {
  const std::string times = "[[vary]]\nparameter = \"simulation.end_time\"\nvalues = [2.0, 0.5]\n" +
                            response("m", "mean", "window = [0.0, 1.0]");
  EXPECT_THAT(said(times), HasSubstr("after the run (0.5 s)"));
  diagnostics_ = {};
  const std::string load =
      "[[load_case]]\nname = \"short\"\nset = { \"simulation.end_time\" = 0.5 }\n";
  EXPECT_THAT(said(steps("[0.08]") + response("m", "mean", "window = [0.0, 1.0]") + load),
              HasSubstr("after the run (0.5 s)"));
  diagnostics_ = {};
  EXPECT_THAT(
      said("reference = { set = { \"simulation.end_time\" = 0.8 } }\n" + steps("[0.08]") + kMatch),
      HasSubstr("the reference run ends at 0.8 s"));
}

TEST_F(FallingMass, Responses_may_not_take_the_name_of_another_column) {
  for (const char* name : {"evaluation", "status", "message", "attempts", "parent_evaluation",
                           "wall_s", "rank", "host", "gap_max", "simulation_step"}) {
    diagnostics_ = {};
    EXPECT_THAT(said(steps("[0.08]") + response(name, "mean")),
                HasSubstr(fmt::format("study.toml:8:8: error: response '{}' has the name of "
                                      "another column",
                                      name)));
  }
  diagnostics_ = {};
  const std::string loads = "[[load_case]]\nname = \"a\"\n[[load_case]]\nname = \"a_b\"\n";
  EXPECT_THAT(said(steps("[0.08]") + response("b_c", "mean") + response("c", "mean") + loads),
              HasSubstr("'a_b_c'"));
}

}  // namespace
}  // namespace linkstudy::means_and_times_test

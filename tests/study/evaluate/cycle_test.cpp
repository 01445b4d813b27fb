// Numbers of the last full turns of a crank, and where extremes are reached, against closed forms:
// an arm that a motor turns, its tip at y = L sin(omega t + phi).
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "study/evaluate/reference_bytes.h"
#include "tests/study/evaluate/falling_mass.h"

namespace linkstudy::cycle_test {
namespace {

using ::testing::HasSubstr;

constexpr double kPi = std::numbers::pi;
constexpr double kLength = 0.5;  // m
constexpr double kSpeed = 7.0;   // rad/s: 2 s are 2.228 turns

class TurningArm : public FallingMassFolder {
 protected:
  TurningArm() {
    write("model.toml", R"(format = 1
kind = "model"
[[link]]
name = "arm"
mass = 1.0
inertia = [0.01, 0.01, 0.01]
[[joint]]
name = "J"
type = "revolute"
parent = "ground"
child = "arm"
[[motion]]
name = "motor"
joint = "J"
law = { shape = "speed", speed = 7.0, from = 0.0 }
[[point]]
name = "tip"
link = "arm"
position = [0.5, 0.0, 0.0]
[simulation]
end_time = 2.0
step = 0.02
)");
  }
};

std::string steps(const char* values = "[0.02, 0.01, 0.005, 0.0025]") {
  return fmt::format("[[vary]]\nparameter = \"simulation.step\"\nvalues = {}\n", values);
}

std::string response(const char* name, const char* reduce, const char* more) {
  return fmt::format(
      "[[response]]\nname = \"{}\"\nsignal = \"point.tip.position.y\"\nreduce = \"{}\"\n{}\n", name,
      reduce, more);
}

constexpr const char* kLastTurn = "cycle = { of = \"joint.J.q\" }";
constexpr const char* kLastTurns = "cycle = { of = \"joint.J.q\", turns = 2 }";

TEST_F(TurningArm, Has_over_its_last_turns_the_means_of_a_sine) {
  const auto evaluator =
      make(steps() + response("mean", "mean", kLastTurn) + response("rms", "rms", kLastTurn) +
           response("twice", "mean", kLastTurns) + response("whole", "mean", ""));
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  for (const double h : {0.02, 0.01, 0.005, 0.0025}) {
    const Evaluation one = evaluate(*evaluator, h);
    ASSERT_EQ(one.status, Cause::ok) << one.message;
    // The piece before the first sample counts with it: off by L omega h^2 / 2 of the turn at most.
    const double bound = kLength * kSpeed * h * h / 2.0 / (2.0 * kPi / kSpeed);
    EXPECT_NEAR(one.responses[0], 0.0, bound);
    EXPECT_NEAR(one.responses[1], kLength / std::sqrt(2.0), bound);
    EXPECT_NEAR(one.responses[2], 0.0, bound / 2.0);
    // Of the whole run, no whole number of turns, the mean is L (1 - cos(14)) / 14.
    EXPECT_NEAR(one.responses[3], kLength * (1.0 - std::cos(14.0)) / 14.0, bound);
  }
}

TEST_F(TurningArm, Reaches_its_extremes_where_a_sine_does) {
  const auto evaluator =
      make(steps() + response("high", "max", "where = true") +
           response("low", "min", fmt::format("where = \"joint.J.q\"\n{}", kLastTurn).c_str()) +
           response("far", "max_abs", "where = \"joint.J.q\"\nwindow = [0.5, 0.8]") +
           "[[response]]\nname = \"tip\"\nsignal = \"point.tip.position\"\nreduce = \"max\"\n"
           "where = true\n");
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < 14; ++i) names.push_back(evaluator->responses()[i].name);
  EXPECT_THAT(names, ::testing::ElementsAre("high", "high_at", "low", "low_at", "low_where", "far",
                                            "far_at", "far_where", "tip_x", "tip_y", "tip_z",
                                            "tip_x_at", "tip_y_at", "tip_z_at"));
  EXPECT_EQ(evaluator->responses()[3].unit, "s");
  EXPECT_EQ(evaluator->responses()[4].unit, "rad");
  for (const double h : {0.02, 0.01, 0.005, 0.0025}) {
    const std::vector<double> numbers = evaluate(*evaluator, h).responses;
    const double apart = h / 2.0 * (1.0 + 1e-9);  // the next step to an extreme
    const double below = kLength * (1.0 - std::cos(kSpeed * apart));
    // Two maxima of the whole run, at 90 and 450 deg: the sample that is nearer to its own.
    const double turn = std::round((kSpeed * numbers[1] - kPi / 2.0) / (2.0 * kPi));
    EXPECT_NEAR(numbers[1], (kPi / 2.0 + 2.0 * kPi * turn) / kSpeed, apart);
    EXPECT_NEAR(numbers[0], kLength, below);
    // The last turn is from 82 deg of the second to 802 - 360 deg of it: its minimum is at 630 deg.
    EXPECT_NEAR(numbers[3], 3.5 * kPi / kSpeed, apart);
    EXPECT_NEAR(numbers[4], 3.5 * kPi, kSpeed * apart);
    EXPECT_NEAR(numbers[2], -kLength, below);
    // Below in the window, at 270 deg: the larger absolute value is that of the minimum.
    EXPECT_NEAR(numbers[5], kLength, below);
    EXPECT_NEAR(numbers[6], 1.5 * kPi / kSpeed, apart);
    EXPECT_NEAR(numbers[7], 1.5 * kPi, kSpeed * apart);
    EXPECT_EQ(numbers[9], numbers[0]);
    EXPECT_EQ(numbers[12], numbers[1]);
  }
}

TEST_F(TurningArm, That_turns_less_has_failed) {
  const auto evaluator =
      make(steps() + response("mean", "mean", "cycle = { of = \"joint.J.q\", turns = 3 }"));
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  const Evaluation one = evaluate(*evaluator, 0.02);
  EXPECT_EQ(one.status, Cause::no_full_turn);
  EXPECT_THAT(one.message, HasSubstr("joint.J.q was at most 2.228 turns away from where it ends"));
  EXPECT_TRUE(std::isnan(one.responses[0]));
}

// A reference that is phi ahead: x - r is a sine of amplitude 2 L sin(phi / 2), whose root mean
// square over whole turns is that over sqrt(2); over the whole run it is another.
TEST_F(TurningArm, Is_compared_over_the_last_turn_of_its_reference) {
  const std::string match =
      "[[match]]\nsignal = \"point.tip.position.y\"\nnorm = \"rms\"\ntolerance = 0.1\n";
  const std::string text =
      "reference = { set = { \"motion.motor.law.from\" = 0.3, \"simulation.step\" = 0.005 } }\n" +
      steps("[0.005]") + match;
  const auto whole = make(text);
  ASSERT_TRUE(whole) << to_string(diagnostics_);
  const auto cycle = make(text + kLastTurn + "\n");
  ASSERT_TRUE(cycle) << to_string(diagnostics_);
  const double expected = 2.0 * std::sin(0.15);
  // Samples inside the turn: less than a step of it is left out, of x - r and of r that scales it,
  // and mean squares by as much at most.
  const double left_out = kSpeed * 0.005 / (2.0 * kPi);
  EXPECT_NEAR(evaluate(*cycle, 0.005).responses[1], expected, left_out * expected);
  EXPECT_GT(std::abs(evaluate(*whole, 0.005).responses[1] - expected), 0.02 * expected);
  // What is kept of the reference holds its cycle.
  const std::string stored = encode_reference(cycle->run_reference(0));
  const ReferenceRecord again = decode_reference(stored);
  ASSERT_EQ(again.cycles.size(), 1u);
  EXPECT_NEAR(again.cycles[0].first, 2.0 - 2.0 * kPi / kSpeed, 1e-8);
  EXPECT_EQ(again.cycles[0].last, 2.0);
  EXPECT_EQ(encode_reference(again), stored);
  const auto other = make(text + kLastTurn + "\n");
  other->set_reference(0, again);
  EXPECT_EQ(evaluate(*other, 0.005).responses, evaluate(*cycle, 0.005).responses);
}

TEST_F(TurningArm, Whose_reference_does_not_turn_so_far_is_compared_with_nothing) {
  const auto evaluator =
      make("reference = { set = { \"motion.motor.law.speed\" = 3.0 } }\n" + steps("[0.02]") +
           "[[match]]\nsignal = \"point.tip.position.y\"\ntolerance = 0.1\n" + kLastTurn + "\n");
  ASSERT_TRUE(evaluator) << to_string(diagnostics_);
  try {
    evaluator->run_reference(0);
    FAIL();
  } catch (const ReferenceFailure& error) {
    EXPECT_EQ(error.cause(), Cause::no_full_turn);
  }
}

TEST_F(TurningArm, Bad_cycles_and_places_are_errors_at_their_lines) {
  const auto said = [&](const std::string& text) {
    diagnostics_ = {};
    EXPECT_FALSE(make(steps() + text)) << text;
    return to_string(diagnostics_);
  };
  EXPECT_THAT(said(response("a", "mean", "where = true")),
              HasSubstr("study.toml:11:9: error: reduce = \"mean\" is reached nowhere"));
  EXPECT_THAT(said(response("a", "max", "where = 3")),
              HasSubstr("where must be true or a channel"));
  EXPECT_THAT(said(response("a", "max", "where = \"joint.K.q\"")),
              HasSubstr("study.toml:11:9: error: there is no signal 'joint.K.q'"));
  EXPECT_THAT(said(response("a", "max", "where = \"point.tip.position\"")),
              HasSubstr("has 3 components"));
  EXPECT_THAT(said(response("a", "max", "cycle = { of = \"joint.J.v\" }")),
              HasSubstr("'joint.J.v' is not the angle of a joint"));
  EXPECT_THAT(said(response("a", "max", "cycle = { of = \"joint.J.q\", turns = 0 }")),
              HasSubstr("turns"));
  EXPECT_THAT(said(response("a", "max", "window = [0, 1]\ncycle = { of = \"joint.J.q\" }")),
              HasSubstr("cycle"));
  EXPECT_THAT(said(response("a", "max", "where = true") +
                   "[[response]]\nname = \"a_at\"\nsignal = \"joint.J.q\"\nreduce = \"last\"\n"),
              HasSubstr("'a_at' has the name of another column"));
}

}  // namespace
}  // namespace linkstudy::cycle_test

// `statics` as a user meets it: the equilibrium by names, reactions, holds, what is left out, and
// why there is none.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace linkstudy::testing::statics_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// Gravity leans by 20 deg: 9.81 sin 20 = 3.35522 m/s^2 along the rail x.
constexpr const char* kIncline = R"(format = 1
kind = "model"
name = "block on incline"
gravity = [3.3552176060248105, 0.0, -9.218384609909762]

[[link]]
name = "block"
mass = 2.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [0.01, 0.01, 0.01]

[[joint]]
name = "P"
type = "prismatic"
parent = "ground"
child = "block"
frame = { rotation = { axis = [0, 1, 0], angle = "90 deg" } }
child_frame = { rotation = { axis = [0, 1, 0], angle = "90 deg" } }
initial = { velocity = [0.0], hold = true }
friction = { mu_s = 0.5, mu_k = 0.4, stribeck_speed = 0.01, sigma0 = 1.0e5, sigma1 = 300.0 }

[simulation]
end_time = 0.1
step = 1.0e-4
start = "equilibrium"
)";

constexpr const char* kBushing = R"(format = 1
kind = "model"
name = "bushing"
gravity = [0.0, 0.0, 0.0]

[[link]]
name = "b"
mass = 1.0
center_of_mass = [0.0, 0.0, 0.0]
inertia = [0.1, 0.12, 0.15]

[[joint]]
name = "S"
type = "spherical"
parent = "ground"
child = "b"

[[closure]]
name = "B"
type = "fixed"
first = { link = "b", position = [0.0, 0.0, 0.0] }
second = { link = "ground", position = [0.0, 0.0, 0.0] }
model = "sde"
sde = { tilt = "angle", stiffness = { all = 1.0e5, phi = 5, theta = 5, psi = 5 } }

[[load]]
name = "T"
type = "link_torque"
link = "b"
direction = [1.0, 0.0, 0.0]
course = { shape = "ramp", value = 8.0, duration = 2.0 }

[simulation]
end_time = 0.01
step = 0.001
statics_time = 1.0
)";

// Two hinges on the x axis, 1 m apart, and a frame of 10 kg that hangs 0.3 m off their middle.
constexpr const char* kTwoHinges = R"(format = 1
kind = "model"
name = "two hinges"
gravity = [0.0, -9.81, 0.0]

[[link]]
name = "frame"
mass = 10.0
center_of_mass = [0.8, -0.4, 0.0]
inertia = [1.0, 0.5, 1.2]

[[joint]]
name = "L"
type = "revolute"
parent = "ground"
child = "frame"
frame = { position = [-0.5, 0, 0], rotation = { axis = [0, 1, 0], angle = "90 deg" } }
child_frame = { rotation = { axis = [0, 1, 0], angle = "90 deg" } }

[[closure]]
name = "R"
type = "revolute"
first = { link = "frame", position = [1.0, 0.0, 0.0] }
second = { link = "ground", position = [0.5, 0.0, 0.0] }
)";

class StaticsVerb : public Program {
 protected:
  StaticsVerb() {
    write("incline.toml", kIncline);
    write("bushing.toml", kBushing);
  }
  json object_of(const std::string& arguments) {
    const Ended ended = run("statics " + arguments + " --json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    return json::parse(ended.out);
  }
};

TEST_F(StaticsVerb, A_held_block_is_reported_with_its_reaction_its_hold_and_friction_left_out) {
  const json object = object_of("incline.toml");
  const json& values = object["values"];
  const double slope = 2.0 * 3.3552176060248105, press = 2.0 * 9.218384609909762;
  EXPECT_EQ(values["joint.P.q"], 0.0);
  EXPECT_NEAR(values["joint.P.hold"], -slope, 1e-12);
  EXPECT_EQ(object["units"]["joint.P.hold"], "N");
  EXPECT_NEAR(values["joint.P.force.x"], -slope, 1e-12);
  EXPECT_NEAR(values["joint.P.force.z"], press, 1e-12);
  EXPECT_EQ(object["equilibrium"]["stability"], "stable");
  EXPECT_EQ(object["equilibrium"]["free_directions"], 0);
  EXPECT_THAT(object["equilibrium"]["friction_left_out"], ElementsAre("P"));
  const Ended text = run("statics incline.toml");
  EXPECT_THAT(text.out, HasSubstr("friction of joint P"));
  EXPECT_THAT(text.out, HasSubstr("a structure: nothing can move"));
  EXPECT_THAT(text.out, HasSubstr("joint.P.hold"));
  EXPECT_THAT(text.out, HasSubstr("joint.P.force.z"));
}

TEST_F(StaticsVerb, Without_a_hold_the_cause_names_what_nothing_bears) {
  const Ended ended = run("statics incline.toml --set joint.P.initial.hold=false --json");
  EXPECT_EQ(ended.code, 3);
  const json object = json::parse(ended.out);
  EXPECT_EQ(object["cause"], "statics_failed");
  EXPECT_THAT(std::string(object["message"]),
              HasSubstr("nothing holds against 6.71 N at joint.P (friction is left out)"));
  EXPECT_FALSE(object.contains("values"));
}

TEST_F(StaticsVerb, Loads_count_with_their_value_at_the_time_of_statics) {
  const json half = object_of("bushing.toml");
  EXPECT_NEAR(half["values"]["joint.S.q.2"], 0.8, 1e-9);  // 4 N m on 5 N m/rad
  EXPECT_NEAR(half["values"]["closure.B.torque.x"], -4.0, 1e-9);
  EXPECT_EQ(half["equilibrium"]["time"], 1.0);
  EXPECT_EQ(half["equilibrium"]["stiffness_unit"], "N m/rad");
  EXPECT_NEAR(half["equilibrium"]["smallest_stiffness"], 5.0, 0.6);  // angles psi, theta, phi
  const json rest = object_of("bushing.toml --set simulation.statics_time=0.0");
  EXPECT_NEAR(rest["values"]["joint.S.q.2"], 0.0, 1e-12);
  EXPECT_THAT(run("statics bushing.toml").out, HasSubstr("loads of t = 1 s"));
}

// The moment 0.3 m x 98.1 N across the axis is borne by half as forces M / 2 on 1 m, by half as
// moments M / 4; the cut hinge alone bears nothing of it.
TEST_F(StaticsVerb, Two_hinges_share_a_weight_on_request_and_the_warning_says_what_was_taken) {
  write("hinges.toml", kTwoHinges);
  const double weight = 98.1, M = 0.3 * weight;
  const std::string set = "hinges.toml --set simulation.redundant_reactions=";
  const json cut = object_of(set + "cut")["values"], loops = object_of(set + "loops")["values"];
  EXPECT_NEAR(cut["joint.L.force.y"], weight, 1e-9);
  EXPECT_NEAR(cut["joint.L.torque.z"], 0.8 * weight, 1e-9);
  EXPECT_EQ(cut["closure.R.force.y"], 0.0);
  EXPECT_NEAR(loops["joint.L.force.y"], weight / 2 - M / 2, 1e-9);
  EXPECT_NEAR(loops["closure.R.force.y"], weight / 2 + M / 2, 1e-9);
  EXPECT_NEAR(loops["joint.L.torque.z"], M / 4, 1e-9);
  EXPECT_NEAR(loops["closure.R.torque.z"], M / 4, 1e-9);
  EXPECT_THAT(run("statics hinges.toml").err,
              AllOf(HasSubstr("5 of 5 closure equations are redundant"),
                    HasSubstr("joint.L, closure.R"), HasSubstr("redundant_reactions = \"cut\"")));
  EXPECT_THAT(run("statics " + set + "loops").err, HasSubstr("redundant_reactions = \"loops\""));
  const Ended wrong = run("statics " + set + "all");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("cut, loops"));
}

TEST_F(StaticsVerb, A_torque_beyond_the_largest_of_a_sine_is_a_failure_that_says_so) {
  const Ended ended = run("statics bushing.toml --set closure.B.sde.tilt=axis --json");
  EXPECT_EQ(ended.code, 3);
  const std::string message = json::parse(ended.out)["message"];
  EXPECT_THAT(message, HasSubstr("balance is missed by 1.5 N m"));
  EXPECT_THAT(message, HasSubstr("tilt = \"angle\""));
}

TEST_F(StaticsVerb, A_study_varies_the_stiffness_of_a_bushing_measured_by_its_angle) {
  write("study.toml", R"(format = 1
kind = "study"
name = "bushing"
model = "bushing.toml"
base = { set = { "simulation.start" = "equilibrium" } }

[[vary]]
parameter = "closure.B.sde.stiffness.phi"
values = [4.0, 5.0, 8.0]

[[response]]
name = "turn"
signal = "joint.S.q.2"
reduce = "max"
)");
  const Ended ended = run("study study.toml -o out");
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const json rows = json::parse(run("export out --format json").out)["rows"];
  ASSERT_EQ(rows.size(), 3u);
  // The run begins turned by 4 N m over the stiffness, and swings back as its loads begin at zero.
  const double stiffness[] = {4.0, 5.0, 8.0};
  for (std::size_t i = 0; i < 3; ++i) {
    const double turn = rows[i]["turn"];
    EXPECT_NEAR(turn, 4.0 / stiffness[i], 1e-9);
  }
}

TEST_F(StaticsVerb, A_study_may_vary_how_redundant_reactions_are_shared) {
  write("hinges.toml", kTwoHinges);
  write("study.toml", R"(format = 1
kind = "study"
name = "hinges"
model = "hinges.toml"

[base.set]
"simulation.end_time" = 0.01
"simulation.step" = 0.001

[[vary]]
parameter = "simulation.redundant_reactions"
values = ["cut", "loops"]

[[response]]
name = "left"
signal = "joint.L.force.y"
reduce = "mean"

[[response]]
name = "right"
signal = "closure.R.force.y"
reduce = "mean"
)");
  const Ended ended = run("study study.toml -o out");
  EXPECT_EQ(ended.code, 0) << ended.err << ended.out;
  const json rows = json::parse(run("export out --format json").out)["rows"];
  ASSERT_EQ(rows.size(), 2u);
  // At rest below the axis: as in statics.
  const double weight = 98.1, M = 0.3 * weight;
  EXPECT_NEAR(rows[0]["left"], weight, 1e-9);
  EXPECT_NEAR(rows[0]["right"], 0.0, 1e-9);
  EXPECT_NEAR(rows[1]["left"], weight / 2 - M / 2, 1e-9);
  EXPECT_NEAR(rows[1]["right"], weight / 2 + M / 2, 1e-9);
}

}  // namespace
}  // namespace linkstudy::testing::statics_test

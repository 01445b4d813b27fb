// Contacts as a table: of one run, of a study with lanes and load cases, from a file alone.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace linkstudy::testing::contacts_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

// A mass of 2 kg that flies to a stop 1 m away with 1.5 m/s; f = K d, no loss: half a swing.
std::string bouncing(const std::string& simulation) {
  return R"(format = 1
kind = "model"
name = "bouncing mass"
[[link]]
name = "b"
mass = 2.0
inertia = [0.01, 0.01, 0.01]
[[joint]]
name = "J"
type = "prismatic"
parent = "ground"
child = "b"
initial = { velocity = [1.5] }
[joint.stop]
low = [-0.2]
high = [1.0]
stiffness = [1.0e5]
exponent = 1.0
restitution = 1.0
[simulation]
)" + simulation;
}

const char* const kFixed = "end_time = 1.6\nstep = 5.0e-5\noutput_interval = 0.1\n";

class Contacts : public Program {
 protected:
  json rows(const std::string& results) const {
    const Ended ended = run("export " + results + " --table contacts --format json");
    EXPECT_EQ(ended.code, 0) << ended.err;
    return json::parse(ended.out)["rows"];
  }
};

TEST_F(Contacts, Of_a_run_are_those_of_half_a_swing) {
  write("model.toml", bouncing(kFixed));
  ASSERT_EQ(run("simulate model.toml -o results").code, 0);
  const json all = rows("results");
  ASSERT_EQ(all.size(), 2u);
  const double half = M_PI * std::sqrt(2.0 / 1e5), force = 1.5 * std::sqrt(2e5);
  EXPECT_EQ(all[0]["run"], "evaluation_0");
  EXPECT_EQ(all[0]["at"], "joint.J");
  EXPECT_EQ(all[0]["contact"], "high");
  EXPECT_EQ(all[0]["within"], "whole");
  EXPECT_EQ(all[0]["unlisted"], 0);
  EXPECT_NEAR(all[0]["begin"], 1.0 / 1.5, 1e-5);
  EXPECT_NEAR(all[0]["end"], 1.0 / 1.5 + half, 1e-5);
  EXPECT_NEAR(all[0]["restitution"], 1.0, 1e-4);
  EXPECT_NEAR(all[0]["peak_force"], force, 1e-4 * force);
  EXPECT_EQ(all[1]["contact"], "low");
  EXPECT_NEAR(all[1]["begin"], 1.0 / 1.5 + half + 0.8, 2e-5);
  // From the file alone, and as text with units.
  EXPECT_EQ(rows("results/results.h5"), all);
  EXPECT_THAT(run("export results --table contacts --rows 'peak_force > 1 kN'").out,
              Not(HasSubstr("high")));
  EXPECT_THAT(run("export results --table contacts --rows 'peak_force > 0.6 kN'").out,
              HasSubstr("high"));
  EXPECT_THAT(run("export results --list").out, HasSubstr("contacts"));
}

TEST_F(Contacts, Are_told_shortly_by_a_run_that_keeps_nothing) {
  write("model.toml", bouncing("end_time = 0.67\nstep = 1.0e-3\nintegrator = \"adaptive\"\n"));
  const Ended ended = run("simulate model.toml");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("joint.J high: "));
  EXPECT_THAT(on_one_line(ended.out),
              HasSubstr("met with 1.5 m/s at t = 0.666667 s, lasts at the end"));
}

TEST_F(Contacts, Of_a_study_are_kept_with_its_histories_and_do_not_depend_on_lanes) {
  write("model.toml", bouncing(kFixed));
  const std::string study = R"(format = 1
kind = "study"
model = "model.toml"
[[vary]]
parameter = "joint.J.stop.restitution"
lin = [0.5, 1.0, 6]
[[load_case]]
name = "slow"
set = { "joint.J.initial.velocity.0" = 1.0 }
[[load_case]]
name = "fast"
set = { "joint.J.initial.velocity.0" = 3.0 }
)";
  write("bare.toml", study);
  write("study.toml", study + "[[trace]]\nsignals = [\"energy.dissipated_in_contacts\"]\n");
  ASSERT_EQ(run("study study.toml -o wide").code, 0);
  ASSERT_EQ(run("study study.toml -o alone", "LINKSTUDY_LANES=1").code, 0);
  const json all = rows("wide");
  EXPECT_EQ(all, rows("alone"));
  EXPECT_EQ(all[0]["run"], "evaluation_0_slow");
  EXPECT_EQ(all.back()["run"], "evaluation_5_fast");
  // Lankarani and Nikravesh at 0.5: D = 9/16, and D - ln(1 + D) = -D e - ln(1 - D e) at 0.725241;
  // some 280 steps take the contact.
  EXPECT_NEAR(all[0]["restitution"], 0.725241, 1e-4);
  EXPECT_NEAR(all.back()["restitution"], 1.0, 1e-3);
  ASSERT_EQ(run("study bare.toml -o bare").code, 0);
  const Ended none = run("export bare --table contacts");
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("[[trace]]"));
}

}  // namespace
}  // namespace linkstudy::testing::contacts_test

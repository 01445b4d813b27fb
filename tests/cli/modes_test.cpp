// `statics --modes`, `--write-start`, and motions and couplings as a user meets them.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::modes_test {
namespace {

using nlohmann::json;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

// A rod of 1 m on a pin, hanging, with a damper: w^2 = 3 g / (2 L), zeta = b / (2 I w).
constexpr const char* kRod = R"(format = 1
kind = "model"
name = "rod"
gravity = [0.0, -9.81, 0.0]

[[link]]
name = "rod"
mass = 3.0
center_of_mass = [0.5, 0.0, 0.0]
inertia = [1.0e-6, 0.25, 0.25]

[[joint]]
name = "A"
type = "revolute"
parent = "ground"
child = "rod"
initial = { position = ["-80 deg"] }
spring = { damping = [0.3] }

[simulation]
end_time = 0.01
step = 0.001
)";

std::string shipped(const std::string& name) {
  return source_file("configs/mechanisms/" + name + ".toml");
}

}  // namespace

class Modes : public Program {};

TEST_F(Modes, Of_a_hanging_rod_are_those_of_the_textbook) {
  write("rod.toml", kRod);
  const Ended ended = run("statics rod.toml --modes 3 --json");
  ASSERT_EQ(ended.code, 0) << ended.err;
  const json modes = json::parse(ended.out)["modes"];
  ASSERT_EQ(modes.size(), 1u);
  const double w = std::sqrt(1.5 * 9.81), inertia = 1.0;
  EXPECT_NEAR(modes[0]["frequency"].get<double>(), w / (2 * std::numbers::pi), 1e-9);
  EXPECT_NEAR(modes[0]["damping_ratio"].get<double>(), 0.3 / (2 * inertia * w), 1e-9);
  EXPECT_NEAR(modes[0]["shape"]["joint.A"][0].get<double>(), 1.0, 1e-12);
  EXPECT_THAT(ended.err, HasSubstr("swings most"));
  EXPECT_EQ(run("statics rod.toml --modes 0").code, 2);
  EXPECT_EQ(run("simulate rod.toml --modes 1").code, 2);
}

TEST_F(Modes, Are_a_table_of_the_results) {
  write("rod.toml", kRod);
  ASSERT_EQ(run("statics rod.toml -o kept").code, 0);
  EXPECT_THAT(run("export kept --list").out, HasSubstr("modes"));
  const Ended table = run("export kept --table modes --format csv");
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("frequency"));
  EXPECT_EQ(run("verify kept").code, 0);
}

class StartedModel : public Program {};

// The pose is taken as it is, to the last bit, and the run is the same.
TEST_F(StartedModel, Begins_where_the_run_began) {
  const std::string model = shipped("four_bar");
  const Ended first = run("simulate " + model +
                          " -s simulation.end_time=0.01 -s joint.B.initial.position=[-0.4] "
                          "--write-start started.toml --csv first.csv");
  ASSERT_EQ(first.code, 0) << first.err;
  const Ended again = run("simulate started.toml --csv again.csv");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read_text(path("again.csv")), read_text(path("first.csv")));
  EXPECT_THAT(again.out, Not(HasSubstr("moved")));
}

// The angles and rates of a bent link too: here statics bends it, and the run goes on from there.
TEST_F(StartedModel, Bends_flexible_links_as_the_run_began) {
  const std::string end = " -s simulation.end_time=0.01 ";
  const Ended first = run("simulate " + shipped("rsup_flexible") + end +
                          "-s simulation.start=\"equilibrium\" --write-start started.toml --csv "
                          "first.csv");
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_THAT(read_text(path("started.toml")), HasSubstr("velocity = "));
  const Ended again = run("simulate started.toml -s simulation.start=\"given\" --csv again.csv");
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(read_text(path("again.csv")), read_text(path("first.csv")));
}

TEST_F(StartedModel, Never_takes_the_place_of_its_model) {
  write("rod.toml", kRod);
  const Ended ended = run("statics rod.toml --write-start rod.toml");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("is the input"));
  EXPECT_EQ(read_text(path("rod.toml")), kRod);
  EXPECT_EQ(run("statics rod.toml --write-start no/where.toml").code, 2);
  EXPECT_EQ(run("simulate rod.toml -o kept --write-start a.toml").code, 2);
}

class Motions : public Program {};

// The ram goes back faster by (180 + 2 b) / (180 - 2 b), sin b = 0.1 / 0.25: the times between its
// turning points.
TEST_F(Motions, Of_a_crank_bring_a_ram_back_quickly) {
  const Ended ended = run("simulate " + shipped("quick_return") +
                          " -s simulation.output_interval=0.0005 --signals joint.P.v --csv v.csv");
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("the run is an inverse dynamics"));
  std::istringstream lines(read_text(path("v.csv")));
  std::vector<double> turns;
  std::string line;
  double t_old = 0.0, v_old = 0.0;
  while (std::getline(lines, line)) {
    double t = 0.0, v = 0.0;
    if (std::sscanf(line.c_str(), "%lf,%lf", &t, &v) != 2) continue;
    if (v_old != 0.0 && v_old * v < 0.0) turns.push_back(t_old + (t - t_old) * v_old / (v_old - v));
    t_old = t;
    v_old = v;
  }
  ASSERT_GE(turns.size(), 4u);
  const double a = turns[1] - turns[0], b = turns[2] - turns[1];
  // The ram turns where the rocker does, but for what the short link adds: nothing at the ends.
  const double beta = std::asin(0.4);
  EXPECT_NEAR(std::max(a, b) / std::min(a, b),
              (std::numbers::pi + 2 * beta) / (std::numbers::pi - 2 * beta), 1e-4);
  EXPECT_NEAR(a + b, 1.0, 1e-6);
}

TEST_F(Motions, Are_channels_and_a_drive_of_kinematics) {
  const Ended channels = run("describe channels " + shipped("geared_five_bar"));
  EXPECT_THAT(channels.out, HasSubstr("motion.crank.effort"));
  EXPECT_THAT(channels.out, HasSubstr("coupling.gears.effort"));
  const Ended course = run("kinematics " + shipped("geared_five_bar"));
  EXPECT_EQ(course.code, 0) << course.err;
  EXPECT_THAT(course.out, HasSubstr("by motion.crank, speed"));
  EXPECT_THAT(course.out, HasSubstr("1 freedom"));
  EXPECT_THAT(run("kinematics " + shipped("geared_five_bar") + " --drive joint.E=0:1").out,
              Not(HasSubstr("motion.crank")));
}

// The effort of the driven crank, taken as measured, tells two masses.
TEST_F(Motions, Tell_by_their_effort_what_they_move) {
  const std::string model = shipped("quick_return");
  ASSERT_EQ(run("simulate " + model +
                " -s simulation.end_time=1 --signals motion.crank.effort "
                "--csv effort.csv")
                .code,
            0);
  std::istringstream lines(read_text(path("effort.csv")));
  std::string data, line;
  for (int i = 0; std::getline(lines, line); ++i) {
    if (i > 0) data += (i == 1 ? "t [s],M [N m]" : line) + "\n";
  }
  write("effort.csv", data);
  write("masses.toml", "format = 1\nkind = \"calibrate\"\nmodel = \"" + model + R"("
base = { set = { "simulation.end_time" = 1.0 } }
fit = { starts = 2 }
[[parameter]]
path = "link.ram.mass"
range = { log = [2.0, 50.0] }
[[parameter]]
path = "link.rocker.mass"
range = { log = [1.0, 20.0] }
[[experiment]]
name = "turning"
file = "effort.csv"
sigma = { "motion.crank.effort" = "0.05 N m" }
columns = { time = "t [s]", "motion.crank.effort" = "M [N m]" }
)");
  const Ended fitted = run("calibrate masses.toml -o masses --json");
  ASSERT_EQ(fitted.code, 0) << fitted.err;
  const json table =
      json::parse(run("export masses --table calibration --format json").out)["rows"];
  EXPECT_NEAR(table[0]["value"].get<double>(), 10.0, 1e-9);
  EXPECT_NEAR(table[1]["value"].get<double>(), 4.0, 1e-9);
}

}  // namespace linkstudy::testing::modes_test

// Calibration files: what is read, and what is wrong with them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_text.h"
#include "study/config/study_input.h"
#include "wrong_text.h"

namespace linkstudy::calibrate_test {
namespace {

using test::write_file;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char* const kCalibration = R"(format = 1
kind = "calibrate"
model = "rsrrp.toml"
base = { set = { "closure.S.model" = "sde" } }

[[parameter]]
path = "closure.S.sde.stiffness"
range = { log = [1.0e4, "1 MN/m"] }
start = "100 kN/m"

[[parameter]]
path = "link.crank.mass"
range = { lin = [0.5, 2.0] }

[[parameter]]
path = "link.coupler.mass"
tied_to = "link.crank.mass"
factor = 1.5

[[parameter]]
path = "closure.S.sde.damping"
fixed = "60 N s/m"

[[experiment]]
name = "slow"
file = "force.csv"
columns = { time = "t [ms]", "closure.S.force.x" = "Fx [N]" }
window = [0.5, 10.0]
sigma = { "closure.S.force" = "0.5 N" }
time_offset = "3 ms"
set = { "load.drive.course.value" = 5.0 }

[[experiment]]
name = "exact"
reference = { set = { "closure.S.model" = "cut" } }
signals = ["closure.S.force"]
weight = 2.0
)";

std::optional<StudyInput> read(const std::string& text, Diagnostics& diagnostics,
                               const std::vector<Override>& set = {}) {
  write_file("rsrrp.toml", test::kRsrrp);
  write_file("force.csv", "t [ms],Fx [N]\n600,1\n700,2\n");
  return read_study(write_file("calibrate.toml", text), set, diagnostics);
}

TEST(CalibrationFile, says_what_is_fitted_to_what) {
  Diagnostics diagnostics;
  const auto input = read(kCalibration, diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  ASSERT_EQ(4u, input->calibrated.size());
  EXPECT_EQ(ParameterRole::free, input->calibrated[0].role);
  EXPECT_TRUE(input->calibrated[0].is_logarithmic);
  EXPECT_EQ(1e6, input->calibrated[0].high);
  EXPECT_EQ(1e5, input->calibrated[0].start);
  EXPECT_FALSE(input->calibrated[1].is_logarithmic);
  EXPECT_EQ(ParameterRole::tied, input->calibrated[2].role);
  EXPECT_EQ(1u, input->calibrated[2].leader);
  EXPECT_EQ(1.5, input->calibrated[2].factor);
  EXPECT_EQ(60.0, input->calibrated[3].fixed);
  ASSERT_EQ(2u, input->load_case.size());
  const MeasuredInput& slow = *input->load_case[0].measured;
  EXPECT_THAT(slow.data->times, ElementsAre(DoubleEq(0.6), DoubleEq(0.7)));
  EXPECT_EQ(0.003, slow.time_offset);
  EXPECT_EQ(1u, input->load_case[0].set.size());
  EXPECT_TRUE(input->load_case[1].reference);
  EXPECT_EQ(2.0, *input->load_case[1].measured->weight);
  EXPECT_EQ(20, input->fit.starts);
}

class WrongCalibrations : public ::testing::TestWithParam<test::WrongFile> {};

TEST_P(WrongCalibrations, give_one_error_at_their_place) {
  test::expect_one_message(
      kCalibration, GetParam(),
      [](const std::string& text, Diagnostics& found) { return read(text, found).has_value(); });
}

const test::WrongFile kWrong[] = {
    {"path", "path = \"closure.S.sde.stiffness\"", "path = \"closure.S.sde.stifness\"",
     ":7:8: error: parameter names no value"},
    {"word", "path = \"closure.S.sde.damping\"\nfixed = \"60 N s/m\"",
     "path = \"closure.S.sde.axes\"\nrange.lin = [1, 2]", "is no real number and cannot be fitted"},
    {"range", "lin = [0.5, 2.0]", "lin = [2.0, 0.5]", ":13:17: error: range must rise"},
    {"start", "start = \"100 kN/m\"", "start = \"1 kN/m\"",
     ":9:9: error: start must lie within the range"},
    {"roles", "fixed = \"60 N s/m\"", "fixed = \"60 N s/m\"\ntied_to = \"link.crank.mass\"",
     "error: "},
    {"leader", "tied_to = \"link.crank.mass\"", "tied_to = \"closure.S.sde.damping\"",
     ":17:11: error: tied_to must name a [[parameter]] with a range"},
    {"idle_factor", "range = { lin = [0.5, 2.0] }", "range = { lin = [0.5, 2.0] }\nfactor = 2",
     "is not tied and has no factor"},
    {"twice", "path = \"closure.S.sde.damping\"\nfixed = \"60 N s/m\"",
     "path = \"link.0.mass\"\nfixed = 1.0",
     "names 'link.0.mass', which [[parameter]] names as 'link.crank.mass' too"},
    {"experiment_names_it", "\"load.drive.course.value\" = 5.0", "\"link.crank.mass\" = 5.0",
     "experiment 'slow' names 'link.crank.mass', which [[parameter]] names too"},
    {"no_time", "time = \"t [ms]\", ", "", "does not say which column is the time"},
    {"no_channel", ", \"closure.S.force.x\" = \"Fx [N]\"", "", "compares no channel"},
    {"both_sources", "signals = [\"closure.S.force\"]",
     "signals = [\"closure.S.force\"]\nfile = \"force.csv\"", "error: "},
    {"no_signals", "signals = [\"closure.S.force\"]\n", "", "names nothing to compare"},
    {"sigma", "sigma = { \"closure.S.force\"", "sigma = { \"closure.R.force\"",
     "sigma names 'closure.R.force', which is not compared"},
    {"offset", "time_offset = \"3 ms\"", "time_offset = \"3 mm\"", "time_offset must be a time"},
    {"no_head", "\"Fx [N]\"", "\"Fx\"", "has no column 'Fx'"},
    {"name_twice", "name = \"exact\"", "name = \"slow\"", "the name 'slow' is used twice"},
    {"match", "[[experiment]]\nname = \"slow\"",
     "[[match]]\nsignal = \"closure.S.force\"\n[[experiment]]\nname = \"slow\"", "match"},
};

INSTANTIATE_TEST_SUITE_P(All, WrongCalibrations, ::testing::ValuesIn(kWrong),
                         [](const auto& one) { return one.param.name; });

// What --set replaces stands in the runs that stand for measurements, too.
TEST(CalibrationFile, takes_a_value_of_the_command_line_wherever_it_states_it) {
  Diagnostics diagnostics;
  const auto input = read(kCalibration, diagnostics,
                          {test::set("closure.S.model=cut"), test::set("simulation.end_time=12")});
  EXPECT_FALSE(input);  // no stiffness acts then
  Diagnostics fewer;
  const auto longer = read(kCalibration, fewer, {test::set("simulation.end_time=12")});
  ASSERT_TRUE(longer) << to_string(fewer);
  const auto& reference = *longer->load_case[1].reference;
  const auto model = reference.model->with(reference.set, fewer);
  EXPECT_EQ(12.0, model->options.end_time);
}

}  // namespace
}  // namespace linkstudy::calibrate_test

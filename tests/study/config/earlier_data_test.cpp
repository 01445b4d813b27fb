// Histories of earlier results as measured data: what is asked of them, how it is kept, what is
// wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "config_text.h"
#include "study/config/measured_reader.h"
#include "study/config/precedence.h"
#include "wrong_text.h"

namespace linkstudy::earlier_data_test {
namespace {

using test::replaced;
using test::write_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNan;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

const char* const kCalibration = R"(format = 1
kind = "calibrate"
model = "rsrrp.toml"
base = { set = { "closure.S.model" = "sde" } }

[[parameter]]
path = "closure.S.sde.stiffness"
range = { log = [1.0e4, "1 MN/m"] }

[[experiment]]
name = "slow"
results = "first/results"
evaluation = 3
load_case = "slow"
signals = ["closure.S.force"]
time_offset = "3 ms"

[[experiment]]
name = "fast"
results = "second"
columns = { "closure.S.force.y" = "rig.force.y" }
weight = 2.0
)";

const char* const kStudy = R"(format = 1
kind = "study"
model = "rsrrp.toml"
base = { set = { "closure.S.model" = "sde" } }
[reference]
results = "first"

[[vary]]
parameter = "closure.S.sde.stiffness"
values = [1e5, 1e6]

[[match]]
signal = "closure.S.force"
reference_signal = "-rig.force"
tolerance = 0.02

[[match]]
signal = "joint.A.q"
tolerance = 0.02
)";

// Digits that no shorter number has, and a missing sample.
EarlierRun run_of_a_rig() {
  return {{{"joint.A.q", "rad", {0.0, 0.25, 0.5}},
           {"time", "s", {0.0, 0.1, 0.1 + 0.2}},
           {"rig.force.x", "N", {1.0, 2.0, 3.0}},
           {"rig.force.y", "N", {0.0, 1.0 / 3.0, -1e-300}},
           {"rig.force.z", "N", {7.0, kMissing, 9.0}},
           {"closure.S.force.x", "N", {10.0, 20.0, 30.0}}},
          "d1g357"};
}

std::optional<StudyInput> read(const std::string& text, Diagnostics& diagnostics,
                               std::vector<std::string>* asked = nullptr) {
  write_file("rsrrp.toml", test::kRsrrp);
  const ReadEarlierRun earlier = [&](const std::string& path, const MeasuredInput& measured,
                                     Diagnostics& found) -> std::optional<EarlierRun> {
    if (asked != nullptr) asked->push_back(path);
    if (measured.results->directory != "none") return run_of_a_rig();
    found.add(measured.file_at, "there is nothing", "");
    return std::nullopt;
  };
  return read_study(write_file("earlier.toml", text), {}, diagnostics, earlier);
}

TEST(EarlierData, of_experiments_are_what_signals_or_columns_name) {
  Diagnostics diagnostics;
  std::vector<std::string> asked;
  const auto input = read(kCalibration, diagnostics, &asked);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const MeasuredInput& slow = *input->load_case[0].measured;
  EXPECT_EQ(3u, slow.results->evaluation);
  EXPECT_EQ("slow", slow.results->load_case);
  EXPECT_EQ("d1g357", slow.results->digest);
  EXPECT_EQ(0.003, slow.time_offset);
  EXPECT_THAT(slow.data->times, ElementsAre(0.0, 0.1, 0.1 + 0.2));
  ASSERT_EQ(1u, slow.data->channels.size());
  EXPECT_EQ("closure.S.force.x", slow.data->channels[0].channel);
  EXPECT_THAT(slow.data->channels[0].values, ElementsAre(10.0, 20.0, 30.0));
  const MeasuredInput& fast = *input->load_case[1].measured;
  ASSERT_EQ(1u, fast.data->channels.size());
  EXPECT_EQ("closure.S.force.y", fast.data->channels[0].channel);
  EXPECT_THAT(fast.data->channels[0].values, ElementsAre(0.0, 1.0 / 3.0, -1e-300));
  const auto folder = std::filesystem::path(input->file).parent_path();
  EXPECT_THAT(asked,
              ElementsAre((folder / "first/results").string(), (folder / "second").string()));
}

TEST(EarlierData, of_a_reference_are_what_the_matches_compare) {
  Diagnostics diagnostics;
  const auto input = read(kStudy, diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const MeasuredInput* measured = reference_data_of(*input, {});
  ASSERT_TRUE(measured != nullptr && measured->data);
  std::vector<std::string> channels;
  for (const MeasuredChannel& one : measured->data->channels) channels.push_back(one.channel);
  EXPECT_THAT(channels, ElementsAre("joint.A.q", "rig.force.x", "rig.force.y", "rig.force.z"));
  EXPECT_THAT(measured->data->channels[3].values, ElementsAre(7.0, IsNan(), 9.0));
}

// The text is what a person could have written into a file, and holds all bits.
TEST(EarlierData, are_kept_as_a_text_that_gives_the_same_numbers_again) {
  Diagnostics diagnostics;
  const auto input = read(kCalibration, diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const std::vector<DataText> kept = data_texts(*input);
  ASSERT_EQ(2u, kept.size());
  EXPECT_EQ("first/results, evaluation 3, load case slow: closure.S.force", kept[0].name);
  EXPECT_EQ("d1g357", kept[0].digest);
  EXPECT_EQ("second: rig.force.y", kept[1].name);
  EXPECT_EQ("time [s],rig.force.y [N]\n0,0\n0.1,0.3333333333333333\n0.30000000000000004,-1e-300\n",
            kept[1].text);
  const auto again = read_study({kCalibration, test::kRsrrp, "", kept}, "results", diagnostics);
  ASSERT_TRUE(again) << to_string(diagnostics);
  for (std::size_t i = 0; i < 2; ++i) {
    const MeasuredData& before = *input->load_case[i].measured->data;
    const MeasuredData& after = *again->load_case[i].measured->data;
    EXPECT_EQ(before.times, after.times);
    EXPECT_EQ(before.channels[0].values, after.channels[0].values);
    EXPECT_EQ(before.channels[0].channel, after.channels[0].channel);
  }
}

TEST(EarlierData, that_results_do_not_hold_are_an_error_of_the_line_that_names_them) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_study({kStudy, test::kRsrrp, "", {}}, "results", diagnostics));
  EXPECT_THAT(to_string(diagnostics),
              HasSubstr("results:6:11: error: the results do not hold the data 'first: "
                        "rig.force, joint.A.q' of their input"));
}

TEST(EarlierData, are_refused_where_nobody_can_read_them) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_study(write_file("earlier.toml", kStudy), {}, diagnostics));
  EXPECT_THAT(to_string(diagnostics),
              HasSubstr("6:11: error: earlier results cannot be read here"));
}

bool reads(const std::string& text, Diagnostics& found) {
  return read(text, found).has_value();
}

class WrongEarlierExperiments : public ::testing::TestWithParam<test::WrongFile> {};

TEST_P(WrongEarlierExperiments, give_one_error_at_their_place) {
  test::expect_one_message(kCalibration, GetParam(), reads);
}

const test::WrongFile kWrongEarlierExperiments[] = {
    {"evaluation_of_a_file", "results = \"second\"\ncolumns = {",
     "evaluation = 1\nfile = \"force.csv\"\ncolumns = { time = \"t\",",
     ":18:1: error: experiment 'fast' names an evaluation or a load case of no results"},
    {"two_sources", "results = \"second\"", "results = \"second\"\nfile = \"a.csv\"", "error: "},
    {"nothing", "columns = { \"closure.S.force.y\" = \"rig.force.y\" }\n", "",
     ":18:1: error: experiment 'fast' names nothing to compare"},
    {"signals_and_columns", "weight = 2.0", "signals = [\"joint.A.q\"]",
     ":21:13: error: columns belong to a file or to results, and this experiment has signals"},
    {"time", "columns = {", "columns = { time = \"time\",",
     ":21:13: error: results have a time of their own"},
    {"not_kept", "[\"closure.S.force\"]", "[\"closure.S.torque\"]",
     ":15:12: error: 'first/results, evaluation 3, load case slow' keeps no history of "
     "'closure.S.torque'"},
    {"no_column", "\"rig.force.y\"", "\"rig.force\"",
     ":21:35: error: 'second' keeps no history of 'rig.force'"},
    {"not_there", "results = \"second\"", "results = \"none\"", ":20:11: error: there is nothing"},
    {"number", "evaluation = 3", "evaluation = -3", ":13:14: error: "},
};

INSTANTIATE_TEST_SUITE_P(All, WrongEarlierExperiments,
                         ::testing::ValuesIn(kWrongEarlierExperiments),
                         [](const auto& one) { return one.param.name; });

class WrongEarlierReferences : public ::testing::TestWithParam<test::WrongFile> {};

TEST_P(WrongEarlierReferences, give_one_error_at_their_place) {
  test::expect_one_message(kStudy, GetParam(), reads);
}

const test::WrongFile kWrongEarlierReferences[] = {
    {"run_and_results", "results = \"first\"", "results = \"first\"\nmodel = \"rsrrp.toml\"",
     ":7:9: error: a reference is a run, with model and set, or measured data"},
    {"evaluation_alone", "results = \"first\"", "evaluation = 1",
     ":5:1: error: this reference names an evaluation or a load case of no results"},
    {"no_match",
     "[[match]]\nsignal = \"closure.S.force\"\nreference_signal = \"-rig.force\"\ntolerance = "
     "0.02\n\n[[match]]\nsignal = \"joint.A.q\"\ntolerance = 0.02\n",
     "", ":6:11: error: no [[match]] compares anything with these results"},
    {"file_too", "results = \"first\"", "results = \"first\"\nfile = \"force.csv\"", "error: "},
    {"signals", "results = \"first\"", "results = \"first\"\nsignals = [\"rig.force\"]",
     ":7:1: error: "},
    {"not_kept", "\"-rig.force\"", "\"rig.torque\"",
     ":14:20: error: 'first' keeps no history of 'rig.torque'"},
};

INSTANTIATE_TEST_SUITE_P(All, WrongEarlierReferences, ::testing::ValuesIn(kWrongEarlierReferences),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace linkstudy::earlier_data_test

// [reference] and references of load cases that are measured data: what is read, what is wrong.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_text.h"
#include "study/config/measured_reader.h"
#include "study/config/precedence.h"
#include "wrong_text.h"

namespace linkstudy::reference_data_test {
namespace {

using test::write_file;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char* const kMeasuredStudy = R"(format = 1
kind = "study"
model = "rsrrp.toml"
base = { set = { "closure.S.model" = "sde" } }
[reference]
file = "force.csv"
columns = { time = "t [ms]", "closure.S.force.x" = "Fx [kN]" }
time_offset = "3 ms"

[[vary]]
parameter = "closure.S.sde.stiffness"
values = [1e5, 1e6]

[[match]]
signal = "closure.S.force.x"
tolerance = 0.02

[[load_case]]
name = "slow"
reference = { file = "slow.csv", columns = { time = "t", "closure.S.force.x" = "F" } }

[[load_case]]
name = "fast"
set = { "load.drive.course.value" = 5.0 }
)";

std::optional<StudyInput> read_measured_study(const std::string& text, Diagnostics& diagnostics) {
  write_file("rsrrp.toml", test::kRsrrp);
  write_file("force.csv", "t [ms],Fx [kN]\n600,1\n700,2\n");
  write_file("slow.csv", "t\tF\n0.5\t30\n");
  return read_study(write_file("measured.toml", text), {}, diagnostics);
}

TEST(ReferenceData, serve_all_load_cases_that_have_none_of_their_own) {
  Diagnostics diagnostics;
  const auto input = read_measured_study(kMeasuredStudy, diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  const MeasuredInput* slow = reference_data_of(*input, input->load_case[0]);
  const MeasuredInput* fast = reference_data_of(*input, input->load_case[1]);
  ASSERT_TRUE(slow != nullptr && fast != nullptr);
  EXPECT_EQ(nullptr, reference_run_of(*input, input->load_case[0]));
  EXPECT_THAT(slow->data->channels[0].values, ElementsAre(30.0));
  EXPECT_THAT(fast->data->channels[0].values, ElementsAre(1000.0, 2000.0));
  EXPECT_THAT(fast->data->times, ElementsAre(DoubleEq(0.6), DoubleEq(0.7)));
  EXPECT_EQ(0.003, fast->time_offset);
  const std::vector<DataText> texts = data_texts(*input);
  ASSERT_EQ(2u, texts.size());
  EXPECT_EQ("force.csv", texts[0].name);
  EXPECT_EQ("t\tF\n0.5\t30\n", texts[1].text);
}

TEST(ReferenceData, are_read_from_what_results_hold_of_them) {
  Diagnostics diagnostics;
  const std::string single =
      std::string(kMeasuredStudy).substr(0, std::string(kMeasuredStudy).find("[[load_case]]"));
  ResolvedTexts texts{single, test::kRsrrp, "", {{"force.csv", "t [ms],Fx [kN]\n1,5\n"}}};
  const auto input = read_study(texts, "results", diagnostics);
  ASSERT_TRUE(input) << to_string(diagnostics);
  EXPECT_THAT(input->reference->measured->data->channels[0].values, ElementsAre(5000.0));
  texts.data.clear();
  EXPECT_FALSE(read_study(texts, "results", diagnostics));
  EXPECT_THAT(to_string(diagnostics),
              HasSubstr("results:6:8: error: the results do not hold the data 'force.csv'"));
}

class WrongReferences : public ::testing::TestWithParam<test::WrongFile> {};

TEST_P(WrongReferences, give_one_error_at_their_place) {
  test::expect_one_message(kMeasuredStudy, GetParam(),
                           [](const std::string& text, Diagnostics& found) {
                             return read_measured_study(text, found).has_value();
                           });
}

const test::WrongFile kWrongReferences[] = {
    {"run_and_data", "time_offset = \"3 ms\"", "set = { \"closure.S.model\" = \"cut\" }",
     ":8:9: error: a reference is a run, with model and set, or measured data"},
    {"model_and_data", "time_offset = \"3 ms\"", "model = \"rsrrp.toml\"",
     ":8:9: error: a reference is a run, with model and set, or measured data"},
    {"no_file", "file = \"force.csv\"\n", "", ":5:1: error: this reference has columns"},
    {"no_columns", "columns = { time = \"t [ms]\", \"closure.S.force.x\" = \"Fx [kN]\" }\n", "",
     ":6:8: error: this reference does not say which column is the time"},
    {"no_channel", ", \"closure.S.force.x\" = \"Fx [kN]\"", "",
     ":6:8: error: this reference compares no channel"},
    {"no_head", "\"Fx [kN]\"", "\"Fx [N]\"", "has no column 'Fx [N]'"},
    {"not_there", "file = \"force.csv\"", "file = \"none.csv\"", ":6:8: error: data '"},
    {"fitted_offset", "\"3 ms\"", "\"fit\"", ":8:15: error: time_offset must be a time"},
    {"window_of_an_experiment", "time_offset = \"3 ms\"", "window = [0, 1]", ":8:1: error: "},
    {"run_of_a_load_case", "reference = { file = \"slow.csv\"",
     "reference = { set = {}, file = \"slow.csv\"", ":20:15: error: "},
    {"useless", "name = \"fast\"",
     "name = \"fast\"\nreference = { file = \"slow.csv\", columns = { time = \"t\", "
     "\"closure.S.force.x\" = \"F\" } }",
     ":5:1: error: nothing is compared with this: every load case has a reference"},
    {"missing",
     "[reference]\nfile = \"force.csv\"\ncolumns = { time = \"t [ms]\", \"closure.S.force.x\" = "
     "\"Fx [kN]\" }\ntime_offset = \"3 ms\"\n",
     "", ":18:1: error: this load case has no reference to compare with"},
};

INSTANTIATE_TEST_SUITE_P(All, WrongReferences, ::testing::ValuesIn(kWrongReferences),
                         [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace linkstudy::reference_data_test

#include "study/config/measured_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "config_text.h"

namespace linkstudy::measured_data_test {
namespace {

using test::write_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<WantedColumn> wanted(const std::string& time, const std::string& force) {
  return {{"time", {}, time, make_location("study.toml", 3, 1)},
          {"closure.S.force.x", make_location("study.toml", 4, 1), force,
           make_location("study.toml", 4, 20)}};
}

std::shared_ptr<const MeasuredData> read(const std::string& text, Diagnostics& diagnostics,
                                         const std::string& force = "Fx [kN]") {
  const std::string path = write_file("data.csv", text);
  const Location at = make_location("study.toml", 2, 8);
  const std::optional<std::string> read = read_data_text(path, at, diagnostics);
  return read ? parse_measured_data(*read, path, at, wanted("t [ms]", force), diagnostics)
              : nullptr;
}

std::vector<std::string> errors_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_EQ(nullptr, read(text, diagnostics));
  std::vector<std::string> errors;
  for (const Diagnostic& one : diagnostics.sorted()) errors.push_back(to_string(one));
  return errors;
}

TEST(MeasuredData, comes_in_SI_units_by_the_heads_of_its_columns) {
  for (const char* text : {"t [ms],note,Fx [kN]\n10,a,0.5\n20,b,-1.5e0\n",
                           "# units\n\nt [ms] ; note ; Fx [kN]\r\n10;a;+0.5\r\n20;\"b;c\";-1.5\r\n",
                           "\xEF\xBB\xBF\"t [ms]\"\tFx [kN]\n10\t0.5\n20\t-1.5\n"}) {
    Diagnostics diagnostics;
    const auto data = read(text, diagnostics);
    ASSERT_NE(nullptr, data) << to_string(diagnostics);
    EXPECT_THAT(data->times, ElementsAre(0.01, 0.02));
    EXPECT_EQ("closure.S.force.x", data->channels.at(0).channel);
    EXPECT_THAT(data->channels[0].values, ElementsAre(500.0, -1500.0));
    EXPECT_EQ((std::array{1, 1, -2, 0}), data->channels[0].unit->dimensions);
  }
}

TEST(MeasuredData, leaves_missing_samples_as_NaN) {
  Diagnostics diagnostics;
  const auto data = read("t [ms],Fx [kN]\n1,\n2,NaN\n3\n4,7\n", diagnostics);
  ASSERT_NE(nullptr, data) << to_string(diagnostics);
  const std::vector<double>& values = data->channels[0].values;
  ASSERT_EQ(4u, values.size());
  EXPECT_TRUE(std::isnan(values[0]) && std::isnan(values[1]) && std::isnan(values[2]));
  EXPECT_EQ(7000.0, values[3]);
}

TEST(MeasuredData, says_the_place_of_everything_that_is_wrong_in_one_pass) {
  const auto errors = errors_of("t [ms],Fx [kN]\n1,2\n2,\"3,5\"\n3, x\n");
  ASSERT_EQ(2u, errors.size());
  EXPECT_THAT(errors[0], HasSubstr("data.csv:3:3: error: '3,5' is no number"));
  EXPECT_THAT(errors[1], HasSubstr("data.csv:4:3: error: 'x' is no number"));
}

TEST(MeasuredData, has_instants_that_rise) {
  EXPECT_THAT(errors_of("t [ms],Fx [kN]\n1,2\n1,3\n"),
              ElementsAre(HasSubstr("data.csv:3:1: error: this instant is not after")));
  EXPECT_THAT(errors_of("t [ms],Fx [kN]\n1,2\n,3\n"),
              ElementsAre(HasSubstr("data.csv:3:1: error: this line has no instant")));
}

TEST(MeasuredData, names_the_nearest_heads_and_what_is_no_unit) {
  EXPECT_THAT(errors_of("t [ms],Fx [N]\n1,2\n"),
              ElementsAre(HasSubstr("study.toml:4:20: error: ")));
  EXPECT_THAT(errors_of("t [ms],Fy [kN]\n1,2\n"), ElementsAre(HasSubstr("nearest: Fy [kN]")));
  Diagnostics diagnostics;
  EXPECT_EQ(nullptr, read("t [ms],Fx [newts]\n1,2\n", diagnostics, "Fx [newts]"));
  EXPECT_THAT(to_string(diagnostics), HasSubstr("data.csv:1:8: error: 'newts' is no unit"));
}

TEST(MeasuredData, that_is_not_there_is_an_error_of_the_line_that_names_it) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read_data_text("nowhere.csv", make_location("study.toml", 2, 8), diagnostics));
  EXPECT_THAT(to_string(diagnostics), HasSubstr("study.toml:2:8: error: data 'nowhere.csv'"));
  EXPECT_THAT(errors_of("t [ms],Fx [kN]\n"), ElementsAre(HasSubstr("no lines of numbers")));
}

}  // namespace
}  // namespace linkstudy::measured_data_test

// Designs as users write them: the forms of [[vary]] that each takes, units, points from a file,
// and what is refused with its place.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "config_text.h"
#include "study/config/case_selection.h"
#include "study/config/toml_writer.h"
#include "study/design/design.h"

namespace linkstudy::design_input_test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

constexpr const char* kPeak =
    "[[response]]\nname = \"peak\"\nsignal = \"closure.S.force\"\nreduce = \"max_abs\"\n";

std::string study(const std::string& design, const std::string& rest) {
  return "format = 1\nkind = \"study\"\nmodel = \"rsrrp.toml\"\n"
         "base = { set = { \"closure.S.model\" = \"sde\" } }\n" +
         fmt::format("design = {{ {} }}\n", design) + rest;
}

std::string vary(const std::string& path, const std::string& form) {
  return fmt::format("[[vary]]\nparameter = \"{}\"\n{}\n", path, form);
}

std::string mass(const std::string& form) {
  return vary("link.crank.mass", form);
}

std::optional<StudyInput> read(const std::string& text, Diagnostics& diagnostics) {
  test::write_file("rsrrp.toml", test::kRsrrp);
  return read_study(test::write_file("study.toml", text), {}, diagnostics);
}

StudyInput good(const std::string& text) {
  Diagnostics diagnostics;
  const std::optional<StudyInput> input = read(text, diagnostics);
  EXPECT_TRUE(input) << to_string(diagnostics) << text;
  return input.value_or(StudyInput{});
}

std::string errors_of(const std::string& text) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read(text, diagnostics)) << text;
  return to_string(diagnostics);
}

std::vector<double> numbers(const VaryInput& one) {
  std::vector<double> found;
  for (const Value& value : one.values) found.push_back(std::get<double>(value));
  return found;
}

TEST(DesignInput, Samples_have_distributions_in_the_units_of_their_parameters) {
  const StudyInput input = good(study(
      "type = \"sobol\", samples = 16",
      mass("lin = [\"800 g\", 1.2]") + vary("closure.S.sde.stiffness", "log = [\"1 kN/m\", 1e6]") +
          vary("link.coupler.mass", "normal = { mean = 1.5, deviation = \"50 g\", low = 1.4 }") +
          vary("closure.S.sde.damping", "triangular = { low = 1, mode = 3, high = 10 }") + kPeak));
  ASSERT_EQ(input.vary.size(), 4u);
  EXPECT_EQ(*input.vary[0].distribution, (Distribution{Law::lin, 0.8, 1.2}));
  EXPECT_EQ(*input.vary[1].distribution, (Distribution{Law::log, 1.0e3, 1.0e6}));
  const Distribution& normal = *input.vary[2].distribution;
  EXPECT_EQ(normal.law, Law::normal);
  EXPECT_EQ(normal.mean, 1.5);
  EXPECT_DOUBLE_EQ(normal.deviation, 0.05);
  EXPECT_EQ(normal.low, 1.4);
  EXPECT_TRUE(std::isinf(normal.high));
  EXPECT_EQ(input.vary[3].distribution->mode, 3.0);
  EXPECT_EQ(input.design.samples, 16u);
  EXPECT_EQ(count_points(input.design, axes_of(input)), 16u);
}

TEST(DesignInput, The_seed_of_the_run_is_that_of_the_samples) {
  const std::string text =
      study("type = \"latin_hypercube\", samples = 4", mass("lin = [1, 2]") + kPeak);
  EXPECT_EQ(good(text).design.seed, 1u);
  EXPECT_EQ(good(text + "[run]\nseed = 9\n").design.seed, 9u);
}

TEST(DesignInput, A_centre_is_the_value_of_the_model_where_it_is_not_said) {
  const StudyInput input =
      good(study("type = \"centered\"",
                 mass("around = { step = \"100 g\", steps = 2 }") +
                     vary("link.coupler.mass", "around = { center = 2, ratio = 2, steps = 1 }")));
  EXPECT_THAT(numbers(input.vary[0]),
              ElementsAre(::testing::DoubleEq(0.8), ::testing::DoubleEq(0.9), 1.0,
                          ::testing::DoubleEq(1.1), ::testing::DoubleEq(1.2)));
  EXPECT_EQ(input.vary[0].center, 2u);
  EXPECT_THAT(numbers(input.vary[1]), ElementsAre(1.0, 2.0, 4.0));
  EXPECT_EQ(count_points(input.design, axes_of(input)), 7u);
  EXPECT_THAT(write_toml(input.resolved), HasSubstr("center = 1.0"));
}

TEST(DesignInput, A_vector_has_its_ends_and_its_steps) {
  const StudyInput input =
      good(study("type = \"vector\", steps = 4",
                 mass("lin = [2, 1]") + vary("link.coupler.mass", "log = [1, \"16 kg\"]")));
  EXPECT_THAT(numbers(input.vary[0]), ElementsAre(2.0, 1.75, 1.5, 1.25, 1.0));
  EXPECT_EQ(numbers(input.vary[1]).front(), 1.0);
  EXPECT_DOUBLE_EQ(numbers(input.vary[1])[1], 2.0);
  EXPECT_EQ(numbers(input.vary[1]).back(), 16.0);
}

TEST(DesignInput, Points_of_a_list_come_from_a_file_with_units_in_its_heads) {
  test::write_file("points.csv",
                   "# by hand\nrun;c [kN/m];m [g];kind\n1;100;900;ground\n2;2e3;1100;first\n");
  const StudyInput input = good(
      study("type = \"list\", file = \"points.csv\", columns = { \"closure.S.sde.stiffness\" = "
            "\"c [kN/m]\", \"link.crank.mass\" = \"m [g]\", \"closure.S.sde.axes\" = \"kind\" }",
            ""));
  ASSERT_EQ(input.vary.size(), 3u);
  EXPECT_THAT(numbers(input.vary[0]), ElementsAre(1.0e5, 2.0e6));
  EXPECT_THAT(numbers(input.vary[1]), ElementsAre(0.9, 1.1));
  EXPECT_THAT(input.vary[2].values, ElementsAre(Value("ground"), Value("first")));
  // What is kept needs no file.
  const std::string kept = write_toml(input.resolved);
  EXPECT_THAT(kept, Not(HasSubstr("points.csv")));
  EXPECT_THAT(kept, HasSubstr("[[vary]]"));
}

TEST(DesignInput, Heads_may_be_the_paths_as_a_plan_writes_them) {
  test::write_file("points.csv",
                   "# units: ,kg,N/m\nevaluation,link.crank.mass,closure.S.sde.stiffness [N/mm]\n"
                   "0,1.5,100\n1,2.5,200\n2,2.5,200\n");
  const StudyInput input = good(study("type = \"list\", file = \"points.csv\"", ""));
  ASSERT_EQ(input.vary.size(), 2u);
  EXPECT_EQ(input.vary[0].parameter.path, "link.crank.mass");
  EXPECT_THAT(numbers(input.vary[1]), ElementsAre(1.0e5, 2.0e5));  // equal rows run once
  EXPECT_EQ(input.remarks.size(), 1u);
}

TEST(DesignInput, What_is_wrong_in_a_file_is_said_with_its_line) {
  const auto errors = [](const std::string& csv, const std::string& rest = "") {
    test::write_file("points.csv", csv);
    return errors_of(study("type = \"list\", file = \"points.csv\"", rest));
  };
  EXPECT_THAT(errors("link.crank.mass\n1\nheavy\n"),
              HasSubstr("points.csv:3:1: error: 'heavy' is no number"));
  EXPECT_THAT(errors("link.crank.mass [N]\n1\n"),
              HasSubstr("points.csv:1:1: error: column 'link.crank.mass [N]' must be in kg"));
  EXPECT_THAT(errors("link.crank.mass,link.coupler.mass\n1,2\n3\n"),
              HasSubstr("points.csv:3:1: error: this line has no number"));
  EXPECT_THAT(errors("link.crank.mas\n1\n"),
              HasSubstr("points.csv:1:1: error: parameter names no"));
  EXPECT_THAT(errors("link.crank.mass\n1\n-2\n"),
              HasSubstr("points.csv:3:1: error: link.crank.mass must be positive"));
  EXPECT_THAT(errors("evaluation\n1\n"), HasSubstr("points.csv' has no column of a parameter"));
  EXPECT_THAT(errors(""), HasSubstr("has no column of a parameter"));
  EXPECT_THAT(errors("link.crank.mass\n"), HasSubstr("there are no lines of numbers in it"));
  EXPECT_THAT(errors("closure.S.sde.axes\nground\n\nsideways\n"),
              HasSubstr("points.csv:4:1: error: closure.S.sde.axes must be one of"));
  EXPECT_THAT(errors("link.crank.mass\n1\n", mass("values = [1]")),
              HasSubstr("the points are those of design.file, and [[vary]] gives others"));
  EXPECT_THAT(errors_of(study("type = \"list\", file = \"none.csv\"", "")),
              HasSubstr("study.toml:5:34: error: data"));
  EXPECT_THAT(errors_of(study("type = \"list\", columns = { }", mass("values = [1]"))),
              HasSubstr("columns are those of a file, and none is given"));
}

struct Refused {
  std::string design;
  std::string rest;
  std::string message;
  std::string remedy;
};

TEST(DesignInput, What_a_design_would_ignore_or_lacks_is_refused_with_a_remedy) {
  const std::string lhs = "type = \"latin_hypercube\", samples = 4";
  const std::string saltelli = "type = \"saltelli\", samples = 4";
  const Refused cases[] = {
      {lhs, mass("values = [1, 2]"), "values does not go with a design of type 'latin_hypercube'",
       "it takes lin, log, normal, triangular"},
      {lhs, mass("lin = [1, 2, 3]"), "lin is [lowest, highest] in a design of type", "lin = ["},
      {"type = \"grid\"", mass("lin = [1, 2]"), "lin is [first, last, count]", "lin = ["},
      {"type = \"grid\"", mass("normal = { mean = 1, deviation = 0.1 }"),
       "normal does not go with a design of type 'grid'", "values, lin, log, ladder, around"},
      {"type = \"grid\", samples = 4", mass("values = [1]"),
       "samples does not go with type = 'grid'",
       "it goes with type = latin_hypercube, sobol, saltelli"},
      {"type = \"sobol\"", mass("lin = [1, 2]"), "design.samples is missing", "add samples"},
      {"type = \"sobol\", samples = 8, levels = 4", mass("lin = [1, 2]"),
       "levels does not go with type = 'sobol'", "morris"},
      {"type = \"vector\"", mass("lin = [1, 2]"), "design.steps is missing", "add steps"},
      {"type = \"vector\", steps = 3", mass("values = [1, 2]"),
       "values does not go with a design of type 'vector'", "it takes lin, log"},
      {"type = \"centered\"", mass("lin = [1, 2, 3]"), "lin does not go with", "it takes around"},
      {"type = \"centered\"", mass("around = { steps = 2 }"), "step or ratio is missing",
       "add step"},
      {"type = \"centered\"", mass("around = { step = \"1 N\", steps = 2 }"),
       "step of 'link.crank.mass' must be", "kg"},
      {"type = \"centered\"", mass("around = { step = 0.6, steps = 2 }"),
       "must be positive, got -0.2", ""},
      {"type = \"morris\", trajectories = 4, levels = 3", mass("lin = [1, 2]"),
       "levels must be even, got 3", "4, 6 or 8"},
      {"type = \"morris\", trajectories = 4", mass("triangular = { low = 1, mode = 2, high = 3 }"),
       "triangular does not go with a design of type 'morris'", "it takes lin, log"},
      {"type = \"morris\", trajectories = 4", mass("lin = [1, 2]") + "#",
       "a design of type 'morris' tells sensitivities, and no quantity is kept", "[[response]]"},
      {lhs, vary("closure.S.model", "lin = [1, 2]"), "is no real number and cannot be sampled",
       "list its values"},
      {lhs, mass("lin = [2, 1]"), "the range of 'link.crank.mass' must rise", "[lowest, highest]"},
      {lhs, mass("normal = { mean = 1, deviation = 0.2 }"), "and its samples reach -0.64",
       "give low and high"},
      {lhs, mass("normal = { mean = 1, deviation = 0 }"), "deviation of 'link.crank.mass' must be",
       ""},
      {lhs, mass("normal = { mean = 1, deviation = 0.01, low = 2, high = 3 }"),
       "the bounds of 'link.crank.mass' hold 0 of", "about the mean"},
      {lhs, mass("triangular = { low = 1, mode = 4, high = 3 }"), "must rise from low to high",
       "triangular = { low, mode, high }"},
      {lhs, mass("lin = [1, 2]") + mass("lin = [1, 2]"), "is listed twice", ""},
      {"type = \"saltelli\", samples = 1", mass("lin = [1, 2]"), "one tells nothing, got 1",
       "64 or more"},
      {saltelli, "", "there is nothing to sample", "name a parameter"},
      {"type = \"saltelli\", samples = 100000000", mass("lin = [1, 2]"),
       "100000000 x 3 points are more than", "use fewer"},
  };
  for (const Refused& one : cases) {
    const bool keeps_nothing = !one.rest.empty() && one.rest.back() == '#';
    const std::string errors =
        errors_of(study(one.design, one.rest + (keeps_nothing ? "" : kPeak)));
    EXPECT_THAT(errors, HasSubstr("study.toml:"));
    EXPECT_THAT(errors, HasSubstr(one.message)) << one.design << "\n" << one.rest;
    EXPECT_THAT(errors, HasSubstr(one.remedy)) << one.design << "\n" << one.rest;
  }
}

// The step must not exceed the end: true of some of the points alone.
TEST(DesignInput, Points_of_samples_are_judged_as_models) {
  const std::string errors =
      errors_of(study("type = \"sobol\", samples = 64",
                      vary("simulation.step", "lin = [0.001, 0.1]") +
                          vary("simulation.end_time", "lin = [0.05, 0.2]") + kPeak));
  EXPECT_THAT(errors, HasSubstr("simulation.step must not exceed end_time"));
}

TEST(DesignInput, A_sampled_value_without_effect_is_refused) {
  const std::string text =
      test::replaced(study("type = \"sobol\", samples = 4",
                           vary("closure.S.sde.stiffness", "log = [1e4, 1e6]") + kPeak),
                     "\"sde\" }", "\"cut\" }");
  EXPECT_THAT(errors_of(text), HasSubstr("has no effect on any case"));
}

}  // namespace
}  // namespace linkstudy::design_input_test

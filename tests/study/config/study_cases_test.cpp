// Cases of a study before they run: those that occur, without repetitions, each of them with an
// effect.
#include "study/config/study_cases.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "config_text.h"
#include "study/config/case_selection.h"

namespace linkstudy::study_cases_test {
namespace {

using test::kRsrrp;
using test::write_file;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr const char* kHead = "format = 1\nkind = \"study\"\nmodel = \"rsrrp.toml\"\n";
constexpr const char* kSde = "base = { set = { \"closure.S.model\" = \"sde\" } }\n";

std::string vary(const std::string& path, const std::string& values) {
  return fmt::format("[[vary]]\nparameter = \"{}\"\n{}\n", path, values);
}

std::optional<StudyInput> read(const std::string& text, Diagnostics& diagnostics,
                               const std::string& model = kRsrrp) {
  write_file("rsrrp.toml", model);
  return read_study(write_file("study.toml", kHead + text), {}, diagnostics);
}

std::string errors_of(const std::string& text, const std::string& model = kRsrrp) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read(text, diagnostics, model)) << text;
  return to_string(diagnostics);
}

StudyInput good(const std::string& text, const std::string& model = kRsrrp) {
  Diagnostics diagnostics;
  const std::optional<StudyInput> input = read(text, diagnostics, model);
  EXPECT_TRUE(input) << to_string(diagnostics);
  return input.value_or(StudyInput{});
}

constexpr const char* kList = "design = { type = \"list\" }\n";

TEST(StudyCases, Equal_values_of_a_grid_run_once_and_a_note_counts_them) {
  const StudyInput input =
      good(kSde + vary("closure.S.sde.stiffness",
                       "values = [1.0e5, \"1e5 N/m\", \"100 kN/m\", 1.0e6, 100000]"));
  EXPECT_THAT(input.vary[0].values, ElementsAre(Value(1.0e5), Value(1.0e6)));
  ASSERT_EQ(input.remarks.size(), 1u);
  EXPECT_EQ(input.remarks[0].severity, Severity::note);
  EXPECT_THAT(input.remarks[0].message,
              HasSubstr("100000 N/m of 'closure.S.sde.stiffness' is given 4 times and runs once"));
  EXPECT_EQ(input.remarks[0].line, 7);
  EXPECT_EQ(input.remarks[0].column, 18);  // of the second
}

TEST(StudyCases, A_list_merges_whole_rows_only) {
  const StudyInput input = good(kList + vary("link.crank.mass", "values = [1, 1, 2, 1]") +
                                vary("link.coupler.mass", "values = [3, 4, 3, \"3000 g\"]"));
  EXPECT_THAT(input.vary[0].values, ElementsAre(Value(1.0), Value(1.0), Value(2.0)));
  EXPECT_THAT(input.vary[1].values, ElementsAre(Value(3.0), Value(4.0), Value(3.0)));
  EXPECT_EQ(input.remarks.size(), 1u);
  EXPECT_THAT(good(vary("link.crank.mass", "values = [1, 1.0000001]")).remarks, IsEmpty());
}

// mu_s must not be below mu_k, and the step not exceed the end: true of every row, and not of every
// combination.
TEST(StudyCases, Of_a_list_only_the_rows_are_judged) {
  const std::string times = vary("simulation.end_time", "values = [1.0, 0.05]") +
                            vary("simulation.step", "values = [0.1, 0.01]");
  good(kList + times);
  EXPECT_THAT(errors_of(times), HasSubstr("simulation.step must not exceed end_time"));
  const std::string swapped = vary("simulation.end_time", "values = [0.05, 1.0]") +
                              vary("simulation.step", "values = [0.1, 0.01]");
  EXPECT_THAT(errors_of(kList + swapped),
              HasSubstr("study.toml:10:11: error: simulation.step must not exceed end_time"));
}

TEST(StudyCases, Every_combination_of_a_small_grid_is_judged) {
  // Only the last of both values is wrong together.
  const std::string text = vary("simulation.end_time", "values = [1.0, 0.5, 0.05]") +
                           vary("simulation.step", "values = [0.01, 0.02, 0.1]");
  EXPECT_THAT(errors_of(text), HasSubstr("got 0.1 s"));
}

TEST(StudyCases, A_grid_beyond_all_bounds_is_an_error_of_the_entry_that_makes_it_so) {
  const std::string text = vary("link.crank.mass", "log = [1, 2, 100000]") +
                           vary("link.coupler.mass", "log = [1, 2, 100000]") +
                           vary("gravity.1", "lin = [-10, -9, 100000]");
  const std::string errors = errors_of(text);
  EXPECT_THAT(errors, HasSubstr("study.toml:8:13: error: the grid of 100000 x 100000 cases"));
  EXPECT_EQ(std::count(errors.begin(), errors.end(), '\n'), 2) << errors;
}

TEST(StudyCases, A_value_without_effect_on_any_case_is_an_error_that_names_both_lines) {
  const std::string stiffness = vary("closure.S.sde.stiffness", "values = [1e5, 1e6]");
  const std::string errors = errors_of(stiffness);
  EXPECT_THAT(errors, HasSubstr("study.toml:5:13: error: 'closure.S.sde.stiffness' has no effect "
                                "on any case: closure.S.model = 'cut' ("));
  EXPECT_THAT(errors, HasSubstr("rsrrp.toml:"));
  good(kSde + stiffness);
  good(stiffness + vary("closure.S.model", "values = [\"cut\", \"sde\"]"));
  good(stiffness + "[[load_case]]\nname = \"soft\"\nset = { \"closure.S.model\" = \"sde\" }\n");
  EXPECT_THAT(errors_of("base = { set = { \"closure.S.model\" = \"cut\" } }\n" + stiffness),
              HasSubstr("closure.S.model = 'cut' ("));
  EXPECT_THAT(errors_of(vary("kinematics.positions", "values = [3, 4]")),
              HasSubstr("has no effect on any case: study does not use it"));
  const std::string drawn = test::replaced(
      test::kRsrrp, "mass = 0.2", "mass = 0.2\nshape = [{ kind = \"sphere\", diameter = 0.01 }]");
  EXPECT_THAT(errors_of(vary("link.yoke.shape.0.diameter", "values = [0.01, 0.02]"), drawn),
              HasSubstr("has no effect on any case: study does not use it"));
}

TEST(StudyCases, A_tuned_value_without_effect_is_an_error_too) {
  write_file("rsrrp.toml", kRsrrp);
  const std::string text =
      "format = 1\nkind = \"tune\"\nmodel = \"rsrrp.toml\"\nreference = {}\n[[tune]]\nparameter = "
      "\"closure.S.sde.stiffness\"\nrange = { log = [1e3, 1e8] }\n[[match]]\nsignal = "
      "\"closure.S.force\"\ntolerance = 0.02\n";
  Diagnostics diagnostics;
  EXPECT_FALSE(read_study(write_file("tune.toml", text), {}, diagnostics));
  EXPECT_THAT(to_string(diagnostics), HasSubstr("tune.toml:6:13: error: 'closure.S.sde.stiffness' "
                                                "has no effect on any case"));
}

TEST(StudyCases, What_a_study_sets_without_effect_is_remarked) {
  const StudyInput input = good("base = { set = { \"closure.S.sde.damping_ratio\" = 0.7 } }\n" +
                                vary("link.crank.mass", "values = [1, 2]"));
  ASSERT_EQ(input.remarks.size(), 1u);
  EXPECT_EQ(input.remarks[0].line, 4);
  EXPECT_THAT(input.remarks[0].message, HasSubstr("closure.S.sde.damping_ratio has no effect"));
}

TEST(StudyCases, A_selection_keeps_every_case_of_a_small_design) {
  EXPECT_THAT(choose_cases(Design::grid, {2, 3}, 6),
              ElementsAre(ElementsAre(0, 0), ElementsAre(0, 1), ElementsAre(0, 2),
                          ElementsAre(1, 0), ElementsAre(1, 1), ElementsAre(1, 2)));
  EXPECT_THAT(choose_cases(Design::list, {3, 3}, 6),
              ElementsAre(ElementsAre(0, 0), ElementsAre(1, 1), ElementsAre(2, 2)));
  EXPECT_THAT(choose_cases(Design::grid, {}, 6), ElementsAre(IsEmpty()));
}

TEST(StudyCases, A_selection_of_a_large_design_is_bounded_and_has_both_ends) {
  const auto list = choose_cases(Design::list, {1000, 1000}, 10);
  EXPECT_EQ(list.size(), 10u);
  EXPECT_THAT(list.front(), ElementsAre(0, 0));
  EXPECT_THAT(list.back(), ElementsAre(999, 999));
  const auto grid = choose_cases(Design::grid, {1000, 7}, 10);
  EXPECT_LE(grid.size(), 2u * (10 + 7));
  std::set<std::size_t> sevens;
  for (const CasePositions& one : grid) sevens.insert(one[1]);
  EXPECT_EQ(sevens.size(), 7u);
  EXPECT_THAT(grid, ::testing::Contains(ElementsAre(999, 6)));
}

TEST(StudyCases, Are_counted_as_far_as_a_study_goes) {
  EXPECT_EQ(count_cases(Design::grid, {1000, 1000, 100}), 100'000'000u);
  EXPECT_FALSE(count_cases(Design::grid, {1000, 1000, 101}));
  EXPECT_FALSE(count_cases(Design::grid, {1u << 31, 1u << 31, 1u << 31}));
  EXPECT_EQ(count_cases(Design::list, {1000, 1000, 1000}), 1000u);
}

}  // namespace
}  // namespace linkstudy::study_cases_test

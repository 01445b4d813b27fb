// Study and tune files: what is read, what is wrong with them, and that they fit their model.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "config_text.h"
#include "study/config/check_file.h"
#include "study/config/precedence.h"
#include "study/config/toml_writer.h"

namespace linkstudy::study_test {
namespace {

using test::kRsrrp;
using test::replaced;
using test::write_file;
using ::testing::DoubleEq;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

const char* const kTune = R"(format = 1
kind = "tune"
model = "rsrrp.toml"
name = "lowest spherical-joint stiffness of RSRRP"
reference = { set = { "closure.S.model" = "cut" } }
base      = { set = { "closure.S.model" = "sde", "closure.S.sde.damping_ratio" = 0.7 } }

[[tune]]
parameter = "closure.S.sde.stiffness"
range = { log = [1.0e3, "100 MN/m"] }

[[match]]
signal = "closure.S.force"
norm = "max"
tolerance = 0.02
window = [0.5, 15.0]

[[load_case]]
name = "fast"
set = { "load.resistance.law.at_speed" = 12.0 }
)";

const char* const kStudy = R"(format = 1
kind = "study"
model = "rsrrp.toml"
reference = {}
base.set.closure.S.model = "sde"

[[vary]]
parameter = "closure.S.sde.stiffness"
log = [1e4, 1e8, 5]

[[vary]]
parameter = "simulation.step"
ladder = { from = "100 us", ratio = 0.5, levels = 3 }

[[vary]]
parameter = "joint.A.initial.position"
values = ["0 deg", 0.5, "90 deg"]

[[vary]]
parameter = "gravity.1"
lin = [-10, 0, 3]

[[vary]]
parameter = "closure.S.sde.axes"
values = ["ground", "first"]

[[match]]
signal = "closure.S.force"
reference_signal = "-joint.A.force"
norm = "rms"
scale = "vector"
tolerance = "2 %"

[[response]]
name = "largest_drift"
signal = "closure.S.gap.x"
reduce = "max_abs"
window = [1, 2]

[[trace]]
signals = ["closure.S.force", "joint.A.q"]

[run]
seed = 7
timeout = "2 min"
max_failures = "5 %"
on_failure = "abort"
)";

std::optional<StudyInput> read(const std::string& text, Diagnostics& diagnostics,
                               const std::string& model = kRsrrp,
                               std::vector<std::string> sets = {}) {
  write_file("rsrrp.toml", model);
  std::vector<Override> overrides;
  for (const std::string& assignment : sets) overrides.push_back(test::set(assignment));
  return read_study(write_file("study.toml", text), overrides, diagnostics);
}

StudyInput good(const std::string& text, std::vector<std::string> sets = {}) {
  Diagnostics diagnostics;
  std::optional<StudyInput> input = read(text, diagnostics, kRsrrp, std::move(sets));
  EXPECT_TRUE(input) << to_string(diagnostics);
  return input.value_or(StudyInput{});
}

std::vector<double> numbers(const VaryInput& vary) {
  std::vector<double> result;
  for (const Value& value : vary.values) result.push_back(std::get<double>(value));
  return result;
}

TEST(Study, A_tune_file_is_read) {
  const StudyInput input = good(kTune);
  EXPECT_EQ(input.kind, FileKind::tune);
  EXPECT_EQ(input.name, "lowest spherical-joint stiffness of RSRRP");
  ASSERT_EQ(input.tune.size(), 1u);
  EXPECT_EQ(input.tune[0].parameter.path, "closure.S.sde.stiffness");
  EXPECT_EQ(input.tune[0].parameter.unit, "N/m");
  EXPECT_TRUE(input.tune[0].is_logarithmic);
  EXPECT_EQ(input.tune[0].low, 1e3);
  EXPECT_EQ(input.tune[0].high, 1e8);
  ASSERT_EQ(input.match.size(), 1u);
  EXPECT_EQ(input.match[0].signal, "closure.S.force");
  EXPECT_EQ(input.match[0].reference_signal, "closure.S.force");
  EXPECT_EQ(input.match[0].norm, ErrorNorm::max);
  EXPECT_EQ(input.match[0].scale, ErrorScale::component);
  EXPECT_EQ(input.match[0].tolerance, std::vector<double>{0.02});
  EXPECT_EQ(input.match[0].floor, 0.05);
  EXPECT_EQ(input.match[0].window->first, 0.5);
  EXPECT_EQ(input.match[0].window->last, 15.0);
  EXPECT_EQ(input.match[0].at.line, 13);
  EXPECT_EQ(input.match[0].at.column, 10);
  EXPECT_EQ(input.search.scan, 16);
  EXPECT_EQ(input.search.batch, 8);
  EXPECT_EQ(input.search.resolution, 0.001);
  EXPECT_EQ(input.search.max_evaluations, std::nullopt);
  EXPECT_EQ(input.search.delta, 0.02);
  EXPECT_FALSE(input.run.timeout);
  EXPECT_FALSE(input.run.max_failures);
  EXPECT_EQ(input.run.on_failure, FailurePolicy::record);
}

TEST(Study, Base_reference_and_load_cases_build_their_models) {
  const StudyInput input = good(kTune);
  Diagnostics diagnostics;
  const auto base = input.model->with(input.base_set, diagnostics);
  ASSERT_TRUE(base);
  EXPECT_EQ(base->linkage.closures[0].model, ClosureModel::sde);
  EXPECT_EQ(base->linkage.closures[0].sde.damping_ratio, 0.7);
  const auto reference = input.reference->model->with(input.reference->set, diagnostics);
  EXPECT_EQ(reference->linkage.closures[0].model, ClosureModel::cut);
  const auto fast = input.model->with(input.load_case[0].set, diagnostics);
  EXPECT_EQ(fast->linkage.loads[1].law.at_speed, 12.0);
}

// As a whole or by components, and where the model is silent; of its reference too.
TEST(Study, Every_kind_takes_gravity_by_load_case) {
  const std::string cases = R"(
[reference]
set = { "closure.S.model" = "cut" }
[[match]]
signal = "closure.S.force"
tolerance = 0.1
[[load_case]]
name = "earth"
[[load_case]]
name = "moon"
set = { gravity = [0, -1.62, "0 m/s^2"] }
[[load_case]]
name = "tilted"
set = { "gravity.0" = "0.5 g0" }
)";
  const std::pair<const char*, const char*> kinds[] = {
      {"study", "[[vary]]\nparameter = \"link.crank.mass\"\nvalues = [1, 2]\n"},
      {"tune", "[[tune]]\nparameter = \"link.crank.mass\"\nrange = { lin = [1, 2] }\n"},
      {"converge",
       "[[refine]]\nparameter = \"link.crank.mass\"\nladder = { from = 1, ratio = 2, levels = 3 }\n"
       "limit = \"infinity\"\n"}};
  const std::string silent = test::replaced(kRsrrp, "gravity = [0.0, -9.81, 0.0]", "");
  for (const auto& [kind, parameter] : kinds) {
    for (const bool speaks : {true, false}) {
      SCOPED_TRACE(kind);
      test::write_file("rsrrp.toml", speaks ? kRsrrp : silent);
      const std::string text = fmt::format(
          "format = 1\nkind = \"{}\"\nmodel = \"rsrrp.toml\"\n{}{}", kind, parameter, cases);
      Diagnostics diagnostics;
      const auto input = read_study(test::write_file("gravity.toml", text), {}, diagnostics);
      ASSERT_TRUE(input) << to_string(diagnostics);
      const Eigen::Vector3d own(0, speaks ? -9.81 : 0.0, 0);
      const Eigen::Vector3d expected[] = {
          own, {0, -1.62, 0}, own + Eigen::Vector3d(4.903325, 0, 0)};
      for (std::size_t i = 0; i < 3; ++i) {
        const LoadCaseInput& one = input->load_case[i];
        const auto model = input->model->with(case_overrides(*input, one, {}), diagnostics);
        const auto reference =
            input->reference->model->with(reference_overrides(*input, one), diagnostics);
        EXPECT_LT((model->linkage.gravity - expected[i]).norm(), 1e-15) << one.name;
        EXPECT_LT((reference->linkage.gravity - expected[i]).norm(), 1e-15) << one.name;
      }
    }
  }
}

TEST(Study, Varied_values_are_expanded_in_the_unit_of_their_key) {
  const StudyInput input = good(kStudy);
  EXPECT_EQ(input.kind, FileKind::study);
  EXPECT_EQ(input.design.type, Design::grid);
  ASSERT_EQ(input.vary.size(), 5u);
  EXPECT_THAT(numbers(input.vary[0]), ElementsAre(1e4, 1e5, 1e6, 1e7, 1e8));
  EXPECT_THAT(numbers(input.vary[1]),
              ElementsAre(DoubleEq(1e-4), DoubleEq(5e-5), DoubleEq(2.5e-5)));
  EXPECT_THAT(numbers(input.vary[2]), ElementsAre(0.0, 0.5, DoubleEq(1.5707963267948966)));
  EXPECT_EQ(input.vary[2].parameter.unit, "rad");
  EXPECT_THAT(numbers(input.vary[3]), ElementsAre(-10.0, -5.0, 0.0));
  EXPECT_THAT(input.vary[4].values, ElementsAre(Value("ground"), Value("first")));
  EXPECT_EQ(input.vary[4].parameter.unit, "");
}

TEST(Study, What_is_compared_kept_and_how_it_runs_is_read) {
  const StudyInput input = good(kStudy);
  EXPECT_EQ(input.match[0].reference_signal, "joint.A.force");
  EXPECT_EQ(input.match[0].reference_sign, -1.0);
  EXPECT_EQ(input.match[0].norm, ErrorNorm::rms);
  EXPECT_EQ(input.match[0].scale, ErrorScale::vector);
  EXPECT_EQ(input.match[0].tolerance, std::vector<double>{0.02});
  EXPECT_FALSE(input.match[0].window);
  EXPECT_EQ(input.response[0].name, "largest_drift");
  EXPECT_EQ(input.response[0].reduce, Reduction::max_abs);
  EXPECT_EQ(input.response[0].window->last, 2.0);
  ASSERT_EQ(input.trace.size(), 2u);
  EXPECT_EQ(input.trace[1].signal, "joint.A.q");
  EXPECT_EQ(input.trace[1].at.line, 41);
  EXPECT_EQ(input.trace[1].at.column, 31);
  EXPECT_EQ(input.run.seed, 7u);
  EXPECT_EQ(input.run.timeout, 120.0);
  EXPECT_EQ(input.run.max_failures->value, 5.0);
  EXPECT_TRUE(input.run.max_failures->is_percent);
  EXPECT_EQ(input.run.on_failure, FailurePolicy::abort);
}

TEST(Study, A_resolved_study_reads_back_to_itself) {
  for (const char* text : {kTune, kStudy}) {
    const std::string resolved = write_toml(good(text).resolved);
    EXPECT_EQ(write_toml(good(resolved).resolved), resolved);
    EXPECT_THAT(resolved, HasSubstr("floor = 0.05"));
  }
}

TEST(Study, Set_options_go_to_the_study_or_to_its_models) {
  const StudyInput input =
      good(kTune, {"search.scan=32", "link.crank.mass=2", "match.0.tolerance=0.5"});
  Diagnostics diagnostics;
  EXPECT_EQ(input.search.scan, 32);
  EXPECT_EQ(input.match[0].tolerance, std::vector<double>{0.5});
  EXPECT_EQ(input.model->with(input.base_set, diagnostics)->linkage.links[0].mass, 2.0);
  EXPECT_EQ(input.reference->model->with({}, diagnostics)->linkage.links[0].mass, 2.0);
}

TEST(Study, A_reference_may_be_another_model_file) {
  write_file("other.toml",
             replaced(kRsrrp, "name = \"RSRRP linkage, reference set R1\"", "name = \"other\""));
  const StudyInput input =
      good(replaced(kTune, "reference = { set", "reference = { model = \"./other.toml\", set"));
  Diagnostics diagnostics;
  EXPECT_EQ(input.reference->model->with(input.reference->set, diagnostics)->name, "other");
  EXPECT_NE(input.model->with({}, diagnostics)->name, "other");
}

struct Wrong {
  const char* base;
  const char* from;
  const char* to;  // @ marks the place
  const char* message;
  const char* remedy = "";
};

void expect_error(const Wrong& wrong) {
  std::string text = replaced(wrong.base, wrong.from, wrong.to);
  const std::size_t at = text.find('@');
  ASSERT_NE(at, std::string::npos) << wrong.to;
  const auto line =
      1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t column = at - (text.rfind('\n', at) + 1) + 1;
  text.erase(at, 1);
  Diagnostics diagnostics;
  EXPECT_FALSE(read(text, diagnostics)) << wrong.to;
  const std::vector<Diagnostic> found = diagnostics.sorted();
  ASSERT_EQ(found.size(), 1u) << wrong.to << "\n" << to_string(diagnostics);
  EXPECT_EQ(found[0].line, line) << to_string(diagnostics);
  EXPECT_EQ(found[0].column, static_cast<int>(column)) << to_string(diagnostics);
  EXPECT_THAT(found[0].file, ::testing::EndsWith("study.toml"));
  EXPECT_THAT(found[0].message, HasSubstr(wrong.message));
  EXPECT_THAT(found[0].remedy, HasSubstr(wrong.remedy));
}

TEST(Study, Paths_and_values_that_do_not_fit_the_model_are_errors_of_the_study) {
  const Wrong wrongs[] = {
      {kTune, "parameter = \"closure.S", "parameter = @\"closure.T", "parameter names no value of",
       "closure.S.sde.stiffness"},
      {kTune, "parameter = \"closure.S.sde.stiffness\"", "parameter = @\"closure.S.sde\"",
       "parameter names no value of"},
      {kTune, "parameter = \"closure.S.sde.stiffness\"", "parameter = @\"closure.S.model\"",
       "cannot be tuned"},
      {kTune, "\"closure.S.sde.damping_ratio\" = 0.7", "@\"closure.S.sde.damping_ration\" = 0.7",
       "names no value of", "closure.S.sde.damping_ratio"},
      {kTune, "\"closure.S.sde.damping_ratio\" = 0.7", "\"closure.S.sde.damping_ratio\" = @-0.7",
       "damping_ratio must not be negative"},
      {kTune, "{ \"closure.S.model\" = \"cut\" }", "{ \"closure.S.model\" = @\"cutt\" }",
       "model must be one of cut, sde", "did you mean 'cut'?"},
      {kTune, "{ \"load.resistance.law.at_speed\" = 12.0 }",
       "{ @\"load.resistence.law.at_speed\" = 12.0 }", "names no value of",
       "load.resistance.law.at_speed"},
      {kTune, "{ \"load.resistance.law.at_speed\" = 12.0 }",
       "{ \"load.resistance.law.at_speed\" = @\"12 m/s\" }", "must be in rad/s here"},
      {kTune, "log = [1.0e3, \"100 MN/m\"]", "log = [1.0e3, @\"100 MN\"]",
       "must be a number in N/m, got '100 MN'"},
      {kTune, "log = [1.0e3, \"100 MN/m\"]", "log = @[1.0e3, 1e2]",
       "range must rise from a positive number"},
      {kTune, "log = [1.0e3, \"100 MN/m\"]", "log = @[1.0e3]", "must have 2 entries, got 1"},
      {kTune, "range = { log = [1.0e3, \"100 MN/m\"] }", "range = @{}",
       "range.log or lin is missing"},
      {kStudy, "log = [1e4, 1e8, 5]", "log = [@-1, 1e8, 5]", "must be positive, got -1 N/m"},
      {kStudy, "log = [1e4, 1e8, 5]", "log = [1e4, 1e8, @1]",
       "must be an integer of at least 2, got 1"},
      {kStudy, "log = [1e4, 1e8, 5]", "log = [1e4, 1e8, @1000001]",
       "must be an integer of at most 1000000, got 1000001"},
      {kStudy, "log = [1e4, 1e8, 5]", "values = @[]", "values must not be empty"},
      {kStudy, "log = [1e4, 1e8, 5]", "log = [1e4, 1e8, 5]\n@lin = [1, 2, 3]",
       "exclude each other"},
      {kStudy, "lin = [-10, 0, 3]", "log = @[-10, -1, 3]", "log needs positive ends"},
      {kStudy, "ratio = 0.5", "ratio = @-0.5", "ladder.ratio must be positive"},
      {kStudy, "{ from = \"100 us\", ratio = 0.5, levels = 3 }",
       "@{ from = 1, ratio = 1, levels = 3 }", "are all the same"},
      {kStudy, "{ from = \"100 us\", ratio = 0.5, levels = 3 }",
       "{ from = @1e3, ratio = 0.5, levels = 3 }", "simulation.step must not exceed end_time"},
      {kStudy, "values = [\"ground\", \"first\"]", "values = [\"ground\", @\"last\"]",
       "must be one of ground, first, got 'last'"},
      {kStudy, "values = [\"ground\", \"first\"]", "lin = @[1, 2, 3]", "takes no number"},
      {kStudy, "parameter = \"simulation.step\"", "parameter = @\"closure.S.sde.stiffness\"",
       "listed twice"},
      {kStudy, "base.set.closure.S.model", "base.set.closure.S.@modl", "names no value of"},
  };
  for (const Wrong& wrong : wrongs) expect_error(wrong);
}

TEST(Study, Wrong_study_keys_are_errors_with_a_place) {
  const Wrong wrongs[] = {
      {kTune, "model = \"rsrrp.toml\"", "model = @\"rsrp.toml\"", "the file cannot be opened"},
      {kTune, "model = \"rsrrp.toml\"", "model = @\"..\"", "got a directory"},
      {kTune, "model = \"rsrrp.toml\"", "model = @\"\"", "model must not be empty"},
      {kTune, "kind = \"tune\"", "kind = @\"tunes\"", "there is no kind 'tunes' of files",
       "did you mean 'tune'?"},
      {kTune, "norm = \"max\"", "norm = @\"maximum\"", "norm must be one of max, rms"},
      {kTune, "tolerance = 0.02", "tolerance = @0", "match 0: tolerance must be positive, got 0"},
      {kTune, "window = [0.5, 15.0]", "window = @[15.0, 0.5]", "window must end after it begins"},
      {kTune, "window = [0.5, 15.0]", "window = [@-1, 0.5]",
       "match 0: window.0 must not be negative"},
      {kStudy, "name = \"largest_drift\"", "name = @\"largest drift\"",
       "name must be a letter followed by"},
      {kStudy, "reduce = \"max_abs\"", "reduce = @\"abs\"", "reduce must be one of max, min"},
      {kStudy, "[[trace]]",
       "[[response]]\nname = @\"largest_drift\"\nsignal = \"time\"\nreduce = \"last\"\n[[trace]]",
       "the name 'largest_drift' is used twice"},
      {kStudy, "signals = [", "signals = [@3, ", "signals.0 must be a text, got 3"},
      {kStudy, "seed = 7", "seed = @-7", "run.seed must not be negative"},
      {kStudy, "seed = 7", "seed = 7\n@threads = 2", "run.threads is not a known key"},
      {kStudy, "max_failures = \"5 %\"", "max_failures = @\"many\"", "must be a count or a share"},
      {kStudy, "on_failure = \"abort\"", "on_failure = @\"refine\"",
       "not supported in this version", "record, abort"},
      {kStudy, "[run]", "[design]\ntype = @\"soboll\"\n[run]",
       "must be one of grid, list, centered", "did you mean 'sobol'?"},
      {kStudy, "[run]", "[@search]\nscan = 3\n[run]", "search is not a known key"},
      {kStudy, "reference_signal = \"-joint.A.force\"", "reference_signal = @\"-\"",
       "must name a channel"},
  };
  for (const Wrong& wrong : wrongs) expect_error(wrong);
}

TEST(Study, A_match_needs_a_reference_and_a_tune_a_match) {
  expect_error({kTune,
                "reference = { set = { \"closure.S.model\" = \"cut\" } }\nbase      = { set = { "
                "\"closure.S.model\" = \"sde\", \"closure.S.sde.damping_ratio\" = 0.7 } "
                "}\n\n[[tune]]\nparameter = \"closure.S.sde.stiffness\"\nrange = { log = [1.0e3, "
                "\"100 MN/m\"] }\n\n[[match]]",
                "[[tune]]\nparameter = \"closure.S.sde.stiffness\"\nrange = { log = [1.0e3, \"100 "
                "MN/m\"] }\n@[[match]]",
                "[[match]] needs a reference"});
  const std::string match = std::string(kTune).substr(std::string(kTune).find("[[match]]"));
  Diagnostics diagnostics;
  EXPECT_FALSE(read(replaced(kTune, match, ""), diagnostics));
  ASSERT_EQ(diagnostics.sorted().size(), 1u) << to_string(diagnostics);
  EXPECT_THAT(diagnostics.sorted()[0].message, HasSubstr("a tune needs at least one [[match]]"));
}

TEST(Study, A_list_design_needs_equal_lengths) {
  expect_error(
      {kStudy,
       "parameter = \"simulation.step\"\nladder = { from = \"100 us\", ratio = 0.5, levels = 3 "
       "}\n\n[[vary]]\nparameter = \"joint.A.initial.position\"\nvalues = [\"0 deg\", 0.5, \"90 "
       "deg\"]\n\n[[vary]]\nparameter = \"gravity.1\"\nlin = [-10, 0, 3]\n\n[[vary]]\nparameter = "
       "\"closure.S.sde.axes\"\nvalues = [\"ground\", \"first\"]",
       "parameter = @\"simulation.step\"\nvalues = [1e-4]\n[design]\ntype = \"list\"",
       "as many values of each parameter, got 1 of 'simulation.step' and 5"});
}

TEST(Study, Errors_of_the_model_file_are_reported_there_and_once) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read(kTune, diagnostics, replaced(kRsrrp, "mass = 1.5", "mass = -1.5")));
  const std::vector<Diagnostic> found = diagnostics.sorted();
  ASSERT_EQ(found.size(), 1u) << to_string(diagnostics);
  EXPECT_THAT(found[0].file, ::testing::EndsWith("rsrrp.toml"));
  EXPECT_EQ(found[0].line, 24);
  EXPECT_EQ(found[0].column, 8);
  EXPECT_EQ(check_file(std::filesystem::path(found[0].file).parent_path() / "study.toml").size(),
            1u);
}

TEST(Study, A_model_in_the_place_of_a_study_is_an_error) {
  Diagnostics diagnostics;
  EXPECT_FALSE(read(kRsrrp, diagnostics));
  EXPECT_THAT(diagnostics.sorted().front().message, HasSubstr("a study or tune is expected here"));
}

}  // namespace
}  // namespace linkstudy::study_test

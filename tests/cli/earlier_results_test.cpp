// Earlier results in the place of measurements, as a user meets them: they give what a file of the
// same numbers gives and what the run gives that they hold, to the last bit.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/store/journal.h"
#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::earlier_results_test {
namespace {

using nlohmann::json;
using test::replaced;
using ::testing::HasSubstr;

const char* const kCalibration = R"(format = 1
kind = "calibrate"
model = "model.toml"
base = { set = { "closure.S.model" = "sde" } }

[[parameter]]
path = "closure.S.sde.stiffness"
range = { log = [1.0e4, 1.0e6] }

[[parameter]]
path = "closure.S.sde.damping"
range = { log = [5.0, 500.0] }

[fit]
starts = 2

[[experiment]]
name = "on"
set = { "load.drive.course.duration" = 0.01 }
)";

class EarlierResults : public Program {
 protected:
  EarlierResults() {
    write_inputs();
    keep("soft",
         "-s closure.S.model=sde -s closure.S.sde.stiffness=4e4 -s closure.S.sde.damping=50");
  }

  // A run whose drive is switched on at once, as results.
  void keep(const std::string& name, const std::string& joint) const {
    const Ended made = run("simulate model.toml -o " + name + " " + joint +
                           " -s load.drive.course.duration=0.01 "
                           "-s simulation.output_interval=2e-3 --signals closure.S.force");
    EXPECT_EQ(0, made.code) << made.err;
  }

  // The histories of a run as a file that a person would have got from them.
  void write_csv(const std::string& name) const {
    const Ended made = run("export " + name + " --table traces --format csv");
    EXPECT_EQ(0, made.code) << made.err;
    write(name + ".csv", made.out);
  }

  json answer(const std::string& experiment, const std::string& output) const {
    write("calibrate.toml", std::string(kCalibration) + experiment);
    const Ended ended = run("calibrate calibrate.toml -o " + output + " --fresh --json");
    EXPECT_EQ(0, ended.code) << ended.err;
    return json::parse(ended.out, nullptr, false);
  }

  std::string problems(const std::string& experiment) const {
    write("calibrate.toml", std::string(kCalibration) + experiment);
    const Ended ended = run("check calibrate.toml");
    EXPECT_EQ(2, ended.code);
    return ended.out + ended.err;
  }

  std::string text_of(const std::string& output, const std::string& name) const {
    for (const NamedText& text : read_journal(path(output)).texts)
      if (text.name == name) return text.text;
    return "";
  }
};

const char* const kSoft = "results = \"soft\"\nsignals = [\"closure.S.force\"]\n";
const char* const kFile = R"(file = "soft.csv"
[experiment.columns]
time = "time"
"closure.S.force.x" = "closure.S.force.x"
"closure.S.force.y" = "closure.S.force.y"
"closure.S.force.z" = "closure.S.force.z"
)";

TEST_F(EarlierResults, Fit_as_a_file_of_the_same_numbers_does_to_the_last_bit) {
  write_csv("soft");
  const std::string window = "window = [0.01, 0.2]\n";
  const json by_results = answer(window + kSoft, "by_results");
  const json by_file = answer(window + kFile, "by_file");
  EXPECT_EQ(by_file, by_results);
  // Data without noise: the fit ends where residuals are rounding.
  EXPECT_TRUE(by_results["check"]["confirms"].get<bool>());
  EXPECT_NEAR(4e4, by_results["parameters"]["closure.S.sde.stiffness"]["value"].get<double>(), 4.0);
  EXPECT_NEAR(50.0, by_results["parameters"]["closure.S.sde.damping"]["value"].get<double>(), 5e-3);
}

TEST_F(EarlierResults, Fit_as_the_run_does_that_they_hold) {
  keep("cut", "-s closure.S.model=cut");
  const json by_results =
      answer("results = \"cut\"\nsignals = [\"closure.S.force\"]\n", "by_results");
  const json by_run = answer(
      "reference = { set = { \"closure.S.model\" = \"cut\", \"simulation.output_interval\" = 2e-3 "
      "} "
      "}\nsignals = [\"closure.S.force\"]\n",
      "by_run");
  EXPECT_EQ(by_run, by_results);
}

TEST_F(EarlierResults, Are_kept_in_what_is_made_of_them) {
  answer(kSoft, "out");
  EXPECT_EQ("soft: closure.S.force", text_of("out", "data_0_file"));
  EXPECT_EQ(64U, text_of("out", "data_0_digest").size());
  EXPECT_EQ(json::parse(run("status soft --json").out)["digest"], text_of("out", "data_0_digest"));
  std::filesystem::remove_all(path("soft"));
  for (const char* file : {"calibrate.toml", "model.toml"}) std::filesystem::remove(path(file));
  const Ended verified = run("verify out --count 2 --json");
  EXPECT_EQ(0, verified.code) << verified.err << verified.out;
  EXPECT_EQ("verified", json::parse(verified.out)["status"]);
  for (const char* table : {"calibration", "data", "residuals"}) {
    EXPECT_EQ(0, run(std::string("export out --table ") + table).code) << table;
  }
}

TEST_F(EarlierResults, Make_another_study_when_they_have_changed) {
  answer(kSoft, "out");
  EXPECT_EQ(0, run("calibrate calibrate.toml -o out").code);
  std::filesystem::remove_all(path("soft"));
  keep("soft", "-s closure.S.model=cut");
  const Ended changed = run("calibrate calibrate.toml -o out");
  EXPECT_EQ(2, changed.code);
  EXPECT_THAT(changed.err, HasSubstr("holds a study of another input"));
  std::filesystem::remove_all(path("soft"));
  const Ended gone = run("calibrate calibrate.toml -o out");
  EXPECT_EQ(2, gone.code);
  EXPECT_THAT(gone.err, HasSubstr("calibrate.toml:20:11: error: earlier results: "));
}

TEST_F(EarlierResults, Are_not_overwritten_by_what_is_made_of_them) {
  write("calibrate.toml", std::string(kCalibration) + kSoft);
  const Ended refused = run("calibrate calibrate.toml -o ./soft --fresh");
  EXPECT_EQ(2, refused.code);
  EXPECT_THAT(refused.err, HasSubstr(":20:11: error: 'soft' is where the results of this file go"));
  EXPECT_EQ(0, run("export soft --table traces").code);
}

// Evaluation 9 has 1e9 N/m at steps of 1 ms, far beyond what is stable.
TEST_F(EarlierResults, Are_refused_with_what_they_lack) {
  ASSERT_EQ(0, run("study study.toml -o many").code);
  write("bare.toml", replaced(study_text(), "[[trace]]\nsignals = [\"closure.S.force\"]\n", ""));
  ASSERT_EQ(0, run("study bare.toml -o bare").code);
  write("cases.toml", study_text() +
                          "[[load_case]]\nname = \"slow\"\n[[load_case]]\nname = "
                          "\"fast\"\nset = { \"load.drive.course.duration\" = 0.01 }\n");
  ASSERT_EQ(0, run("study cases.toml -o cases").code);
  const auto experiment = [](const std::string& name, const std::string& data) {
    return fmt::format("\n[[experiment]]\nname = \"{}\"\n{}signals = [\"closure.S.force\"]\n", name,
                       data);
  };
  const std::string text = problems(
      std::string(kSoft) + experiment("nowhere", "results = \"nowhere\"\n") +
      experiment("which", "results = \"many\"\n") +
      experiment("unknown", "results = \"many\"\nevaluation = 12\n") +
      experiment("failed", "results = \"many\"\nevaluation = 9\n") +
      experiment("traces", "results = \"bare\"\nevaluation = 0\n") +
      experiment("a_case", "results = \"cases\"\nevaluation = 0\n") +
      experiment("other_case", "results = \"cases\"\nevaluation = 0\nload_case = \"slwo\"\n") +
      experiment("no_case", "results = \"many\"\nevaluation = 0\nload_case = \"slow\"\n") +
      "\n[[experiment]]\nname = \"torque\"\nresults = \"soft\"\nsignals = "
      "[\"closure.S.torque\"]\n");
  for (
      const char* message :
      {":25:11: error: earlier results: nowhere: there is no such directory",
       ":30:11: error: 'many' has 12 evaluations, and it is not said which is meant\n    "
       "evaluation = one of 0-8\n",
       ":35:11: error: 'many' has no evaluation 12 that has ended\n",
       ":41:11: error: evaluation 9 of 'many' failed (diverged): diverged at t = ",
       ":47:11: error: evaluation 0 of 'bare' has no histories\n    a study keeps those that "
       "[[trace]] names",
       ":53:11: error: evaluation 0 of 'cases' has several load cases, and it is not said which is "
       "meant\n    load_case = one of slow, fast\n",
       ":59:11: error: evaluation 0 of 'cases' has no load case 'slwo'\n",
       ":66:11: error: evaluation 0 of 'many' has no load cases, and 'slow' is asked for\n    take "
       "load_case out\n",
       ":74:12: error: 'soft' keeps no history of 'closure.S.torque'\n    nearest of what it "
       "keeps: "
       "closure.S.force.x"}) {
    EXPECT_THAT(text, HasSubstr(message));
  }
}

TEST_F(EarlierResults, Have_units_that_the_channel_must_have) {
  EXPECT_THAT(
      problems("results = \"soft\"\ncolumns = { \"closure.S.gap.x\" = \"closure.S.force.x\" "
               "}\n"),
      HasSubstr(":21:13: error: 'closure.S.gap.x' is in m, and its column in kg m/s^2"));
}

// One evaluation and load case of many, and a channel of another name.
TEST_F(EarlierResults, Serve_by_evaluation_load_case_and_name) {
  write("cases.toml", study_text() +
                          "[[load_case]]\nname = \"slow\"\n[[load_case]]\nname = "
                          "\"fast\"\nset = { \"load.drive.course.duration\" = 0.01 }\n");
  ASSERT_EQ(0, run("study cases.toml -o cases").code);
  // Evaluation 5: 3e4 N/m at a step of 0.1 ms.
  const json fit = answer(
      "results = \"cases/results.h5\"\nevaluation = 5\nload_case = \"fast\"\n"
      "columns = { \"closure.S.force.y\" = \"closure.S.force.y\" }\n",
      "out");
  EXPECT_NEAR(3e4, fit["parameters"]["closure.S.sde.stiffness"]["value"].get<double>(), 60.0);
  EXPECT_EQ("cases/results.h5, evaluation 5, load case fast: closure.S.force.y",
            text_of("out", "data_0_file"));
}

// The block of a text after a mark, between lines of three backquotes.
std::string block_after(const std::string& text, const std::string& mark) {
  const std::size_t begin = text.find('\n', text.find("```" + mark)) + 1;
  return text.substr(begin, text.find("```", begin) - begin);
}

// With the short model of these tests.
TEST_F(EarlierResults, Serve_as_the_README_shows) {
  const std::string readme = read_text(source_file("study/README.md"));
  const std::string chapter = readme.substr(readme.find("\n## Calibrating"));
  write("rsrrp.toml", model_text());
  write("nearest.toml", block_after(chapter, "toml"));
  std::istringstream commands(block_after(chapter, "\nlinkstudy"));
  std::size_t count = 0;
  const std::string program = "linkstudy ";
  for (std::string line; std::getline(commands, line); ++count) {
    ASSERT_TRUE(line.starts_with(program)) << line;
    const Ended ended = run(line.substr(program.size()));
    EXPECT_EQ(0, ended.code) << line << ended.err;
  }
  EXPECT_EQ(2U, count);
  // The stiffer the nearer: the bound is the answer.
  EXPECT_THAT(run("export results/nearest --format csv --table calibration").out,
              HasSubstr("closure.S.sde.stiffness"));
}

const char* const kRun = "reference = { set = { \"closure.S.model\" = \"cut\" } }\n";

class EarlierReference : public EarlierResults {
 protected:
  // At every step of the model.
  void keep_cut() const {
    const Ended made =
        run("simulate model.toml -o cut -s closure.S.model=cut -s simulation.output_interval=1e-3 "
            "--signals closure.S.force");
    EXPECT_EQ(0, made.code) << made.err;
  }

  std::string evaluations(const std::string& reference, const std::string& more) const {
    write("own.toml", std::string("format = 1\nkind = \"study\"\nmodel = \"model.toml\"\n") +
                          "base = { set = { \"closure.S.model\" = \"sde\" } }\n" +
                          "vary = [{ parameter = \"closure.S.sde.stiffness\", values = [3e4, 1e5] "
                          "}]\n" +
                          reference +
                          "[[match]]\nsignal = \"closure.S.force\"\ntolerance = 0.02\n" + more);
    const Ended ended = run("study own.toml -o own --fresh");
    EXPECT_EQ(0, ended.code) << ended.err;
    return run("export own --table evaluations --format csv").out;
  }
};

const char* const kCutResults = "[reference]\nresults = \"cut\"\n";

TEST_F(EarlierReference, Gives_the_errors_of_a_file_of_the_same_numbers_to_the_last_bit) {
  keep_cut();
  write_csv("cut");
  for (const char* more : {"", "window = [0.05, 0.15]\nscale = \"vector\"\n"}) {
    const std::string by_results = evaluations(kCutResults, more);
    EXPECT_EQ(evaluations(kForceData, more), by_results);
    EXPECT_THAT(by_results, HasSubstr("error_max_closure_S_force_x"));
  }
}

TEST_F(EarlierReference, Gives_the_answer_of_a_tune_against_the_run_and_is_verified_without_it) {
  keep_cut();
  const std::string text = tune_text() + "\n[search]\nscan = 8\n";
  write("tune.toml", text);
  const Ended by_run = run("tune tune.toml -o by_run --json");
  ASSERT_EQ(0, by_run.code) << by_run.err;
  write("earlier.toml", replaced(text, kRun, "") + kCutResults);
  const Ended by_results = run("tune earlier.toml -o by_results --json");
  ASSERT_EQ(0, by_results.code) << by_results.err;
  const auto answer = [](const Ended& ended) {
    return json::parse(ended.out)["parameters"]["closure.S.sde.stiffness"].get<double>();
  };
  // The run of the tune has steps of 0.2 ms and the kept one of 1 ms: errors of 1e-8, far below the
  // resolution of 1e-3 decades.
  EXPECT_NEAR(std::log10(answer(by_run)), std::log10(answer(by_results)), 2e-3);
  std::filesystem::remove_all(path("cut"));
  for (const char* file : {"earlier.toml", "model.toml"}) std::filesystem::remove(path(file));
  const Ended verified = run("verify by_results --json");
  EXPECT_EQ(0, verified.code) << verified.err << verified.out;
  EXPECT_EQ("certified", json::parse(verified.out)["answer"]);
}

// A refinement, whose differences from the earlier run fall as 1/c.
TEST_F(EarlierReference, Serves_a_refinement) {
  keep_cut();
  write("refine.toml", std::string("format = 1\nkind = \"converge\"\nmodel = \"model.toml\"\n") +
                           "base = { set = { \"closure.S.model\" = \"sde\", \"simulation.step\" = "
                           "1e-4 } }\n" +
                           "[[refine]]\nparameter = \"closure.S.sde.stiffness\"\nladder = { from "
                           "= 1e5, ratio = 2, levels = 4 }\n" +
                           kCutResults +
                           "[[match]]\nsignal = \"closure.S.force\"\nwindow = [0.05, 0.2]\n");
  const Ended ended = run("converge refine.toml -o refined --json");
  EXPECT_EQ(0, ended.code) << ended.err;
  const json tables = json::parse(ended.out, nullptr, false)["tables"];
  ASSERT_FALSE(tables.empty());
  EXPECT_NEAR(1.0, tables[0]["observed_order"].get<double>(), 0.1) << tables[0].dump(1);
}

}  // namespace
}  // namespace linkstudy::testing::earlier_results_test

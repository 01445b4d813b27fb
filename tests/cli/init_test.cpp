// What `linkstudy init` writes is right, runs as it is and with everything that is commented out,
// and never replaces a file unasked.
#include <gmock/gmock.h>

#include <cctype>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"

namespace linkstudy::testing::init_test {
namespace {

using ::testing::AnyOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

// Settings that make the inputs as written a matter of milliseconds.
const std::string kShort = " -s simulation.end_time=0.1 -s simulation.step=1e-3";
const std::string kShortMatch = kShort + " -s 'match.0.window=[0.02, 0.1]'";

class Init : public Program {
 protected:
  Init() { setenv("LINKSTUDY", kProgram, 1); }
  ~Init() override { unsetenv("LINKSTUDY"); }
};

// "#key = 1" and "#[[table]]" without the mark; comments in words ("# words") stay.
std::string uncommented(const std::string& text) {
  std::string result;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) {
    const bool is_key = line.size() > 1 && line[0] == '#' && line[1] != ' ' && line[1] != '#';
    result += (is_key ? line.substr(1) : line) + "\n";
  }
  return result;
}

TEST_F(Init, Every_kind_is_right_as_written_and_with_all_that_is_commented_out) {
  for (const std::string kind : {"model", "study", "tune", "converge"}) {
    const std::string file = kind + ".toml";
    const Ended ended = run("init " + kind + " -o " + file);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr(file + "\n"));
    const Ended checked = run("check " + file);
    EXPECT_EQ(checked.code, 0) << checked.err;
    const std::string text = read_text(path(file));
    const std::string all = uncommented(text);
    EXPECT_GT(std::count(text.begin(), text.end(), '#'), std::count(all.begin(), all.end(), '#'));
    write("all_" + file, all);
    const Ended all_checked = run("check all_" + file);
    EXPECT_EQ(all_checked.code, 0) << all_checked.err;
  }
}

TEST_F(Init, Explains_keys_in_the_words_of_the_reference) {
  const std::string text = run("init model").out;
  EXPECT_THAT(text, HasSubstr("# mass; kg, > 0\n"));
  for (const std::string kind : {"model", "study", "tune", "converge"}) {
    std::istringstream stream(run("init " + kind).out);
    for (std::string line; std::getline(stream, line);) {
      EXPECT_LE(line.size(), 100u) << line;
      EXPECT_THAT(line, Not(AnyOf(HasSubstr("#@"), HasSubstr("#?"), ContainsRegex("[A-Z]_NAME"))));
    }
  }
}

TEST_F(Init, The_model_starts_from_equilibrium_and_runs_with_both_closures) {
  ASSERT_EQ(run("init model -o model.toml").code, 0);
  for (const std::string model : {"cut", "sde"}) {
    const Ended ended =
        run("simulate model.toml -s simulation.end_time=0.5 -s closure.S.model=" + model);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("mobility     1 "));
    EXPECT_THAT(ended.out, HasSubstr("equilibrium  stable"));
    EXPECT_THAT(ended.err, Not(HasSubstr("warning")));
  }
}

TEST_F(Init, The_study_runs_with_the_model_it_brings) {
  ASSERT_EQ(run("init study -o study.toml").code, 0);
  EXPECT_THAT(left_behind(), ElementsAre("model.toml", "study.toml"));
  const Ended ended =
      run("study study.toml -o out --json -s 'vary.0.log=[1e4, 1e5, 2]'" + kShortMatch);
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(nlohmann::json::parse(ended.out)["done"], 2);
}

TEST_F(Init, The_tune_runs_with_the_model_it_brings) {
  ASSERT_EQ(run("init tune -o tune.toml").code, 0);
  const Ended ended =
      run("tune tune.toml -o out --json -s search.scan=4 "
          "-s search.max_evaluations=8 -s match.0.tolerance=0.5" +
          kShortMatch);
  // A budget so small does not certify; it does find something.
  EXPECT_THAT(ended.code, AnyOf(0, 4)) << ended.err;
  EXPECT_THAT(nlohmann::json::parse(ended.out)["evaluations"], ::testing::Gt(0));
}

TEST_F(Init, No_file_is_replaced_unless_fresh) {
  write("mine.toml", "mine");
  const Ended refused = run("init model -o mine.toml");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("mine.toml exists; --fresh overwrites it"));
  EXPECT_EQ(read_text(path("mine.toml")), "mine");
  EXPECT_EQ(run("init model -o mine.toml --fresh").code, 0);
  EXPECT_EQ(run("check mine.toml").code, 0);
}

TEST_F(Init, A_model_that_is_there_already_is_kept_even_if_fresh) {
  write("model.toml", "mine");
  write("study.toml", "old");
  EXPECT_EQ(run("init study -o study.toml --fresh").out, "study.toml\n");
  EXPECT_EQ(read_text(path("model.toml")), "mine");
}

TEST_F(Init, Nothing_is_written_where_one_of_the_files_is_in_the_way) {
  write("study.sbatch", "mine");
  EXPECT_EQ(run("init study --slurm -o study.toml").code, 2);
  EXPECT_THAT(left_behind(), IsEmpty());
}

TEST_F(Init, The_batch_script_runs_its_study_with_what_mpirun_finds) {
  ASSERT_EQ(run("init study --slurm -o study.toml").code, 0);
  EXPECT_THAT(left_behind(), ElementsAre("model.toml", "study.sbatch", "study.toml"));
  const std::string text = read_text(path("study.sbatch"));
  EXPECT_THAT(text, HasSubstr("#SBATCH --requeue"));
  EXPECT_THAT(text, HasSubstr("linkstudy=${LINKSTUDY:-" + std::string(kProgram) + "}"));
  const std::string command =
      "cd '" + path("").string() + "' && bash study.sbatch --fresh" + kShortMatch + " > log 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << read_text(path("log"));
  const auto status = nlohmann::json::parse(run("status results_study --json").out);
  EXPECT_EQ(status["total"], 9);
  EXPECT_EQ(status["eta_s"], 0.0);  // nothing left
}

TEST_F(Init, What_it_cannot_do_is_a_usage_error) {
  EXPECT_THAT(run("init modle").err, HasSubstr("did you mean 'model'"));
  EXPECT_EQ(run("init model --slurm -o model.toml").code, 2);
  EXPECT_EQ(run("init study --slurm").code, 2);
  EXPECT_EQ(run("init study -o model.toml").code, 2);
  EXPECT_EQ(run("init study -o nowhere/study.toml").code, 2);
  EXPECT_EQ(run("init").code, 2);
  EXPECT_THAT(left_behind(), IsEmpty());
}

}  // namespace
}  // namespace linkstudy::testing::init_test

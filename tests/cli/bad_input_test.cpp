// Wrong commands and wrong inputs: exit 2, a message that says where and what, nothing left behind.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace linkstudy::testing::bad_input_test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

struct BadCommand {
  const char* name;
  const char* arguments;
  const char* says;
};

class BadCommands : public Program, public ::testing::WithParamInterface<BadCommand> {};

TEST_P(BadCommands, Exit_with_2_and_leave_nothing) {
  write_inputs();
  write("text.txt", "not TOML [");
  const Ended ended = run(GetParam().arguments);
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr(GetParam().says));
  EXPECT_THAT(ended.out, IsEmpty());
  EXPECT_THAT(left_behind(), IsEmpty());
}

const BadCommand kBadCommands[] = {
    {"no_verb", "", "a verb is missing"},
    {"unknown_verb", "simulat model.toml", "did you mean 'simulate'?"},
    {"file_of_another_kind", "converge study.toml", "this file has kind = \"study\""},
    {"option_first", "--json study study.toml", "a verb comes first"},
    {"no_input", "study", "usage: linkstudy study"},
    {"two_inputs", "simulate model.toml model.toml", "usage: linkstudy simulate"},
    {"unknown_option", "study study.toml --jsn", "--json"},
    {"abbreviated_option", "study study.toml --out x", "there is no option '--out'"},
    {"option_of_another_verb", "check model.toml --fresh", "does not apply to 'check'"},
    {"short_option_of_another_verb", "check model.toml -s a=1", "does not apply to 'check'"},
    {"output_of_plan", "plan study.toml -o x", "does not apply to 'plan'"},
    {"fresh_without_a_directory", "simulate model.toml --fresh", "--fresh goes with -o"},
    {"fresh_statics_without_one", "statics model.toml --fresh", "--fresh goes with -o"},
    {"csv_beside_a_directory", "simulate model.toml -o x --csv x.csv", "--csv with -o"},
    {"watch_as_json", "status x --watch --json", "--watch is for people"},
    {"batch_of_a_study", "study study.toml --batch 4", "does not apply to 'study'"},
    {"value_missing", "study study.toml --seed", "seed"},
    {"value_mistyped", "study study.toml --seed many", "many"},
    {"negative_timeout", "study study.toml --timeout -1", "--timeout must be a positive number"},
    {"wrong_progress", "study study.toml --progress loud", "auto, bar, line or none"},
    {"wrong_policy", "study study.toml --on-failure refine", "record or abort"},
    {"wrong_limit", "study study.toml --max-failures 5x", "--max-failures must be"},
    {"wrong_level", "study study.toml --log-level loud", "--log-level must be"},
    {"wrong_format", "export x --format xml", "--format"},
    {"two_outputs", "simulate model.toml --json --csv -", "both want standard output"},
    {"signals_alone", "simulate model.toml --signals time", "--csv"},
    {"unknown_signal", "simulate model.toml --csv x.csv --signals joint.B.q", "joint.A.q"},
    {"csv_nowhere", "simulate model.toml --csv no/where.csv", "there is no directory 'no'"},
    {"csv_is_a_directory", "simulate model.toml --csv .", "is a directory"},
    {"missing_file", "simulate none.toml", "none.toml"},
    {"directory_as_file", "study .", "."},
    {"no_toml", "check text.txt", "text.txt:1:"},
    {"study_as_model", "simulate study.toml", "study.toml:2:8"},
    {"model_as_study", "study model.toml", "model.toml:2:8"},
    {"tune_as_study", "study tune.toml", "linkstudy tune tune.toml"},
    {"set_without_value", "simulate model.toml -s gravity", "gravity"},
    {"set_of_nothing", "simulate model.toml -s link.crnk.mass=1", "link.crank.mass"},
    {"set_out_of_range", "simulate model.toml -s link.crank.mass=-1", "mass must be positive"},
    {"set_wrong_unit", "simulate model.toml -s 'link.crank.mass=1 m'", "link.crank.mass=1 m"},
    {"unknown_key_path", "describe lnk.mass", "nearest"},
    {"markdown_and_path", "describe link --markdown", "leave PATH out"},
    {"status_of_nothing", "status none", "none"},
    {"export_of_nothing", "export none", "none"},
    {"status_of_a_file", "status model.toml", "is no results directory but a file"},
    {"key_without_its_path", "describe mass", "nearest: link.*.mass"},
};

INSTANTIATE_TEST_SUITE_P(All, BadCommands, ::testing::ValuesIn(kBadCommands),
                         [](const auto& tested) { return std::string(tested.param.name); });

struct BadStudy {
  const char* name;
  const char* file;  // study.toml or tune.toml
  const char* replace;
  const char* by;
  const char* says;
};

class BadStudies : public Program, public ::testing::WithParamInterface<BadStudy> {};

TEST_P(BadStudies, Are_located_and_leave_nothing) {
  write_inputs();
  const BadStudy& bad = GetParam();
  const std::string verb = std::string(bad.file) == "tune.toml" ? "tune" : "study";
  std::string text = read_text(path(bad.file));
  const std::size_t at = text.find(bad.replace);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, std::string(bad.replace).size(), bad.by);
  write(bad.file, text);
  for (const std::string& command :
       {"check " + std::string(bad.file), verb + " " + bad.file + " -o out"}) {
    const Ended ended = run(command);
    EXPECT_EQ(ended.code, 2) << command << ended.err;
    EXPECT_THAT(ended.err, HasSubstr(std::string(bad.file) + ":"));
    EXPECT_THAT(ended.err, HasSubstr(bad.says)) << command;
    EXPECT_THAT(left_behind(), IsEmpty()) << command;
  }
}

const BadStudy kBadStudies[] = {
    {"unknown_signal", "study.toml", "signal = \"closure.S.force\"", "signal = \"closure.T.force\"",
     "study.toml:17:10: error: there is no signal 'closure.T.force'"},
    {"unknown_response", "study.toml", "signal = \"joint.A.v\"", "signal = \"joint.A.w\"",
     "joint.A.v"},
    {"unknown_trace", "study.toml", "signals = [\"closure.S.force\"]", "signals = [\"forces\"]",
     "there is no signal 'forces'"},
    {"window_past_the_end", "study.toml", "window = [0.05, 0.2]", "window = [0.05, 2.0]",
     "after the run"},
    {"unequal_components", "study.toml", "tolerance = 0.02",
     "tolerance = 0.02\nreference_signal = \"closure.S.force.x\"", "components"},
    {"taken_name", "study.toml", "name = \"crank_speed\"", "name = \"gap_max\"",
     "the name of another"},
    {"linear_range", "tune.toml", "[[match]]",
     "[[tune]]\nparameter = \"closure.S.sde.damping_ratio\"\nrange = { lin = [0.1, 2.0] "
     "}\n[[match]]",
     "no sum of log10"},
    {"step_beside_another", "tune.toml", "[[match]]",
     "[[tune]]\nparameter = \"simulation.step\"\nrange = { log = [1e-4, 1e-3] }\n[[match]]",
     "cannot be tuned"},
    {"tuned_step", "tune.toml", "parameter = \"closure.S.sde.stiffness\"",
     "parameter = \"simulation.step\"", "simulation.step"},
    {"load_case_with_step", "tune.toml", "[[match]]",
     "[[load_case]]\nname = \"fine\"\nset = { \"simulation.step\" = 1e-4 }\n[[match]]",
     "load case 'fine' sets simulation.step"},
};

INSTANTIATE_TEST_SUITE_P(All, BadStudies, ::testing::ValuesIn(kBadStudies),
                         [](const auto& tested) { return std::string(tested.param.name); });

class BadUse : public Program {};

TEST_F(BadUse, Check_lists_all_errors_as_json) {
  std::string text = model_text();
  text.replace(text.find("mass = 1.0"), 10, "mass = -1");
  text.replace(text.find("mass = 2.0"), 10, "mas = 2.0");
  write("bad.toml", text);
  const Ended ended = run("check bad.toml --json");
  EXPECT_EQ(ended.code, 2);
  const nlohmann::json errors = nlohmann::json::parse(ended.out)["errors"];
  ASSERT_GE(errors.size(), 2u);
  EXPECT_EQ(errors[0]["file"], "bad.toml");
  EXPECT_EQ(errors[0]["line"], 8);
  EXPECT_THAT(ended.err, IsEmpty());
}

TEST_F(BadUse, A_start_that_cannot_close_fails_with_its_cause) {
  write_inputs();
  const Ended ended = run("simulate model.toml --csv x.csv -s closure.S.first.position.1=5");
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("assembly_failed"));
  EXPECT_THAT(left_behind(), IsEmpty());
}

TEST_F(BadUse, A_failing_reference_is_an_error_of_the_whole_study) {
  write_inputs();
  std::string text = study_text();
  text.replace(text.find("\"simulation.step\" = 1.0e-4"), 26,
               "\"simulation.drift_limit\" = 1.0e-17");
  write("study.toml", text);
  const Ended ended = run("study study.toml -o out");
  EXPECT_EQ(ended.code, 3);
  EXPECT_THAT(ended.err, HasSubstr("the reference run failed (constraint_drift)"));
  EXPECT_THAT(left_behind(), IsEmpty());
}

TEST_F(BadUse, Copies_of_a_verb_for_one_process_are_refused_once_and_write_nothing) {
  ASSERT_EQ(setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1), 0);
  ASSERT_EQ(setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1), 0);
  write_inputs();
  for (const std::string verb : {"simulate model.toml --csv out.csv", "init model -o new.toml"}) {
    const Ended ended = run(verb, "mpirun --oversubscribe -n 2");
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    const std::string says = "works in one process, and mpirun (Open MPI) started 2";
    const std::size_t first = ended.err.find(says);
    ASSERT_NE(first, std::string::npos) << ended.err;
    EXPECT_EQ(ended.err.find(says, first + 1), std::string::npos) << ended.err;
    EXPECT_THAT(left_behind(), IsEmpty());
  }
}

TEST_F(BadUse, A_directory_with_other_files_is_left_alone) {
  write_inputs();
  std::filesystem::create_directory(path("mine"));
  write("mine/thesis.tex", "precious");
  const Ended ended = run("study study.toml -o mine");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, HasSubstr("thesis.tex"));
  EXPECT_EQ(read_text(path("mine/thesis.tex")), "precious");
  EXPECT_FALSE(std::filesystem::exists(path("mine/journal.bin")));
}

TEST_F(BadUse, Another_input_is_refused_unless_fresh) {
  write_inputs();
  const Ended first = run("study study.toml -o out");
  const Ended other = run("study study.toml -o out -s link.crank.mass=1.1");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("--fresh"));
  EXPECT_EQ(digest_in(run("study study.toml -o out").out), digest_in(first.out));
  const Ended fresh = run("study study.toml -o out -s link.crank.mass=1.1 --fresh");
  EXPECT_EQ(fresh.code, 0) << fresh.err;
  EXPECT_NE(digest_in(fresh.out), digest_in(first.out));
}

TEST_F(BadUse, Too_many_failures_exit_with_3) {
  write_inputs();
  EXPECT_EQ(run("study study.toml -o a --max-failures 3").code, 0);
  const Ended counted = run("study study.toml -o b --max-failures 2");
  EXPECT_EQ(counted.code, 3);
  EXPECT_THAT(counted.err, HasSubstr("3 evaluations failed, 2 are accepted"));
  EXPECT_EQ(run("study study.toml -o c --max-failures 25%").code, 0);
  EXPECT_EQ(run("study study.toml -o d --max-failures 20%").code, 3);
  const Ended aborted = run("study study.toml -o e --on-failure abort");
  EXPECT_EQ(aborted.code, 3);
  EXPECT_THAT(aborted.err, HasSubstr("on-failure is abort"));
}

TEST_F(BadUse, A_full_standard_output_is_an_error) {
  write_inputs();
  const Ended ended = run("simulate model.toml --json >/dev/full 2>message; test $? = 1");
  EXPECT_EQ(ended.code, 0);
  EXPECT_THAT(read_text(path("message")), HasSubstr("standard output cannot be written"));
}

}  // namespace
}  // namespace linkstudy::testing::bad_input_test

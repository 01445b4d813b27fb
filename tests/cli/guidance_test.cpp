// What the program tells its users about itself, and what it does not do behind their backs.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "study/store/results_file.h"
#include "tests/cli/program.h"

namespace linkstudy::testing::guidance_test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

// Three bars of 1 m and the ground, 2 m away behind them. Stretched to the other side, every joint
// is where the gap is stationary: no step from there closes it.
std::string stretched_chain(const std::array<std::string, 3>& starts) {
  std::string text = "format = 1\nkind = \"model\"\n";
  std::string parent = "ground";
  for (std::size_t i = 0; i < 3; ++i) {
    const std::string n = std::to_string(i);
    text += "[[link]]\nname = \"bar" + n + "\"\nmass = 1.0\ninertia = [0.1, 0.1, 0.1]\n";
    text += "[[joint]]\nname = \"J" + n + "\"\ntype = \"revolute\"\nparent = \"" + parent +
            "\"\nchild = \"bar" + n + "\"\nframe.position = [" + (i == 0 ? "0" : "1") +
            ", 0, 0]\n" + starts[i] + "\n";
    parent = "bar" + n;
  }
  return text + R"([[closure]]
name = "C"
type = "spherical"
first = { link = "bar2", position = [1, 0, 0] }
second = { link = "ground", position = [-2, 0, 0] }
model = "cut"
[simulation]
end_time = 0.01
step = 1e-3
start = "given"
)";
}

class Guidance : public Program {
 protected:
  Guidance() { write_inputs(); }
};

TEST_F(Guidance, Help_of_a_verb_is_that_of_its_option) {
  for (const char* verb : {"simulate", "study", "describe", "export"}) {
    const Ended help = run(std::string("help ") + verb);
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.out, run(std::string(verb) + " --help").out);
    EXPECT_THAT(help.out, HasSubstr(std::string("usage: linkstudy ") + verb));
  }
  EXPECT_EQ(run("help").out, run("--help").out);
  EXPECT_THAT(run("help simulat").err, HasSubstr("did you mean 'simulate'?"));
  EXPECT_EQ(run("help simulate study").code, 2);
  EXPECT_THAT(run("help").out, AllOf(HasSubstr("local z"), HasSubstr("local x")));
}

TEST_F(Guidance, Describe_lists_the_channels_that_simulate_writes) {
  const Ended csv = run("simulate model.toml --csv - -s simulation.end_time=0.01");
  const std::size_t names = csv.out.find('\n') + 1;
  std::string header = csv.out.substr(names, csv.out.find('\n', names) - names);
  const Ended described = run("describe channels model.toml");
  EXPECT_EQ(described.code, 0) << described.err;
  std::size_t count = 0;
  for (std::size_t at = 0; at < header.size(); ++count) {
    const std::size_t comma = std::min(header.find(',', at), header.size());
    const std::string name = header.substr(at, comma - at);
    EXPECT_THAT("\n" + described.out, ::testing::ContainsRegex("[\n ]" + name + " ")) << name;
    at = comma + 1;
  }
  EXPECT_GT(count, 70u);
  const Ended patterns = run("describe channels");
  for (const char* part : {"joint.NAME.torque.x|y|z  [N m]", "ground axes", "drive, resistance",
                           "bearing's frame", "w x y z", "body frame", "about the new y"}) {
    EXPECT_THAT(patterns.out, HasSubstr(part));
  }
  EXPECT_EQ(run("describe channels study.toml").code, 2);
  EXPECT_EQ(run("describe link joint").code, 2);
}

TEST_F(Guidance, Describe_units_has_the_usual_ones) {
  const Ended ended = run("describe units");
  EXPECT_EQ(ended.code, 0);
  for (const char* part : {"rpm", "lbf", "4.4482216152605", "0.0254", "N.m", "takes prefixes"}) {
    EXPECT_THAT(ended.out, HasSubstr(part));
  }
}

TEST_F(Guidance, Signals_take_groups_once_each) {
  const Ended ended =
      run("simulate model.toml --csv - --signals joint.A,energy,joint.A.q -s "
          "simulation.end_time=0.01");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::size_t names = ended.out.find('\n') + 1;
  const std::string header = ended.out.substr(names, ended.out.find('\n', names) - names);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), 15 + 5);
  EXPECT_EQ(run("simulate model.toml --csv - --signals joint.B9").code, 2);
}

TEST_F(Guidance, A_match_of_several_quantities_is_told_to_choose) {
  std::string text = study_text();
  const std::string signal = "signal = \"closure.S.force\"";
  ASSERT_NE(text.find(signal), std::string::npos);
  text.replace(text.find(signal), signal.size(), "signal = \"closure.S\"");
  write("wide.toml", text);
  const Ended ended = run("check wide.toml");
  EXPECT_EQ(ended.code, 2);
  EXPECT_THAT(ended.err, AllOf(HasSubstr("group of several quantities"),
                               HasSubstr("closure.S.force, closure.S.torque, closure.S.gap")));
}

TEST_F(Guidance, A_star_sets_every_closure) {
  const Ended one = run("simulate model.toml --json -s closure.S.model=sde");
  const Ended all = run("simulate model.toml --json -s 'closure.*.model=sde'");
  EXPECT_EQ(all.code, one.code) << all.err;
  const auto limit = [](const Ended& ended) {
    return nlohmann::json::parse(ended.out)["step_limit"];
  };
  EXPECT_EQ(limit(one), limit(all));
}

// script(1) gives the program a terminal.
TEST_F(Guidance, Colours_are_for_terminals_that_want_them) {
  const std::string wrong = std::string(kProgram) + " check none.toml";
  const auto on_terminal = [&](const std::string& before) {
    return run("--version >/dev/null; " + before + " script -qec '" + wrong + "' /dev/null").out;
  };
  const std::string red = "\x1b[1;31merror:\x1b[0m";
  EXPECT_THAT(on_terminal("TERM=xterm"), HasSubstr(red));
  EXPECT_THAT(on_terminal("NO_COLOR=1 TERM=xterm"), Not(HasSubstr("\x1b[1;")));
  EXPECT_THAT(on_terminal("TERM=dumb"), Not(HasSubstr("\x1b[1;")));
  EXPECT_THAT(run("check none.toml").err, AllOf(HasSubstr("error:"), Not(HasSubstr("\x1b"))));
}

TEST_F(Guidance, A_failed_run_leaves_no_old_table) {
  ASSERT_EQ(run("simulate model.toml --csv out.csv -s simulation.end_time=0.01").code, 0);
  ASSERT_TRUE(std::filesystem::exists(path("out.csv")));
  const Ended failed =
      run("simulate model.toml --csv out.csv -s closure.S.first.position.1=9 -s "
          "simulation.end_time=0.01");
  EXPECT_EQ(failed.code, 3) << failed.err;
  EXPECT_FALSE(std::filesystem::exists(path("out.csv")));
}

TEST_F(Guidance, Results_without_a_journal_are_not_overwritten) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  std::filesystem::remove(path("out/journal.bin"));
  const std::string before = read_text(path("out/results.h5"));
  const Ended again = run("study study.toml -o out");
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, AllOf(HasSubstr("results.h5"), HasSubstr("--fresh")));
  EXPECT_EQ(read_text(path("out/results.h5")), before);
  EXPECT_EQ(run("study study.toml -o out --fresh").code, 0);
}

TEST_F(Guidance, What_a_damaged_journal_has_lost_is_said_and_run_again) {
  const Ended whole = run("study study.toml -o out");
  std::string bytes = read_text(path("out/journal.bin"));
  bytes[bytes.size() / 2] ^= 1;
  write("out/journal.bin", bytes);
  for (const char* reader : {"status out", "export out", "study study.toml -o out"}) {
    const Ended ended = run(reader);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("torn or damaged")) << reader;
  }
  EXPECT_EQ(digest_in(run("study study.toml -o out").out), digest_in(whole.out));
}

TEST_F(Guidance, Evaluations_that_would_round_otherwise_are_not_added) {
  const std::string study = "study study.toml -o out -s simulation.end_time=20";  // time to abort
  ASSERT_EQ(run(study + " --on-failure abort", "LINKSTUDY_SIMD=baseline").code, 3);
  const Ended other = run(study);
  if (run("--version").out.find("baseline") != std::string::npos) GTEST_SKIP() << "no other set";
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("continue with LINKSTUDY_SIMD=baseline"));
  EXPECT_EQ(run(study, "LINKSTUDY_SIMD=baseline").code, 0);
  // With nothing left to run there is nothing to round.
  EXPECT_EQ(run(study).code, 0);
}

TEST_F(Guidance, A_study_that_failures_ended_early_is_not_complete) {
  // Runs so long that most of them are left when the first failure is seen.
  const std::string study = "study study.toml -o out -s simulation.end_time=20";
  ASSERT_EQ(run(study + " --on-failure abort").code, 3);
  EXPECT_EQ(read_results(path("out/results.h5")).status, RunStatus::interrupted);
  EXPECT_THAT(run("status out").out, Not(HasSubstr("complete")));
  ASSERT_EQ(run(study).code, 0);
  EXPECT_EQ(read_results(path("out/results.h5")).status, RunStatus::complete);
}

// A limit of file sizes stands for a full disk: both end the write with an error.
TEST_F(Guidance, A_full_disk_names_the_file) {
  const std::string full = "trap '' XFSZ; ulimit -f 1;";
  EXPECT_THAT(run("study study.toml -o out --progress none", full).err,
              AllOf(HasSubstr("out/journal.bin: cannot write"), HasSubstr("free some space")));
  EXPECT_THAT(run("simulate model.toml --csv table.csv", full).err,
              HasSubstr("table.csv.tmp: cannot write"));
  EXPECT_FALSE(std::filesystem::exists(path("table.csv")));
}

TEST_F(Guidance, Every_table_has_messages_and_no_complete_study_counts_less_than_all) {
  const Ended ended = run("study study.toml -o out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const Ended table = run("export out --table evaluations --format csv");
  EXPECT_THAT(table.out.substr(0, 400 + table.out.find("status")), HasSubstr("message"));
  const Ended status = run("status out");
  EXPECT_THAT(status.out,
              AllOf(HasSubstr("complete"), HasSubstr("12 of 12"), Not(HasSubstr("9 of 12"))));
}

TEST_F(Guidance, Held_joints_that_contradict_the_closures_are_named) {
  const Ended ended =
      run("simulate model.toml -s 'joint.*.initial.hold=true' -s joint.A.initial.velocity.0=1");
  EXPECT_EQ(ended.code, 3) << ended.err;
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("held or driven joints (A, "), HasSubstr("let one of them go")));
}

TEST_F(Guidance, The_pose_of_a_restart_is_told_in_lines_for_the_model) {
  write("chain.toml", stretched_chain({}));
  const Ended first = run("simulate chain.toml");
  EXPECT_EQ(first.code, 0) << first.err;
  ASSERT_THAT(first.err, HasSubstr("used restart"));
  std::array<std::string, 3> lines;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t end = first.err.find("# of joint J" + std::to_string(i));
    ASSERT_NE(end, std::string::npos);
    const std::size_t begin = first.err.rfind("initial.position", end);
    lines[i] = first.err.substr(begin, end - begin);
  }
  write("pasted.toml", stretched_chain(lines));
  const Ended again = run("simulate pasted.toml");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, Not(HasSubstr("used restart")));
  EXPECT_THAT(again.out, Not(HasSubstr("moved")));
}

TEST_F(Guidance, A_full_standard_output_is_named) {
  run("describe >/dev/full 2>message; true");
  EXPECT_THAT(read_text(path("message")),
              AllOf(HasSubstr("/dev/full"), Not(HasSubstr("internal"))));
}

}  // namespace
}  // namespace linkstudy::testing::guidance_test

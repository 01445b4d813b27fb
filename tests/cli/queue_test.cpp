// Folders of files that are drained: by any number of ranks, groups and programs, and however often
// they are stopped.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <thread>

#include "study/store/journal.h"
#include "tests/cli/launcher_watch.h"
#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::queue_test {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using test::replaced;
using ::testing::AllOf;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

using States = std::map<std::string, std::string>;
using Digests = std::map<std::string, std::string>;

const char* const kFit = R"(format = 1
kind = "calibrate"
model = "model.toml"
base = { set = { "closure.S.model" = "sde" } }
[[parameter]]
path = "closure.S.sde.stiffness"
range = { log = [1.0e4, 1.0e6] }
[[experiment]]
name = "on"
reference = { set = { "closure.S.sde.stiffness" = 4e4 } }
signals = ["closure.S.force"]
[fit]
starts = 2
)";

const char* const kRefinement = R"(format = 1
kind = "converge"
model = "model.toml"
[[refine]]
parameter = "simulation.step"
ladder = { from = 4e-3, ratio = 0.5, levels = 5 }
[[response]]
name = "mean_speed"
signal = "joint.A.v"
reduce = "mean"
)";

// `cases` runs over so much time, 0.2 s: some milliseconds each.
std::string plain_study(int cases, double end_time = 0.2) {
  return fmt::format(R"(format = 1
kind = "study"
model = "model.toml"
[base.set]
"closure.S.model" = "sde"
"simulation.step" = 1e-4
"simulation.output_interval" = 0.1
"simulation.end_time" = {}
[[vary]]
parameter = "closure.S.sde.stiffness"
log = [1e4, 1e5, {}]
[[response]]
name = "speed"
signal = "joint.A.v"
reduce = "last"
)",
                     end_time, cases);
}

// No machine ends it in time.
std::string endless_study() {
  return replaced(plain_study(2, 2e5), "\"simulation.output_interval\" = 0.1",
                  "\"simulation.output_interval\" = 1e2");
}

class Queue : public Program {
 protected:
  Queue() {
    for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) {
      setenv(name, "1", 1);
    }
    setenv("OMPI_MCA_pml", "ob1", 1);
    write_inputs();
    make_folder("q");
  }

  void make_folder(const std::string& name) const {
    std::filesystem::create_directory(path(name));
    write(name + "/model.toml", model_text());
  }

  void write_all_kinds(const std::string& folder) const {
    write(folder + "/1_study.toml", study_text());
    write(folder + "/2_tune.toml", tune_text());
    write(folder + "/3_fit.toml", kFit);
    write(folder + "/4_refinement.toml", kRefinement);
  }

  static std::string on_ranks(int ranks) {
    return "mpirun -n " + std::to_string(ranks) + " --oversubscribe --bind-to none";
  }

  json status(const std::string& folder = "q") const {
    return json::parse(run("status " + folder + " --json").out);
  }
  States states(const std::string& folder = "q") const { return states_of(status(folder)); }
  static States states_of(const json& status) {
    States states;
    for (const json& entry : status.at("entries")) states[entry["name"]] = entry["state"];
    return states;
  }
  Digests digests(const std::string& folder = "q") const {
    Digests digests;
    const json all = status(folder);
    for (const json& entry : all.at("entries")) digests[entry["name"]] = entry["study"]["digest"];
    return digests;
  }
  // What the verbs by themselves make of the same files.
  Digests digests_alone(const std::string& folder = "q") const {
    Digests digests;
    const json all = status(folder);
    for (const json& entry : all.at("entries")) {
      const std::string name = entry["name"];
      const Ended ended = run(entry["kind"].get<std::string>() + " " +
                              entry["file"].get<std::string>() + " -o alone/" + name);
      digests[name] = digest_in(ended.out);
    }
    return digests;
  }

  std::size_t rows_of(const std::string& name) const {
    const std::filesystem::path results = path("q/results") / name;
    if (!std::filesystem::exists(results / kJournalName)) return 0;
    return read_journal(results).evaluations.size();
  }

  // Names in the order in which they were begun.
  static std::vector<std::string> begun_in(const std::string& err) {
    std::vector<std::string> names;
    std::istringstream lines(err);
    for (std::string line; std::getline(lines, line);) {
      if (!line.ends_with(" begins")) continue;
      line.resize(line.size() - 7);
      names.push_back(line.substr(line.rfind(' ') + 1));
    }
    return names;
  }

  static void wait_for(const std::function<bool()>& state) {
    for (int tries = 0; tries < 3000; ++tries) {
      if (state()) return;
      std::this_thread::sleep_for(milliseconds(10));
    }
    ADD_FAILURE() << "not within half a minute";
  }

  std::string log() const { return read_text(path(".streams/log")); }  // of what start() started
};

TEST_F(Queue, All_kinds_are_drained_in_order_with_the_digests_of_their_verbs) {
  write_all_kinds("q");
  const Digests alone = digests_alone();
  ASSERT_THAT(alone, Each(Pair(::testing::_, Not(IsEmpty()))));
  for (const int ranks : {1, 2, 3}) {
    const std::string folder = "q" + std::to_string(ranks);
    make_folder(folder);
    write_all_kinds(folder);
    const Ended ended = run("queue " + folder, on_ranks(ranks));
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(begun_in(ended.err), ElementsAre("1_study", "2_tune", "3_fit", "4_refinement"));
    EXPECT_EQ(digests(folder), alone) << ranks << " ranks";
    EXPECT_THAT(ended.out, AllOf(HasSubstr("\n4 done\n"), Not(HasSubstr("model"))));
  }
  const json complete = status("q2");
  for (const json& entry : complete["entries"]) {
    EXPECT_EQ(entry["study"]["state"], "complete") << entry["name"];
  }
  const Ended again = run("queue q2 --json");
  EXPECT_EQ(again.code, 0);
  EXPECT_THAT(begun_in(again.err), IsEmpty());
  EXPECT_EQ(json::parse(again.out)["states"]["done"], 4);
}

TEST_F(Queue, What_is_refused_keeps_no_other_from_running) {
  write("q/1_syntax.toml", "format = 1\nkind = \"study\"\nmodel = [\n");
  write("q/2_signal.toml", replaced(study_text(), "[[match]]\nsignal = \"closure.S",
                                    "[[match]]\nsignal = \"closure.X"));
  write("q/3_kind.toml", "kind = \"banana\"\n");
  write("q/4_study.toml", study_text());
  // Not as if one was being written; and a clock may be wrong.
  const auto now = std::filesystem::file_time_type::clock::now();
  std::filesystem::last_write_time(path("q/1_syntax.toml"), now + std::chrono::hours(1));
  std::filesystem::last_write_time(path("q/3_kind.toml"), now - std::chrono::hours(1));
  for (const std::string& before : {on_ranks(2), std::string()}) {
    const Ended ended = run("queue q", before);
    EXPECT_EQ(ended.code, 2);
    for (const char* place : {"q/1_syntax.toml:3:11: error", "q/2_signal.toml:17:10: error",
                              "q/3_kind.toml:1:8: error"}) {
      EXPECT_THAT(ended.err, HasSubstr(place));
    }
    EXPECT_EQ(ended.err.find("not TOML"), ended.err.rfind("not TOML")) << "said by rank 0 alone";
    EXPECT_EQ(states(), (States{{"1_syntax", "refused"},
                                {"2_signal", "refused"},
                                {"3_kind", "refused"},
                                {"4_study", "done"}}));
    EXPECT_THAT(ended.out, HasSubstr("linkstudy check q/2_signal.toml"));
  }
  // Mended, it runs.
  write("q/1_syntax.toml", study_text());
  write("q/2_signal.toml", study_text());
  std::filesystem::remove(path("q/3_kind.toml"));
  const Ended mended = run("queue q");
  EXPECT_EQ(mended.code, 0) << mended.err;
  EXPECT_THAT(begun_in(mended.err), ElementsAre("1_syntax", "2_signal"));
}

TEST_F(Queue, The_exit_code_is_the_gravest_of_all_whenever_they_ended) {
  write("q/a_done.toml", plain_study(2));
  write("q/b_failures.toml", study_text() + "[run]\nmax_failures = 0\n");
  EXPECT_EQ(run("queue q").code, 3);
  write("q/c_infeasible.toml", replaced(tune_text(), "log = [1e3, 1e7]", "log = [1e3, 2e3]"));
  const Ended tuned = run("queue q");
  EXPECT_EQ(tuned.code, 4) << tuned.err;
  EXPECT_THAT(begun_in(tuned.err), ElementsAre("c_infeasible"));
  write("q/d_no_order.toml", R"(format = 1
kind = "converge"
model = "model.toml"
base = { set = { "closure.S.model" = "sde" } }
[[refine]]
parameter = "closure.S.sde.stiffness"
values = [1e4, 1e5, 1e9]
[[response]]
name = "force"
signal = "closure.S.force"
reduce = "last"
)");
  EXPECT_EQ(run("queue q").code, 5);
  const Ended again = run("queue q");
  EXPECT_EQ(again.code, 5) << "nothing has changed";
  EXPECT_THAT(begun_in(again.err), IsEmpty());
  States expected = {
      {"b_failures", "failed"}, {"c_infeasible", "failed"}, {"d_no_order", "failed"}};
  expected["a_done"] = "done";
  EXPECT_EQ(states(), expected);
}

TEST_F(Queue, Ended_files_are_run_again_only_where_their_input_reads_differently) {
  write("q/a.toml", plain_study(3));
  write("q/b.toml", plain_study(4));
  ASSERT_EQ(run("queue q").code, 0);
  write("q/a.toml", "# the same\n" + plain_study(3));
  EXPECT_THAT(begun_in(run("queue q").err), IsEmpty());
  write("q/a.toml", replaced(plain_study(3), "log = [1e4, 1e5, 3]", "values = [1e4, 1e5, 2e5]"));
  const Ended other = run("queue q");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(begun_in(other.err), ElementsAre("a"));
  EXPECT_THAT(other.err, HasSubstr("--extend"));
  EXPECT_EQ(states()["a"], "refused");
  EXPECT_THAT(other.out, HasSubstr("linkstudy study q/a.toml -o q/results/a"))
      << "its input is right: check has nothing to say";
  write("q/a.toml", replaced(plain_study(3), "log = [1e4, 1e5, 3]",
                             "values = [1e4, 31622.776601683792, 1e5, 2e5]"));
  const Ended extended = run("queue q --extend");
  EXPECT_EQ(extended.code, 0) << extended.err;
  EXPECT_THAT(begun_in(extended.err), ElementsAre("a"));
  EXPECT_EQ(digests(), digests_alone());
  // The model is part of the input.
  write("q/model.toml", replaced(model_text(), "end_time = 0.2", "end_time = 0.19"));
  EXPECT_THAT(begun_in(run("queue q").err), ElementsAre("a", "b"));
  write("q/model.toml", model_text());
  EXPECT_EQ(run("queue q").code, 0);
}

TEST_F(Queue, A_file_that_comes_while_it_runs_is_taken_once_it_is_whole) {
  write("q/b.toml", plain_study(2));
  const pid_t child = start({"queue", "q", "--wait", "1"});
  wait_for([&] { return log().find("b is done") != std::string::npos; });
  const std::string text = plain_study(3);
  const std::size_t half = text.find("[[vary]]") + 4;
  write("q/a.toml", text.substr(0, half));
  std::this_thread::sleep_for(milliseconds(700));
  std::ofstream(path("q/a.toml"), std::ios::app) << text.substr(half);
  EXPECT_EQ(code_of(child), 0);
  EXPECT_THAT(log(), Not(HasSubstr("error")));
  EXPECT_THAT(begun_in(log()), ElementsAre("b", "a"));
}

TEST_F(Queue, Groups_of_ranks_work_on_several_files_at_once) {
  for (const int i : {1, 2, 3, 4, 5, 6}) {
    write(fmt::format("q/{}.toml", i), plain_study(10 * i));
  }
  const Digests alone = digests_alone();
  for (const int ranks : {3, 4}) {
    std::filesystem::remove_all(path("q/results"));
    const Ended ended = run("queue q --group 2", on_ranks(ranks));
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.err,
                AllOf(HasSubstr("2 groups of 2"), HasSubstr("group 0: "), HasSubstr("group 1: ")));
    EXPECT_THAT(begun_in(ended.err), UnorderedElementsAre("1", "2", "3", "4", "5", "6"));
    EXPECT_EQ(digests(), alone);
  }
}

TEST_F(Queue, Programs_share_a_folder_and_run_every_file_once) {
  std::vector<std::string> all;
  for (int i = 10; i < 22; ++i) {
    all.push_back(std::to_string(i));
    write("q/" + all.back() + ".toml", plain_study(20));
  }
  const pid_t child = start({"queue", "q"});
  const Ended other = run("queue q", on_ranks(2));
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_EQ(code_of(child), 0) << log();
  std::vector<std::string> begun = begun_in(other.err);
  for (const std::string& name : begun_in(log())) begun.push_back(name);
  EXPECT_THAT(begun, ::testing::UnorderedElementsAreArray(all));
  EXPECT_THAT(states(), Each(Pair(::testing::_, "done")));
}

// What is longer than any allocation is begun when nothing else is left.
TEST_F(Queue, The_wall_time_ends_it_and_further_starts_end_all) {
  write("q/a_endless.toml", endless_study());
  write("q/b.toml", plain_study(2));
  const Ended first = run("queue q --walltime 2.5", on_ranks(2));
  EXPECT_EQ(first.code, 75) << first.err;
  EXPECT_THAT(begun_in(first.err), ElementsAre("b", "a_endless"));
  EXPECT_THAT(first.err, HasSubstr("are left: it comes last"));
  EXPECT_EQ(states(), (States{{"a_endless", "interrupted"}, {"b", "done"}}));
  // Some seconds of work on any machine.
  write("probe.toml", plain_study(100, 6.0));
  const double probe_s = seconds_of("study probe.toml -o probe");
  write("q/c_long.toml", plain_study(std::max(400, static_cast<int>(300 / probe_s)), 6.0));
  std::filesystem::remove(path("q/a_endless.toml"));
  int starts = 0;
  Ended ended{75, "", ""};
  for (double walltime = 1.4; ended.code == 75 && starts < 12; ++starts, walltime *= 1.5) {
    const std::size_t before = rows_of("c_long");
    ended = run(fmt::format("queue q --walltime {}", walltime));
    EXPECT_GE(rows_of("c_long"), before) << ended.err;
  }
  EXPECT_GE(starts, 2);
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(digests(), digests_alone());
}

TEST_F(Queue, Signals_end_it_with_75_and_the_next_start_goes_on) {
  write("q/1.toml", plain_study(150, 20.0));
  write("q/2.toml", endless_study());
  write("q/3.toml", plain_study(2));
  pid_t child = start({"queue", "q"});
  wait_for([&] { return rows_of("1") > 0; });
  kill(child, SIGUSR1);
  EXPECT_EQ(code_of(child), 75);
  EXPECT_EQ(states(), (States{{"1", "interrupted"}, {"2", "waiting"}, {"3", "waiting"}}));
  child = start({"queue", "q"});
  wait_for(
      [&] { return states()["2"] == "running" && status()["entries"][1]["study"].is_object(); });
  EXPECT_EQ(states(), (States{{"1", "done"}, {"2", "running"}, {"3", "waiting"}}));
  kill(child, SIGTERM);
  EXPECT_EQ(code_of(child), 75);
  EXPECT_EQ(states(), (States{{"1", "done"}, {"2", "interrupted"}, {"3", "waiting"}}));
  child = start({"queue", "q"});
  wait_for([&] { return states()["2"] == "running"; });
  kill(child, SIGKILL);
  code_of(child);
  write("q/results/2.queue", "{\"torn");  // as one killed within a write leaves it
  EXPECT_EQ(states()["2"], "interrupted");
  write("q/2.toml", plain_study(3));
  std::filesystem::remove_all(path("q/results/2"));
  const Ended ended = run("queue q", on_ranks(2));
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(begun_in(ended.err), ElementsAre("2", "3"));
  EXPECT_EQ(digests(), digests_alone());
}

TEST_F(Queue, Failures_that_pass_are_tried_again_when_asked_for) {
  write("q/a.toml", plain_study(3));
  EXPECT_EQ(run("queue q --timeout 1e-9").code, 3);
  const Ended plain = run("queue q");
  EXPECT_EQ(plain.code, 3);
  EXPECT_THAT(begun_in(plain.err), IsEmpty());
  const Ended again = run("queue q --retry-failed");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(digests(), digests_alone());
}

TEST_F(Queue, Files_share_a_cache) {
  write("q/a.toml", plain_study(3));
  write("q/b.toml", plain_study(3) + "[run]\nmax_failures = 1\n");
  const Ended ended = run("queue q --cache cache");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("cache cache: 3 rows and 0 reference runs taken"));
  EXPECT_EQ(digests()["a"], digests()["b"]);
}

TEST_F(Queue, A_rank_that_freezes_ends_it_resumable_with_what_has_ended_kept) {
  write("q/a.toml", plain_study(40, 20.0));
  write("q/b.toml", plain_study(2));
  write("freeze.sh",
        "#!/bin/sh\nif [ $OMPI_COMM_WORLD_RANK = 1 ]; then echo $$ >frozen.pid; fi\n"
        "exec \"$@\"\n");
  std::thread freezing([&] {
    wait_for([&] { return rows_of("a") > 0; });
    kill(std::stoi(read_text(path("frozen.pid"))), SIGSTOP);
  });
  const Ended ended =
      run("queue q --timeout 1", "LINKSTUDY_LANES=1 " + on_ranks(2) + " sh freeze.sh");
  freezing.join();
  EXPECT_THAT(ended.code, aborted_with(75)) << ended.err;
  EXPECT_EQ(states(), (States{{"a", "done"}, {"b", "waiting"}})) << ended.err;
  EXPECT_EQ(run("queue q").code, 0);
}

TEST_F(Queue, Folders_that_are_none_are_refused_once) {
  for (const std::string& before : {std::string(), on_ranks(2)}) {
    const Ended none = run("queue nowhere", before);
    EXPECT_EQ(none.code, 2);
    const std::string said = "nowhere: there is no such folder; name one with the files to run";
    EXPECT_THAT(none.err, HasSubstr(said));
    EXPECT_EQ(none.err.find(said), none.err.rfind(said));
  }
  EXPECT_EQ(run("queue study.toml").code, 2);
  EXPECT_EQ(run("status nowhere").code, 2);
  const Ended empty = run("queue q");
  EXPECT_EQ(empty.code, 0);
  EXPECT_EQ(empty.out, "no files to run\n");
  EXPECT_EQ(run("status q").code, 2);
  EXPECT_FALSE(std::filesystem::exists(path("q/results")));
  EXPECT_EQ(run("queue q --group 0").code, 2);
  EXPECT_EQ(run("queue q --wait -1").code, 2);
  // Results hold a resolved.toml, which is no file to run.
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const Ended results = run("queue out");
  EXPECT_EQ(results.code, 2);
  EXPECT_THAT(results.err, HasSubstr("out: holds results (journal.bin)"));
}

TEST_F(Queue, Where_nothing_can_be_kept_one_error_ends_all_ranks) {
  write("q/a.toml", plain_study(2));
  write("q/results", "a file");
  const Ended blocked = run("queue q", on_ranks(2));
  EXPECT_EQ(blocked.code, 2);
  const std::string said = "q/results: cannot make this folder for the results";
  EXPECT_THAT(blocked.err, AllOf(HasSubstr(said), Not(HasSubstr("ABORT"))));
  EXPECT_EQ(blocked.err.find(said), blocked.err.rfind(said));
  std::filesystem::remove(path("q/results"));
  std::filesystem::create_directory(path("q/results"));
  std::filesystem::create_symlink("/dev/full", path("q/results/a.queue"));
  const Ended full = run("queue q", on_ranks(2));
  EXPECT_EQ(full.code, 2);
  EXPECT_THAT(full.err, AllOf(HasSubstr("q/results/a.queue: cannot "), Not(HasSubstr("ABORT"))));
  std::filesystem::remove(path("q/results/a.queue"));
  // Of one file alone, the others go on; what was in the way may be gone at the next start.
  write("q/b.toml", plain_study(3));
  write("q/results/a", "a file");
  const Ended half = run("queue q");
  EXPECT_EQ(half.code, 2);
  EXPECT_EQ(states(), (States{{"a", "refused"}, {"b", "done"}}));
  std::filesystem::remove(path("q/results/a"));
  EXPECT_EQ(run("queue q").code, 0);
  EXPECT_EQ(digests(), digests_alone());
}

TEST_F(Queue, The_table_fits_a_hundred_columns) {
  write_all_kinds("q");
  const std::string name = "0_a_name_that_is_longer_than_most_would_write_for_a_file.toml";
  write("q/" + name, "x = [\n");
  std::filesystem::last_write_time(
      path("q") / name, std::filesystem::file_time_type::clock::now() - std::chrono::hours(1));
  const Ended ended = run("queue q");
  EXPECT_EQ(ended.code, 2);
  const Ended status = run("status q --watch");
  EXPECT_EQ(status.code, 0);
  EXPECT_EQ(status.out, ended.out);
  std::istringstream lines(status.out);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

}  // namespace
}  // namespace linkstudy::testing::queue_test

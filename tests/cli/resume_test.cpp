// Studies that are interrupted, killed and started again, and studies over several processes: all
// end with the digest of the undisturbed run.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "study/store/journal.h"
#include "tests/cli/launcher_watch.h"
#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::resume_test {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

// 150 evaluations of some milliseconds each.
std::string long_study() {
  const std::string text =
      test::replaced(study_text(), "values = [\"1e4 N/m\", 3e4, 1e5, 1e9]", "log = [1e4, 1e6, 50]");
  return test::replaced(text, "model.toml", "longer.toml");
}

std::map<std::uint64_t, Evaluation> rows_of(const std::filesystem::path& directory) {
  std::map<std::uint64_t, Evaluation> rows;
  if (!std::filesystem::exists(directory / kJournalName)) return rows;
  for (const Evaluation& row : read_journal(directory).evaluations) rows[row.point.id] = row;
  return rows;
}

void allow_mpirun() {
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) {
    setenv(name, "1", 1);
  }
  setenv("OMPI_MCA_pml", "ob1", 1);
}

class Resume : public Program {
 protected:
  Resume() {
    write_inputs();
    write("long.toml", long_study());
    write("longer.toml", test::replaced(model_text(), "end_time = 0.2", "end_time = 1.0"));
  }

  // Ends the program by `signal` after `delay`; its exit code.
  int interrupt(const std::vector<std::string>& arguments, milliseconds delay, int signal) const {
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(delay);
    kill(child, signal);
    return code_of(child);
  }

  // The same once `state` holds, however slow the machine is.
  int interrupt_when(const std::vector<std::string>& arguments, int signal,
                     const std::function<bool()>& state) const {
    const pid_t child = start(arguments);
    EXPECT_TRUE(comes_about(state));
    kill(child, signal);
    return code_of(child);
  }

  static bool comes_about(const std::function<bool()>& state) {
    for (int tries = 0; tries < 6000; ++tries) {
      if (state()) return true;
      std::this_thread::sleep_for(milliseconds(10));
    }
    return false;
  }

  std::string log_of(const std::string& directory) const {
    return read_text(path(directory) / "linkstudy.log");
  }
  bool has_logged(const std::string& directory, const std::string& words) const {
    return log_of(directory).find(words) != std::string::npos;
  }
  nlohmann::json status_of(const std::string& directory) const {
    return nlohmann::json::parse(run("status " + directory + " --json").out);
  }
};

// Two evaluations of 2e9 steps, which no machine ends in time, after a reference of an instant.
std::string endless_study() {
  std::string text = study_text();
  const std::string reference = "\"simulation.step\" = 1.0e-4 } }";
  text.replace(text.find(reference), reference.size(),
               "\"simulation.step\" = 1.0e-4, \"simulation.end_time\" = 0.2 } }");
  const std::string base = "base = { set = { ";
  text.replace(text.find(base), base.size(),
               base + "\"simulation.end_time\" = 2e5, \"simulation.output_interval\" = 1e2, ");
  const std::string values = "values = [\"1e4 N/m\", 3e4, 1e5, 1e9]";
  text.replace(text.find(values), values.size(), "values = [1e4, 2e4]");
  const std::string steps = "values = [1e-3, 5e-4, 1e-4]";
  text.replace(text.find(steps), steps.size(), "values = [1e-4]");
  return text.substr(0, text.find("[[trace]]"));
}

// The other way round: a reference of 2e7 steps, all of which are kept.
std::string endless_reference() {
  std::string text = study_text();
  const std::string step = "\"simulation.step\" = 1.0e-4 } }";
  text.replace(text.find(step), step.size(),
               "\"simulation.step\" = 1.0e-4, \"simulation.output_interval\" = 1.0, "
               "\"simulation.end_time\" = 2e3 } }");
  return text;
}

TEST_F(Resume, A_study_killed_at_random_moments_loses_no_acknowledged_row) {
  const auto begin = std::chrono::steady_clock::now();
  const Ended whole = run("study long.toml -o whole");
  const auto taken =
      std::chrono::duration_cast<milliseconds>(std::chrono::steady_clock::now() - begin);
  ASSERT_EQ(whole.code, 0) << whole.err;
  ASSERT_EQ(rows_of(path("whole")).size(), 150u);
  std::mt19937 random(20240607);
  std::map<std::uint64_t, Evaluation> before;
  int kills = 0;
  int midway = 0;  // kills that found a part of the rows
  for (; kills < 20 && before.size() < 150; ++kills) {
    // Some fall anywhere, the start included; others, however fast the machine is, into the work.
    std::uniform_int_distribution<int> delay(1, static_cast<int>(taken.count()) / 2);
    const std::vector<std::string> arguments = {"study", "long.toml",  "-o",
                                                "out",   "--progress", "none"};
    if (kills % 2 == 0) {
      interrupt(arguments, milliseconds(delay(random)), SIGKILL);
    } else {
      interrupt_when(arguments, SIGKILL,
                     [&] { return rows_of(path("out")).size() > before.size(); });
    }
    const auto after = rows_of(path("out"));
    for (const auto& [id, row] : before) {
      ASSERT_TRUE(after.contains(id)) << "row " << id << " of an earlier start is gone";
      EXPECT_EQ(after.at(id).responses.size(), row.responses.size());
    }
    midway += after.size() > before.size() && after.size() < 150 ? 1 : 0;
    before = after;
  }
  EXPECT_GE(midway, 1);
  const Ended last = run("study long.toml -o out");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(digest_in(last.out), digest_in(whole.out)) << kills << " kills";
  EXPECT_EQ(rows_of(path("out")).size(), 150u);
}

TEST_F(Resume, SIGTERM_ends_in_order_with_75_and_the_next_start_continues) {
  const Ended whole = run("study long.toml -o whole");
  const int code = interrupt_when({"study", "long.toml", "-o", "out"}, SIGTERM,
                                  [&] { return !rows_of(path("out")).empty(); });
  ASSERT_EQ(code, 75);
  const std::size_t rows = rows_of(path("out")).size();
  ASSERT_LT(rows, 150u);
  EXPECT_TRUE(std::filesystem::exists(path("out/results.h5")));
  const Ended last = run("study long.toml -o out");
  EXPECT_THAT(last.err, HasSubstr(std::to_string(rows) + " of 150 done"));
  EXPECT_EQ(digest_in(last.out), digest_in(whole.out));
}

TEST_F(Resume, The_wall_time_ends_a_study_with_75) {
  const Ended ended = run("study long.toml -o out --walltime 0.02 --json");
  EXPECT_EQ(ended.code, 75) << ended.err;
  const nlohmann::json object = nlohmann::json::parse(ended.out);
  EXPECT_EQ(object["status"], "interrupted");
  EXPECT_LT(object["evaluations"], 150);
  EXPECT_EQ(run("study long.toml -o out").code, 0);
}

TEST_F(Resume, A_killed_tune_takes_the_same_path_again) {
  for (const std::string tolerance : {"0.001", "[0.002,0.001]"}) {
    const std::string option = "match.0.tolerance=" + tolerance;
    const Ended whole = run("tune tune.toml --fresh -o whole -s " + option);
    ASSERT_EQ(whole.code, 0) << whole.out << whole.err;
    const std::size_t all = rows_of(path("whole")).size();
    std::filesystem::remove_all(path("out"));
    for (std::size_t least = 1; least < all; least += all / 4 + 1) {
      interrupt_when({"tune", "tune.toml", "-o", "out", "-s", option}, SIGKILL,
                     [&] { return rows_of(path("out")).size() >= least; });
    }
    const Ended last = run("tune tune.toml -o out -s " + option);
    EXPECT_EQ(last.code, 0) << last.err;
    EXPECT_EQ(last.out, whole.out);
  }
}

TEST_F(Resume, SIGTERM_cancels_an_evaluation_in_flight_with_journal_and_log) {
  write("endless.toml", endless_study());
  for (const int signal : {SIGTERM, SIGHUP}) {
    const int code = interrupt_when({"study", "endless.toml", "-o", "out"}, signal, [&] {
      return std::filesystem::exists(path("out")) && has_logged("out", "reference run took");
    });
    EXPECT_EQ(code, 75);
    EXPECT_TRUE(rows_of(path("out")).empty()) << "what was cancelled is nobody's result";
    EXPECT_THAT(log_of("out"), HasSubstr("what is in flight is cancelled"));
    EXPECT_EQ(status_of("out")["state"], "interrupted");
    EXPECT_EQ(status_of("out")["references"], 1);
    std::filesystem::remove_all(path("out"));
  }
}

TEST_F(Resume, The_wall_time_cancels_an_evaluation_in_flight) {
  write("endless.toml", endless_study());
  EXPECT_EQ(run("study endless.toml -o out --walltime 1").code, 75);
  EXPECT_THAT(log_of("out"), HasSubstr("interrupted: wall time"));
  EXPECT_TRUE(rows_of(path("out")).empty());
}

TEST_F(Resume, A_reference_in_flight_ends_by_a_signal_and_by_the_wall_time) {
  write("endless.toml", endless_reference());
  EXPECT_EQ(run("study endless.toml -o out --walltime 1").code, 75);
  EXPECT_EQ(status_of("out")["references"], 0);
  const int code = interrupt_when({"study", "endless.toml", "-o", "again"}, SIGTERM, [&] {
    return std::filesystem::exists(path("again")) && has_logged("again", "12 left");
  });
  EXPECT_EQ(code, 75);
  EXPECT_EQ(status_of("again")["references"], 0);
}

TEST_F(Resume, A_finished_reference_is_never_run_again) {
  ASSERT_EQ(interrupt_when({"study", "long.toml", "-o", "out"}, SIGTERM,
                           [&] { return !rows_of(path("out")).empty(); }),
            75);
  ASSERT_EQ(run("study long.toml -o out").code, 0);
  const std::string log = log_of("out");
  const std::string words = "reference run took";
  EXPECT_NE(log.find(words), std::string::npos);
  EXPECT_EQ(log.find(words), log.rfind(words)) << log;
  EXPECT_EQ(digest_in(run("study long.toml -o out").out),
            digest_in(run("study long.toml -o whole").out));
  EXPECT_EQ(status_of("out")["digest"], digest_in(run("study long.toml -o whole").out));
  EXPECT_EQ(status_of("out")["state"], "complete");
}

// A requeued job starts with the command line of its first start.
TEST_F(Resume, Fresh_erases_for_a_job_of_the_queue_once) {
  const std::string fresh = "study study.toml -o out --fresh";
  ASSERT_EQ(run(fresh, "SLURM_JOB_ID=7").code, 0);
  const Ended requeued = run(fresh, "SLURM_JOB_ID=7 SLURM_RESTART_COUNT=1");
  EXPECT_EQ(requeued.code, 0) << requeued.err;
  EXPECT_THAT(requeued.err, HasSubstr("--fresh was for the first start of job 7"));
  EXPECT_THAT(requeued.err, HasSubstr(", 0 left"));
  const JournalContents journal = read_journal(path("out"));
  ASSERT_EQ(journal.provenance.size(), 2u);
  EXPECT_EQ(journal.provenance[1].job, "7");
  EXPECT_EQ(journal.provenance[1].restart, 1u);
  EXPECT_THAT(log_of("out"), HasSubstr("Slurm job 7, restart 1"));
  EXPECT_THAT(run(fresh, "SLURM_JOB_ID=8").err, HasSubstr("0 of 12 done"));
  EXPECT_THAT(run(fresh, "SLURM_JOB_ID=9 SLURM_RESTART_COUNT=1").err, HasSubstr("0 of 12 done"))
      << "its first start did not come this far";
}

// The last rank stops for good in the midst of its work; three would be killed with it otherwise.
class Frozen : public Resume {
 protected:
  Frozen() { allow_mpirun(); }

  Ended freeze_last_of(int ranks) const {
    write("freeze.sh", "#!/bin/sh\nif [ $OMPI_COMM_WORLD_RANK = " + std::to_string(ranks - 1) +
                           " ]; then echo $$ >frozen.pid; fi\nexec \"$@\"\n");
    std::thread freezing([&] {
      EXPECT_TRUE(comes_about([&] { return !rows_of(path("out")).empty(); }));
      kill(std::stoi(read_text(path("frozen.pid"))), SIGSTOP);
    });
    const Ended ended = run("study study.toml -o out --timeout 15" + long_runs_,
                            "LINKSTUDY_LANES=1 mpirun -n " + std::to_string(ranks) +
                                " --oversubscribe --bind-to none sh freeze.sh");
    freezing.join();
    return ended;
  }

  std::string digest_alone() const {
    return digest_in(run("study study.toml -o alone" + long_runs_).out);
  }

  // Long enough to be met at work, short of the time limit under sanitizers.
  const std::string long_runs_ = " -s simulation.end_time=20";
};

TEST_F(Frozen, A_process_is_lost_and_its_cases_go_elsewhere) {
  const Ended ended = freeze_last_of(3);
  EXPECT_THAT(ended.code, aborted_with(0)) << ended.err;
  EXPECT_THAT(log_of("out"), HasSubstr("exit code 0"));
  EXPECT_EQ(status_of("out")["state"], "complete");
  EXPECT_THAT(ended.err, HasSubstr("rank 2 is lost: no sign of life"));
  EXPECT_EQ(digest_in(ended.out), digest_alone());
}

TEST_F(Frozen, With_no_other_process_left_rank_0_goes_on_alone) {
  const Ended ended = freeze_last_of(2);
  EXPECT_THAT(ended.code, aborted_with(0)) << ended.err;
  EXPECT_THAT(log_of("out"), HasSubstr("exit code 0"));
  EXPECT_THAT(ended.err, HasSubstr("rank 1 is lost: no sign of life"));
  EXPECT_EQ(digest_in(ended.out), digest_alone());
}

TEST_F(Resume, Any_number_of_processes_gives_the_same_digest) {
  allow_mpirun();
  const Ended alone = run("study study.toml -o alone");
  const std::string tolerances = " -s match.0.tolerance=[0.002,0.001]";
  const Ended tuned = run("tune tune.toml -o tuned" + tolerances);
  ASSERT_EQ(alone.code, 0) << alone.err;
  for (const std::string ranks : {"1", "2", "3"}) {
    const std::string launch = "mpirun -n " + ranks + " --oversubscribe --bind-to none";
    const Ended study = run("study study.toml -o study" + ranks, launch);
    EXPECT_EQ(study.code, 0) << study.err;
    EXPECT_EQ(study.out, alone.out) << ranks << " ranks";
    const Ended tune = run("tune tune.toml -o tune" + ranks + tolerances, launch);
    EXPECT_EQ(tune.out, tuned.out) << ranks << " ranks";
    const Ended bad = run("study model.toml", launch);
    EXPECT_EQ(bad.code, 2);
    EXPECT_EQ(bad.err.find("model.toml:2:8"), bad.err.rfind("model.toml:2:8")) << bad.err;
  }
}

}  // namespace
}  // namespace linkstudy::testing::resume_test

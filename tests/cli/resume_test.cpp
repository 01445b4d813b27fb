// Studies that are interrupted, killed and started again, and studies over several processes: all
// end with the digest of the undisturbed run.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "study/store/journal.h"
#include "tests/cli/program.h"

namespace linkstudy::testing {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

// 150 evaluations of some milliseconds each.
std::string long_study() {
  std::string text = study_text();
  const std::string values = "values = [\"1e4 N/m\", 3e4, 1e5, 1e9]";
  text.replace(text.find(values), values.size(), "log = [1e4, 1e6, 50]");
  return text;
}

std::map<std::uint64_t, Evaluation> rows_of(const std::filesystem::path& directory) {
  std::map<std::uint64_t, Evaluation> rows;
  if (!std::filesystem::exists(directory / kJournalName)) return rows;
  for (const Evaluation& row : read_journal(directory).evaluations) rows[row.point.id] = row;
  return rows;
}

class Resume : public Program {
 protected:
  Resume() {
    write_inputs();
    write("long.toml", long_study());
  }

  // Ends the program after `delay` by `signal`; its exit code.
  int interrupt(const std::vector<std::string>& arguments, milliseconds delay, int signal) const {
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(delay);
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

TEST_F(Resume, A_study_killed_at_random_moments_loses_no_acknowledged_row) {
  const Ended whole = run("study long.toml -o whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  ASSERT_EQ(rows_of(path("whole")).size(), 150u);
  std::mt19937 random(20240607);
  std::map<std::uint64_t, Evaluation> before;
  int kills = 0;
  int midway = 0;  // kills that found a part of the rows
  for (; kills < 20 && before.size() < 150; ++kills) {
    // Longer and longer, so that some kill falls into the work however slow the machine is.
    std::uniform_int_distribution<int> delay(20, 80 + 30 * kills);
    interrupt({"study", "long.toml", "-o", "out", "--progress", "none"},
              milliseconds(delay(random)), SIGKILL);
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
  std::size_t rows = 0;
  for (int wait = 50; wait < 2000 && rows == 0; wait += 50) {
    const int code = interrupt({"study", "long.toml", "-o", "out"}, milliseconds(wait), SIGTERM);
    if (code == 0) break;
    EXPECT_EQ(code, 75);
    rows = rows_of(path("out")).size();
  }
  ASSERT_GT(rows, 0u);
  EXPECT_TRUE(std::filesystem::exists(path("out/results.h5")));
  const Ended last = run("study long.toml -o out");
  EXPECT_THAT(last.err, HasSubstr(std::to_string(rows) + " of 150 done"));
  EXPECT_EQ(digest_in(last.out), digest_in(whole.out));
}

TEST_F(Resume, The_wall_time_ends_a_study_with_75) {
  const Ended ended = run("study long.toml -o out --walltime 0.15 --json");
  EXPECT_EQ(ended.code, 75) << ended.err;
  const nlohmann::json object = nlohmann::json::parse(ended.out);
  EXPECT_EQ(object["status"], "interrupted");
  EXPECT_LT(object["evaluations"], 150);
  EXPECT_EQ(run("study long.toml -o out").code, 0);
}

TEST_F(Resume, A_killed_tune_takes_the_same_path_again) {
  const Ended whole = run("tune tune.toml -o whole");
  ASSERT_EQ(whole.code, 0) << whole.out << whole.err;
  for (const int delay : {60, 120, 200, 300}) {
    interrupt({"tune", "tune.toml", "-o", "out"}, milliseconds(delay), SIGKILL);
  }
  const Ended last = run("tune tune.toml -o out");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(last.out, whole.out);
}

TEST_F(Resume, Any_number_of_processes_gives_the_same_digest) {
  ASSERT_EQ(setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1), 0);
  ASSERT_EQ(setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1), 0);
  ASSERT_EQ(setenv("OMPI_MCA_pml", "ob1", 1), 0);
  const Ended alone = run("study study.toml -o alone");
  const Ended tuned = run("tune tune.toml -o tuned");
  ASSERT_EQ(alone.code, 0) << alone.err;
  for (const std::string ranks : {"1", "2", "3"}) {
    const std::string launch = "mpirun -n " + ranks + " --oversubscribe --bind-to none";
    const Ended study = run("study study.toml -o study" + ranks, launch);
    EXPECT_EQ(study.code, 0) << study.err;
    EXPECT_EQ(study.out, alone.out) << ranks << " ranks";
    const Ended tune = run("tune tune.toml -o tune" + ranks, launch);
    EXPECT_EQ(tune.out, tuned.out) << ranks << " ranks";
    const Ended bad = run("study model.toml", launch);
    EXPECT_EQ(bad.code, 2);
    EXPECT_EQ(bad.err.find("model.toml:2:8"), bad.err.rfind("model.toml:2:8")) << bad.err;
  }
}

}  // namespace
}  // namespace linkstudy::testing

// --retry-failed: what failed for a cause that passes, or by a limit that is wider now, is run
// again; the rows are then those of a study that never failed so.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "study/store/journal.h"
#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::retry_test {
namespace {

using test::replaced;
using ::testing::HasSubstr;
using ::testing::Not;

class Retry : public Program {
 protected:
  Retry() { write_inputs(); }

  // Adaptive steps, of which a few softer springs need less than 300, and the stiffer ones more.
  void write_capped() const {
    write("capped.toml", replaced(study_text(), "base = { set = { ",
                                  "base = { set = { \"simulation.integrator\" = \"adaptive\", "
                                  "\"simulation.step_limit\" = 300, "));
  }

  std::vector<Evaluation> rows_of(const std::string& directory) const {
    return read_journal(path(directory)).evaluations;
  }
  std::size_t count_of(const std::string& directory, Cause cause) const {
    const std::vector<Evaluation> rows = rows_of(directory);
    return static_cast<std::size_t>(std::ranges::count(rows, cause, &Evaluation::status));
  }
};

TEST_F(Retry, Runs_that_took_too_long_get_more_time_and_the_digest_of_the_undisturbed_study) {
  const Ended whole = run("study study.toml -o whole");
  ASSERT_EQ(whole.code, 0) << whole.err;
  EXPECT_EQ(run("study study.toml -o out --timeout 1e-9").code, 3);
  ASSERT_EQ(count_of("out", Cause::timeout), 12u);
  EXPECT_EQ(run("study study.toml -o out").code, 3) << "nobody asked for another try";
  const Ended again = run("study study.toml -o out --retry-failed");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr("12 failed evaluations are run again (12 timeout)"));
  EXPECT_EQ(again.out, whole.out);
  for (const Evaluation& row : rows_of("out")) EXPECT_EQ(row.attempts, 2u) << row.point.id;
}

TEST_F(Retry, What_would_fail_again_is_not_repeated_and_counted) {
  const Ended whole = run("study study.toml -o out");
  const std::size_t failed = 12 - count_of("out", Cause::ok);
  ASSERT_GT(failed, 0u) << "the stiffest spring needs shorter steps";
  const Ended again = run("study study.toml -o out --retry-failed");
  EXPECT_THAT(again.err, HasSubstr("no failed evaluation is run again; not repeated, since they "
                                   "would fail again: "));
  EXPECT_EQ(again.out, whole.out);
  for (const Evaluation& row : rows_of("out")) EXPECT_EQ(row.attempts, 1u);
}

TEST_F(Retry, A_wider_step_budget_runs_those_again_that_it_ended) {
  write_capped();
  ASSERT_EQ(run("study capped.toml -o out").code, 0);
  const std::size_t ended = count_of("out", Cause::step_budget);
  ASSERT_GT(ended, 0u);
  ASSERT_LT(ended, 12u);
  const std::string wider = "study capped.toml -s simulation.step_limit=100000";
  const Ended refused = run(wider + " -o out");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("holds a study of another input"));
  EXPECT_THAT(refused.err, HasSubstr("--retry-failed"));
  const Ended again = run(wider + " -o out --retry-failed");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr(std::to_string(ended) + " step_budget)"));
  EXPECT_EQ(again.out, run(wider + " -o whole").out);
  const Ended later = run(wider + " -o out");
  EXPECT_EQ(later.code, 0) << "the directory is of the wider limit now: " << later.err;
  EXPECT_THAT(later.err, HasSubstr("0 left"));
}

TEST_F(Retry, Narrower_limits_and_other_models_are_refused_with_the_reason) {
  write_capped();
  ASSERT_EQ(run("study capped.toml -o out").code, 0);
  const std::string before = read_text(path("out/journal.bin"));
  const Ended narrower =
      run("study capped.toml -o out --retry-failed -s simulation.step_limit=299");
  EXPECT_EQ(narrower.code, 2);
  EXPECT_THAT(narrower.err, HasSubstr("its rows were run under wider limits"));
  const Ended other = run("study capped.toml -o out --retry-failed -s link.crank.mass=1.5");
  EXPECT_EQ(other.code, 2);
  EXPECT_THAT(other.err, HasSubstr("'link.crank.mass' was 1, now 1.5"));
  EXPECT_EQ(run("study capped.toml -o out --retry-failed --fresh").code, 2);
  EXPECT_EQ(read_text(path("out/journal.bin")), before) << "nothing was touched";
}

TEST_F(Retry, A_retry_that_was_killed_goes_on_by_the_plain_command) {
  const Ended whole = run("study study.toml -o whole");
  ASSERT_EQ(run("study study.toml -o out --timeout 1e-9").code, 3);
  const pid_t child = start({"study", "study.toml", "-o", "out", "--retry-failed"});
  for (int tries = 0; tries < 6000; ++tries) {
    if (count_of("out", Cause::timeout) < 12) break;  // it has begun
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const Ended last = run("study study.toml -o out");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(last.out, whole.out);
}

// Rows as three lost ranks leave them: that takes minutes to bring about.
TEST_F(Retry, Rows_of_lost_ranks_and_of_exceptions_are_run_again) {
  const Ended whole = run("study study.toml -o out");
  ASSERT_EQ(whole.code, 0);
  {
    const JournalContents contents = read_journal(path("out"));
    Journal journal(path("out"), contents.input_sha256, OpenMode::resume);
    const std::pair<std::size_t, Cause> lost[] = {{0, Cause::rank_lost}, {5, Cause::exception}};
    for (const auto& [id, cause] : lost) {
      Evaluation row = contents.evaluations.at(id);
      row.status = cause;
      row.attempts = 3;
      row.responses.clear();
      journal.append(row);
    }
  }
  EXPECT_NE(digest_in(run("study study.toml -o out").out), digest_in(whole.out));
  const Ended again = run("study study.toml -o out --retry-failed");
  EXPECT_THAT(again.err,
              HasSubstr("2 failed evaluations are run again (1 exception, 1 rank_lost)"));
  EXPECT_EQ(again.out, whole.out);
  EXPECT_EQ(rows_of("out").at(5).attempts, 4u);
}

// A killed process ends the job; what it had in hand is nobody's row.
TEST_F(Retry, After_a_killed_process_the_same_command_makes_it_whole) {
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) {
    setenv(name, "1", 1);
  }
  setenv("OMPI_MCA_pml", "ob1", 1);
  write("die.sh",
        "#!/bin/sh\nif [ $OMPI_COMM_WORLD_RANK = 1 ]; then echo $$ >worker.pid; fi\nexec \"$@\"\n");
  const std::string study = "study study.toml -s simulation.end_time=20";
  std::thread killing([&] {
    for (int tries = 0; tries < 6000; ++tries) {
      const bool has_begun = std::filesystem::exists(path("out/journal.bin")) &&
                             !read_journal(path("out")).evaluations.empty();
      if (has_begun) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    kill(std::stoi(read_text(path("worker.pid"))), SIGKILL);
  });
  const Ended killed = run(
      study + " -o out", "LINKSTUDY_LANES=1 mpirun -n 2 --oversubscribe --bind-to none sh die.sh");
  killing.join();
  EXPECT_NE(killed.code, 0);
  EXPECT_LT(rows_of("out").size(), 12u);
  const Ended again = run(study + " -o out --retry-failed");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_EQ(again.out, run(study + " -o whole").out);
}

}  // namespace
}  // namespace linkstudy::testing::retry_test

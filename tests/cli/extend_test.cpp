// --extend: a larger design, or a search with a larger budget or wider ranges, keeps the rows that
// are there; results are those of the larger study from nothing.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <chrono>
#include <thread>

#include "study/store/journal.h"
#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::extend_test {
namespace {

using test::replaced;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kStiffnesses = "values = [\"1e4 N/m\", 3e4, 1e5, 1e9]";
constexpr const char* kSteps = "values = [1e-3, 5e-4, 1e-4]";

class Extend : public Program {
 protected:
  Extend() { write_inputs(); }

  std::map<std::uint64_t, Evaluation> rows_of(const std::string& directory) const {
    std::map<std::uint64_t, Evaluation> rows;
    for (const Evaluation& row : read_journal(path(directory)).evaluations) {
      rows[row.point.id] = row;
    }
    return rows;
  }

  // Rows of out that are runs of before: their wall times are the same numbers.
  std::size_t count_kept(const std::map<std::uint64_t, Evaluation>& before) const {
    std::size_t kept = 0;
    for (const auto& [id, row] : rows_of("out")) {
      kept += std::ranges::any_of(before,
                                  [&](const auto& one) { return one.second.wall_s == row.wall_s; });
    }
    return kept;
  }

  // The small study in out, then study.toml on top of it.
  void expect_extended(const std::string& small, std::size_t rows) {
    write("small.toml", small);
    ASSERT_EQ(run("study small.toml -o out").code, 0);
    const auto before = rows_of("out");
    ASSERT_EQ(before.size(), rows);
    const Ended plain = run("study study.toml -o out");
    EXPECT_EQ(plain.code, 2);
    EXPECT_THAT(plain.err, HasSubstr("keep its rows with --extend"));
    const Ended larger = run("study study.toml -o out --extend");
    EXPECT_EQ(larger.code, 0) << larger.err;
    EXPECT_THAT(larger.err, HasSubstr("extended: " + std::to_string(rows) + " rows are kept, " +
                                      std::to_string(12 - rows) + " to run"));
    const Ended whole = run("study study.toml -o whole");
    EXPECT_EQ(larger.out, whole.out);
    EXPECT_EQ(run("export out --table traces --format csv").out,
              run("export whole --table traces --format csv").out);
    EXPECT_EQ(count_kept(before), rows);
    const std::string log = read_text(path("out/linkstudy.log"));
    EXPECT_EQ(log.find("reference run took"), log.rfind("reference run took")) << "it is kept too";
    EXPECT_EQ(run("study study.toml -o out").out, whole.out) << "no option is needed any more";
  }
};

TEST_F(Extend, A_grid_that_grows_along_its_first_axis_keeps_its_ids) {
  expect_extended(replaced(study_text(), kStiffnesses, "values = [\"1e4 N/m\", 3e4]"), 6);
  EXPECT_FALSE(std::filesystem::exists(path("out/journal_1.bin")));
}

TEST_F(Extend, A_grid_that_grows_along_its_last_axis_moves_its_rows) {
  expect_extended(replaced(study_text(), kSteps, "values = [1e-3, 1e-4]"), 8);
  EXPECT_TRUE(std::filesystem::exists(path("out/journal_1.bin")));
}

TEST_F(Extend, Another_axis_through_the_value_that_there_was) {
  std::string small = study_text();
  const std::string axis =
      "[[vary]]\nparameter = \"simulation.step\"\nvalues = [1e-3, 5e-4, 1e-4]\n";
  small = replaced(small, axis, "");
  expect_extended(small, 4);
}

TEST_F(Extend, A_list_takes_rows_before_and_after_its_own) {
  const std::string list = "[design]\ntype = \"list\"\n\n[[match]]";
  const auto of = [&](const std::string& stiffnesses, const std::string& steps) {
    std::string text = replaced(study_text(), kStiffnesses, stiffnesses);
    return replaced(replaced(text, kSteps, steps), "[[match]]", list);
  };
  write("small.toml", of("values = [3e4, 1e5]", "values = [1e-3, 5e-4]"));
  write("list.toml", of("values = [1e4, 3e4, 1e5, 2e5]", "values = [1e-4, 1e-3, 5e-4, 1e-4]"));
  ASSERT_EQ(run("study small.toml -o out").code, 0);
  const auto before = rows_of("out");
  const Ended larger = run("study list.toml -o out --extend");
  EXPECT_EQ(larger.code, 0) << larger.err;
  EXPECT_EQ(larger.out, run("study list.toml -o whole").out);
  EXPECT_EQ(count_kept(before), 2u);
}

TEST_F(Extend, What_does_not_contain_the_rows_is_refused_with_the_reason) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const std::string before = read_text(path("out/journal.bin"));
  const auto refusal = [&](const std::string& from, const std::string& to) {
    write("other.toml", replaced(study_text(), from, to));
    const Ended ended = run("study other.toml -o out --extend");
    EXPECT_EQ(ended.code, 2);
    return ended.err;
  };
  EXPECT_THAT(refusal(kSteps, "values = [1e-3, 1e-4]"),
              HasSubstr("row 1 is none of it (no point is at closure.S.sde.stiffness = 10000 N/m, "
                        "simulation.step = 0.0005 s)"));
  EXPECT_THAT(refusal("reduce = \"last\"", "reduce = \"max\""),
              HasSubstr("other things are kept of a run: 'response.crank_speed.reduce' was 'last', "
                        "now 'max'"));
  EXPECT_THAT(
      refusal("\"simulation.step\" = 1.0e-4 } }", "\"simulation.step\" = 5.0e-5 } }"),
      HasSubstr("it is compared with another run: 'reference.simulation.step' was 0.0001, now "
                "5e-05"));
  EXPECT_THAT(refusal("[[trace]]",
                      "[[load_case]]\nname = \"fast\"\nset = { "
                      "\"load.resistance.law.at_speed\" = 12.0 }\n\n[[trace]]"),
              HasSubstr("'load_case' was nothing"));
  EXPECT_THAT(run("study study.toml -o out --extend -s link.crank.mass=1.5").err,
              HasSubstr("the model is another: 'link.crank.mass' was 1, now 1.5"));
  EXPECT_THAT(run("tune tune.toml -o out --extend").err, HasSubstr("it is a study"));
  EXPECT_EQ(read_text(path("out/journal.bin")), before) << "nothing was touched";
}

TEST_F(Extend, Tolerances_and_names_judge_and_name_and_cost_no_run) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const auto before = rows_of("out");
  const std::string other = "study study.toml -s match.0.tolerance=0.001 -s name=Strict";
  const Ended strict = run(other + " -o out --extend");
  EXPECT_EQ(strict.code, 0) << strict.err;
  EXPECT_EQ(strict.out, run(other + " -o whole").out);
  EXPECT_EQ(count_kept(before), 12u);
}

TEST_F(Extend, An_extension_that_was_killed_goes_on_by_the_plain_command) {
  write("small.toml", replaced(study_text(), kSteps, "values = [1e-3, 1e-4]"));
  ASSERT_EQ(run("study small.toml -o out").code, 0);
  const auto before = rows_of("out");
  const std::vector<std::string> arguments = {"study", "study.toml", "-o", "out", "--extend"};
  for (int delay = 1; delay <= 81; delay += 20) {
    const pid_t child = start(arguments);
    for (int tries = 0; tries < 6000; ++tries) {
      if (std::filesystem::exists(path("out/journal_1.bin"))) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    kill(child, SIGKILL);
    waitpid(child, nullptr, 0);
  }
  const Ended last = run("study study.toml -o out");
  EXPECT_EQ(last.code, 0) << last.err;
  EXPECT_EQ(last.out, run("study study.toml -o whole").out);
  EXPECT_EQ(count_kept(before), 8u);
}

TEST_F(Extend, Fresh_removes_what_was_set_aside) {
  write("small.toml", replaced(study_text(), kSteps, "values = [1e-3, 1e-4]"));
  ASSERT_EQ(run("study small.toml -o out").code, 0);
  ASSERT_EQ(run("study study.toml -o out --extend").code, 0);
  ASSERT_TRUE(std::filesystem::exists(path("out/journal_1.bin")));
  const Ended fresh = run("study study.toml -o out --fresh");
  EXPECT_THAT(fresh.err, Not(HasSubstr("taken from")));
  EXPECT_FALSE(std::filesystem::exists(path("out/journal_1.bin")));
}

// A search asks for what it asks for: those of its points that are there are taken.
TEST_F(Extend, A_tune_with_a_wider_range_and_a_larger_budget_takes_what_is_there) {
  const std::string wide = "range = { log = [1e3, 1e7] }";
  write("narrow.toml", replaced(tune_text(), wide, "range = { log = [1e4, 1e6] }"));
  ASSERT_NE(run("tune narrow.toml -o out -s search.max_evaluations=12").code, 2);
  const auto first = rows_of("out");
  ASSERT_EQ(first.size(), 12u);
  const Ended budget = run("tune narrow.toml -o out --extend");
  EXPECT_EQ(budget.code, 0) << budget.out << budget.err;
  EXPECT_THAT(budget.err, HasSubstr("12 rows of 12 taken from journals set aside"));
  EXPECT_EQ(budget.out, run("tune narrow.toml -o narrow").out);
  const Ended wider = run("tune tune.toml -o out --extend");
  EXPECT_EQ(wider.code, 0) << wider.err;
  EXPECT_EQ(wider.out, run("tune tune.toml -o wide").out);
  const Ended back = run("tune narrow.toml -o out --extend");
  EXPECT_EQ(back.code, 2);
  EXPECT_THAT(back.err, HasSubstr("the range of 'closure.S.sde.stiffness' was [1000, 10000000], "
                                  "now [10000, 1000000]"));
}

// Its reference and its levels are there; the answer is drawn anew.
TEST_F(Extend, A_refinement_by_one_level_more) {
  std::string text = replaced(tune_text(), "kind = \"tune\"", "kind = \"converge\"");
  text = replaced(text, "[[tune]]", "[[refine]]");
  text = replaced(text, "range = { log = [1e3, 1e7] }",
                  "ladder = { from = 1e4, ratio = 4.0, levels = 4 }");
  write("ladder.toml", text);
  const Ended three = run("converge ladder.toml -o out -s refine.0.ladder.levels=3");
  ASSERT_NE(three.code, 2) << three.err;
  const auto before = rows_of("out");
  const Ended four = run("converge ladder.toml -o out --extend");
  EXPECT_THAT(four.err, HasSubstr("extended: 3 rows are kept, 1 to run"));
  const Ended whole = run("converge ladder.toml -o whole --cache cache");
  EXPECT_EQ(four.code, whole.code);
  EXPECT_EQ(four.out, whole.out);
  EXPECT_EQ(count_kept(before), 3u);
  const Ended cached = run("converge ladder.toml -o cached --cache cache");
  EXPECT_EQ(cached.out, whole.out);
  EXPECT_THAT(cached.err, HasSubstr("4 rows and 1 reference run taken\n"));
}

TEST_F(Extend, A_tune_whose_runs_took_too_long_is_run_again) {
  const Ended whole = run("tune tune.toml -o whole");
  ASSERT_EQ(whole.code, 0);
  ASSERT_NE(run("tune tune.toml -o out --timeout 1e-9").code, 0);
  const Ended again = run("tune tune.toml -o out --retry-failed");
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, HasSubstr(" timeout)"));
  EXPECT_EQ(again.out, whole.out);
  EXPECT_EQ(rows_of("out").at(0).attempts, 2u);
  EXPECT_EQ(run("tune tune.toml -o out").out, whole.out);
}

}  // namespace
}  // namespace linkstudy::testing::extend_test

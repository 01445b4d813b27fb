// --cache: what one study has run no other runs again, and results are the same with and without.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <fstream>

#include "study/store/journal.h"
#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::cache_test {
namespace {

using test::replaced;
using ::testing::HasSubstr;
using ::testing::Not;

class Cache : public Program {
 protected:
  Cache() { write_inputs(); }

  // The files of results, sorted.
  std::vector<std::filesystem::path> entries() const {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(path("cache"))) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && name != "CACHEDIR.TAG") files.push_back(entry.path());
    }
    std::ranges::sort(files);
    return files;
  }
};

TEST_F(Cache, A_study_that_has_been_done_elsewhere_runs_nothing) {
  const Ended plain = run("study study.toml -o plain");
  const Ended first = run("study study.toml -o first --cache cache");
  EXPECT_THAT(first.err, HasSubstr("cache cache: 0 rows and 0 reference runs taken; 13 were not "
                                   "there (13 new)"));
  const Ended second = run("study study.toml -o second --cache cache");
  EXPECT_THAT(second.err, HasSubstr("cache cache: 12 rows and 1 reference run taken\n"));
  EXPECT_EQ(first.out, plain.out);
  EXPECT_EQ(second.out, plain.out);
  EXPECT_EQ(second.code, plain.code);
  EXPECT_THAT(read_text(path("second/linkstudy.log")), Not(HasSubstr("reference run took")));
  EXPECT_EQ(run("export second --table traces --format csv").out,
            run("export plain --table traces --format csv").out);
  // Times are of the runs that were made: nothing was run again.
  const auto made = read_journal(path("first")).evaluations;
  const auto taken = read_journal(path("second")).evaluations;
  ASSERT_EQ(taken.size(), made.size());
  for (std::size_t i = 0; i < made.size(); ++i) EXPECT_EQ(taken[i].wall_s, made[i].wall_s);
  EXPECT_THAT(read_text(path("second/journal.bin")),
              HasSubstr("12 rows and 1 reference run taken"));
  EXPECT_EQ(entries().size(), 13u);
}

TEST_F(Cache, Another_value_of_the_model_is_another_case) {
  ASSERT_EQ(run("study study.toml -o first --cache cache").code, 0);
  for (const std::string other :
       {"-s link.crank.mass=1.5", "-s load.drive.course.value=11", "-s simulation.end_time=0.3"}) {
    const Ended ended = run("study study.toml -o other --fresh --cache cache " + other);
    EXPECT_THAT(ended.err, HasSubstr("cache cache: 0 rows and 0 reference runs taken")) << other;
    EXPECT_EQ(ended.out, run("study study.toml -o whole --fresh " + other).out);
  }
  // What only judges or names is no part of a case.
  const Ended strict =
      run("study study.toml -o strict --cache cache -s match.0.tolerance=0.5 -s "
          "match.0.norm=rms -s name=other");
  EXPECT_THAT(strict.err, HasSubstr("12 rows and 1 reference run taken\n"));
}

// Only deterministic failures are results.
TEST_F(Cache, What_may_end_otherwise_is_not_kept) {
  const Ended late = run("study study.toml -o late --cache cache --timeout 1e-9");
  EXPECT_EQ(late.code, 3);
  EXPECT_EQ(entries().size(), 1u) << "the reference run";
  const Ended whole = run("study study.toml -o whole --cache cache");
  EXPECT_THAT(whole.err, HasSubstr("0 rows and 1 reference run taken; 12 were not there"));
  const Ended again = run("study study.toml -o again --cache cache");
  EXPECT_THAT(again.err, HasSubstr("12 rows and 1 reference run taken"));
  EXPECT_THAT(again.out, HasSubstr("diverged"));
  EXPECT_EQ(again.out, whole.out);
}

// The study varies one value, the tune that and the step.
TEST_F(Cache, A_tune_takes_what_a_study_has_done_and_the_other_way_round) {
  const Ended plain = run("tune tune.toml -o plain");
  ASSERT_EQ(plain.code, 0);
  const std::vector<Evaluation> rows = read_journal(path("plain")).evaluations;
  std::string values;
  for (int i = 0; i < 10; ++i) {
    values += fmt::format("{}{:.17g}", i == 0 ? "" : ", ",
                          std::get<double>(rows.at(static_cast<std::size_t>(i)).point.values[0]));
  }
  std::string study = replaced(tune_text(), "kind = \"tune\"", "kind = \"study\"");
  study = replaced(study, "[[tune]]", "[[vary]]");
  study = replaced(study, "range = { log = [1e3, 1e7] }", "values = [" + values + "]");
  write("scan.toml", study);
  ASSERT_EQ(run("study scan.toml -o scan --cache cache").code, 0);
  const Ended tuned = run("tune tune.toml -o tuned --cache cache");
  EXPECT_EQ(tuned.out, plain.out);
  EXPECT_THAT(tuned.err, HasSubstr("cache cache: 10 rows and 1 reference run taken; "));
  std::filesystem::remove_all(path("cache"));
  ASSERT_EQ(run("tune tune.toml -o again --cache cache").code, 0);
  const Ended scanned = run("study scan.toml -o from_tune --cache cache");
  EXPECT_THAT(scanned.err, HasSubstr("cache cache: 10 rows and 1 reference run taken\n"));
  EXPECT_EQ(scanned.out, run("study scan.toml -o scan_alone").out);
  // A tune of another tolerance shares what its search asks for.
  const Ended other = run("tune tune.toml -o other --cache cache -s match.0.tolerance=0.002");
  EXPECT_EQ(other.out, run("tune tune.toml -o whole -s match.0.tolerance=0.002").out);
  EXPECT_THAT(other.err, Not(HasSubstr("cache cache: 0 rows")));
}

TEST_F(Cache, Other_roundings_are_other_results) {
  ASSERT_EQ(run("study study.toml -o first --cache cache").code, 0);
  if (run("--version").out.find("SIMD    baseline") != std::string::npos) {
    GTEST_SKIP() << "this machine has one";
  }
  const Ended other = run("study study.toml -o other --cache cache", "LINKSTUDY_SIMD=baseline");
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_THAT(other.err, HasSubstr("13 were not there (13 of another instruction set)"));
  const Ended lanes = run("study study.toml -o lanes --cache cache", "LINKSTUDY_LANES=1");
  EXPECT_THAT(lanes.err, HasSubstr("12 rows and 1 reference run taken\n"));
}

// Every byte of an entry counts.
TEST_F(Cache, Damaged_entries_are_run_again_and_said_once) {
  const Ended first = run("study study.toml -o first --cache cache");
  const std::vector<std::filesystem::path> files = entries();
  ASSERT_EQ(files.size(), 13u);
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::string bytes = read_text(files[i]);
    if (i % 3 == 0) bytes.resize(bytes.size() * i / files.size());
    if (i % 3 == 1) bytes[bytes.size() * i / files.size()] ^= 0x20;
    if (i % 3 == 2) bytes = read_text(files[(i + 1) % files.size()]);
    std::ofstream(files[i], std::ios::binary) << bytes;
  }
  const Ended second = run("study study.toml -o second --cache cache");
  EXPECT_EQ(second.out, first.out);
  EXPECT_THAT(second.err, HasSubstr("0 rows and 0 reference runs taken; 13 were not there (13 "
                                    "damaged)"));
  const std::string said = "is damaged and is made anew";
  EXPECT_NE(second.err.find(said), std::string::npos);
  EXPECT_EQ(second.err.find(said), second.err.rfind(said));
  const Ended third = run("study study.toml -o third --cache cache");
  EXPECT_THAT(third.err, HasSubstr("12 rows and 1 reference run taken\n"));
  EXPECT_EQ(third.out, first.out);
}

TEST_F(Cache, Directories_that_are_no_cache_are_refused_before_anything_begins) {
  write("file", "text");
  EXPECT_EQ(run("study study.toml -o out --cache file").code, 2);
  std::filesystem::create_directory(path("full"));
  std::ofstream(path("full/notes.txt")) << "text";
  const Ended full = run("study study.toml -o out --cache full");
  EXPECT_EQ(full.code, 2);
  EXPECT_THAT(full.err, HasSubstr("holds other files ('notes.txt') and no cache; choose another "
                                  "directory with --cache"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

}  // namespace
}  // namespace linkstudy::testing::cache_test

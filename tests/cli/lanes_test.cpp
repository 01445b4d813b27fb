// How many evaluations run side by side, and on which instruction set, is seen in the records of a
// study and in nothing that it answers.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>

#include "core/base/isa.h"
#include "study/store/journal.h"
#include "study/store/results_file.h"
#include "tests/cli/program.h"

namespace linkstudy::testing::lanes_test {
namespace {

using ::testing::HasSubstr;
using ::testing::MatchesRegex;
using ::testing::Not;

class Lanes : public Program {
 protected:
  Lanes() {
    write_inputs();
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_pml", "ob1", 1);
  }
};

std::string launch_of(int ranks) {
  return "mpirun -n " + std::to_string(ranks) + " --oversubscribe --bind-to none";
}

// Sets with a fused multiply-add give equal bits; the baseline has none.
std::vector<std::string> fused_sets() {
  std::vector<std::string> sets;
  for (const auto isa : {InstructionSet::avx2, InstructionSet::avx512}) {
    if (machine_has(isa)) sets.emplace_back(name_of(isa));
  }
  return sets;
}

// What /provenance says of them.
std::string kernels_in(const std::string& file) {
  const std::vector<NamedText> texts = read_results(file).texts;
  const auto found = std::ranges::find(texts, "kernels", &NamedText::name);
  return found == texts.end() ? "" : found->text;
}

TEST_F(Lanes, Change_no_digest_however_many_ranks_there_are) {
  const Ended alone = run("study study.toml -o alone", "LINKSTUDY_LANES=1");
  ASSERT_EQ(alone.code, 0) << alone.err;
  for (const int ranks : {1, 2, 3}) {
    for (const char* lanes : {"LINKSTUDY_LANES=", "LINKSTUDY_LANES=1"}) {
      const Ended ended = run("study study.toml --fresh -o out",
                              std::string("env ") + lanes + " " + launch_of(ranks));
      EXPECT_EQ(ended.code, 0) << ended.err;
      EXPECT_EQ(ended.out, alone.out) << ranks << " ranks, " << lanes;
    }
  }
}

TEST_F(Lanes, Of_ranks_that_round_differently_are_refused) {
  if (fused_sets().empty()) GTEST_SKIP() << "this machine has no other set than the baseline";
  const std::string one_differs = launch_of(2) +
                                  " sh -c 'test $OMPI_COMM_WORLD_RANK = 1 && export "
                                  "LINKSTUDY_SIMD=baseline; exec \"$0\" \"$@\"'";
  const Ended ended = run("study study.toml -o mixed", one_differs);
  EXPECT_EQ(ended.code, 2) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("rounds differently"));
  EXPECT_THAT(left_behind(), Not(::testing::Contains(HasSubstr("mixed"))));
}

TEST_F(Lanes, Give_equal_bits_wherever_multiply_and_add_are_fused) {
  if (fused_sets().size() < 2) GTEST_SKIP() << "this machine has not both";
  std::vector<std::string> outs;
  for (const std::string& set : fused_sets()) {
    const Ended study = run("study study.toml -o " + set, "LINKSTUDY_SIMD=" + set);
    EXPECT_THAT(study.err, HasSubstr("SIMD " + set));
    const Ended tune = run("tune tune.toml -o tune_" + set, "LINKSTUDY_SIMD=" + set);
    EXPECT_EQ(tune.code, 0) << tune.err;
    outs.push_back(study.out + tune.out);
  }
  EXPECT_EQ(outs[0], outs[1]);
}

TEST_F(Lanes, Do_not_lead_a_tune) {
  const Ended scalar = run("tune tune.toml -o scalar --json", "LINKSTUDY_LANES=1");
  const Ended packed = run("tune tune.toml -o packed --json");
  ASSERT_EQ(scalar.code, 0) << scalar.err;
  EXPECT_EQ(packed.out, scalar.out);
}

// Its searches run side by side and ask together: in an order that no machine decides.
TEST_F(Lanes, And_ranks_do_not_lead_a_tune_of_two_values) {
  std::string text = tune_text();
  const std::string whole = "stiffness\"\nrange = { log = [1e3, 1e7] }\n";
  const std::size_t at = text.find(whole);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, whole.size(),
               "stiffness.y\"\nrange = { log = [1e3, 1e7] }\n\n[[tune]]\n"
               "parameter = \"closure.S.sde.stiffness.z\"\nrange = { log = [1e3, 1e7] }\n\n"
               "[search]\nmax_evaluations = 600\n");
  write("axes.toml", text);
  const Ended alone = run("tune axes.toml -o alone --json", "LINKSTUDY_LANES=1");
  ASSERT_THAT(alone.code, ::testing::AnyOf(0, 4)) << alone.err;
  EXPECT_THAT(alone.out, HasSubstr("\"C4\""));
  for (const int ranks : {1, 2, 3}) {
    const Ended ended = run("tune axes.toml --fresh -o out --json", launch_of(ranks));
    EXPECT_EQ(ended.out, alone.out) << ranks << " ranks";
  }
}

TEST_F(Lanes, Do_not_matter_to_a_study_that_is_continued) {
  const Ended whole = run("study study.toml -o whole");
  const Ended part = run("study study.toml -o out --on-failure abort", "LINKSTUDY_LANES=1");
  ASSERT_EQ(part.code, 3) << part.err;
  const std::size_t done = read_journal(path("out")).evaluations.size();
  EXPECT_GT(done, 0u);
  EXPECT_LT(done, 12u);
  const Ended rest = run("study study.toml -o out");
  EXPECT_EQ(digest_in(rest.out), digest_in(whole.out));
}

TEST_F(Lanes, Are_in_the_banner_the_version_and_the_provenance) {
  const Ended ended = run("study study.toml -o out", "LINKSTUDY_SIMD=baseline");
  EXPECT_THAT(ended.err, HasSubstr("SIMD baseline, 2 lanes"));
  const Ended again = run("study study.toml -o out", "LINKSTUDY_SIMD=baseline LINKSTUDY_LANES=1");
  EXPECT_THAT(again.err, HasSubstr("SIMD baseline, 1 lane,"));
  EXPECT_THAT(run("--version", "LINKSTUDY_SIMD=baseline").out,
              HasSubstr("SIMD    baseline, 2 lanes\n"));
  EXPECT_THAT(ended.err, HasSubstr("kernels general (no fused multiply-add), "));
  const StudyResults results = read_results(path("out/results.h5"));
  ASSERT_EQ(results.provenance.size(), 2u);
  EXPECT_EQ(results.provenance[0].simd, "baseline");
  EXPECT_EQ(results.provenance[0].lanes, 2u);
  EXPECT_EQ(results.provenance[1].lanes, 1u);
}

TEST_F(Lanes, Of_written_steps_give_the_bits_of_the_general_loop_and_say_so) {
  if (fused_sets().empty()) GTEST_SKIP() << "steps are written for AVX2";
  const Ended general = run("study study.toml -o general", "LINKSTUDY_KERNELS=general");
  const Ended written = run("study study.toml -o written", "LINKSTUDY_KERNELS=written");
  ASSERT_EQ(written.code, 0) << written.err;
  EXPECT_EQ(written.out, general.out);
  EXPECT_THAT(general.err, HasSubstr("kernels general (LINKSTUDY_KERNELS=general), "));
  const std::string set = machine_has(InstructionSet::avx512) ? "AVX-512" : "AVX2";
  const std::string kernels = "written for each linkage (" + set + ")";
  EXPECT_THAT(written.err, HasSubstr("kernels " + kernels + ", "));
  EXPECT_THAT(run("--version").out, HasSubstr("kernels " + kernels + "\n"));
  EXPECT_THAT(kernels_in(path("written/results.h5")),
              MatchesRegex(kernels.substr(0, kernels.find('(')) + ".*" + set +
                           "., [0-9]+ step kernels? written in [0-9.]+ ms on rank 0"));
  EXPECT_EQ(kernels_in(path("general/results.h5")), "general (LINKSTUDY_KERNELS=general)");
  EXPECT_THAT(read_text(path("written/linkstudy.log")), HasSubstr("written in "));
  EXPECT_THAT(read_text(path("general/linkstudy.log")), Not(HasSubstr("written in ")));
  const Ended wrong = run("study study.toml -o out", "LINKSTUDY_KERNELS=fast");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_EQ(wrong.err, "linkstudy: error: LINKSTUDY_KERNELS=fast: must be written or general\n");
}

TEST_F(Lanes, That_the_machine_lacks_are_a_usage_error_of_every_verb_that_runs) {
  for (const std::string verb : {"simulate model.toml", "statics model.toml",
                                 "study study.toml -o out", "tune tune.toml -o out", "--version"}) {
    const Ended set = run(verb, "LINKSTUDY_SIMD=neon");
    EXPECT_EQ(set.code, 2) << verb;
    EXPECT_EQ(set.err, "linkstudy: error: LINKSTUDY_SIMD=neon: must be baseline, avx2 or avx512\n");
    EXPECT_EQ(set.out, "");
    const Ended lanes = run(verb, "LINKSTUDY_LANES=3");
    EXPECT_EQ(lanes.code, 2) << verb;
    EXPECT_THAT(lanes.err, HasSubstr("LINKSTUDY_LANES=3: must be 1 or"));
  }
  EXPECT_EQ(run("check study.toml", "LINKSTUDY_SIMD=neon").code, 0);
  const Ended ranks = run("study study.toml -o out", "LINKSTUDY_SIMD=neon " + launch_of(2));
  EXPECT_EQ(ranks.code, 2);
  EXPECT_EQ(ranks.err.find("neon"), ranks.err.rfind("neon")) << ranks.err;
  EXPECT_THAT(left_behind(), ::testing::IsEmpty());
}

TEST_F(Lanes, Share_their_time_among_evaluations_that_are_journalled_each) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const JournalContents contents = read_journal(path("out"));
  ASSERT_EQ(contents.evaluations.size(), 12u);
  // Packs hold what has the same step: 3 of 4, of one width, with equal shares inside.
  std::map<double, int> shares;
  for (const Evaluation& evaluation : contents.evaluations) ++shares[evaluation.wall_s];
  const int lanes = simd_level().lanes;
  for (const auto& [seconds, count] : shares) {
    EXPECT_GT(seconds, 0.0);
    EXPECT_EQ(count, std::min(lanes, 4));
  }
}

}  // namespace
}  // namespace linkstudy::testing::lanes_test

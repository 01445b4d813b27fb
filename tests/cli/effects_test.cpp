// What a user is told who sets what does nothing, twice, or in vain.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace linkstudy::testing::effects_test {
namespace {

using nlohmann::json;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Effects : public Program {
 protected:
  Effects() { write_inputs(); }

  void replace(const std::string& file, const std::string& from, const std::string& to) {
    std::string text = read_text(path(file));
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    write(file, text.replace(at, from.size(), to));
  }
};

TEST_F(Effects, An_option_without_effect_is_remarked_and_the_run_goes_on) {
  const Ended ended = run("simulate model.toml -s closure.S.sde.stiffness=1e7");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("warning: closure.S.sde.stiffness has no effect: "
                                   "closure.S.model = 'cut' (model.toml:"));
  const Ended acts =
      run("simulate model.toml -s closure.S.sde.stiffness=1e7 -s closure.S.model=sde");
  EXPECT_THAT(acts.err, Not(HasSubstr("no effect")));
}

TEST_F(Effects, Equal_values_run_once_and_check_and_study_say_so) {
  replace("study.toml", "3e4, 1e5, 1e9]", "3e4, \"30 kN/m\", 1e9]");
  const Ended checked = run("check study.toml");
  EXPECT_EQ(checked.code, 0);
  EXPECT_THAT(checked.err, HasSubstr("study.toml:10:27: note: 30000 N/m"));
  const json remarks = json::parse(run("check study.toml --json").out)["remarks"];
  ASSERT_EQ(remarks.size(), 1u);
  EXPECT_EQ(remarks[0]["line"], 10);
  const Ended ended = run("study study.toml -o out --json");
  EXPECT_EQ(json::parse(ended.out)["evaluations"], 9) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("is given 2 times and runs once"));
}

TEST_F(Effects, The_command_line_stands_above_base_and_is_refused_beside_varied_values) {
  replace("study.toml", "base = { set = {", "base = { set = { \"link.crank.mass\" = 3.0,");
  const auto digest = [&](const std::string& options, const std::string& out) {
    const Ended ended = run("study study.toml -o " + out + options);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return digest_in(ended.out);
  };
  const std::string three = digest("", "three");
  EXPECT_NE(digest(" -s link.0.mass=2.5", "less"), three);
  EXPECT_THAT(read_text(path("less/resolved.toml")), HasSubstr("\"link.0.mass\" = 2.5"));
  const Ended refused = run("study study.toml -o out -s closure.0.sde.stiffness=1e6");
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("which [[vary]] names as 'closure.S.sde.stiffness' too "
                                     "(study.toml:9:13)"));
}

TEST_F(Effects, A_tune_that_cannot_succeed_is_refused_by_check_at_its_keys) {
  const std::pair<const char*, const char*> searches[] = {
      {"resolution = 0.9", "tune.toml:13:14: error: resolution is 0.9"},
      {"delta = 1e-4", "tune.toml:13:9: error: delta 0.0001 is finer than the resolution"},
      {"scan = 1", "tune.toml:13:8: error: search.scan must"}};
  for (const auto& [key, says] : searches) {
    write_inputs();
    replace("tune.toml", "[[match]]", "[search]\n" + std::string(key) + "\n\n[[match]]");
    for (const char* verb : {"check tune.toml", "tune tune.toml -o out"}) {
      const Ended ended = run(verb);
      EXPECT_EQ(ended.code, 2) << verb << ended.err;
      EXPECT_THAT(ended.err, HasSubstr(says)) << verb;
    }
  }
  write_inputs();
  replace("tune.toml", "[[match]]",
          "[[tune]]\nparameter = \"closure.S.sde.damping_ratio\"\nrange = { lin = [0.1, 2.0] "
          "}\n\n[[match]]");
  EXPECT_THAT(run("check tune.toml").err,
              HasSubstr("tune.toml:14:17: error: values of a linear range have no sum"));
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(Effects, A_proposed_velocity_that_cannot_be_is_remarked) {
  const Ended ended = run("simulate model.toml -s joint.A.initial.velocity.0=1");
  EXPECT_THAT(run("simulate model.toml").err, Not(HasSubstr("initial.velocity")));
  EXPECT_THAT(ended.err, HasSubstr("initial velocity is 0.9494 instead of the given 1"));
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

// What comes up where the evaluations run reaches whoever watches, however many say it.
TEST_F(Effects, What_a_start_leaves_of_a_velocity_is_said_once_by_a_study_and_by_a_tune) {
  for (const char* before : {"", "mpirun -n 2 --oversubscribe --allow-run-as-root"}) {
    for (const std::string verb : {"study", "tune"}) {
      const Ended ended = run(
          verb + " " + verb + ".toml -o out --fresh -s 'joint.P.initial.velocity=[5.0]'", before);
      const std::string kept = "joint.P: its initial velocity is 0 instead of the given 5";
      EXPECT_EQ(count_of(ended.err, "warning: reference run: " + kept), 1u) << ended.err;
      EXPECT_THAT(ended.err, ContainsRegex("warning: evaluation [0-9]+: joint.P: its initial"));
      EXPECT_EQ(count_of(ended.err, kept), 2u) << ended.err;
      EXPECT_THAT(read_text(path("out/linkstudy.log")),
                  HasSubstr(" evaluations like this: " + kept));
    }
  }
}

}  // namespace
}  // namespace linkstudy::testing::effects_test

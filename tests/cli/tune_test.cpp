// Tunes of several answers, with limits, and with other objectives, as users run them.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::tune_test {
namespace {

using nlohmann::json;
using test::replaced;
using ::testing::HasSubstr;

class TuneFile : public Program {
 protected:
  TuneFile() { write_inputs(); }

  // A tune with lines before and after its tables.
  void write_tune(const std::string& before, const std::string& after) const {
    std::string text = tune_text();
    const std::size_t first = text.find("[[tune]]");
    text.insert(first, before + "\n");
    write("wanted.toml", text + after);
  }

  json tuned(const std::string& arguments, int code) const {
    const Ended ended = run("tune " + arguments + " --json");
    EXPECT_EQ(ended.code, code) << ended.err << ended.out;
    return json::parse(ended.out, nullptr, false);
  }
};

TEST_F(TuneFile, Answers_every_tolerance_of_a_list_in_one_run) {
  const json both = tuned("tune.toml -o out -s match.0.tolerance=[0.002,0.001]", 0);
  EXPECT_EQ(both["status"], "certified");
  ASSERT_EQ(both["answers"].size(), 2U);
  const std::string path = "closure.S.sde.stiffness";
  std::size_t alone = 0;
  for (const json& answer : both["answers"]) {
    const json one =
        tuned("tune.toml --fresh -o one -s match.0.tolerance=" + answer["tolerance"].dump(), 0);
    EXPECT_EQ(one["parameters"], answer["parameters"]);
    EXPECT_EQ(one["window"], answer["window"]);
    alone += one["evaluations"].get<std::size_t>();
  }
  EXPECT_LE(both["evaluations"].get<std::size_t>(), alone - 16);  // one scan serves both
  EXPECT_GT(both["answers"][1]["parameters"][path], both["answers"][0]["parameters"][path]);
  EXPECT_EQ(run("verify out").code, 0);
  const json rows = json::parse(run("export out --table tuning --format json").out)["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["target_tolerance"], 0.002);
  EXPECT_EQ(rows[1]["value"], both["answers"][1]["parameters"][path]);
  EXPECT_EQ(tuned("tune.toml -o out -s match.0.tolerance=[0.002,0.001]", 0)["digest"],
            both["digest"]);
}

TEST_F(TuneFile, Answers_every_step_and_names_the_largest_that_matches) {
  const json map = tuned("tune.toml -o out -s search.steps=[1e-4,2e-4,2e-2]", 4);
  ASSERT_EQ(map["answers"].size(), 3U);
  EXPECT_EQ(map["answers"][0]["status"], "certified");
  EXPECT_EQ(map["answers"][2]["status"], "infeasible");
  EXPECT_EQ(map["cheapest"][0]["step"], 2e-4);
  const json alone = tuned("tune.toml -o one -s simulation.step=1e-4", 0);
  // The reference keeps its own step here, and has that of --set there.
  const std::string path = "closure.S.sde.stiffness";
  const double found = map["answers"][0]["parameters"][path];
  EXPECT_NEAR(alone["parameters"][path].get<double>() / found, 1.0, 1e-5);
}

TEST_F(TuneFile, Keeps_limits_beside_its_matches) {
  const json free = tuned("tune.toml -o free", 0);
  const std::string path = "closure.S.sde.stiffness";
  write_tune("", "\n[[limit]]\nresponse = \"gap_max\"\nat_most = \"0.02 mm\"\n");
  const json limited = tuned("wanted.toml -o out", 0);
  EXPECT_EQ(limited["binding"]["component"], "gap_max.at_most");
  EXPECT_EQ(limited["binding"]["bound"], "at most 2e-05 m");
  EXPECT_GT(limited["parameters"][path], free["parameters"][path]);
  const json rows = json::parse(run("export out --table evaluations --format json").out)["rows"];
  const std::size_t id = limited["binding"]["evaluation"];
  EXPECT_LE(rows[id]["gap_max"], 2e-5);
  EXPECT_NEAR(rows[id]["gap_max"].get<double>() / 2e-5, limited["binding"]["error"].get<double>(),
              1e-12);
  EXPECT_EQ(run("verify out").code, 0);
}

TEST_F(TuneFile, Finds_the_lowest_stiffness_while_the_damping_ratio_is_free) {
  const std::string damping =
      "\n[[tune]]\nparameter = \"closure.S.sde.damping_ratio\"\nrange = { log = [0.2, 2.0] }\n";
  const std::string path = "closure.S.sde.stiffness";
  write_tune("objective = { minimize = \"closure.S.sde.stiffness\" }", damping);
  const json free = tuned("wanted.toml -o out", 0);
  const double best = free["parameters"][path];
  EXPECT_EQ(free["objective"], best);
  for (const double ratio : {0.2, 0.4, 0.7, 1.2, 2.0}) {
    const json held = tuned(
        "tune.toml --fresh -o one -s closure.S.sde.damping_ratio=" + std::to_string(ratio), 0);
    EXPECT_LE(best, held["parameters"][path].get<double>() * 1.01) << ratio;
  }
  EXPECT_EQ(run("verify out").code, 0);
}

// Twice the resolution: 0.001 decades of one, 0.001 of the range of the other.
TEST_F(TuneFile, Finds_in_a_linear_range_what_it_finds_in_decades) {
  const std::string path = "closure.S.sde.stiffness";
  const double by_decades = tuned("tune.toml -o decades", 0)["parameters"][path];
  const double high = std::round(4.0 * by_decades);
  write("linear.toml",
        replaced(tune_text(), "log = [1e3, 1e7]", "lin = [1e3, " + std::to_string(high) + "]"));
  const json linear = tuned("linear.toml -o out", 0);
  const double found = linear["parameters"][path];
  EXPECT_NEAR(found, by_decades, 0.001 * high + 0.0024 * by_decades);
  EXPECT_EQ(linear["objective"], found);
  EXPECT_TRUE(linear["window"]["margin_decades"].is_null());
  EXPECT_EQ(linear["window"]["high"], high);
  EXPECT_EQ(run("verify out").code, 0);
}

// What gravity along x does to the force of the cut joint is odd in it: the window is even.
TEST_F(TuneFile, Tunes_a_value_that_may_be_negative) {
  write("sideways.toml",
        replaced(replaced(replaced(tune_text(), "\"closure.S.sde.stiffness\"", "\"gravity.0\""),
                          "log = [1e3, 1e7]", "lin = [-0.5, 0.3]"),
                 "\"closure.S.model\" = \"sde\", \"simulation.step\" = 2.0e-4",
                 "\"closure.S.model\" = \"cut\""));
  const json found = tuned("sideways.toml -o out -s match.0.tolerance=0.002", 0);
  const double low = found["parameters"]["gravity.0"];
  EXPECT_LT(low, 0.0);
  // The resolution of both ends, of a range of 0.8.
  EXPECT_NEAR(low, -found["window"]["high"].get<double>(), 2e-3) << found.dump(1);
  const Ended shown = run("export out --table tuning");
  EXPECT_EQ(shown.code, 0);
  EXPECT_EQ(run("report out").code, 0);
  EXPECT_EQ(run("verify out").code, 0);
}

TEST_F(TuneFile, Minimises_a_response_among_what_matches) {
  write_tune("objective = { minimize = \"gap_max\" }", "");
  const json stiffest = tuned("wanted.toml -o out", 0);
  // The stiffer the smaller is the gap: the answer is the upper end of what matches.
  const json window = tuned("tune.toml -o one", 0)["window"];
  const double found = stiffest["parameters"]["closure.S.sde.stiffness"];
  EXPECT_NEAR(std::log10(found / window["high"].get<double>()), 0.0, 0.01);
}

TEST_F(TuneFile, Wrong_lists_limits_and_objectives_are_located) {
  const auto said = [&](const std::string& before, const std::string& after,
                        const std::string& options = "") {
    write_tune(before, after);
    const Ended ended = run("tune wanted.toml -o never " + options);
    EXPECT_EQ(ended.code, 2) << ended.out;
    EXPECT_THAT(ended.err, HasSubstr(options.empty() ? "wanted.toml:" : "error: "));
    return ended.err;
  };
  EXPECT_THAT(said("", "\n[[limit]]\nresponse = \"gap_mx\"\nat_most = 1\n"),
              HasSubstr("limit names no response, got 'gap_mx'"));
  EXPECT_THAT(said("", "\n[[limit]]\nresponse = \"gap_max\"\nat_most = \"1 N\"\n"),
              HasSubstr("limit of gap_max"));
  EXPECT_THAT(said("", "\n[[limit]]\nresponse = \"gap_max\"\nat_most = 1\nat_least = 0\n"),
              HasSubstr("at_least"));
  EXPECT_THAT(said("",
                   "\n[[tune]]\nparameter = \"closure.S.sde.damping_ratio\"\nrange = { lin = "
                   "[0.2, 2.0] }\n"),
              HasSubstr("values of a linear range have no sum of log10 with others"));
  EXPECT_THAT(said("objective = { minimize = \"closure.S.sde.stiff\" }", ""),
              HasSubstr("objective names neither a tuned value nor a response"));
  EXPECT_THAT(said("", "\n[search]\ngap = 0.2\n"), HasSubstr("search.gap acts where"));
  EXPECT_THAT(said("", "", "-s match.0.tolerance=[]"), HasSubstr("tolerance"));
  EXPECT_THAT(said("", "", "-s match.0.tolerance=[0.1,0.1]"), HasSubstr("stands twice"));
  const std::string second =
      "\n[[match]]\nsignal = \"joint.A.v\"\ntolerance = [0.1, 0.2, 0.3]\nwindow = [0.05, 0.2]\n";
  EXPECT_THAT(said("", second, "-s match.0.tolerance=[0.1,0.2]"),
              HasSubstr("has 2 tolerances and another match 3"));
}

}  // namespace
}  // namespace linkstudy::testing::tune_test

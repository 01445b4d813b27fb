// Keys of cases: equal exactly where the runs are, whoever asks for them.
#include "study/evaluate/case_key.h"

#include <set>

#include "study/config/precedence.h"
#include "tests/study/evaluate/falling_mass.h"

namespace linkstudy::testing::case_key_test {
namespace {

const char* const kStudy = R"([[vary]]
parameter = "simulation.step"
values = [0.08, 0.04]
[[response]]
name = "speed"
signal = "joint.P.v"
reduce = "last"
)";

class CaseKey : public FallingMassFolder {
 protected:
  // The key of a step in a study of these lines.
  std::string key(const std::string& study, const std::vector<Value>& values = {0.08}) {
    const std::unique_ptr<Evaluator> evaluator = make(study);
    EXPECT_NE(evaluator, nullptr);
    const auto found = CaseKeys(*evaluator).of(values);
    EXPECT_TRUE(found);
    return found ? found->with_caps() : "";
  }
  static std::string with(std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  }
};

TEST_F(CaseKey, Is_of_the_point_and_not_of_the_design) {
  const std::string own = key(kStudy);
  EXPECT_EQ(own.size(), 64u);
  EXPECT_NE(key(kStudy, {0.04}), own);
  EXPECT_EQ(key(with(kStudy, "[0.08, 0.04]", "[0.01, 0.08, 0.02]")), own);
  EXPECT_EQ(key(std::string("name = \"other\"\n[run]\nseed = 7\ntimeout = 3.0\n") + kStudy), own);
  // The same value by base.set, and by a varied one of another path.
  const std::string mass = "[[vary]]\nparameter = \"link.b.mass\"\nvalues = [1.0, 2.0]\n";
  const std::string rest = std::string(kStudy).substr(std::string(kStudy).find("[[response]]"));
  EXPECT_EQ(key(mass + rest, {1.0}), own);
  EXPECT_NE(key(mass + rest, {2.0}), own);
  EXPECT_EQ(key("base = { set = { \"simulation.step\" = 0.08 } }\n" + mass + rest, {1.0}), own);
  EXPECT_EQ(key("base = { set = { \"link.b.mass\" = 1 } }\n" + std::string(kStudy)), own)
      << "a default or a value that is spelled out is the same value";
}

// Every number of the resolved model, changed by its least bit.
TEST_F(CaseKey, Counts_every_value_of_the_resolved_model) {
  const std::unique_ptr<Evaluator> evaluator = make(kStudy);
  ASSERT_NE(evaluator, nullptr);
  const auto own = CaseKeys(*evaluator).of({0.08});
  ASSERT_TRUE(own);
  std::set<std::string> keys = {own->with_caps()};
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"gravity = [0.0, 0.0, -9.0]", "gravity = [0.0, 0.0, -9.000000000000002]"},
      {"mass = 1.0", "mass = 1.0000000000000002"},
      {"inertia = [0.01, 0.01, 0.01]", "inertia = [0.01, 0.010000000000000002, 0.01]"},
      {"end_time = 2.0", "end_time = 2.0000000000000004"},
      {"type = \"prismatic\"", "type = \"prismatic\"\ninitial = { velocity = [1e-300] }"},
      {"step = 0.08", "step = 0.08\noutput_interval = 0.02"},
      {"step = 0.08", "step = 0.08\nstart = \"equilibrium\""},
      {"step = 0.08", "step = 0.08\nintegrator = \"adaptive\""},
      {"step = 0.08", "step = 0.08\nintegrator = \"adaptive\"\nstep_limit = 99"},
      {"step = 0.08", "step = 0.08\nintegrator = \"adaptive\"\ntolerance = { relative = 1e-7 }"},
      {"[simulation]", "[[point]]\nname = \"tip\"\nlink = \"b\"\n[simulation]"}};
  std::ifstream file(directory_ / "model.toml");
  const std::string model((std::istreambuf_iterator<char>(file)), {});
  for (const auto& [from, to] : changes) {
    write("model.toml", with(model, from, to));
    EXPECT_TRUE(keys.insert(key(kStudy)).second) << to;
  }
}

TEST_F(CaseKey, Counts_what_is_kept_and_what_it_is_compared_with) {
  std::set<std::string> keys = {key(kStudy)};
  const std::string study = kStudy;
  const std::string match = "[reference]\nset = { \"link.b.mass\" = 2.0 }\n" + study +
                            "[[match]]\nsignal = \"joint.P.v\"\ntolerance = 0.01\n";
  for (const std::string& other :
       {with(study, "\"last\"", "\"mean\""), with(study, "joint.P.v", "joint.P.q"),
        study + "window = [0.5, 1.0]\n", study + "[[trace]]\nsignals = [\"joint.P.q\"]\n", match,
        with(match, "2.0 }", "3.0 }"), with(match, "0.01\n", "0.01\nwindow = [0.5, 1.0]\n"),
        with(match, "0.01\n", "0.01\nfloor = 0.1\n"),
        match + "[[load_case]]\nname = \"a\"\nset = { \"gravity.2\" = -9.0 }\n",
        match + "[[load_case]]\nname = \"b\"\nset = { \"gravity.2\" = -9.0 }\n",
        match + "[[load_case]]\nname = \"b\"\nset = { \"gravity.2\" = -8.0 }\n"}) {
    EXPECT_TRUE(keys.insert(key(other)).second) << other;
  }
  // What only judges does not count.
  EXPECT_TRUE(keys.contains(key(with(match, "tolerance = 0.01", "tolerance = 0.5"))));
  EXPECT_TRUE(keys.contains(key(match + "norm = \"rms\"\n")));
}

// Data count by their text and not by the name of their file.
TEST_F(CaseKey, Counts_measured_data_by_their_text) {
  const std::string study = std::string(kStudy) +
                            "[[match]]\nsignal = \"joint.P.v\"\ntolerance = 0.01\n"
                            "[reference]\nfile = \"x.csv\"\n"
                            "columns = { time = \"t\", \"joint.P.v\" = \"v\" }\n";
  write("x.csv", "t,v\n0,0\n1,-9\n2,-18\n");
  const std::string own = key(study);
  write("y.csv", "t,v\n0,0\n1,-9\n2,-18\n");
  EXPECT_EQ(key(with(study, "x.csv", "y.csv")), own);
  write("x.csv", "t,v\n0,0\n1,-9\n2,-18.000000000000004\n");
  EXPECT_NE(key(study), own);
}

TEST_F(CaseKey, Limits_of_runs_stand_apart) {
  const std::string study =
      "base = { set = { \"simulation.integrator\" = \"adaptive\", "
      "\"simulation.step_limit\" = 100 } }\n" +
      std::string(kStudy);
  const auto of = [&](const std::string& text) { return *CaseKeys(*make(text)).of({0.08}); };
  const auto before = of(study);
  const auto wider = of(with(study, "= 100", "= 200"));
  EXPECT_EQ(wider.digest, before.digest);
  EXPECT_NE(wider.with_caps(), before.with_caps());
  EXPECT_EQ(compare_caps(before, before), CapChange::none);
  EXPECT_EQ(compare_caps(before, wider), CapChange::wider);
  EXPECT_EQ(compare_caps(wider, before), CapChange::narrower);
  EXPECT_TRUE(is_ended_by_caps(Cause::step_budget, before, wider));
  EXPECT_FALSE(is_ended_by_caps(Cause::step_budget, before, before));
  EXPECT_FALSE(is_ended_by_caps(Cause::diverged, before, wider));
  EXPECT_FALSE(is_ended_by_caps(Cause::constraint_drift, before, wider));
}

TEST_F(CaseKey, An_invalid_point_has_none) {
  const std::unique_ptr<Evaluator> evaluator = make(kStudy);
  ASSERT_NE(evaluator, nullptr);
  EXPECT_FALSE(CaseKeys(*evaluator).of({-1.0}));
}

}  // namespace
}  // namespace linkstudy::testing::case_key_test

// Results that hold, and results that somebody has changed.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "study/store/journal.h"
#include "tests/cli/program.h"

namespace linkstudy::testing::verify_test {
namespace {

using nlohmann::json;
using ::testing::Contains;
using ::testing::HasSubstr;

class Verify : public Program {
 protected:
  Verify() { write_inputs(); }

  json verified(const std::string& arguments, int code) const {
    const Ended ended = run("verify " + arguments + " --json");
    EXPECT_EQ(ended.code, code) << ended.err << ended.out;
    return json::parse(ended.out, nullptr, false);
  }

  // The latest record of an evaluation counts.
  void change(const std::string& directory, std::uint64_t id,
              const std::function<void(Evaluation&, const StudyDescription&)>& edit) const {
    const JournalContents contents = read_journal(path(directory));
    const auto found = std::ranges::find_if(
        contents.evaluations, [&](const Evaluation& one) { return one.point.id == id; });
    ASSERT_NE(found, contents.evaluations.end());
    Evaluation changed = *found;
    edit(changed, *contents.description);
    Journal journal(path(directory), contents.input_sha256, OpenMode::resume);
    journal.append(changed);
    journal.sync();
  }
};

TEST_F(Verify, Runs_evaluations_again_without_the_files_of_the_input) {
  ASSERT_EQ(run("study study.toml -o out -s link.crank.mass=1.5").code, 0);
  for (const char* file : {"study.toml", "model.toml"}) std::filesystem::remove(path(file));
  const json all = verified("out --all", 0);
  EXPECT_EQ(all["status"], "verified");
  EXPECT_EQ(all["rerun"].size(), 12U);
  EXPECT_EQ(all["to_the_bit"], true);
  const json some = verified("out/results.h5 --count 5", 0);
  EXPECT_EQ(some["rerun"].size(), 5U);
  EXPECT_THAT(some["rerun"], Contains(0));
  EXPECT_THAT(some["rerun"], Contains(11));
  EXPECT_EQ(some["rerun"], verified("out --count 5", 0)["rerun"]);
  EXPECT_THAT(run("verify out --all").out, HasSubstr("12 of 12 evaluations run again: 0-11\n"));
}

TEST_F(Verify, Finds_the_number_that_was_changed_by_its_last_bit) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  change("out", 4, [&](Evaluation& one, const StudyDescription& study) {
    const auto at = std::ranges::find(study.responses, "crank_speed", &Response::name);
    double& value = one.responses.at(static_cast<std::size_t>(at - study.responses.begin()));
    value = std::nextafter(value, 1e9);
  });
  const json found = verified("out --all", 4);
  EXPECT_EQ(found["status"], "refuted");
  ASSERT_EQ(found["disagreements"].size(), 1U);
  EXPECT_EQ(found["disagreements"][0]["evaluation"], 4);
  EXPECT_EQ(found["disagreements"][0]["column"], "crank_speed");
}

TEST_F(Verify, Refutes_a_certificate_whose_evaluation_ended_otherwise) {
  ASSERT_EQ(run("tune tune.toml -o out").code, 0);
  const json held = verified("out --count 1", 0);
  EXPECT_EQ(held["answer"], "certified");
  EXPECT_GT(held["rerun"].size(), 8U);  // all that the certificate names
  const std::uint64_t id = held["rerun"].back();
  change("out", id, [](Evaluation& one, const StudyDescription&) {
    for (double& number : one.responses) number *= 1.5;
  });
  const json refuted = verified("out --count 1", 4);
  EXPECT_THAT(refuted["disagreements"][0]["evaluation"], id);
}

TEST_F(Verify, Judges_an_answer_anew_from_all_evaluations) {
  ASSERT_EQ(run("tune tune.toml -o out").code, 0);
  const json held = verified("out --count 1", 0);
  // One that the certificate does not rest on, and is not run again: the search takes another way.
  std::uint64_t id = 0;
  for (std::uint64_t one = 0; one < held["rerun"].back(); ++one) {
    if (std::ranges::find(held["rerun"], json(one)) == held["rerun"].end()) id = one;
  }
  ASSERT_GT(id, 0U);
  change("out", id, [](Evaluation& one, const StudyDescription&) {
    for (double& number : one.responses) number *= 100.0;
  });
  const json found = verified("out --count 1", 4);
  EXPECT_TRUE(found["disagreements"].empty());
  EXPECT_FALSE(found["refuted"].is_null());
}

const char* const kCalibration = R"(format = 1
kind = "calibrate"
model = "model.toml"
base = { set = { "closure.S.model" = "sde", "closure.S.sde.damping" = "50 N s/m" } }

[[parameter]]
path = "closure.S.sde.stiffness"
range = { log = [1.0e4, 1.0e6] }

[[experiment]]
name = "on"
file = "force.csv"
columns = { time = "t", "closure.S.force.x" = "Fx [mN]" }

[[experiment]]
name = "off"
file = "force.csv"
columns = { time = "t", "closure.S.force.y" = "Fy [N]" }

[fit]
starts = 2
)";
// Nobody's own, and not those of any stiffness: the fit has something to do.
const char* const kForce =
    "t,Fx [mN],Fy [N]\n0.05,-1900,31\n0.08,-2400,34\n0.1,,36\n0.11,-2100,35\n0.15,-1000,32\n";

class VerifyCalibration : public Verify {
 protected:
  VerifyCalibration() {
    write("calibrate.toml", kCalibration);
    write("force.csv", kForce);
    EXPECT_EQ(run("calibrate calibrate.toml -o out").code, 0);
    for (const char* file : {"calibrate.toml", "model.toml", "force.csv"}) {
      std::filesystem::remove(path(file));
    }
  }

  // The stored answer, edited as a text.
  void change_answer(const std::function<void(json&)>& edit) const {
    const JournalContents contents = read_journal(path("out"));
    const auto found = std::ranges::find_if(
        contents.texts, [](const NamedText& one) { return one.name.starts_with("calibration/"); });
    ASSERT_NE(found, contents.texts.end());
    json answer = json::parse(found->text);
    edit(answer);
    Journal journal(path("out"), contents.input_sha256, OpenMode::resume);
    journal.append(NamedText{found->name, answer.dump()});
    journal.sync();
  }
};

TEST_F(VerifyCalibration, Repeats_the_fit_without_the_files_of_its_data) {
  const json held = verified("out --count 1", 0);
  EXPECT_EQ(held["status"], "verified");
  EXPECT_THAT(held["answer"], ::testing::AnyOf("fitted", "ambiguous"));
  EXPECT_LT(held["rerun"].size(), held["stored"].get<std::size_t>());
  // A file of results has the residuals of the best alone: all others are run again.
  const json whole = verified("out/results.h5 --count 1", 0);
  EXPECT_EQ(whole["rerun"].size(), whole["stored"].get<std::size_t>());
  EXPECT_EQ(whole["answer"], held["answer"]);
}

TEST_F(VerifyCalibration, Refutes_an_estimate_that_the_fit_does_not_find) {
  change_answer([](json& answer) {
    json& value = answer["parameters"]["closure.S.sde.stiffness"]["value"];
    value = 1.001 * value.get<double>();
  });
  const json found = verified("out --count 1", 4);
  EXPECT_TRUE(found["disagreements"].empty());
  EXPECT_THAT(found["refuted"].get<std::string>(), HasSubstr("closure.S.sde.stiffness/value"));
}

TEST_F(VerifyCalibration, Finds_a_residual_that_was_changed_by_its_last_bit) {
  const JournalContents contents = read_journal(path("out"));
  const auto found = std::ranges::find(contents.traces, "residuals_3", &TraceSet::name);
  ASSERT_NE(found, contents.traces.end());
  {
    TraceSet changed = *found;
    double& value = changed.traces.front().values.at(2);
    value = std::nextafter(value, 1e9);
    Journal journal(path("out"), contents.input_sha256, OpenMode::resume);
    journal.append(changed);
    journal.sync();
  }
  const json all = verified("out --all", 4);
  ASSERT_EQ(all["disagreements"].size(), 1U);
  EXPECT_EQ(all["disagreements"][0]["evaluation"], 3);
  EXPECT_EQ(all["disagreements"][0]["column"], "residual 2");
}

TEST_F(Verify, Says_what_it_cannot_do) {
  EXPECT_EQ(run("verify nowhere").code, 2);
  EXPECT_EQ(run("verify nowhere --count 0").code, 2);
  EXPECT_THAT(run("verify nowhere --count 2 --all").err, HasSubstr("leave out --count"));
}

}  // namespace
}  // namespace linkstudy::testing::verify_test

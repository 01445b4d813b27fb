// Refinements, run as a user runs them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/cli/program.h"

namespace linkstudy::testing::converge_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string step_text() {
  return R"(format = 1
kind = "converge"
name = "Short refinement"
model = "model.toml"

[[refine]]
parameter = "simulation.step"
ladder = { from = 4e-3, ratio = 0.5, levels = 5 }

[[response]]
name = "crank_speed"
signal = "joint.A.v"
reduce = "last"

[[response]]
name = "mean_speed"
signal = "joint.A.v"
reduce = "mean"

[[series]]
signal = "closure.S.force"
)";
}

// Against the cut joint at a step that resolves the stiffest spring.
std::string stiffness_text() {
  return R"(format = 1
kind = "converge"
name = "Short limit"
model = "model.toml"
reference = { set = { "closure.S.model" = "cut", "simulation.step" = 2e-5 } }
base = { set = { "closure.S.model" = "sde", "simulation.step" = 2e-5 } }

[[refine]]
parameter = "closure.S.sde.stiffness"
values = [1e7, 1e5, 1e6]

[[response]]
name = "force"
signal = "closure.S.force"
reduce = "last"

[[match]]
signal = "closure.S.force"
norm = "rms"
window = [0.1, 0.2]
)";
}

class Converge : public Program {
 protected:
  Converge() {
    write_inputs();
    write("step.toml", step_text());
    write("stiffness.toml", stiffness_text());
  }

  json answer_of(const std::string& arguments, int code = 0, const std::string& before = "") const {
    const Ended ended = run("converge " + arguments + " --json --progress none", before);
    EXPECT_EQ(ended.code, code) << ended.err;
    return json::parse(ended.out, nullptr, false);
  }

  static json table_of(const json& answer, const std::string& name) {
    for (const json& table : answer["tables"])
      if (table["name"] == name) return table;
    ADD_FAILURE() << "no table " << name;
    return {};
  }

  // Of a file with one text replaced, both by check and by the verb.
  void expect_wrong(const std::string& old, const std::string& by, const std::string& says) const {
    std::string text = step_text();
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), by);
    write("wrong.toml", text);
    for (const char* command : {"check wrong.toml", "converge wrong.toml -o out"}) {
      const Ended ended = run(command);
      EXPECT_EQ(ended.code, 2) << command << ended.err;
      EXPECT_THAT(ended.err, HasSubstr("wrong.toml:")) << command;
      EXPECT_THAT(ended.err, HasSubstr(says)) << command;
      EXPECT_THAT(left_behind(), IsEmpty()) << command;
    }
  }
};

TEST_F(Converge, RK4_shows_order_4_and_means_by_the_trapezoidal_rule_order_2) {
  const json answer = answer_of("step.toml -o out");
  EXPECT_EQ(answer["status"], "converged");
  const json speed = table_of(answer, "crank_speed");
  EXPECT_EQ(speed["class"], "monotone");
  EXPECT_EQ(speed["formal_order"], 4.0);
  // Of four levels the orders differ by the next term, of relative size h.
  EXPECT_NEAR(speed["observed_order"].get<double>(), 4.0, 0.1);
  EXPECT_EQ(speed["rows"].size(), 5U);
  EXPECT_EQ(table_of(answer, "mean_speed")["formal_order"], 2.0);
  EXPECT_NEAR(table_of(answer, "mean_speed")["observed_order"].get<double>(), 2.0, 0.02);
  for (const char* axis : {"x", "y", "z"}) {
    const json force = table_of(answer, std::string("closure.S.force.") + axis);
    EXPECT_EQ(force["kind"], "series");
    EXPECT_TRUE(force["extrapolated"].is_null());
    EXPECT_NEAR(force["observed_order"].get<double>(), 4.0, 0.2) << axis;
  }
  // Every level is finer than 0.1 % asks for, and so is the model's 1e-3 s.
  EXPECT_EQ(answer["needed"][0]["needed_by"], "coarsest");
  EXPECT_NEAR(answer["needed"][0]["fineness"].get<double>(), 4.0, 1e-12);
}

TEST_F(Converge, Says_which_step_a_wanted_error_needs) {
  const json answer = answer_of("step.toml -o out -s wanted_error=1e-10");
  const json speed = table_of(answer, "crank_speed");
  ASSERT_EQ(speed["needed_by"], "levels");
  // A run at that step is off by what was wanted, to the bend of the power law within an octave.
  const double needed = speed["needed"].get<double>();
  const double limit = speed["extrapolated"].get<double>();
  // Whole steps to 0.2 s.
  const double step = 0.2 / std::ceil(0.2 / needed);
  std::string text = step_text();
  text.replace(text.find("kind = \"converge\""), 17, "kind = \"study\"");
  text.replace(text.find("[[refine]]"), 10, "[[vary]]");
  text.replace(text.find("ladder = "), 49, fmt::format("values = [{:.17g}]", step));
  write("one.toml", text.substr(0, text.find("[[series]]")));
  ASSERT_EQ(run("study one.toml -o one").code, 0);
  const json row = json::parse(run("export one --table evaluations --format json").out)["rows"][0];
  const double error = std::abs(row["crank_speed"].get<double>() / limit - 1.0);
  EXPECT_NEAR(error * std::pow(needed / step, 4.0) / 1e-10, 1.0, 0.1);
}

TEST_F(Converge, A_spring_of_infinite_stiffness_carries_the_multiplier) {
  const json answer = answer_of("stiffness.toml -o out");
  for (const char* axis : {"x", "y", "z"}) {
    const json force = table_of(answer, std::string("force_") + axis);
    EXPECT_EQ(force["formal_order"], 1.0);
    EXPECT_EQ(force["rows"][0]["size"], 1e5);  // coarse to fine, however they were written
    // What is left is of second order in 1/c, a hundredth where the ladder is asymptotic; that of
    // the smallest component, 2e-7 N, also holds what is left of the start.
    const double off = std::abs(force["difference"].get<double>());
    EXPECT_LT(off, 0.15 * std::abs(force["rows"][2]["error"].get<double>())) << axis;
    const json error = table_of(answer, std::string("error_rms_closure_S_force_") + axis);
    EXPECT_NEAR(error["rows"][2]["error_order"].get<double>(), 1.0, 0.1) << axis;
  }
  const Ended ended = run("converge stiffness.toml -o out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("the reference has"));
}

TEST_F(Converge, Is_the_same_on_more_ranks_and_when_it_is_started_again) {
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_pml", "ob1", 1);
  const json alone = answer_of("stiffness.toml -o one");
  const json pair = answer_of("stiffness.toml -o two", 0, "mpirun -n 2 --oversubscribe");
  EXPECT_EQ(alone, pair);
  EXPECT_EQ(alone, answer_of("stiffness.toml -o one"));
  // With evaluations that have to be run again.
  std::filesystem::copy(path("one"), path("torn"));
  std::filesystem::resize_file(path("torn") / "journal.bin",
                               std::filesystem::file_size(path("torn") / "journal.bin") / 2);
  std::filesystem::remove(path("torn") / "results.h5");
  EXPECT_EQ(alone, answer_of("stiffness.toml -o torn"));
}

TEST_F(Converge, Of_two_ladders_makes_a_table_at_each_value_of_the_second_and_one_over_it) {
  std::string text = step_text();
  text.replace(text.find("ladder = { from = 4e-3"), 22, "ladder = { from = 2e-3");
  text.replace(text.find("levels = 5"), 10, "levels = 3");
  text.replace(text.find("[[response]]"), 12,
               "[[refine]]\nparameter = \"closure.S.sde.stiffness\"\nvalues = [1e4, 4e4, 16e4]\n\n"
               "[[response]]");
  text.replace(text.find("model = \"model.toml\""), 20,
               "model = \"model.toml\"\nbase = { set = { \"closure.S.model\" = \"sde\" } }");
  write("two.toml", text);
  const Ended ended = run("converge two.toml -o out --json");
  const json answer = json::parse(ended.out);
  std::vector<std::string> at;
  for (const json& table : answer["tables"]) {
    if (table["name"] == "crank_speed") at.push_back(table["at"]);
  }
  EXPECT_THAT(at, ::testing::ElementsAre(
                      "closure.S.sde.stiffness = 10000 N/m", "closure.S.sde.stiffness = 40000 N/m",
                      "closure.S.sde.stiffness = 160000 N/m", "simulation.step = 0.0005 s"));
  EXPECT_EQ(answer["needed"].size(), 2U);
  // Rows name the evaluation they are: the finest step with the middle stiffness.
  const Ended table = run("export out --table evaluations --format json --rows \"evaluation = 7\"");
  const json row = json::parse(table.out)["rows"][0];
  EXPECT_EQ(row["simulation.step"], 5e-4);
  EXPECT_EQ(row["closure.S.sde.stiffness"], 4e4);
  for (const json& one : answer["tables"]) {
    if (one["name"] != "crank_speed" || one["over"] != "closure.S.sde.stiffness") continue;
    EXPECT_EQ(one["rows"][1]["evaluation"], 7);
    EXPECT_EQ(one["rows"][1]["value"], row["crank_speed"]);
  }
}

TEST_F(Converge, Exports_its_tables_in_every_form) {
  ASSERT_EQ(run("converge step.toml -o out").code, 0);
  EXPECT_THAT(run("export out --list").out, HasSubstr("convergence"));
  for (const char* form : {"text", "csv", "md", "latex", "json"}) {
    const Ended ended = run(std::string("export out --table convergence --format ") + form);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("crank")) << form;
  }
  const Ended orders = run("export out --table orders --format csv --columns quantity,class,order");
  EXPECT_THAT(orders.out, HasSubstr("crank_speed,monotone,"));
  ASSERT_EQ(run("study study.toml -o other").code, 0);
  EXPECT_THAT(run("export other --table orders").err, HasSubstr("only a converge"));
}

TEST_F(Converge, Exits_with_5_where_a_quantity_shows_no_order) {
  // Steps too long for the stiffest spring: two levels are left.
  std::string text = stiffness_text();
  for (std::size_t at = 0; (at = text.find("2e-5", at)) != std::string::npos;) {
    text.replace(at, 4, "1e-3");
  }
  text.replace(text.find("[1e7, 1e5, 1e6]"), 15, "[1e4, 1e5, 1e9]");
  write("coarse.toml", text);
  const json answer = answer_of("coarse.toml -o out", 5);
  EXPECT_EQ(answer["status"], "not converged");
  const json force = table_of(answer, "force_y");
  EXPECT_EQ(force["class"], "untold");
  EXPECT_TRUE(force["observed_order"].is_null());
  EXPECT_EQ(force["safety_factor"], 3.0);
  EXPECT_EQ(force["rows"][2]["status"], "diverged");
  EXPECT_TRUE(force["rows"][2]["value"].is_null());
  EXPECT_THAT(force["remarks"][0].get<std::string>(), HasSubstr("1 of 3 levels have no value"));
}

TEST_F(Converge, Wrong_refinements_are_located) {
  expect_wrong("ladder = { from = 4e-3, ratio = 0.5, levels = 5 }", "values = [1e-3]",
               "in 1 level");
  expect_wrong("parameter = \"simulation.step\"\nladder = { from = 4e-3, ratio = 0.5, levels = 5 }",
               "parameter = \"closure.S.model\"\nvalues = [\"cut\", \"sde\"]",
               "must be a positive number");
  expect_wrong("parameter = \"simulation.step\"\nladder = { from = 4e-3, ratio = 0.5, levels = 5 }",
               "parameter = \"link.crank.mass\"\nvalues = [1.0, 0.0]", "positive");
  expect_wrong("simulation.step", "closure.S.sde.stiffness", "has no effect on any case");
  expect_wrong("simulation.step", "simulation.stp", "simulation.step");
  expect_wrong("signal = \"closure.S.force\"", "signal = \"closure.S.forces\"",
               "there is no signal 'closure.S.forces'");
  expect_wrong("signal = \"closure.S.force\"", "signal = \"closure.S.force\"\nwindow = [0.1, 1.0]",
               "after the run");
  expect_wrong("ladder = { from = 4e-3, ratio = 0.5, levels = 5 }",
               "values = [1.7e-3, 0.97e-3, 0.53e-3]", "no two instants");
  expect_wrong("[[series]]\nsignal = \"closure.S.force\"",
               "[[match]]\nsignal = \"closure.S.force\"", "needs a reference");
  const std::string all = step_text().substr(step_text().find("[[response]]"));
  expect_wrong(all, "", "needs something to judge");
}

}  // namespace
}  // namespace linkstudy::testing::converge_test

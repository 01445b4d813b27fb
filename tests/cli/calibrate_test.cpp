// The verb calibrate as a user meets it: coefficients of a replacement joint from a force that the
// model with other coefficients has made.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "tests/cli/program.h"

namespace linkstudy::testing::calibrate_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

constexpr double kStiffness = 4e4;
constexpr double kDamping = 50.0;

const char* const kFile = R"(format = 1
kind = "calibrate"
model = "model.toml"
base = { set = { "closure.S.model" = "sde" } }

[[parameter]]
path = "closure.S.sde.stiffness"
range = { log = [1.0e4, 1.0e6] }

[[parameter]]
path = "closure.S.sde.damping"
range = { log = [5.0, 500.0] }

[[experiment]]
name = "on"
file = "force.csv"
columns = { time = "t", "closure.S.force.x" = "Fx [mN]", "closure.S.force.y" = "Fy [mN]" }
sigma = { "closure.S.force" = "0.05 N" }
set = { "load.drive.course.duration" = 0.01 }

[fit]
starts = 4
)";

class Calibrate : public Program {
 protected:
  Calibrate() {
    write_inputs();
    write("calibrate.toml", kFile);
    write("force.csv", noisy_force());
  }

  // The model's own force at the truth, with noise of 0.05 N.
  std::string noisy_force() const {
    const Ended made =
        run("simulate model.toml -s closure.S.model=sde -s closure.S.sde.stiffness=4e4 "
            "-s closure.S.sde.damping=50 -s load.drive.course.duration=0.01 "
            "-s simulation.output_interval=1e-3 --signals closure.S.force --csv -");
    EXPECT_EQ(0, made.code) << made.err;
    std::mt19937_64 random(4);
    std::normal_distribution<double> noise(0.0, 50.0);
    std::istringstream lines(made.out);
    std::string text = "t,Fx [mN],Fy [mN]\n";
    for (std::string line; std::getline(lines, line);) {
      double t = 0.0, x = 0.0, y = 0.0;
      if (std::sscanf(line.c_str(), "%lf,%lf,%lf", &t, &x, &y) != 3 || t == 0.0) continue;
      text += std::to_string(t) + "," + std::to_string(1e3 * x + noise(random)) + "," +
              std::to_string(1e3 * y + noise(random)) + "\n";
    }
    return text;
  }

  json answer(const std::string& arguments, const std::string& before = "") const {
    const Ended ended = run("calibrate " + arguments + " --json", before);
    EXPECT_EQ(0, ended.code) << ended.err;
    return json::parse(ended.out);
  }
};

TEST_F(Calibrate, Finds_the_coefficients_that_made_the_force_within_its_intervals) {
  const json fit = answer("calibrate.toml -o out");
  EXPECT_EQ("fitted", fit["status"]) << fit.dump(1);
  const auto& parameters = fit["parameters"];
  const std::map<std::string, double> truth = {{"closure.S.sde.stiffness", kStiffness},
                                               {"closure.S.sde.damping", kDamping}};
  for (const auto& [path, value] : truth) {
    EXPECT_LT(parameters[path]["interval"][0].get<double>(), value) << path;
    EXPECT_GT(parameters[path]["interval"][1].get<double>(), value) << path;
    EXPECT_EQ("identifiable", parameters[path]["identifiability"]);
  }
  // Residuals are the noise: 1 to within 3 / sqrt(2 * 400).
  EXPECT_NEAR(1.0, fit["data"][0]["weighted_rms"].get<double>(), 0.11);
  EXPECT_TRUE(fit["check"]["confirms"].get<bool>());
  const Ended list = run("export out --list");
  for (const char* table :
       {"calibration", "correlations", "data", "starts", "profiles", "residuals"}) {
    EXPECT_THAT(list.out, HasSubstr(table));
    EXPECT_EQ(0, run(std::string("export out/results.h5 --table ") + table).code) << table;
  }
}

TEST_F(Calibrate, Ends_with_the_same_digest_on_two_ranks_and_after_a_kill) {
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) {
    setenv(name, "1", 1);
  }
  setenv("OMPI_MCA_pml", "ob1", 1);
  const json alone = answer("calibrate.toml -o alone");
  const json two = answer("calibrate.toml -o two", "mpirun --oversubscribe -n 2");
  const pid_t child = start({"calibrate", "calibrate.toml", "-o", "killed"});
  usleep(700000);  // somewhere in the work; what comes out is the same wherever
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  const json killed = answer("calibrate.toml -o killed");
  EXPECT_EQ(alone, two);
  EXPECT_EQ(alone, killed);
}

TEST_F(Calibrate, Takes_other_data_for_another_study) {
  ASSERT_EQ(0, run("calibrate calibrate.toml -o out -s fit.starts=1").code);
  write("force.csv", "t,Fx [mN],Fy [mN]\n0.1,1,2\n0.15,3,4\n");
  const Ended ended = run("calibrate calibrate.toml -o out -s fit.starts=1");
  EXPECT_EQ(2, ended.code);
  EXPECT_THAT(ended.err, HasSubstr("holds a study of another input"));
}

// Its springs against the cut joint: the stiffer the better, so that the bound is the answer.
TEST_F(Calibrate, Fits_a_run_of_the_model_itself) {
  std::string text = kFile;
  const std::size_t data = text.find("file = ");
  text =
      text.substr(0, data) +
      "reference = { set = { \"closure.S.model\" = \"cut\" } }\nsignals = [\"closure.S.force\"]\n"
      "[fit]\nstarts = 2\n";
  write("calibrate.toml", text);
  const json fit = answer("calibrate.toml -o out");
  EXPECT_EQ("high", fit["parameters"]["closure.S.sde.stiffness"]["at_bound"]);
  EXPECT_EQ("closure.S.force.z", fit["data"][2]["channel"]);
}

TEST_F(Calibrate, Exits_4_with_the_cause_where_no_run_comes_to_its_end) {
  const Ended ended =
      run("calibrate calibrate.toml -o out -s simulation.step=0.05 -s fit.starts=2");
  EXPECT_EQ(4, ended.code) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("failed: every start failed; the first: "));
}

TEST_F(Calibrate, Lists_what_is_wrong_with_data_and_channels) {
  std::string text = kFile;
  text.replace(text.find("\"closure.S.force.x\" = "), 22, "\"closure.S.gap.x\"   = ");
  write("calibrate.toml", text);
  const Ended ended = run("check calibrate.toml");
  EXPECT_EQ(2, ended.code);
  EXPECT_THAT(ended.err + ended.out,
              HasSubstr("'closure.S.gap.x' is in m, and its column in kg m/s^2"));
}

}  // namespace
}  // namespace linkstudy::testing::calibrate_test

// Every verb on good input: exit codes, tables, CSV and JSON.
#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::verbs_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

class Verbs : public Program {
 protected:
  Verbs() { write_inputs(); }
};

TEST_F(Verbs, Version_names_the_build_and_the_libraries) {
  const Ended ended = run("--version");
  EXPECT_EQ(ended.code, 0);
  for (const char* part : {"linkstudy 0.", "build", "MPI", "HDF5", "SIMD"}) {
    EXPECT_THAT(ended.out, HasSubstr(part));
  }
}

TEST_F(Verbs, Check_accepts_models_studies_and_tunes) {
  const Ended ended = run("check model.toml study.toml tune.toml");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_EQ(ended.out, "model.toml: ok\nstudy.toml: ok\ntune.toml: ok\n");
  EXPECT_THAT(left_behind(), IsEmpty());
}

TEST_F(Verbs, Describe_prints_one_key_and_all_keys) {
  const Ended one = run("describe link.*.mass");
  EXPECT_EQ(one.code, 0);
  EXPECT_THAT(one.out, HasSubstr("kg"));
  const Ended all = run("describe");
  EXPECT_THAT(all.out, HasSubstr(one.out.substr(0, one.out.find('\n'))));
  EXPECT_EQ(run("describe --markdown").out, read_text(source_file("configs/README.md")));
}

TEST_F(Verbs, Simulate_tells_assembly_equilibrium_and_step_limit) {
  const Ended ended = run("simulate model.toml");
  EXPECT_EQ(ended.code, 0) << ended.err;
  for (const char* part : {"closed", "branch", "unstable", "RK4 limit", "200 steps", "ok"}) {
    EXPECT_THAT(ended.out, HasSubstr(part));
  }
  EXPECT_THAT(left_behind(), IsEmpty());
}

TEST_F(Verbs, Csv_has_units_names_and_every_bit) {
  const Ended ended = run("simulate model.toml --csv - --signals joint.A.q,closure.S.force");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::vector<std::string> lines = lines_of(ended.out);
  ASSERT_EQ(lines.size(), 2u + 21u);  // 0 .. 0.2 s every 0.01 s
  EXPECT_EQ(lines[0].front(), '#');
  EXPECT_THAT(lines[0], HasSubstr("N"));
  const std::vector<std::string> names = {"time", "joint.A.q", "closure.S.force.x",
                                          "closure.S.force.y", "closure.S.force.z"};
  EXPECT_EQ(cells_of(lines[1]), names);
  for (std::size_t i = 2; i < lines.size(); ++i) {
    const std::vector<std::string> cells = cells_of(lines[i]);
    ASSERT_EQ(cells.size(), 5u);
    const double time = std::strtod(cells[0].c_str(), nullptr);
    EXPECT_NEAR(time, 0.01 * static_cast<double>(i - 2), 1e-12);
    // 17 digits read back to a number that prints the same.
    char again[40];
    std::snprintf(again, sizeof again, "%.17g", std::strtod(cells[2].c_str(), nullptr));
    EXPECT_EQ(std::strtod(again, nullptr), std::strtod(cells[2].c_str(), nullptr));
  }
}

TEST_F(Verbs, Csv_goes_to_a_file_with_every_channel) {
  const Ended ended = run("simulate model.toml --csv out.csv -s simulation.end_time=0.05");
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_THAT(left_behind(), ::testing::ElementsAre("out.csv"));
  const std::vector<std::string> lines = lines_of(read_text(path("out.csv")));
  ASSERT_EQ(lines.size(), 2u + 6u);
  EXPECT_THAT(lines[1], HasSubstr("energy.residual"));
  EXPECT_EQ(cells_of(lines[1]).size(), cells_of(lines[2]).size());
}

TEST_F(Verbs, Simulate_writes_one_json_object) {
  const Ended ended = run("simulate model.toml --json");
  EXPECT_EQ(ended.code, 0);
  const json object = json::parse(ended.out);
  EXPECT_EQ(object["status"], "done");
  EXPECT_EQ(object["cause"], "ok");
  EXPECT_EQ(object["steps"], 200);
  EXPECT_DOUBLE_EQ(object["end_time"], 0.2);
  for (const char* key :
       {"drift_max", "energy_residual_max", "step_limit", "omega_max", "wall_s"}) {
    EXPECT_TRUE(object[key].is_number()) << key;
  }
}

TEST_F(Verbs, A_run_that_diverges_is_a_result_with_exit_code_3) {
  const Ended ended =
      run("simulate model.toml --json -s closure.S.model=sde -s closure.S.sde.stiffness=1e10");
  EXPECT_EQ(ended.code, 3) << ended.err;
  const json object = json::parse(ended.out);
  EXPECT_EQ(object["status"], "failed");
  EXPECT_NE(object["cause"], "ok");
  EXPECT_LT(object["steps"], 200);
  EXPECT_THAT(ended.err, HasSubstr("past the stability limit"));
}

// Crank up, coupler 60 degrees from the slider's axis, all in the plane x = 0 with the slider free
// to move along z: the vertical forces of coupler and yoke that the crank bears are its half share.
TEST_F(Verbs, Simulate_shows_the_model_time_it_has_reached) {
  // As many steps as this machine needs for a bar to be due.
  std::string long_enough;
  Ended bar;
  for (const char* step : {"1e-6", "1e-7", "1e-8"}) {
    long_enough = std::string("simulate model.toml -s simulation.step=") + step + " --progress ";
    bar = run(long_enough + "bar");
    EXPECT_EQ(bar.code, 0) << bar.err;
    if (bar.err.find('\r') != std::string::npos) break;
  }
  EXPECT_THAT(bar.err, ::testing::ContainsRegex("\r\\[#+-+\\] 0\\.[0-9]+ of 0\\.2 s"));
  EXPECT_THAT(bar.err, HasSubstr("100%"));
  EXPECT_THAT(run(long_enough + "none").err, Not(HasSubstr(" of 0.2 s")));
  // In a log no bar, and a line at most every 3 s: none where the run is as short as it should be.
  for (const char* logged : {"line", "auto"}) {
    const auto begin = std::chrono::steady_clock::now();
    const std::string err = run(long_enough + logged).err;
    const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - begin;
    long lines = 0;
    for (const std::string& line : lines_of(err))
      lines += line.find(" of 0.2 s") == std::string::npos ? 0 : 1;
    EXPECT_LE(static_cast<double>(lines), spent.count() / 3.0) << logged;
    EXPECT_THAT(err, Not(HasSubstr("\r"))) << logged;
  }
  EXPECT_EQ(run("simulate model.toml --progress loud").code, 2);
}

TEST_F(Verbs, Statics_finds_the_closure_force_of_the_free_slider) {
  const Ended ended = run("statics model.toml");
  EXPECT_EQ(ended.code, 0) << ended.err;
  double force_y = 0.0, force_z = 1.0;
  for (const std::string& line : lines_of(ended.out)) {
    std::sscanf(line.c_str(), "closure.S.force.y %lf", &force_y);
    std::sscanf(line.c_str(), "closure.S.force.z %lf", &force_z);
  }
  // No horizontal force can be borne by the slider, so S carries half the rod's weight.
  EXPECT_NEAR(force_y, -0.5 * 1.5 * 9.81, 1e-6);
  EXPECT_NEAR(force_z, 0.0, 1e-6);
  EXPECT_EQ(json::parse(run("statics model.toml --json").out)["status"], "done");
}

TEST_F(Verbs, Study_prints_its_table_and_digest_and_can_be_read_back) {
  const Ended ended = run("study study.toml -o out");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const std::string digest = digest_in(ended.out);
  EXPECT_EQ(digest.size(), 64u);
  EXPECT_EQ(lines_of(ended.out).back(), "results digest: " + digest);
  EXPECT_THAT(ended.err, HasSubstr("0 of 12 done, 0 failed, 12 left"));
  for (const char* file : {"journal.bin", "results.h5", "resolved.toml", "linkstudy.log"}) {
    EXPECT_TRUE(std::filesystem::exists(path("out") / file)) << file;
  }
  const json status = json::parse(run("status out --json").out);
  EXPECT_EQ(status["total"], 12);
  EXPECT_EQ(status["done"], 9);  // 1e9 N/m is unstable at all three steps
  EXPECT_EQ(status["running"], false);
  EXPECT_THAT(run("status out").out, HasSubstr("complete"));
  const Ended csv = run("export out --table evaluations");
  EXPECT_EQ(lines_of(csv.out).size(), 14u);
  EXPECT_THAT(csv.out, HasSubstr("error_max_closure_S_force_x"));
  EXPECT_THAT(csv.out, HasSubstr("crank_speed"));
  const json rows = json::parse(run("export out --table evaluations --format json").out)["rows"];
  ASSERT_EQ(rows.size(), 12u);
  // Softer springs are further from the cut joint, and the error falls as 1 / c.
  const double soft = rows[2]["error_max_closure_S_force_y"];
  const double stiff = rows[8]["error_max_closure_S_force_y"];
  EXPECT_GT(soft, 3.0 * stiff);
  EXPECT_TRUE(rows[9]["error_max_closure_S_force_y"].is_null());
}

TEST_F(Verbs, A_second_start_of_a_finished_study_changes_nothing) {
  const Ended first = run("study study.toml -o out");
  const Ended second = run("study study.toml -o out --json");
  EXPECT_EQ(second.code, 0) << second.err;
  EXPECT_THAT(second.err, HasSubstr("9 of 12 done, 3 failed, 0 left"));
  const json object = json::parse(second.out);
  EXPECT_EQ(object["digest"], digest_in(first.out));
  EXPECT_EQ(object["evaluations"], 12);
  EXPECT_EQ(object["done"], 9);
  EXPECT_EQ(object["status"], "complete");
}

TEST_F(Verbs, Traces_are_exported_with_their_difference_from_the_reference) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const Ended ended = run("export out --traces --format json");
  EXPECT_EQ(ended.code, 0) << ended.err;
  const json rows = json::parse(ended.out)["rows"];
  std::size_t references = 0, compared = 0;
  std::map<double, double> reference;
  for (const json& row : rows) {
    if (row["run"] == "reference") {
      ++references;
      reference[row["time"]] = row["closure.S.force.y"];
    } else if (row["run"] == "evaluation_8" && row["closure.S.force.y.difference"].is_number()) {
      ++compared;
      const auto at = reference.lower_bound(static_cast<double>(row["time"]) - 1e-9);
      ASSERT_NE(at, reference.end());
      EXPECT_DOUBLE_EQ(row["closure.S.force.y.difference"],
                       static_cast<double>(row["closure.S.force.y"]) - at->second);
    }
  }
  EXPECT_EQ(references, 21u);
  EXPECT_EQ(compared, 21u);
}

TEST_F(Verbs, Without_output_a_study_goes_to_results_and_its_name) {
  EXPECT_EQ(run("study study.toml").code, 0);
  EXPECT_TRUE(std::filesystem::exists(path("results/short-study/results.h5")));
}

TEST_F(Verbs, Tune_certifies_a_stiffness_and_replays_it_from_the_journal) {
  const Ended first = run("tune tune.toml -o out");
  EXPECT_EQ(first.code, 0) << first.out << first.err;
  EXPECT_THAT(first.out, HasSubstr("certified"));
  const Ended again = run("tune tune.toml -o out --json");
  EXPECT_EQ(again.code, 0) << again.err;
  const json object = json::parse(again.out);
  EXPECT_EQ(object["status"], "certified");
  EXPECT_EQ(object["digest"], digest_in(first.out));
  const double stiffness = object["parameters"]["closure.S.sde.stiffness"];
  EXPECT_GT(stiffness, 1e3);
  EXPECT_LT(stiffness, 1e7);
  EXPECT_GE(object["window"]["high"], stiffness);
  for (const auto& [name, error] : object["error"].items()) EXPECT_LE(error, 0.001) << name;
  // What it says can be checked by hand: a study of the answer and of 5 % below it.
  std::string study = tune_text();
  study.replace(study.find("\"tune\""), 6, "\"study\"");
  study.replace(study.find("[[tune]]"), 8, "[[vary]]");
  const std::size_t range = study.find("range");
  study.replace(
      range, study.find('\n', range) - range,
      "values = [" + std::to_string(stiffness) + ", " + std::to_string(0.95 * stiffness) + "]");
  write("byhand.toml", study);
  ASSERT_EQ(run("study byhand.toml -o byhand").code, 0);
  const json rows = json::parse(run("export byhand --table evaluations --format json").out)["rows"];
  const auto largest = [&](const json& row) {
    double error = 0.0;
    for (const char* axis : {"x", "y", "z"}) {
      error = std::max<double>(error, row[std::string("error_rms_closure_S_force_") + axis]);
    }
    return error;
  };
  EXPECT_LE(largest(rows[0]), 0.001 * (1 + 1e-6));
  EXPECT_GT(largest(rows[1]), 0.001);
}

TEST_F(Verbs, Status_of_a_tune_counts_to_its_budget_until_it_has_its_answer) {
  const Ended cut =
      run("tune tune.toml -o out -s search.max_evaluations=150 --walltime 0.02 --json");
  ASSERT_EQ(cut.code, 75) << cut.err;
  EXPECT_EQ(json::parse(cut.out)["status"], "interrupted");
  const json before = json::parse(run("status out --json").out);
  EXPECT_EQ(before["total"], 150);
  EXPECT_LT(before["done"], 150);
  EXPECT_EQ(before["running"], false);
  EXPECT_THAT(run("status out").out, HasSubstr(" of at most 150\n"));
  const Ended tuned = run("tune tune.toml -o out -s search.max_evaluations=150 --json");
  ASSERT_EQ(tuned.code, 0) << tuned.err;
  const json after = json::parse(run("status out --json").out);
  EXPECT_EQ(after["total"], json::parse(tuned.out)["evaluations"]);
  EXPECT_EQ(after["eta_s"], 0.0);
  EXPECT_THAT(run("status out").out, HasSubstr("complete"));
}

TEST_F(Verbs, A_tune_without_a_window_exits_with_4_and_says_why) {
  const Ended ended =
      run("tune tune.toml -o out -s simulation.step=1e-3 -s search.scan=6 "
          "-s search.max_evaluations=30 -s 'match.0.tolerance=1e-9'");
  EXPECT_EQ(ended.code, 4) << ended.out << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("window      empty"));
}

// A pendulum on a ball that swings past theta = 90 deg, just beside it: its angles fail there,
// which the end says; the same with a quaternion is no event.
TEST_F(Verbs, A_run_past_the_singular_angles_of_a_ball_names_them) {
  const auto model = [](const std::string& ball) {
    return R"(format = 1
kind = "model"
gravity = [0.0, 0.0, -9.81]
[[link]]
name = "b"
mass = 1.0
center_of_mass = [0.3, 0.0, 0.0]
inertia = [0.01, 0.02, 0.03]
[[joint]]
name = "S"
type = "spherical"
parent = "ground"
child = "b"
)" + ball + R"(
[simulation]
end_time = 1.0
step = 1.0e-3
output_interval = 1.0e-3
start = "given"
)";
  };
  write("angles.toml", model("initial = { position = [0, 0.3, 0], velocity = [1e-3, 0.5, 0] }"));
  write("quaternion.toml",
        model("coordinates = \"quaternion\"\n"
              "initial = { position = [0.9887710779360422, 0, 0.1494381324735992, 0], "
              "velocity = [-2.955e-4, 0.5, 9.553e-4] }"));
  const Ended lost = run("simulate angles.toml");
  EXPECT_EQ(lost.code, 3);
  EXPECT_THAT(on_one_line(lost.out + lost.err),
              HasSubstr("the angles of a joint are singular at 90 deg"));
  EXPECT_THAT(lost.out + lost.err, HasSubstr("coordinates = \"quaternion\""));
  EXPECT_EQ(run("simulate quaternion.toml").code, 0);
  EXPECT_THAT(run("simulate angles.toml -s simulation.end_time=0.1").out,
              Not(HasSubstr("singular")));
}

}  // namespace
}  // namespace linkstudy::testing::verbs_test

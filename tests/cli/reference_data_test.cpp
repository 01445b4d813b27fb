// [reference] file as a user meets it: the cut joint's own force from a file gives what its run
// gives, and thinned data what is worked out from the file by hand.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/support/rsrrp_text.h"

namespace linkstudy::testing::reference_data_test {
namespace {

using nlohmann::json;
using test::replaced;
using ::testing::HasSubstr;

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

// Lines of numbers of a CSV text; empty cells are missing.
std::vector<std::vector<double>> numbers_of(const std::string& text) {
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || (std::isdigit(line.front()) == 0 && line.front() != '-')) continue;
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) {
      rows.back().push_back(cell.empty() ? kMissing : std::stod(cell));
    }
  }
  return rows;
}

const char* const kRun = "reference = { set = { \"closure.S.model\" = \"cut\" } }\n";

class ReferenceFile : public Program {
 protected:
  ReferenceFile() {
    write_inputs();
    write("cut.csv", force("cut"));
  }

  // At every step of the model.
  std::string force(const std::string& joint) const {
    const Ended made = run("simulate model.toml -s closure.S.model=" + joint +
                           " -s closure.S.sde.stiffness=3e4 -s simulation.output_interval=1e-3 "
                           "--signals closure.S.force --csv -");
    EXPECT_EQ(0, made.code) << made.err;
    return made.out;
  }

  // Of the three components at 3e4 N/m: largest, then root mean square.
  std::vector<double> errors(const std::string& reference, const std::string& more) const {
    write("own.toml", std::string("format = 1\nkind = \"study\"\nmodel = \"model.toml\"\n") +
                          "base = { set = { \"closure.S.model\" = \"sde\" } }\n" +
                          "vary = [{ parameter = \"closure.S.sde.stiffness\", values = [3e4] }]\n" +
                          reference +
                          "[[match]]\nsignal = \"closure.S.force\"\ntolerance = 0.02\n" + more);
    const Ended ended = run("study own.toml -o own --fresh");
    EXPECT_EQ(0, ended.code) << ended.err;
    std::string columns;
    for (const char* norm : {"max", "rms"}) {
      for (const char* axis : {"x", "y", "z"}) {
        if (!columns.empty()) columns += ",";
        columns += std::string("error_") + norm + "_closure_S_force_" + axis;
      }
    }
    const Ended table = run("export own --table evaluations --format csv --columns " + columns);
    EXPECT_EQ(0, table.code) << table.err;
    const auto rows = numbers_of(table.out);
    EXPECT_EQ(1U, rows.size()) << table.out;
    return rows.empty() ? std::vector<double>() : rows.front();
  }
};

// Rounding: sums of 200 terms, and instants that are multiples of the step to the last digit.
TEST_F(ReferenceFile, Gives_the_errors_of_the_run_that_wrote_it) {
  for (const char* more : {"", "window = [0.05, 0.15]\nscale = \"vector\"\n", "floor = 0.3\n"}) {
    const std::vector<double> by_run = errors(kRun, more);
    const std::vector<double> by_data = errors(kForceData, more);
    ASSERT_EQ(6U, by_run.size());
    ASSERT_EQ(6U, by_data.size());
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_GT(by_run[i], 0.0);
      EXPECT_NEAR(by_run[i], by_data[i], 1e-12 * by_run[i]) << more << i;
    }
  }
}

// Every seventh line, some cells empty, moved by 0.4 ms between the steps of 1 ms.
TEST_F(ReferenceFile, Compares_sparse_data_between_steps_as_worked_out_by_hand) {
  const auto measured = numbers_of(read_text(path("cut.csv")));
  const auto simulated = numbers_of(force("sde"));
  ASSERT_EQ(201U, measured.size());
  ASSERT_EQ(201U, simulated.size());
  std::string text = "t [ms],Fx [kN],Fy [N],Fz [N]\n";
  std::vector<double> t[3], r[3], d[3];
  for (std::size_t i = 7; i < 200; i += 7) {
    text += fmt::format("{:.17g}", 1e3 * measured[i][0]);
    for (std::size_t c = 0; c < 3; ++c) {
      const double value = measured[i][c + 1];
      const bool is_missing = (i / 7 + c) % 5 == 0;
      text += is_missing ? "," : fmt::format(",{:.17g}", c == 0 ? value / 1e3 : value);
      if (is_missing) continue;
      const double between = 0.6 * simulated[i][c + 1] + 0.4 * simulated[i + 1][c + 1];
      t[c].push_back(measured[i][0]);
      r[c].push_back(value);
      d[c].push_back(between - value);
    }
    text += "\n";
  }
  write("sparse.csv", text);
  const std::vector<double> found = errors(R"(
[reference]
file = "sparse.csv"
time_offset = "0.4 ms"
columns.time = "t [ms]"
columns."closure.S.force.x" = "Fx [kN]"
columns."closure.S.force.y" = "Fy [N]"
columns."closure.S.force.z" = "Fz [N]"
)",
                                           "floor = 0.0\n");
  ASSERT_EQ(6U, found.size());
  for (std::size_t c = 0; c < 3; ++c) {
    double most = 0.0, scale = 0.0, square = 0.0, scale_square = 0.0;
    for (std::size_t i = 0; i < t[c].size(); ++i) {
      const double before = i > 0 ? t[c][i] - t[c][i - 1] : 0.0;
      const double after = i + 1 < t[c].size() ? t[c][i + 1] - t[c][i] : 0.0;
      most = std::max(most, std::abs(d[c][i]));
      scale = std::max(scale, std::abs(r[c][i]));
      square += (before + after) * d[c][i] * d[c][i];
      scale_square += (before + after) * r[c][i] * r[c][i];
    }
    // Instants through a text in ms: 1e-16 s beside steps of 1 ms.
    EXPECT_NEAR(most / scale, found[c], 1e-9 * found[c]);
    EXPECT_NEAR(std::sqrt(square / scale_square), found[c + 3], 1e-9 * found[c + 3]);
  }
}

TEST_F(ReferenceFile, Gives_the_answer_of_a_tune_against_the_run_and_is_verified_without_it) {
  const std::string text = tune_text() + "\n[search]\nscan = 8\n";
  write("tune.toml", text);
  const Ended by_run = run("tune tune.toml -o by_run --json");
  ASSERT_EQ(0, by_run.code) << by_run.err;
  write("data.toml", replaced(text, kRun, "") + kForceData);
  const Ended by_data = run("tune data.toml -o by_data --json");
  ASSERT_EQ(0, by_data.code) << by_data.err;
  const auto answer = [](const Ended& ended) {
    return json::parse(ended.out)["parameters"]["closure.S.sde.stiffness"].get<double>();
  };
  EXPECT_NEAR(std::log10(answer(by_run)), std::log10(answer(by_data)), 1e-3);  // resolution
  const Ended kept = run("export by_data --table traces --format csv");
  EXPECT_THAT(kept.out, HasSubstr("closure.S.force.x"));
  for (const char* file : {"cut.csv", "data.toml", "model.toml"}) {
    std::filesystem::remove(path(file));
  }
  const Ended verified = run("verify by_data --json");
  EXPECT_EQ(0, verified.code) << verified.err << verified.out;
  EXPECT_EQ("certified", json::parse(verified.out)["answer"]);
}

TEST_F(ReferenceFile, Is_part_of_the_input_and_the_same_on_two_ranks) {
  for (const char* name : {"OMPI_ALLOW_RUN_AS_ROOT", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM"}) {
    setenv(name, "1", 1);
  }
  setenv("OMPI_MCA_pml", "ob1", 1);
  write("study.toml",
        replaced(study_text(),
                 "reference = { set = { \"closure.S.model\" = \"cut\", \"simulation.step\" = "
                 "1.0e-4 } }",
                 "") +
            kForceData);
  const Ended alone = run("study study.toml -o alone");
  EXPECT_EQ(0, alone.code) << alone.err;
  const Ended two = run("study study.toml -o two", "mpirun --oversubscribe -n 2");
  EXPECT_EQ(digest_in(alone.out), digest_in(two.out));
  EXPECT_EQ(64U, digest_in(two.out).size());
  std::string other = read_text(path("cut.csv"));
  write("cut.csv", other.substr(0, other.rfind('\n', other.size() - 2) + 1));
  const Ended again = run("study study.toml -o alone");
  EXPECT_EQ(2, again.code);
  EXPECT_THAT(again.err, HasSubstr("holds a study of another input"));
}

}  // namespace
}  // namespace linkstudy::testing::reference_data_test

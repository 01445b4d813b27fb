// Tables of results as users get them: by name, by columns and rows, in every form, from a
// directory and from its results.h5 alone.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli/program.h"
#include "tests/support/source_file.h"

namespace linkstudy::testing::export_test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class Export : public Program {
 protected:
  Export() { write_inputs(); }

  // "export ARGUMENTS", which must succeed.
  std::string table(const std::string& arguments) const {
    const Ended ended = run("export " + arguments);
    EXPECT_EQ(ended.code, 0) << arguments << "\n" << ended.err;
    return ended.out;
  }

  std::vector<std::string> names_in(const std::string& results) const {
    std::vector<std::string> names;
    const json list = json::parse(table(results + " --list --format json"));
    for (const json& row : list["rows"]) names.push_back(row["table"]);
    return names;
  }

  // Every table that is there, in every form, from either.
  void expect_same_tables(const std::string& directory, const std::string& file) const {
    EXPECT_EQ(table(directory + " --list"), table(file + " --list"));
    for (const std::string& name : names_in(directory)) {
      for (const char* format : {"text", "csv", "md", "latex", "json"}) {
        const std::string choice = " --table " + name + " --format " + format;
        EXPECT_EQ(table(directory + choice), table(file + choice)) << choice;
      }
    }
  }
};

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t most = 0;
  for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
  return most;
}

TEST_F(Export, Of_a_study_shows_the_summary_that_the_study_printed) {
  const Ended study = run("study study.toml -o out");
  ASSERT_EQ(study.code, 0) << study.err;
  const std::string summary = table("out --format text");
  EXPECT_THAT(study.out, HasSubstr(summary));
  EXPECT_LE(longest_line(summary), 100u) << summary;
  EXPECT_EQ(table("out --table summary"), table("out")) << "the default, csv into a pipe";
  const json rows = json::parse(table("out --format json"))["rows"];
  const json all = json::parse(table("out --table evaluations --format json"))["rows"];
  ASSERT_EQ(rows.size(), 12u);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i]["status"] != "ok") continue;
    double largest = 0.0;
    std::string component;
    for (const std::string axis : {"x", "y", "z"}) {
      const double error = all[i]["error_max_closure_S_force_" + axis];
      if (error > largest) component = axis;
      largest = std::max(largest, error);
    }
    EXPECT_EQ(rows[i]["error_max_closure_S_force"], 100.0 * largest) << i;
    EXPECT_EQ(rows[i]["worst_closure_S_force"], component) << i;
    EXPECT_EQ(rows[i]["crank_speed"], all[i]["crank_speed"]) << i;
  }
}

// 2 zeta sqrt(c m_eff) goes with the root of the stiffness, at every step.
TEST_F(Export, Tells_the_damping_in_SI_where_a_ratio_gives_it) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  for (const char* name : {"summary", "evaluations"}) {
    const json rows = json::parse(table(std::string("out --format json --table ") + name))["rows"];
    const double soft = rows[0]["closure.S.sde.damping"];
    EXPECT_GT(soft, 0.0);
    EXPECT_DOUBLE_EQ(static_cast<double>(rows[6]["closure.S.sde.damping"]) / soft, std::sqrt(10.0));
    EXPECT_DOUBLE_EQ(rows[1]["closure.S.sde.damping"], soft);
  }
  ASSERT_EQ(run("tune tune.toml -o tuned").code, 0);
  const json tuned = json::parse(table("tuned --table tuning --format json"))["rows"][0];
  const double damping = tuned["closure.S.sde.damping"];
  EXPECT_EQ(tuned["closure.S.sde.damping_ratio"], 0.7);
  const json soft = json::parse(table("out --format json"))["rows"][0];
  const double ratio = static_cast<double>(tuned["value"]) / 1e4;
  EXPECT_NEAR(damping / static_cast<double>(soft["closure.S.sde.damping"]), std::sqrt(ratio), 1e-9);
}

TEST_F(Export, From_results_h5_alone_gives_the_tables_of_the_directory) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  ASSERT_EQ(run("tune tune.toml -o tuned").code, 0);
  for (const std::string directory : {"out", "tuned"}) {
    std::filesystem::copy_file(path(directory + "/results.h5"), path(directory + ".h5"));
    expect_same_tables(directory, directory + ".h5");
  }
  EXPECT_THAT(table("tuned --table certificate"), HasSubstr("C3,"));
  EXPECT_THAT(table("tuned.h5 --table scan"), HasSubstr("too soft"));
  EXPECT_THAT(table("tuned --table tuning --format text"),
              AllOf(HasSubstr("closure.S.sde.stiffness"), HasSubstr("N s/m"),
                    HasSubstr("certified"), HasSubstr("high_limited_by")));
}

TEST_F(Export, Chooses_columns_and_rows_and_writes_files) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const std::string choice =
      "out --columns evaluation,status --rows 'closure.S.sde.stiffness >= 100 N/mm and "
      "simulation.step < 1 ms'";
  EXPECT_EQ(table(choice), "# units: ,\nevaluation,status\n7,ok\n8,ok\n10,diverged\n11,diverged\n");
  EXPECT_EQ(table(choice + " -o chosen.csv"), "");
  EXPECT_EQ(read_text(path("chosen.csv")), table(choice));
  EXPECT_THAT(table("out --table evaluations --columns wall_s,host"), HasSubstr("wall_s,host"));
  EXPECT_EQ(table("out --traces"), table("out --table traces"));
}

TEST_F(Export, Refuses_names_and_expressions_with_the_nearest) {
  ASSERT_EQ(run("study study.toml -o out").code, 0);
  const auto refused = [&](const std::string& arguments) {
    const Ended ended = run("export out " + arguments);
    EXPECT_EQ(ended.code, 2) << arguments;
    EXPECT_EQ(ended.out, "") << arguments;
    return ended.err;
  };
  EXPECT_THAT(refused("--table evaluation"), HasSubstr("did you mean 'evaluations'?"));
  EXPECT_THAT(refused("--table tuning"), HasSubstr("only a tune"));
  EXPECT_THAT(refused("--columns gapmax"), HasSubstr("nearest: gap_max"));
  EXPECT_THAT(refused("--rows 'stiffnes > 1'"), HasSubstr("there is no column 'stiffnes'"));
  EXPECT_THAT(refused("--rows 'gap_max > 1 N'"), HasSubstr("does not fit column 'gap_max'"));
  EXPECT_THAT(refused("--rows gap_max"), HasSubstr("is no comparison"));
  EXPECT_THAT(refused("--list --table runtime"), HasSubstr("--list"));
  EXPECT_THAT(refused("--traces --table runtime"), HasSubstr("--traces is --table traces"));
  EXPECT_EQ(run("export study.toml").code, 2) << "a file that is none of results";
}

// What a paper needs is compiled where LaTeX is installed.
TEST_F(Export, Writes_LaTeX_that_compiles) {
  if (std::system("command -v pdflatex > /dev/null && kpsewhich siunitx.sty > /dev/null") != 0) {
    GTEST_SKIP() << "no pdflatex with siunitx";
  }
  write("refine.toml", R"(format = 1
kind = "converge"
model = "model.toml"
[[refine]]
parameter = "simulation.step"
ladder = { from = 4e-3, ratio = 0.5, levels = 4 }
[[response]]
name = "crank_speed"
signal = "joint.A.v"
reduce = "last"
)");
  ASSERT_EQ(run("study study.toml -o studied").code, 0);
  ASSERT_EQ(run("converge refine.toml -o refined").code, 0);
  ASSERT_EQ(run("tune tune.toml -o tuned -s match.0.tolerance=[0.002,0.001]").code, 0);
  std::string text =
      "\\documentclass{article}\n\\usepackage{booktabs, graphicx, siunitx}\n\\begin{document}\n";
  for (const char* directory : {"studied", "refined", "tuned"}) {
    for (const std::string& name : names_in(directory)) {
      // Longer than a page.
      if (name == "traces" || (name == "evaluations" && directory == std::string("tuned")))
        continue;
      text += "\\resizebox{!}{0.05\\textheight}{%\n";
      text += table(directory + (" --format latex --table " + name)) + "}\n\n";
    }
  }
  write("tables.tex", text + "\\end{document}\n");
  const std::string command = "cd '" + path("").string() +
                              "' && pdflatex -interaction=nonstopmode -halt-on-error tables.tex "
                              "> tables.out 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0) << read_text(path("tables.out"));
}

// The README shows the summary of a shipped study as the program prints it.
TEST_F(Export, Summary_of_the_stiffness_ladder_is_what_the_README_shows) {
  const std::string study = source_file("configs/studies/rsrrp_stiffness.toml");
  ASSERT_EQ(run("study " + study + " -o out").code, 0);
  const std::string summary = table("out --format text");
  EXPECT_LE(longest_line(summary), 100u);
  EXPECT_THAT(read_text(source_file("README.md")), HasSubstr(summary)) << summary;
}

}  // namespace
}  // namespace linkstudy::testing::export_test

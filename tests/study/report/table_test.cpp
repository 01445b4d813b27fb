#include "study/report/table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/report/results_table.h"

namespace linkstudy {
namespace {

using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Table sample() {
  return {"stiffness ladder",
          {{"k", "N/m", "{:.3g}", Align::right},
           {"error", "", "{:.2f}", Align::right},
           {"cause", "", "{}", Align::left}},
          {{1e6, 0.1, std::string("ok")},
           {25.0, kNan, std::string("diverged, \"early\"\nh|2 \u03c9_x")},
           {-2.5e-5, {}, std::string()},
           {kInf}}};
}

TEST(Table, Text_is_aligned_and_short) {
  EXPECT_EQ(text_of(sample()),
            "stiffness ladder\n"
            "       k  error  cause\n"
            "     N/m\n"
            "--------  -----  -------------------------\n"
            "   1e+06   0.10  ok\n"
            "      25    nan  diverged, \"early\" h|2 \u03c9_x\n"
            "-2.5e-05      -\n"
            "     inf      -  -\n");
}

TEST(Table, CSV_keeps_17_digits_and_quotes_as_RFC_4180_says) {
  EXPECT_EQ(csv_of(sample()),
            "# units: N/m,,\n"
            "k,error,cause\n"
            "1000000,0.10000000000000001,ok\n"
            "25,nan,\"diverged, \"\"early\"\"\nh|2 \u03c9_x\"\n"
            "-2.5000000000000001e-05,,\n"
            "inf,,\n");
}

TEST(Table, CSV_numbers_read_back_to_the_same_bits) {
  Table table{"", {{"x", "", "{:.3g}", Align::right}}, {}};
  std::vector<double> values = {1.0 / 3.0, -0.1, 5e-324, 1.7976931348623157e308, 0.1 + 0.2};
  for (double value : values) {
    table.rows.push_back({value});
  }
  std::istringstream lines(csv_of(table));
  std::string line;
  std::getline(lines, line);
  std::getline(lines, line);
  for (double value : values) {
    std::getline(lines, line);
    EXPECT_EQ(std::strtod(line.c_str(), nullptr), value);
  }
}

TEST(Table, Markdown_keeps_its_cells_apart) {
  EXPECT_EQ(markdown_of(sample()),
            "**stiffness ladder**\n\n"
            "| k [N/m] | error | cause |\n"
            "| ---: | ---: | :--- |\n"
            "| 1e+06 | 0.10 | ok |\n"
            "| 25 | nan | diverged, \"early\" h\\|2 \u03c9\\_x |\n"
            "| -2.5e-05 |  |  |\n"
            "| inf |  |  |\n");
}

TEST(Table, LaTeX_prints_powers_of_ten_and_escapes_the_rest) {
  Table table = sample();
  table.columns[2].name = "50% of_m^2";
  EXPECT_EQ(latex_of(table),
            "\\begin{tabular}{rrl}\n\\toprule\n"
            "k & error & 50\\% of\\_m\\textasciicircum{}2 \\\\\n"
            "N/m &  &  \\\\\n\\midrule\n"
            "$1 \\cdot 10^{6}$ & $0.10$ & ok \\\\\n"
            "$25$ & nan & diverged, \"early\" h|2 \u03c9\\_x \\\\\n"
            "$-2.5 \\cdot 10^{-5}$ &  &  \\\\\n"
            "$\\infty$ &  &  \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

TEST(Table, JSON_is_valid_and_keeps_the_order_and_the_bits) {
  const nlohmann::ordered_json json = nlohmann::ordered_json::parse(json_of(sample()));
  EXPECT_EQ(json["title"], "stiffness ladder");
  EXPECT_EQ(json["columns"][0]["unit"], "N/m");
  EXPECT_EQ(json["rows"].size(), 4u);
  EXPECT_EQ(json["rows"][0].items().begin().key(), "k");
  EXPECT_EQ(json["rows"][0]["error"].get<double>(), 0.1);
  EXPECT_EQ(json["rows"][2]["k"].get<double>(), -2.5e-5);
  EXPECT_TRUE(json["rows"][1]["error"].is_null());
  EXPECT_TRUE(json["rows"][2]["error"].is_null());
  EXPECT_EQ(json["rows"][1]["cause"], "diverged, \"early\"\nh|2 \u03c9_x");
  Table broken{"\xff", {}, {}};
  EXPECT_TRUE(nlohmann::json::accept(json_of(broken)));
}

TEST(Table, Without_rows_and_without_columns_every_form_can_be_written) {
  for (const char* name : {"text", "csv", "md", "json", "latex"}) {
    EXPECT_FALSE(
        write_table({"t", {{"a", "m", "{:.1f}", Align::right}}, {}}, table_format(name)).empty());
    EXPECT_FALSE(write_table({}, table_format(name)).empty());
  }
  EXPECT_THROW(table_format("xls"), std::invalid_argument);
}

TEST(Table, A_row_that_is_too_long_is_refused) {
  const Table table{"t", {{"a", "", "{}", Align::left}}, {{1.0, 2.0}}};
  for (const char* name : {"text", "csv", "md", "json", "latex"}) {
    EXPECT_THROW(write_table(table, table_format(name)), std::invalid_argument) << name;
  }
}

StudyResults some_results() {
  StudyResults results;
  results.description = {"ladder",
                         "study",
                         0,
                         {{"closure.S.sde.stiffness", "N/m", ""}, {"closure.S.model", "", ""}},
                         {{"gap", "m", ""}}};
  Evaluation good;
  good.point = {0, {1e4, std::string("sde")}};
  good.responses = {0.5};
  good.host = "n1";
  Evaluation bad = good;
  bad.point.id = 1;
  bad.status = Cause::timeout;
  bad.responses.clear();
  bad.message = "after 5 s";
  results.evaluations = {bad, good};
  return results;
}

TEST(ResultsTable, Shows_inputs_outputs_and_causes_by_id) {
  EXPECT_EQ(text_of(results_table(some_results())),
            "ladder\n"
            "evaluation  closure.S.sde.stiffness  closure.S.model  gap  status   message\n"
            "                                N/m                     m\n"
            "----------  -----------------------  ---------------  ---  -------  ---------\n"
            "         0                    10000  sde              0.5  ok\n"
            "         1                    10000  sde              nan  timeout  after 5 s\n");
}

TEST(ResultsTable, Has_the_column_of_messages_when_nothing_failed_too) {
  StudyResults results = some_results();
  results.evaluations.erase(results.evaluations.begin());
  const std::string text = text_of(results_table(results));
  EXPECT_THAT(text, testing::HasSubstr("message"));
  EXPECT_THAT(text, testing::Not(HasSubstr("parent")));
}

TEST(ResultsTable, Gives_the_columns_asked_for_in_their_order) {
  EXPECT_EQ(csv_of(results_table(some_results(), {{"gap", "host", "evaluation", "attempts"}})),
            "# units: m,,,\n"
            "gap,host,evaluation,attempts\n"
            "0.5,n1,0,1\n"
            "nan,n1,1,1\n");
}

TEST(ResultsTable, An_unknown_column_is_refused_with_the_names_there_are) {
  try {
    results_table(some_results(), {{"gapp"}});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("'gapp'"));
    EXPECT_THAT(error.what(), HasSubstr("closure.S.model, gap, status"));
  }
}

TEST(ResultsTable, Stored_groups_become_tables_with_flags_as_words) {
  const DataGroup scan{
      "scan",
      {{"k", "N/m", "", "parameter", std::vector<double>{1e4, 1e5}, {}},
       {"side", "", "", "side", std::vector<std::uint8_t>{1, 0}, {"feasible", "too_soft"}},
       {"round", "", "", "round", std::vector<std::int64_t>{7, -1}, {}}},
      {},
      {}};
  EXPECT_EQ(text_of(table_of(scan)),
            "scan\n"
            "     k  side      round\n"
            "   N/m\n"
            "------  --------  -----\n"
            " 10000  too_soft      7\n"
            "100000  feasible     -1\n");
  EXPECT_EQ(table_of(scan, {"side"}).columns.size(), 1u);
}

TEST(ResultsTable, Starts_and_resumes_have_their_rows) {
  StudyResults results = some_results();
  results.provenance = {{"start", 1.7e9, 2, 3, "n1", "0.1.0", "abc", "linkstudy study", "avx2", 4}};
  EXPECT_THAT(csv_of(provenance_table(results)),
              HasSubstr("start,1700000000,2,3,n1,0.1.0,abc,avx2,4,,0,linkstudy study"));
}

}  // namespace
}  // namespace linkstudy

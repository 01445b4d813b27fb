#include "study/report/write_table.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

namespace linkstudy::table_test {
namespace {

using ::testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Column numbers(const std::string& name, const std::string& unit, std::vector<double> values,
               const char* format = "{:.6g}") {
  Column column{name, unit, "", "", std::move(values)};
  column.format = format;
  return column;
}

Column words(const std::string& name, std::vector<std::string> values) {
  return {name, "", "", "", std::move(values)};
}

Table sample() {
  return {"stiffness ladder",
          {numbers("k", "N/m", {1e6, 25.0, -2.5e-5, kInf}, "{:.3g}"),
           numbers("error", "", {0.1, kNan, kNan, kNan}, "{:.2f}"),
           words("cause", {"ok", "diverged, \"early\"\nh|2 \u03c9_x", "", ""})}};
}

TEST(Table, Text_is_aligned_and_short) {
  EXPECT_EQ(text_of(sample()),
            "stiffness ladder\n"
            "       k  error  cause\n"
            "     N/m\n"
            "--------  -----  -------------------------\n"
            "   1e+06   0.10  ok\n"
            "      25      -  diverged, \"early\" h|2 \u03c9_x\n"
            "-2.5e-05      -\n"
            "     inf      -\n");
}

TEST(Table, CSV_keeps_17_digits_and_quotes_as_RFC_4180_says) {
  EXPECT_EQ(csv_of(sample()),
            "# units: N/m,,\n"
            "k,error,cause\n"
            "1000000,0.10000000000000001,ok\n"
            "25,,\"diverged, \"\"early\"\"\nh|2 \u03c9_x\"\n"
            "-2.5000000000000001e-05,,\n"
            "inf,,\n");
}

TEST(Table, CSV_numbers_read_back_to_the_same_bits) {
  const std::vector<double> values = {1.0 / 3.0, -0.1, 5e-324, 1.7976931348623157e308, 0.1 + 0.2};
  std::istringstream lines(csv_of({"", {numbers("x", "", values, "{:.3g}")}}));
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
            "| 25 |  | diverged, \"early\" h\\|2 \u03c9\\_x |\n"
            "| -2.5e-05 |  |  |\n"
            "| inf |  |  |\n");
}

// Numbers as siunitx reads them, room for the digits there are, units in the head, the rest
// escaped.
TEST(Table, LaTeX_is_a_tabular_of_booktabs_and_siunitx) {
  Table table = sample();
  table.columns[2].name = "50% of_m^2";
  table.columns[1].unit = "N s/m";
  EXPECT_EQ(latex_of(table),
            "% \\usepackage{booktabs, siunitx}\n"
            "\\begin{tabular}{ S[table-format=-1.1e-1] S[table-format=1.2] l }\n\\toprule\n"
            "{k} & {error} & 50\\% of\\_m\\textasciicircum{}2 \\\\\n"
            "{\\si{N/m}} & {\\si{N.s/m}} &  \\\\\n\\midrule\n"
            "1.0e6 & 0.10 & ok \\\\\n"
            "2.5e1 &  & diverged, \"early\" h|2 \u03c9\\_x \\\\\n"
            "-2.5e-5 &  &  \\\\\n"
            "{$\\infty$} &  &  \\\\\n"
            "\\bottomrule\n\\end{tabular}\n");
}

// One column, one notation: the digits are those of the column's form.
TEST(Table, LaTeX_has_powers_of_ten_in_a_whole_column_or_not_at_all) {
  const Table table{"",
                    {numbers("a", "", {316228.0, 0.00876, 0.0, -2e10, 10.0}),
                     numbers("b", "", {117.0, 21.8, 0.0586, -1.0, 0.0})}};
  EXPECT_THAT(latex_of(table), HasSubstr("S[table-format=-1.5e-2] S[table-format=-3.4] }"));
  EXPECT_THAT(latex_of(table), HasSubstr("\\midrule\n"
                                         "3.16228e5 & 117 \\\\\n"
                                         "8.76000e-3 & 21.8 \\\\\n"
                                         "0.00000 & 0.0586 \\\\\n"
                                         "-2.00000e10 & -1 \\\\\n"
                                         "1.00000e1 & 0 \\\\\n"));
}

TEST(Table, LaTeX_breaks_long_names_over_lines_of_the_head) {
  const Table table{"", {numbers("closure.S.sde.stiffness", "N/m", {1e6}), words("end", {"ok"})}};
  EXPECT_THAT(latex_of(table), HasSubstr("\\toprule\n"
                                         "{closure.S.} &  \\\\\n"
                                         "{sde.} &  \\\\\n"
                                         "{stiffness} & end \\\\\n"
                                         "{\\si{N/m}} &  \\\\\n"));
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
  Table broken{"\xff"};
  EXPECT_TRUE(nlohmann::json::accept(json_of(broken)));
}

TEST(Table, Without_rows_and_without_columns_every_form_can_be_written) {
  for (const TableFormat& format : table_formats()) {
    EXPECT_FALSE(format.write({"t", {numbers("a", "m", {})}}, 80).empty()) << format.name;
    EXPECT_FALSE(format.write({}, 80).empty()) << format.name;
    EXPECT_EQ(&table_format(format.name), &format);
  }
  EXPECT_THROW(table_format("xls"), std::invalid_argument);
}

TEST(Table, Columns_of_unequal_lengths_are_refused) {
  const Table table{"t", {numbers("a", "", {1.0}), numbers("b", "", {1.0, 2.0})}};
  for (const TableFormat& format : table_formats()) {
    EXPECT_THROW(format.write(table, 80), std::invalid_argument) << format.name;
  }
}

TEST(Table, Counts_and_flags_are_shown_as_they_are) {
  const Table table{
      "",
      {{"side", "", "", "", std::vector<std::uint8_t>{1, 0}, {"feasible", "too_soft"}},
       {"round", "", "", "", std::vector<std::int64_t>{7, -1}}}};
  EXPECT_EQ(text_of(table),
            "side      round\n"
            "--------  -----\n"
            "too_soft      7\n"
            "feasible     -1\n");
  EXPECT_EQ(csv_of(table), "# units: ,\nside,round\ntoo_soft,7\nfeasible,-1\n");
  EXPECT_EQ(nlohmann::json::parse(json_of(table))["rows"][0]["side"], "too_soft");
}

std::size_t longest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t most = 0;
  for (std::string line; std::getline(lines, line);) most = std::max(most, line.size());
  return most;
}

TEST(TableWidth, Names_go_over_several_lines_before_anything_is_left_out) {
  const Table table{"",
                    {numbers("closure.S.sde.stiffness", "N/m", {31622.8, 1e5}),
                     numbers("error_max_closure_S_force", "%", {58.9, 21.8}),
                     words("status", {"ok", "diverged"})}};
  const std::string text = text_of(table, 40);
  EXPECT_LE(longest_line(text), 40u) << text;
  for (const char* part : {"stiffness", "force", "status", "31622.8", "diverged"}) {
    EXPECT_THAT(text, HasSubstr(part));
  }
  EXPECT_THAT(text, ::testing::Not(HasSubstr("columns fit")));
  EXPECT_EQ(text_of(table, 200), text_of(table)) << "what fits is left alone";
}

TEST(TableWidth, One_row_stands_upright) {
  const Table table{"answer",
                    {words("parameter", {"closure.S.sde.stiffness"}),
                     numbers("value", "N/m", {812945.0}), numbers("margin", "", {1.96})}};
  EXPECT_EQ(text_of(table, 30),
            "answer\n"
            "parameter  closure.S.sde.stiffness\n"
            "value      812945 N/m\n"
            "margin     1.96\n");
}

TEST(TableWidth, Long_texts_are_shortened_then_columns_left_out_with_a_note) {
  const std::string tale(90, 'x');
  Table table{"", {numbers("id", "", {0, 1}), words("tale", {tale, "short"})}};
  const std::string text = text_of(table, 60);
  EXPECT_LE(longest_line(text), 60u) << text;
  EXPECT_THAT(text, HasSubstr("xxx..."));
  for (int i = 0; i < 9; ++i) table.columns.push_back(numbers("more", "", {1e-10, 2.0}));
  const std::string cut = text_of(table, 60);
  EXPECT_LE(longest_line(cut), 72u) << cut;  // the note itself
  EXPECT_THAT(cut, HasSubstr(" of 11 columns fit; export --format csv has all"));
}

}  // namespace
}  // namespace linkstudy::table_test

#include <fmt/format.h>
#include <unistd.h>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/page/paper_figure.h"
#include "study/report/choose_table.h"
#include "study/report/console.h"
#include "study/report/results_tables.h"
#include "study/report/write_table.h"
#include "study/session/exit_code.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

Table make_table(const CommandLine& line, const StudyResults& results) {
  if (line.list) return list_tables(results);
  const std::string name = line.traces ? "traces" : line.table.value_or("summary");
  const Table rows = choose_rows(make_results_table(results, name), line.rows.value_or(""));
  return choose_columns(rows, split_list(line.columns.value_or("")));
}

// People read terminals, programs read files and pipes.
std::string form_of(const CommandLine& line) {
  const bool is_for_people = !line.output && isatty(STDOUT_FILENO) != 0;
  return line.format.value_or(is_for_people || line.list ? "text" : "csv");
}

int export_figure(const CommandLine& line, const StudyResults& results) {
  const std::string word = line.format.value_or("svg");
  const std::optional<PaperFormat> format = find_word<PaperFormat>(word);
  require(format.has_value(), fmt::format("--figure is drawn as svg, pdf or png, not {}", word));
  const bool is_of_tables = line.list || line.table || line.columns || line.rows || line.traces;
  require(!is_of_tables, "--figure goes with --format and -o only");
  const std::string path = line.output.value_or(fmt::format("{}.{}", *line.figure, word));
  draw_paper_figure(make_paper_figure(results, *line.figure), *format, path);
  print_out(path + "\n");
  return kDone;
}

}  // namespace

int run_export(const CommandLine& line) {
  const StudyResults results = read_results_input(line);
  if (line.figure) return export_figure(line, results);
  require(!find_word<PaperFormat>(form_of(line)),
          fmt::format("--format {} is of figures: name one with --figure", form_of(line)));
  const Table table = make_table(line, results);
  const std::string text = table_format(form_of(line)).write(table, output_width());
  if (line.output) {
    write_file_atomically(*line.output, text);
  } else {
    print_out(text);
  }
  return kDone;
}

}  // namespace linkstudy

#include <fmt/format.h>
#include <unistd.h>

#include "study/cli/verb_table.h"
#include "study/report/choose_table.h"
#include "study/report/console.h"
#include "study/report/results_tables.h"
#include "study/report/write_table.h"
#include "study/session/exit_code.h"
#include "study/store/file.h"
#include "study/store/results_file.h"

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

}  // namespace

int run_export(const CommandLine& line) {
  const StudyResults results = read_stored(line.inputs.front());
  if (!results.dropped.empty()) print_err(fmt::format("linkstudy: warning: {}\n", results.dropped));
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

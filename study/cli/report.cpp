#include <fmt/format.h>

#include <filesystem>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/page/page.h"
#include "study/report/console.h"
#include "study/session/exit_code.h"
#include "study/store/directory.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

// -o, or in the directory, or beside the file.
std::filesystem::path page_path(const CommandLine& line) {
  if (line.output) return *line.output;
  const std::filesystem::path input = line.inputs.front();
  if (std::filesystem::is_directory(input)) return input / kReportName;
  return std::filesystem::path(input).replace_extension(".html");
}

}  // namespace

int run_report(const CommandLine& line) {
  const StudyResults results = read_results_input(line);
  const MovingRuns again =
      run_again(results, line.evaluation, line.timeout_s.value_or(kLongestAgain));
  for (const std::string& note : again.notes) print_err(fmt::format("linkstudy: note: {}\n", note));
  const std::filesystem::path path = page_path(line);
  write_file_atomically(path, page_of(results, again));
  print_out(fmt::format("{}\n", path.string()));
  return kDone;
}

}  // namespace linkstudy

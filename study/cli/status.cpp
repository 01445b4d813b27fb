#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "study/cli/input.h"
#include "study/cli/verb_table.h"
#include "study/page/moving_run.h"
#include "study/queue/queue_status.h"
#include "study/record/findings.h"
#include "study/report/console.h"
#include "study/report/status_report.h"
#include "study/report/write_table.h"
#include "study/session/exit_code.h"
#include "study/store/results_file.h"

namespace linkstudy {
namespace {

constexpr auto kPause = std::chrono::seconds(2);

StudyStatus read_and_warn(const CommandLine& line) {
  const StudyStatus status = read_status(line.inputs.front());
  warn_of_lost(status.dropped);
  return status;
}

// On a terminal the text stays in its place, elsewhere each follows the last.
int watch(const CommandLine& line) {
  const bool is_terminal = isatty(STDOUT_FILENO) != 0;
  const char* begin = is_terminal ? "\x1b[H\x1b[J" : "";
  while (true) {
    const StudyStatus status = read_and_warn(line);
    const std::string best = best_text(read_stored(line.inputs.front()));
    print_out(fmt::format("{}{}{}{}", begin, status_text(status),
                          best.empty() ? "" : summary_line("best so far", best),
                          is_terminal ? "" : "\n"));
    if (!status.running) return kDone;
    std::this_thread::sleep_for(kPause);
  }
}

std::string text_of(const CommandLine& line, const std::vector<queue::EntryStatus>& entries) {
  return line.json ? queue::status_json(entries) : queue::status_text(entries, output_width());
}

int run_queue_status(const CommandLine& line, queue::Folder& folder) {
  const char* begin = line.watch && isatty(STDOUT_FILENO) != 0 ? "\x1b[H\x1b[J" : "";
  while (true) {
    const std::vector<queue::EntryStatus> entries = queue::read_status(folder);
    print_out(begin + text_of(line, entries));
    if (!line.watch || !is_any(entries, queue::EntryState::running)) return kDone;
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace

int run_status(const CommandLine& line) {
  require(!line.watch || !line.json, "--watch is for people: --json tells the state once");
  if (auto folder = queue::find_queue(line.inputs.front())) return run_queue_status(line, *folder);
  if (line.watch) return watch(line);
  const StudyStatus status = read_and_warn(line);
  print_out(line.json ? status_json(status) : status_text(status));
  return kDone;
}

}  // namespace linkstudy

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/cli/exit_code.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/schedule/progress.h"
#include "study/store/journal.h"
#include "study/store/status.h"

namespace linkstudy {
namespace {

std::string to_json(const StudyStatus& status) {
  nlohmann::ordered_json failed = nlohmann::ordered_json::object();
  for (const auto& [cause, count] : status.failed) failed[std::string(name_of(cause))] = count;
  nlohmann::ordered_json json = {
      {"total", status.total}, {"done", status.done},
      {"failed", failed},      {"running", status.running},
      {"eta_s", nullptr},      {"last_write_age_s", status.last_write_age_s}};
  if (status.eta_s) json["eta_s"] = *status.eta_s;
  return json.dump() + "\n";
}

// A tune does not know beforehand how many evaluations it needs; it is complete with its answer.
bool is_tuned(const std::string& directory) {
  const JournalContents contents = read_journal(directory);
  return std::ranges::any_of(
      contents.texts, [](const NamedText& text) { return text.name.starts_with("tuning/"); });
}

std::string state_text(const StudyStatus& status, const std::string& directory) {
  if (status.running) return "running";
  const std::uint64_t finished = status.done + status.failed_count();
  const bool is_complete = status.total > 0 ? finished >= status.total : is_tuned(directory);
  return is_complete ? "complete" : "not running, resumable";
}

std::string to_text(const StudyStatus& status, const std::string& directory) {
  std::string text = summary_line("state", state_text(status, directory));
  const std::string total = status.total > 0 ? fmt::format(" of {}", status.total) : "";
  text += summary_line("done", fmt::format("{}{}", status.done, total));
  for (const auto& [cause, count] : status.failed) {
    text += summary_line("failed", fmt::format("{} {}", count, name_of(cause)));
  }
  if (status.eta_s && status.running) {
    text += summary_line("time left", duration_text(*status.eta_s));
  }
  return text + summary_line("last write", duration_text(status.last_write_age_s) + " ago");
}

}  // namespace

int run_status(const CommandLine& line) {
  const StudyStatus status = read_status(line.inputs.front());
  print_out(line.json ? to_json(status) : to_text(status, line.inputs.front()));
  return kDone;
}

}  // namespace linkstudy

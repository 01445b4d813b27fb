#include "study/report/status_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/record/findings.h"
#include "study/schedule/progress.h"

namespace linkstudy {
namespace {

// One word, for scripts.
const char* state_of(const StudyStatus& status) {
  if (status.running) return "running";
  return status.is_complete ? "complete" : "interrupted";
}

std::string state_text(const StudyStatus& status) {
  if (status.running) return "running";
  return status.is_complete ? "complete" : "not running, resumable";
}

}  // namespace

std::string status_json(const StudyStatus& status) {
  nlohmann::ordered_json failed = nlohmann::ordered_json::object();
  for (const auto& [cause, count] : status.failed) failed[std::string(name_of(cause))] = count;
  nlohmann::ordered_json json = {{"state", state_of(status)},
                                 {"total", status.total},
                                 {"done", status.done},
                                 {"finished", status.finished()},
                                 {"failed", failed},
                                 {"references", status.references},
                                 {"running", status.running},
                                 {"eta_s", nullptr},
                                 {"last_write_age_s", status.last_write_age_s},
                                 {"digest", status.digest}};
  if (status.eta_s) json["eta_s"] = *status.eta_s;
  return json.dump() + "\n";
}

std::string finished_text(const StudyStatus& status) {
  const bool is_budget = status.is_search && !status.is_complete;
  return fmt::format("{} of {}{}", status.finished(), is_budget ? "at most " : "", status.total);
}

std::string status_text(const StudyStatus& status) {
  std::string text = summary_line("state", state_text(status));
  const bool is_budget = status.is_search && !status.is_complete;
  text += summary_line("finished", finished_text(status));
  text += summary_line("ok", fmt::format("{}", status.done));
  for (const auto& [cause, count] : status.failed) {
    text += summary_line("failed", fmt::format("{} {}", count, name_of(cause)));
  }
  if (status.eta_s && status.running) {
    text += summary_line("time left", (is_budget ? "at most " : "") + duration_text(*status.eta_s));
  }
  return text + summary_line("last write", duration_text(status.last_write_age_s) + " ago");
}

}  // namespace linkstudy

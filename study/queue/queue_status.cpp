#include "study/queue/queue_status.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "study/record/counted.h"
#include "study/report/status_report.h"
#include "study/report/write_table.h"
#include "study/schedule/progress.h"
#include "study/session/exit_code.h"
#include "study/store/journal.h"
#include "study/store/store_error.h"

namespace linkstudy::queue {
namespace {

EntryState state_of(int exit_code) {
  if (exit_code == kDone) return EntryState::done;
  if (exit_code == kExitResumable) return EntryState::interrupted;
  return exit_code == kInputError ? EntryState::refused : EntryState::failed;
}

// Rank 0 of another program may be about to begin or to end.
std::optional<StudyStatus> read_study(const Entry& entry) {
  std::error_code failed;
  if (!std::filesystem::exists(entry.results / kJournalName, failed)) return std::nullopt;
  try {
    return linkstudy::read_status(entry.results);
  } catch (const StoreError&) {
    return std::nullopt;
  }
}

// Of one that runs, what is left; of one that has ended, what its last start took.
std::string time_text(const EntryStatus& one) {
  if (one.state == EntryState::running) {
    if (!one.study || !one.study->eta_s) return "-";
    return duration_text(*one.study->eta_s) + " left";
  }
  if (!one.record || !one.record->end) return "-";
  return duration_text(one.record->end->unix_s - one.record->begun_unix_s);
}

// What to type to be told.
std::string why_text(const EntryStatus& one) {
  const std::string file = one.entry.file.string();
  const bool is_read = one.entry.kind && !one.record->input_sha256.empty();
  if (!is_read) return "linkstudy check " + file;
  return fmt::format("linkstudy {} {} -o {}", name_of(*one.entry.kind), file,
                     one.entry.results.string());
}

std::string verdict_text(const EntryStatus& one) {
  if (one.state == EntryState::running && one.record) {
    return fmt::format("on {}, {}", one.record->host, counted(one.record->ranks, "rank"));
  }
  if (one.state == EntryState::refused) return why_text(one);
  return one.record && one.record->end ? one.record->end->verdict : "";
}

std::size_t count_of(const std::vector<EntryStatus>& entries, EntryState state) {
  return static_cast<std::size_t>(std::ranges::count(entries, state, &EntryStatus::state));
}

nlohmann::ordered_json to_json(const EntryStatus& one) {
  nlohmann::ordered_json json = {
      {"name", one.entry.name},
      {"file", one.entry.file.string()},
      {"kind", one.entry.kind ? nlohmann::ordered_json(name_of(*one.entry.kind)) : nullptr},
      {"state", name_of(one.state)},
      {"exit_code", nullptr},
      {"verdict", ""},
      {"results", one.entry.results.string()},
      {"study", nullptr}};
  if (one.record && one.record->end && one.state != EntryState::running) {
    json["exit_code"] = one.record->end->exit_code;
    json["verdict"] = one.record->end->verdict;
  }
  if (one.study) json["study"] = nlohmann::ordered_json::parse(status_json(*one.study));
  return json;
}

}  // namespace

EntryStatus read_status(const Entry& entry) {
  EntryStatus status{entry, EntryState::waiting, read_record(entry), read_study(entry)};
  if (is_held(entry)) {
    status.state = EntryState::running;
  } else if (status.record) {
    status.state =
        status.record->end ? state_of(status.record->end->exit_code) : EntryState::interrupted;
  } else if (status.study) {
    status.state = EntryState::interrupted;  // killed while it wrote its record
  }
  return status;
}

std::vector<EntryStatus> read_status(Folder& folder) {
  std::vector<EntryStatus> all;
  for (const Entry& entry : folder.entries()) all.push_back(read_status(entry));
  return all;
}

bool is_any(const std::vector<EntryStatus>& entries, EntryState state) {
  return count_of(entries, state) > 0;
}

Table status_table(const std::vector<EntryStatus>& entries) {
  TableOf<EntryStatus> table("queue", "", entries);
  const auto add = [&](const char* name, const char* meaning, auto field) {
    table.add(name, "", meaning, field);
  };
  add("file", "without .toml", [](const EntryStatus& one) { return one.entry.name; });
  add("kind", "and verb", [](const EntryStatus& one) {
    return one.entry.kind ? std::string(name_of(*one.entry.kind)) : std::string("-");
  });
  add("state", "how far it is",
      [](const EntryStatus& one) { return std::string(name_of(one.state)); });
  add("finished", "evaluations", [](const EntryStatus& one) {
    return one.study ? finished_text(*one.study) : std::string("-");
  });
  add("failed", "evaluations", [](const EntryStatus& one) {
    return one.study ? static_cast<std::int64_t>(one.study->failed_count()) : std::int64_t{0};
  });
  add("time", "left, or taken by the last start", time_text);
  add("verdict", "of its end", verdict_text);
  return table.take();
}

std::string status_json(const std::vector<EntryStatus>& entries) {
  nlohmann::ordered_json json = {{"entries", nlohmann::ordered_json::array()},
                                 {"states", nlohmann::ordered_json::object()}};
  for (const auto& word : kWords<EntryState>) {
    json["states"][std::string(word.text)] = count_of(entries, word.value);
  }
  for (const EntryStatus& one : entries) json["entries"].push_back(to_json(one));
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::string status_text(const std::vector<EntryStatus>& entries, std::size_t width) {
  std::string counts;
  for (const auto& word : kWords<EntryState>) {
    const std::size_t count = count_of(entries, word.value);
    if (count == 0) continue;
    counts += fmt::format("{}{} {}", counts.empty() ? "" : ", ", count, word.text);
  }
  if (entries.empty()) return "no files to run\n";
  return text_of(status_table(entries), width) + "\n" + counts + "\n";
}

}  // namespace linkstudy::queue

// How far a queue is: a row for every file, from what is on disk alone, whoever works on it.
#pragma once

#include <string>
#include <vector>

#include "core/base/words.h"
#include "study/queue/queue_folder.h"
#include "study/record/table.h"
#include "study/store/status.h"

namespace linkstudy::queue {

enum class EntryState { waiting, running, interrupted, done, failed, refused };

}  // namespace linkstudy::queue

namespace linkstudy {

template <>
inline constexpr auto kWords<queue::EntryState> = make_words<queue::EntryState>(
    {{queue::EntryState::waiting, "waiting", "nobody has begun it"},
     {queue::EntryState::running, "running", "a program works on it"},
     {queue::EntryState::interrupted, "interrupted", "the next program goes on with it"},
     {queue::EntryState::done, "done", "ended with exit code 0"},
     {queue::EntryState::failed, "failed", "ended with another exit code"},
     {queue::EntryState::refused, "refused", "an input error, exit code 2"}});

}  // namespace linkstudy

namespace linkstudy::queue {

struct EntryStatus {
  Entry entry;
  EntryState state = EntryState::waiting;
  std::optional<EntryRecord> record;
  std::optional<StudyStatus> study;  // nothing where it has no journal
};

EntryStatus read_status(const Entry& entry);
std::vector<EntryStatus> read_status(Folder& folder);

bool is_any(const std::vector<EntryStatus>& entries, EntryState state);

Table status_table(const std::vector<EntryStatus>& entries);
// One object: counts by state, and the entries.
std::string status_json(const std::vector<EntryStatus>& entries);
// The table and a line with the counts.
std::string status_text(const std::vector<EntryStatus>& entries, std::size_t width);

}  // namespace linkstudy::queue

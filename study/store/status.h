// How far a study is, read from its journal alone: works on running and on dead runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>

#include "study/record/evaluation.h"
#include "study/store/journal.h"

namespace linkstudy {

struct StudyStatus {
  // Evaluations in the design; of a search its budget, and what it took once it has its answer.
  std::uint64_t total = 0;
  bool is_search = false;  // a tune or a calibration
  bool is_complete = false;
  std::uint64_t done = 0;  // ended ok
  std::map<Cause, std::uint64_t> failed;
  bool running = false;          // a process holds the journal
  std::uint64_t references = 0;  // reference runs that have ended
  std::string digest;            // of the results so far
  double started_unix_s = 0.0;   // first start
  double last_write_age_s = 0.0;
  std::string dropped;  // dropped_text of a study that does not run
  // Time left at the rate of the latest start: (total - finished) (t_last_write - t_start) / n,
  // n the evaluations since that start: of a search the most it can be. Empty before the first one.
  std::optional<double> eta_s;

  std::uint64_t failed_count() const;
  std::uint64_t finished() const { return done + failed_count(); }
};

StudyStatus read_status(const std::filesystem::path& directory);

// The same from contents and clocks: seconds since 1970 of the last write and of now.
StudyStatus summarize_status(const JournalContents& contents, double last_write_unix_s,
                             double now_unix_s);

// Now, in seconds since 1970-01-01 UTC, as provenance rows count it.
double unix_time_s();

}  // namespace linkstudy

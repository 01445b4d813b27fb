// DIR/journal.bin, the truth for a resume: append-only, checksummed, one writer. An evaluation is
// acknowledged once it was synced; what was acknowledged survives any kill. A torn or damaged
// record and everything behind it is dropped, never trusted.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "study/store/file.h"
#include "study/store/journal_record.h"
#include "study/store/results.h"
#include "study/store/store_error.h"

namespace linkstudy {

inline constexpr const char* kJournalName = "journal.bin";

struct JournalContents {
  std::uint32_t version = kJournalVersion;
  std::string input_sha256;                 // empty where the run was killed before its header
  std::vector<Evaluation> evaluations;      // by id; the last record of an id counts
  std::vector<TraceSet> traces;             // the last of each name
  std::vector<NamedText> texts;             // the last of each name
  std::vector<StoredReference> references;  // the last of each name
  std::vector<ProvenanceRow> provenance;
  std::optional<StudyDescription> description;
  std::uint64_t evaluations_since_start = 0;  // records after the last provenance row
  std::vector<Evaluation> struck_out;         // by retried_text; the last record of an id counts
  std::uint64_t valid_bytes = 0;
  std::uint64_t dropped_bytes = 0;  // torn or damaged tail
};

// Contents of the bytes of a journal; `path` is for messages. Throws StoreError where the bytes are
// no journal of a version that this program reads.
JournalContents parse_journal(std::string_view bytes, const std::filesystem::path& path);

// Reads DIR/journal.bin of a dead or a running study; takes no lock.
JournalContents read_journal(const std::filesystem::path& directory);

// A journal never forgets, but a later record may change what counts. Rows of these ids that stand
// before the record do not, nor do answers drawn from them: they are run again.
NamedText retried_text(const std::vector<std::uint64_t>& ids);
// The study goes on with the input of this digest, which has all its rows and asks for more.
NamedText input_text(const std::string& input_sha256);

// The journal holds another study: what it is, and how to go on.
class OtherInput : public StoreError {
 public:
  OtherInput(const std::string& fact, const std::string& remedy)
      : StoreError(fact + "; " + remedy), fact_(fact) {}
  const std::string& fact() const { return fact_; }

 private:
  std::string fact_;
};

// What was lost, in a sentence; empty where nothing was. The evaluations that are missing are run
// again when the study is continued.
std::string dropped_text(const JournalContents& contents, const std::filesystem::path& directory);

enum class OpenMode {
  resume,  // continue what is there, if anything
  fresh    // overwrite it, and remove what was derived from it
};

class Journal {
 public:
  // Opens DIR/journal.bin for appending, or creates it, and locks it. DIR exists. Refused: another
  // writer, a journal of another input (OtherInput) or version, a file that is no journal.
  Journal(const std::filesystem::path& directory, const std::string& input_sha256, OpenMode mode);
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;
  ~Journal();

  // What was there when it was opened.
  const JournalContents& contents() const { return contents_; }

  // Writes the record at once; syncs it with the next sync(), after 64 records or 100 ms.
  // After an error the journal is cut back to its last whole record and takes no more.
  void append(const JournalRecord& record);
  void sync();
  // For loops that wait: syncs when the oldest unsynced record is 100 ms old.
  void sync_if_due();

  std::uint64_t appended() const { return appended_; }
  std::uint64_t acknowledged() const { return acknowledged_; }

 private:
  using Clock = std::chrono::steady_clock;

  void start(const std::string& header);
  void resume(const std::string& input_sha256);
  void require_usable() const;

  File file_;
  JournalContents contents_;
  std::uint64_t end_ = 0;  // of the last whole record, bytes
  std::uint64_t appended_ = 0;
  std::uint64_t acknowledged_ = 0;
  Clock::time_point oldest_unsynced_{};
  bool failed_ = false;
};

}  // namespace linkstudy

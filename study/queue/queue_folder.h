// A queue is a folder of files for `study`, `tune`, `calibrate` and `converge`; their models may
// lie beside them. What a file STEM.toml has given is in results/STEM of the folder, and in
// results/STEM.queue who works on it, or how that ended: a lock and one JSON object, written by the
// program that holds it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/config/file_kind.h"
#include "study/store/file.h"

namespace linkstudy::queue {

struct Entry {
  std::string name;                // STEM
  std::filesystem::path file;      // FOLDER/STEM.toml
  std::filesystem::path results;   // FOLDER/results/STEM
  std::filesystem::path record;    // FOLDER/results/STEM.queue
  std::optional<FileKind> kind{};  // nothing where the file cannot be read
  std::string version{};           // another one when the file was written anew
  double age_s = 0.0;              // since then
};

// The files of a folder, each read again only when it was written anew. A model is no entry.
class Folder {
 public:
  // Throws StoreError where it is none, or the results of a study.
  explicit Folder(std::filesystem::path folder);

  // By name. Throws StoreError where it cannot be read any more.
  std::vector<Entry> entries();

 private:
  struct Known {
    std::string version;
    std::optional<FileKind> kind;
  };

  std::optional<FileKind> kind_of(const Entry& entry);

  std::filesystem::path folder_;
  std::map<std::string, Known> known_;
};

// Nothing where a directory is no queue, or the results of one study.
std::optional<Folder> find_queue(const std::filesystem::path& directory);

struct EntryEnd {
  int exit_code = 0;
  std::string verdict;  // in a few words
  double unix_s = 0.0;  // when
};

struct EntryRecord {
  std::string input_sha256;  // of what was run; "" where it could not be read
  std::string version;       // of the file then
  std::string host;
  std::int64_t process = 0;
  int ranks = 0;
  double begun_unix_s = 0.0;
  std::optional<EntryEnd> end{};  // nothing while it runs, or where that was killed
};

// Nothing where nobody has worked on it.
std::optional<EntryRecord> read_record(const Entry& entry);
bool is_held(const Entry& entry);

// The right to work on an entry, for as long as it lives.
class EntryHold {
 public:
  // Nothing where somebody else has it; throws StoreError where results cannot be kept.
  static std::optional<EntryHold> take(const Entry& entry);

  void write(const EntryRecord& record);

 private:
  explicit EntryHold(File file) : file_(std::move(file)) {}

  File file_;
};

}  // namespace linkstudy::queue

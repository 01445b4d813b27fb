#include "study/queue/queue_folder.h"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "study/config/model_document.h"
#include "study/config/toml_reader.h"
#include "study/store/journal.h"
#include "study/store/store_error.h"

namespace linkstudy::queue {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kResults = "results";
constexpr const char* kSuffix = ".queue";
constexpr const char* kInput = ".toml";

[[noreturn]] void fail_at(const fs::path& path, const char* doing, const std::error_code& error) {
  throw StoreError(fmt::format("{}: cannot {}: {}", path.string(), doing, error.message()));
}

Entry make_entry(const fs::path& folder, const fs::path& file) {
  const std::string name = file.stem().string();
  const fs::path results = folder / kResults;
  Entry entry{name, file, results / name, results / (name + kSuffix)};
  const auto written = fs::last_write_time(file);
  entry.version = fmt::format("{}/{}", written.time_since_epoch().count(), fs::file_size(file));
  entry.age_s = std::chrono::duration<double>(fs::file_time_type::clock::now() - written).count();
  return entry;
}

std::optional<FileKind> read_kind(const fs::path& file) {
  Diagnostics ignored;  // whoever runs the file says what is wrong
  const std::optional<Tree> tree = read_toml_file(file.string(), ignored);
  return tree ? linkstudy::kind_of(*tree, ignored) : std::nullopt;
}

std::vector<fs::path> input_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code failed;
  fs::directory_iterator one(folder, failed);
  for (; !failed && one != fs::directory_iterator(); one.increment(failed)) {
    const fs::path& path = one->path();
    const bool is_hidden = path.filename().string().starts_with('.');
    std::error_code ignored;
    if (path.extension() == kInput && !is_hidden && one->is_regular_file(ignored)) {
      files.push_back(path);
    }
  }
  if (failed) fail_at(folder, "read this folder", failed);
  std::ranges::sort(files);
  return files;
}

std::string to_text(const EntryRecord& record) {
  Json json = {{"input_sha256", record.input_sha256},
               {"version", record.version},
               {"host", record.host},
               {"process", record.process},
               {"ranks", record.ranks},
               {"begun_unix_s", record.begun_unix_s},
               {"end", nullptr}};
  if (record.end) {
    json["end"] = {{"exit_code", record.end->exit_code},
                   {"verdict", record.end->verdict},
                   {"unix_s", record.end->unix_s}};
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

// Nothing of a text that is torn.
std::optional<EntryRecord> parse(const std::string& text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    EntryRecord record{json.at("input_sha256"), json.at("version"), json.at("host"),
                       json.at("process"),      json.at("ranks"),   json.at("begun_unix_s")};
    const Json& end = json.at("end");
    if (end.is_object()) record.end = {end.at("exit_code"), end.at("verdict"), end.at("unix_s")};
    return record;
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

}  // namespace

Folder::Folder(fs::path folder) : folder_(std::move(folder)) {
  std::error_code failed;
  if (!fs::is_directory(folder_, failed)) {
    throw StoreError(fmt::format("{}: there is no such folder; name one with the files to run",
                                 folder_.string()));
  }
  if (fs::exists(folder_ / kJournalName, failed)) {
    throw StoreError(fmt::format("{}: holds results ({}); name a folder with the files to run",
                                 folder_.string(), kJournalName));
  }
}

std::vector<Entry> Folder::entries() {
  std::vector<Entry> all;
  for (const fs::path& file : input_files(folder_)) {
    try {
      Entry entry = make_entry(folder_, file);
      entry.kind = kind_of(entry);
      if (entry.kind != FileKind::model) all.push_back(std::move(entry));
    } catch (const fs::filesystem_error&) {
      // Removed since the folder was listed.
    }
  }
  return all;
}

std::optional<FileKind> Folder::kind_of(const Entry& entry) {
  Known& known = known_[entry.name];
  if (known.version != entry.version) known = {entry.version, read_kind(entry.file)};
  return known.kind;
}

std::optional<Folder> find_queue(const fs::path& directory) {
  std::error_code failed;
  if (!fs::is_directory(directory, failed) || fs::exists(directory / kJournalName)) {
    return std::nullopt;
  }
  Folder folder(directory);
  if (folder.entries().empty()) return std::nullopt;
  return folder;
}

std::optional<EntryRecord> read_record(const Entry& entry) {
  std::error_code failed;
  if (!fs::is_regular_file(entry.record, failed)) return std::nullopt;
  return parse(read_file(entry.record));
}

bool is_held(const Entry& entry) {
  std::error_code failed;
  return fs::exists(entry.record, failed) && is_locked(entry.record);
}

std::optional<EntryHold> EntryHold::take(const Entry& entry) {
  std::error_code failed;
  fs::create_directories(entry.record.parent_path(), failed);
  if (failed) fail_at(entry.record.parent_path(), "make this folder for the results", failed);
  File file(entry.record, O_RDWR | O_CREAT);
  if (!file.try_lock()) return std::nullopt;
  return EntryHold(std::move(file));
}

void EntryHold::write(const EntryRecord& record) {
  file_.truncate(0);
  file_.write_all(to_text(record));
  file_.sync_data();
}

}  // namespace linkstudy::queue

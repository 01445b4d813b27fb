#include "study/store/result_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <random>
#include <stdexcept>
#include <system_error>

#include "study/record/bytes.h"
#include "study/record/sha256.h"
#include "study/store/file.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTagName = "CACHEDIR.TAG";
constexpr std::string_view kTag =
    "Signature: 8a477f597d28d172789f06886806bc55\n"
    "# Results of linkstudy, kept by --cache. It may be removed at any time.\n";
constexpr const char* kUnfinished = "unfinished";
constexpr std::string_view kEntryMagic = "linkstC1";
constexpr std::size_t kEntryDigestSize = 64;
constexpr std::size_t kProgramDigits = 16;  // of the name of a folder; files have all
constexpr std::chrono::hours kOld{24};      // nobody writes a file for so long

struct Entry {
  std::string key;
  std::string program;
  std::string rounding;
  std::string bytes;
};

void visit_members(auto& archive, Like<Entry> auto& entry) {
  archive(entry.key, entry.program, entry.rounding, entry.bytes);
}

std::string encode(const Entry& entry) {
  const std::string body = std::string(kEntryMagic) + to_bytes(entry);
  return body + sha256(body);
}

// Nothing where a byte is not as it was written.
std::optional<Entry> decode(std::string_view bytes) {
  if (bytes.size() < kEntryMagic.size() + kEntryDigestSize || !bytes.starts_with(kEntryMagic)) {
    return std::nullopt;
  }
  const std::string_view body = bytes.substr(0, bytes.size() - kEntryDigestSize);
  if (sha256(body) != bytes.substr(body.size())) return std::nullopt;
  try {
    return from_bytes<Entry>(body.substr(kEntryMagic.size()));
  } catch (const std::out_of_range&) {
    return std::nullopt;
  }
}

[[noreturn]] void fail(const fs::path& directory, const std::string& why) {
  throw StoreError(
      fmt::format("{}: {}; choose another directory with --cache", directory.string(), why));
}

// Processes on several machines, or in containers, may have the same number.
std::string make_token() {
  std::random_device source;
  return fmt::format("{}-{:08x}{:08x}", ::getpid(), source(), source());
}

void make_directory(const fs::path& directory) {
  try {
    if (fs::exists(directory) && !fs::is_directory(directory)) fail(directory, "is a file");
    fs::create_directories(directory);
    if (fs::exists(directory / kTagName)) {
      fs::create_directories(directory / kUnfinished);
      return;
    }
    // A second program may be making the same one.
    for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(kTagName) || name == kUnfinished) continue;
      fail(directory, fmt::format("holds other files ('{}') and no cache", name));
    }
    fs::create_directories(directory / kUnfinished);
    const fs::path tag = directory / kUnfinished / fmt::format("{}-{}", kTagName, make_token());
    File(tag, O_WRONLY | O_CREAT | O_TRUNC).write_all(kTag);
    fs::rename(tag, directory / kTagName);
  } catch (const fs::filesystem_error& error) {
    fail(directory, fmt::format("cannot hold a cache: {}", error.code().message()));
  }
}

// What killed programs left.
void remove_old(const fs::path& unfinished) {
  std::error_code ignored;  // another program does the same
  const auto now = fs::file_time_type::clock::now();
  for (const fs::directory_entry& entry : fs::directory_iterator(unfinished, ignored)) {
    const auto written = entry.last_write_time(ignored);
    if (!ignored && now - written > kOld) fs::remove(entry.path(), ignored);
  }
}

fs::path path_in(const fs::path& folder, const std::string& key) {
  return folder / key.substr(0, 2) / key.substr(2);
}

}  // namespace

std::string MadeBy::folder() const {
  return fmt::format("{}-{}", program.substr(0, kProgramDigits), rounding);
}

ResultCache::ResultCache(fs::path directory, MadeBy made_by)
    : directory_(std::move(directory)), made_by_(std::move(made_by)), token_(make_token()) {
  make_directory(directory_);
  remove_old(directory_ / kUnfinished);
  for (const fs::directory_entry& entry : fs::directory_iterator(directory_)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && name != kUnfinished && name != made_by_.folder()) {
      others_.push_back(name);
    }
  }
}

fs::path ResultCache::path_of(const std::string& key) const {
  return path_in(directory_ / made_by_.folder(), key);
}

CacheAnswer ResultCache::find(const std::string& key) const {
  const fs::path path = path_of(key);
  if (::access(path.c_str(), F_OK) != 0) return {std::nullopt, explain(key)};
  std::optional<Entry> entry;
  try {
    entry = decode(read_file(path));
  } catch (const StoreError&) {
    // It cannot be read, or has gone at this moment.
  }
  if (!entry || entry->key != key) return {std::nullopt, CacheMiss::damaged};
  // The digits of a folder are not all.
  if (entry->program != made_by_.program) return {std::nullopt, CacheMiss::other_program};
  return {std::move(entry->bytes), CacheMiss::unknown};
}

CacheMiss ResultCache::explain(const std::string& key) const {
  CacheMiss miss = CacheMiss::unknown;
  for (const std::string& other : others_) {
    if (::access(path_in(directory_ / other, key).c_str(), F_OK) != 0) continue;
    const bool is_same_program = other.starts_with(made_by_.program.substr(0, kProgramDigits));
    if (is_same_program) return CacheMiss::other_rounding;
    miss = CacheMiss::other_program;
  }
  return miss;
}

void ResultCache::keep(const std::string& key, std::string_view bytes) {
  const fs::path path = path_of(key);
  const fs::path unfinished = directory_ / kUnfinished / fmt::format("{}-{}", token_, written_++);
  try {
    fs::create_directories(path.parent_path());
    File(unfinished, O_WRONLY | O_CREAT | O_TRUNC)
        .write_all(encode({key, made_by_.program, made_by_.rounding, std::string(bytes)}));
    fs::rename(unfinished, path);
  } catch (const fs::filesystem_error& error) {
    throw StoreError(fmt::format("{}: {}", path.string(), error.code().message()));
  } catch (const StoreError&) {
    std::error_code ignored;
    fs::remove(unfinished, ignored);
    throw;
  }
}

}  // namespace linkstudy

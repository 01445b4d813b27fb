#include "study/store/directory.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "study/store/file.h"
#include "study/store/journal.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

namespace fs = std::filesystem;

constexpr std::array kDerivedNames = {kResultsName, kResolvedName, kReportName};

fs::path earlier_journal(const fs::path& directory, std::size_t number) {
  return directory / fmt::format("journal_{}.bin", number);
}

bool is_earlier_journal(const std::string& name) {
  constexpr std::string_view kBegin = "journal_", kEnd = ".bin";
  if (!name.starts_with(kBegin) || !name.ends_with(kEnd)) return false;
  const std::string number = name.substr(kBegin.size(), name.size() - kBegin.size() - kEnd.size());
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

bool is_ours(const std::string& name) {
  return name == kLogName || is_earlier_journal(name) ||
         std::ranges::any_of(kDerivedNames, [&](const std::string& derived) {
           return name == derived || name == derived + ".tmp";
         });
}

void require_ours(const fs::path& directory) {
  for (const fs::directory_entry& entry : fs::directory_iterator(directory)) {
    const std::string name = entry.path().filename().string();
    if (!is_ours(name)) {
      throw StoreError(fmt::format(
          "{}: the directory holds other files ('{}') and no study; choose a new or an empty "
          "directory with -o",
          directory.string(), name));
    }
  }
}

bool has_header(const fs::path& journal) {
  return fs::exists(journal) && fs::file_size(journal) >= kJournalHeaderSize;
}

// A killed start leaves a torn header behind, but no results: those are made from the journal.
void require_no_results(const fs::path& directory) {
  for (const char* name : {kResultsName, kReportName}) {
    if (!fs::exists(directory / name)) continue;
    throw StoreError(
        fmt::format("{}: holds results ({}) but no {} to continue them from; choose another "
                    "directory with -o or overwrite them with --fresh",
                    directory.string(), name, kJournalName));
  }
}

}  // namespace

void prepare_directory(const fs::path& directory, bool fresh) {
  try {
    if (fs::exists(directory) && !fs::is_directory(directory)) {
      throw StoreError(
          fmt::format("{}: is a file; choose a directory with -o", directory.string()));
    }
    fs::create_directories(directory);
    if (!fs::exists(directory / kJournalName)) require_ours(directory);
    // Killed between setting a journal aside and beginning the next, it has its rows all the same.
    const bool has_rows =
        has_header(directory / kJournalName) || !earlier_journals(directory).empty();
    if (!fresh && !has_rows) require_no_results(directory);
  } catch (const fs::filesystem_error& error) {
    throw StoreError(fmt::format("{}: cannot use this directory: {}; choose another with -o",
                                 directory.string(), error.code().message()));
  }
}

std::vector<fs::path> earlier_journals(const fs::path& directory) {
  std::vector<fs::path> paths;
  for (std::size_t i = 1; fs::exists(earlier_journal(directory, i)); ++i) {
    paths.push_back(earlier_journal(directory, i));
  }
  return paths;
}

void set_journal_aside(const fs::path& directory) {
  const fs::path aside = earlier_journal(directory, earlier_journals(directory).size() + 1);
  replace_file(directory / kJournalName, aside);
  remove_derived_files(directory);
}

void remove_earlier_journals(const fs::path& directory) {
  for (const fs::path& path : earlier_journals(directory)) fs::remove(path);
}

void remove_derived_files(const fs::path& directory) {
  for (const std::string name : kDerivedNames) {
    std::error_code ignored;  // what cannot be removed is replaced or reported when it is written
    fs::remove(directory / name, ignored);
    fs::remove(directory / (name + ".tmp"), ignored);
  }
}

}  // namespace linkstudy

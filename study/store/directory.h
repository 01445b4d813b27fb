// The directory of a study: DIR/journal.bin, resolved.toml, results.h5, report.html, linkstudy.log.
#pragma once

#include <filesystem>
#include <vector>

namespace linkstudy {

inline constexpr const char* kResultsName = "results.h5";
inline constexpr const char* kResolvedName = "resolved.toml";
inline constexpr const char* kReportName = "report.html";
inline constexpr const char* kLogName = "linkstudy.log";

// Creates the directory, or makes sure that a study may live in what is there: it is empty, holds a
// journal, or holds nothing but files of a study that ended before its journal began. Anything else
// is refused with StoreError, and nothing is touched: a study never mixes with other files.
// Results without a journal (or with one that has lost its header) are refused too, unless `fresh`:
// they would be overwritten and not continued.
void prepare_directory(const std::filesystem::path& directory, bool fresh = false);

// Journals of studies that the one here goes on from: journal_1.bin, journal_2.bin, ..., in this
// order.
std::vector<std::filesystem::path> earlier_journals(const std::filesystem::path& directory);
// Makes the journal the last of them, and removes what was computed from it.
void set_journal_aside(const std::filesystem::path& directory);
void remove_earlier_journals(const std::filesystem::path& directory);

// Removes what was computed from the journal, and left-over temporary files; not the log.
void remove_derived_files(const std::filesystem::path& directory);

}  // namespace linkstudy

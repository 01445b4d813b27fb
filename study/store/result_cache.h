// Results of finished runs in a directory that many studies share, one file each:
//   DIR/CACHEDIR.TAG                  says what the directory is (bford.info/cachedir)
//   DIR/<program>-<rounding>/ab/cd..  the result of the key abcd..., made by that program
//   DIR/unfinished/                   files that are being written
// A file is written whole and renamed, so that any number of programs may use a cache at once and
// may be killed at any time. It repeats its key and who made it, with a SHA-256 over all: what is
// damaged or cut is as good as absent. Nothing is read but what is asked for. Files may be removed
// at any time.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace linkstudy {

// Whose results have the same bits.
struct MadeBy {
  std::string program;   // digest of the executable
  std::string rounding;  // "fma", "baseline": what the instruction set decides

  std::string folder() const;
};

enum class CacheMiss { unknown, other_program, other_rounding, damaged };

struct CacheAnswer {
  std::optional<std::string> bytes;
  CacheMiss miss = CacheMiss::unknown;  // where there are none
};

class ResultCache {
 public:
  // Makes the directory where it is not there. Throws StoreError where it is none of a cache, or
  // where it cannot be written to.
  ResultCache(std::filesystem::path directory, MadeBy made_by);

  // `key`: 64 hexadecimal digits.
  CacheAnswer find(const std::string& key) const;
  // Throws StoreError (no space left).
  void keep(const std::string& key, std::string_view bytes);

  const std::filesystem::path& directory() const { return directory_; }
  std::filesystem::path path_of(const std::string& key) const;

 private:
  CacheMiss explain(const std::string& key) const;

  std::filesystem::path directory_;
  MadeBy made_by_;
  std::vector<std::string> others_;  // folders of other programs, as they were at the start
  std::string token_;                // of this process, for names of unfinished files
  std::size_t written_ = 0;
};

}  // namespace linkstudy

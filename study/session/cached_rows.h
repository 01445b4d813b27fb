// Evaluations and reference runs of a cache (store/result_cache.h) by what they are
// (evaluate/case_key.h, limits of runs included). Kept is what would end the same again: not what
// failed for a cause that passes.
#pragma once

#include <spdlog/logger.h>

#include <map>
#include <memory>

#include "study/evaluate/case_key.h"
#include "study/store/result_cache.h"

namespace linkstudy {

class CachedRows {
 public:
  // `log` outlives this.
  CachedRows(ResultCache cache, spdlog::logger& log);

  // Under the id it had.
  std::optional<Evaluation> find(const CaseKey& key);
  void keep(const CaseKey& key, const Evaluation& evaluation);
  std::optional<std::string> find_reference(const CaseKey& key);
  void keep_reference(const CaseKey& key, const std::string& bytes);

  // "cache DIR: 11 rows and 1 reference run taken; 1 was not there (1 new)"
  std::string summary() const;

 private:
  std::optional<std::string> find_bytes(const std::string& key);
  void keep_bytes(const std::string& key, const std::string& bytes);
  void note_damaged(const std::string& key);

  ResultCache cache_;
  spdlog::logger& log_;
  std::size_t rows_ = 0;
  std::size_t references_ = 0;
  std::map<CacheMiss, std::size_t> misses_;
  bool is_full_ = false;  // something could not be written: no more is kept
};

// The cache of this program and instruction set. Throws StoreError.
ResultCache open_cache(const std::string& directory);

}  // namespace linkstudy

// Evaluations and reference runs of a cache (store/result_cache.h) by what they are
// (evaluate/case_key.h, limits of runs included). Kept is what would end the same again: not what
// failed for a cause that passes.
#pragma once

#include <spdlog/logger.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "study/evaluate/case_key.h"
#include "study/store/result_cache.h"

namespace linkstudy {

// A reference run as it is sent and kept (evaluate/reference_bytes.h), and what it warns of.
struct KnownReference {
  std::string bytes;
  std::vector<std::string> warnings;
};

void visit_members(auto& archive, Like<KnownReference> auto& reference) {
  archive(reference.bytes, reference.warnings);
}

class CachedRows {
 public:
  // `log` outlives this.
  CachedRows(ResultCache cache, spdlog::logger& log);

  // Under the id it had.
  std::optional<Evaluation> find(const CaseKey& key);
  void keep(const CaseKey& key, const Evaluation& evaluation);
  std::optional<KnownReference> find_reference(const CaseKey& key);
  void keep_reference(const CaseKey& key, const KnownReference& reference);

  // "cache DIR: 11 rows and 1 reference run taken; 1 was not there (1 new)"
  std::string summary() const;

 private:
  template <class Record>
  std::optional<Record> find_record(const std::string& key);
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

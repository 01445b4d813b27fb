// Rows of the journals that were set aside in a results directory (continuation.h), found by what
// they are (evaluate/case_key.h) and not by their ids. Read when first asked.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>

#include "study/session/row_comparison.h"

namespace linkstudy {

class EarlierRows {
 public:
  // `now` is this start: rows of instruction sets that round otherwise are refused.
  EarlierRows(const std::filesystem::path& directory, const ProvenanceRow& now);

  bool has_any() const { return !journals_.empty(); }
  // With everything that is kept of it, but under its old id. What a wider limit may let go on is
  // not among them. Throws StoreError.
  std::optional<Evaluation> find(const CaseKey& key);
  // Attempts at a row that is run again.
  std::uint32_t attempts(const CaseKey& key);
  // Bytes of a reference run, or null.
  const std::string* find_reference(const CaseKey& key);

  std::size_t size();  // rows, each case once

 private:
  struct Row {
    CaseKey key;
    std::size_t study;
    std::size_t row;  // among the evaluations of its study
  };
  struct Study;

  void read();
  void add_study(const std::filesystem::path& path);

  std::vector<std::filesystem::path> journals_;
  ProvenanceRow now_;
  bool is_read_ = false;
  std::vector<std::shared_ptr<Study>> studies_;
  std::unordered_map<std::string, Row> rows_;                // by digest
  std::unordered_map<std::string, std::uint32_t> attempts_;  // likewise, of rows struck out
  std::unordered_map<std::string, std::string> references_;  // by digest, their bytes
};

}  // namespace linkstudy

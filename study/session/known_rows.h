// Evaluations and reference runs of this study that some other run has made and that are not made
// again. Rank 0.
#pragma once

#include <optional>
#include <string>

#include "study/session/cached_rows.h"
#include "study/session/earlier_rows.h"

namespace linkstudy {

class KnownRows {
 public:
  // Without a cache: null.
  KnownRows(const Evaluator& evaluator, EarlierRows earlier, std::unique_ptr<CachedRows> cache);

  // The evaluation of the point under its id, as it was run: time, rank and host are of then.
  std::optional<Evaluation> find(const Point& point);
  // Attempts at it before those of this start.
  std::uint32_t attempts(const Point& point);
  std::optional<KnownReference> find_reference(std::size_t load_case);
  // What was run, for others to find.
  void keep(const Evaluation& evaluation);
  void keep_reference(std::size_t load_case, const KnownReference& reference);

  // How many rows came from where, and why others did not, in lines; empty where there was nothing
  // to ask.
  std::string summary();

 private:
  bool has_any() const { return earlier_.has_any() || cache_; }
  const CaseKeys& keys();

  const Evaluator& evaluator_;
  EarlierRows earlier_;
  std::unique_ptr<CachedRows> cache_;
  std::optional<CaseKeys> keys_;              // made when first asked
  std::map<std::uint64_t, CaseKey> missing_;  // by id, of those that were not found
  std::size_t from_earlier_ = 0;
};

}  // namespace linkstudy

#include "study/session/cached_rows.h"

#include <fmt/format.h>

#include <stdexcept>

#include "core/base/isa.h"
#include "core/base/words.h"
#include "study/record/counted.h"
#include "study/record/program_digest.h"
#include "study/record/transient.h"
#include "study/session/warnings.h"
#include "study/store/store_error.h"

namespace linkstudy {

template <>
inline constexpr auto kWords<CacheMiss> =
    make_words<CacheMiss>({{CacheMiss::unknown, "new"},
                           {CacheMiss::other_program, "of another program"},
                           {CacheMiss::other_rounding, "of another instruction set"},
                           {CacheMiss::damaged, "damaged"}});

CachedRows::CachedRows(ResultCache cache, spdlog::logger& log)
    : cache_(std::move(cache)), log_(log) {}

std::optional<Evaluation> CachedRows::find(const CaseKey& key) {
  auto whole = find_record<WholeEvaluation>(key.with_caps());
  if (!whole) return std::nullopt;
  ++rows_;
  return std::move(whole->evaluation);
}

void CachedRows::keep(const CaseKey& key, const Evaluation& evaluation) {
  if (is_transient(evaluation.status)) return;
  keep_bytes(key.with_caps(), to_bytes(WholeEvaluation{evaluation}));
}

std::optional<KnownReference> CachedRows::find_reference(const CaseKey& key) {
  auto reference = find_record<KnownReference>(key.with_caps());
  if (reference) ++references_;
  return reference;
}

void CachedRows::keep_reference(const CaseKey& key, const KnownReference& reference) {
  keep_bytes(key.with_caps(), to_bytes(reference));
}

template <class Record>
std::optional<Record> CachedRows::find_record(const std::string& key) {
  const CacheAnswer answer = cache_.find(key);
  try {
    if (answer.bytes) return from_bytes<Record>(*answer.bytes);
  } catch (const std::out_of_range&) {
    note_damaged(key);
    return std::nullopt;
  }
  if (answer.miss == CacheMiss::damaged) {
    note_damaged(key);
  } else {
    ++misses_[answer.miss];
  }
  return std::nullopt;
}

// Said of the first; the summary counts them.
void CachedRows::note_damaged(const std::string& key) {
  if (++misses_[CacheMiss::damaged] > 1) return;
  say_warning(fmt::format("{} is damaged and is made anew, as others of this cache that are",
                          cache_.path_of(key).string()),
              log_);
}

void CachedRows::keep_bytes(const std::string& key, const std::string& bytes) {
  if (is_full_) return;
  try {
    cache_.keep(key, bytes);
  } catch (const StoreError& error) {
    is_full_ = true;
    say_warning(fmt::format("the cache takes no more: {}", error.what()), log_);
  }
}

std::string CachedRows::summary() const {
  std::string text = fmt::format("cache {}: {} and {} taken", cache_.directory().string(),
                                 counted(static_cast<std::int64_t>(rows_), "row"),
                                 counted(static_cast<std::int64_t>(references_), "reference run"));
  std::size_t all = 0;
  std::string reasons;
  for (const auto& [miss, count] : misses_) {
    all += count;
    reasons += fmt::format("{}{} {}", reasons.empty() ? "" : ", ", count, name_of(miss));
  }
  if (all == 0) return text;
  return text + fmt::format("; {} not there ({})", all == 1 ? "1 was" : fmt::format("{} were", all),
                            reasons);
}

ResultCache open_cache(const std::string& directory) {
  const std::string program = program_digest();
  if (program.empty()) {
    throw StoreError(
        "--cache: the file of this program cannot be read, and results are kept by what it is; "
        "leave out --cache");
  }
  const bool is_baseline = simd_level().isa == InstructionSet::baseline;
  return {directory, {program, is_baseline ? "baseline" : "fma"}};
}

}  // namespace linkstudy

#include "study/session/known_rows.h"

#include <fmt/format.h>

#include "study/record/counted.h"

namespace linkstudy {

KnownRows::KnownRows(const Evaluator& evaluator, EarlierRows earlier,
                     std::unique_ptr<CachedRows> cache)
    : evaluator_(evaluator), earlier_(std::move(earlier)), cache_(std::move(cache)) {}

const CaseKeys& KnownRows::keys() {
  if (!keys_) keys_.emplace(evaluator_);
  return *keys_;
}

std::optional<Evaluation> KnownRows::find(const Point& point) {
  if (!has_any()) return std::nullopt;
  const std::optional<CaseKey> key = keys().of(point.values);
  if (!key) return std::nullopt;
  std::optional<Evaluation> found;
  if (earlier_.has_any()) found = earlier_.find(*key);
  from_earlier_ += found ? 1 : 0;
  if (!found && cache_) found = cache_->find(*key);
  if (found) {
    found->point = point;
  } else {
    missing_[point.id] = *key;
  }
  return found;
}

std::uint32_t KnownRows::attempts(const Point& point) {
  const auto key = missing_.find(point.id);
  return key == missing_.end() || !earlier_.has_any() ? 0 : earlier_.attempts(key->second);
}

void KnownRows::keep(const Evaluation& evaluation) {
  const auto key = missing_.find(evaluation.point.id);
  if (key == missing_.end()) return;
  if (cache_) cache_->keep(key->second, evaluation);
  missing_.erase(key);
}

std::optional<KnownReference> KnownRows::find_reference(std::size_t load_case) {
  if (!has_any()) return std::nullopt;
  const CaseKey key = keys().of_reference(load_case);
  if (earlier_.has_any()) {
    if (const std::string* bytes = earlier_.find_reference(key)) return KnownReference{*bytes, {}};
  }
  return cache_ ? cache_->find_reference(key) : std::nullopt;
}

void KnownRows::keep_reference(std::size_t load_case, const KnownReference& reference) {
  if (cache_) cache_->keep_reference(keys().of_reference(load_case), reference);
}

std::string KnownRows::summary() {
  std::string text = cache_ ? cache_->summary() : "";
  if (from_earlier_ == 0) return text;
  return fmt::format("{} of {} taken from journals set aside{}{}",
                     counted(static_cast<std::int64_t>(from_earlier_), "row"), earlier_.size(),
                     text.empty() ? "" : "\n", text);
}

}  // namespace linkstudy

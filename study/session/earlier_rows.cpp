#include "study/session/earlier_rows.h"

#include <algorithm>

#include "study/session/study_record.h"
#include "study/store/directory.h"
#include "study/store/file.h"
#include "study/store/results_file.h"

namespace linkstudy {

// What is stored apart, by the id of the evaluation.
struct EarlierRows::Study {
  explicit Study(StudyResults stored) : earlier(std::move(stored)) {
    const StudyResults& results = earlier.results;
    for (const TraceSet& set : results.traces) traces.emplace(set.evaluation, &set);
    for (const Table& table : results.contacts) {
      const Attribute* id = find_attribute(table, "evaluation");
      if (id != nullptr) contacts.emplace(std::get<std::int64_t>(id->value), &table);
    }
  }

  Evaluation whole(std::size_t row) const {
    Evaluation evaluation = earlier.results.evaluations.at(row);
    const auto id = static_cast<std::int64_t>(evaluation.point.id);
    for (auto [at, end] = traces.equal_range(id); at != end; ++at) {
      evaluation.traces.push_back({load_case_of(at->second->name, id), at->second->traces});
    }
    for (auto [at, end] = contacts.equal_range(id); at != end; ++at) {
      evaluation.contacts.push_back({load_case_of(at->second->name, id), *at->second});
    }
    return evaluation;
  }

  EarlierStudy earlier;
  std::multimap<std::int64_t, const TraceSet*> traces;
  std::multimap<std::int64_t, const Table*> contacts;
};

EarlierRows::EarlierRows(const std::filesystem::path& directory, const ProvenanceRow& now)
    : journals_(earlier_journals(directory)), now_(now) {}

std::optional<Evaluation> EarlierRows::find(const CaseKey& key) {
  read();
  const auto found = rows_.find(key.digest);
  if (found == rows_.end()) return std::nullopt;
  const Row& row = found->second;
  const Study& study = *studies_[row.study];
  const Cause status = study.earlier.results.evaluations[row.row].status;
  const bool counts =
      compare_caps(row.key, key) != CapChange::narrower && !is_ended_by_caps(status, row.key, key);
  return counts ? std::optional(study.whole(row.row)) : std::nullopt;
}

std::uint32_t EarlierRows::attempts(const CaseKey& key) {
  read();
  const auto found = attempts_.find(key.digest);
  return found == attempts_.end() ? 0 : found->second;
}

const std::string* EarlierRows::find_reference(const CaseKey& key) {
  read();
  const auto found = references_.find(key.with_caps());
  return found == references_.end() ? nullptr : &found->second;
}

std::size_t EarlierRows::size() {
  read();
  return rows_.size();
}

void EarlierRows::read() {
  if (is_read_) return;
  is_read_ = true;
  for (const std::filesystem::path& path : journals_) add_study(path);
}

// Rows of later journals stand for those of earlier ones: they may have been tried again.
void EarlierRows::add_study(const std::filesystem::path& path) {
  JournalContents contents = parse_journal(read_file(path), path);
  if (!contents.description) return;
  refuse_other_rounding(contents, now_, path.parent_path());
  const auto study = std::make_shared<Study>(results_from(contents));
  const EarlierStudy& earlier = study->earlier;
  for (const Evaluation& one : contents.struck_out) {
    if (const auto key = earlier.keys.of(one.point.values)) attempts_[key->digest] = one.attempts;
  }
  const std::vector<Evaluation>& evaluations = earlier.results.evaluations;
  for (std::size_t i = 0; i < evaluations.size(); ++i) {
    const auto key = earlier.keys.of(evaluations[i].point.values);
    if (key) rows_.insert_or_assign(key->digest, Row{*key, studies_.size(), i});
  }
  for (std::size_t i = 0; i < earlier.evaluator->load_case_count(); ++i) {
    if (!earlier.evaluator->has_reference(i)) continue;
    const std::string& name = earlier.evaluator->load_case_name(i);
    const auto stored = std::ranges::find(contents.references, name, &StoredReference::name);
    if (stored == contents.references.end()) continue;
    references_[earlier.keys.of_reference(i).with_caps()] = std::move(stored->bytes);
  }
  studies_.push_back(study);
}

}  // namespace linkstudy

#include "study/session/study_record.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "core/base/isa.h"
#include "study/record/version.h"
#include "study/store/directory.h"
#include "study/store/file.h"
#include "study/store/results_file.h"
#include "study/store/status.h"
#include "study/store/store_error.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kFirstWrite{30};
constexpr int kWriteShare = 50;

// Makes the directory; the rest of the members follow it.
const std::filesystem::path& prepared(const std::filesystem::path& directory, bool fresh) {
  prepare_directory(directory, fresh);
  return directory;
}

bool was_begun_by_job(const std::filesystem::path& directory, const ProvenanceRow& now) {
  if (now.restart == 0 || !std::filesystem::exists(directory / kJournalName)) return false;
  const std::vector<ProvenanceRow> rows = read_journal(directory).provenance;
  return std::ranges::any_of(rows, [&](const ProvenanceRow& row) {
    return row.job == now.job && row.restart < now.restart;
  });
}

// A study in which nothing is left to do may be started on any.
void require_same_rounding(const JournalContents& contents, const ProvenanceRow& now,
                           const std::filesystem::path& directory) {
  if (summarize_status(contents, 0.0, 0.0).is_complete) return;
  refuse_other_rounding(contents, now, directory);
}

std::string with_case(const std::string& base, const std::string& load_case) {
  return load_case.empty() ? base : base + "_" + load_case;
}

const std::string& text_named(const std::vector<NamedText>& texts, const std::string& name) {
  return std::ranges::find(texts, name, &NamedText::name)->text;
}

// "evaluation_12_fast"
std::string trace_name(std::uint64_t evaluation, const std::string& load_case) {
  return with_case(fmt::format("evaluation_{}", evaluation), load_case);
}

}  // namespace

std::string load_case_of(const std::string& name, std::int64_t evaluation) {
  const std::string own = trace_name(static_cast<std::uint64_t>(evaluation), "");
  return name.size() > own.size() ? name.substr(own.size() + 1) : "";
}

void refuse_other_rounding(const JournalContents& contents, const ProvenanceRow& now,
                           const std::filesystem::path& directory) {
  if (contents.evaluations.empty() || contents.provenance.empty()) return;
  const std::string& before = contents.provenance.back().simd;
  const std::string baseline(name_of(InstructionSet::baseline));
  if (before.empty() || (before == baseline) == (now.simd == baseline)) return;
  const bool is_choice = before == baseline;
  throw StoreError(fmt::format(
      "{}: {} evaluations were made with instruction set {}, this start has {}, which rounds "
      "differently; {}, or overwrite them with --fresh",
      directory.string(), contents.evaluations.size(), before, now.simd,
      is_choice ? "continue with LINKSTUDY_SIMD=baseline" : "continue on a machine that has it"));
}

const std::vector<Trace>* find_traces(const StudyResults& results, std::uint64_t evaluation,
                                      const std::string& load_case) {
  const auto found =
      std::ranges::find(results.traces, trace_name(evaluation, load_case), &TraceSet::name);
  return found == results.traces.end() ? nullptr : &found->traces;
}

std::vector<std::string> load_cases_with_traces(const StudyResults& results,
                                                std::uint64_t evaluation) {
  std::vector<std::string> names;
  for (const TraceSet& set : results.traces) {
    if (set.evaluation != static_cast<std::int64_t>(evaluation)) continue;
    names.push_back(load_case_of(set.name, set.evaluation));
  }
  return names;
}

std::string slug_of(const std::string& name) {
  std::string slug;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 128 && std::isalnum(byte) != 0) {
      slug += static_cast<char>(std::tolower(byte));
    } else if (!slug.empty() && slug.back() != '-') {
      slug += '-';
    }
  }
  while (!slug.empty() && slug.back() == '-') slug.pop_back();
  return slug.empty() ? "study" : slug.substr(0, 80);
}

StudyRecord::StudyRecord(std::filesystem::path directory, const StudyIdentity& identity, bool fresh)
    : directory_(std::move(directory)),
      is_made_(!std::filesystem::exists(directory_)),
      keeps_own_job_(fresh && was_begun_by_job(directory_, identity.start)),
      journal_(prepared(directory_, fresh), identity.input_sha256,
               fresh && !keeps_own_job_ ? OpenMode::fresh : OpenMode::resume),
      next_write_(Clock::now() + kFirstWrite) {
  require_same_rounding(journal_.contents(), identity.start, directory_);
  is_resumed_ = journal_.contents().description.has_value();
  if (!is_resumed_) journal_.append(identity.description);
  for (const NamedText& text : identity.texts) journal_.append(text);
  ProvenanceRow row = identity.start;
  row.event = is_resumed_ ? "resume" : "start";
  journal_.append(row);
  journal_.sync();
  results_ = results_from(journal_.contents());
  results_.description = identity.description;
  results_.texts = identity.texts;
  results_.provenance.push_back(row);
  results_.program_version = row.program_version;
  results_.git_revision = row.git_revision;
  results_.input_sha256 = identity.input_sha256;
  for (const Evaluation& evaluation : results_.evaluations) {
    evaluations_[evaluation.point.id] = evaluation;
  }
  for (const Evaluation& one : journal_.contents().struck_out) {
    attempts_before_[one.point.id] = one.attempts;
  }
  write_file_atomically(directory_ / kResolvedName, text_named(identity.texts, "resolved"));
}

void StudyRecord::discard_if_empty() {
  if (!is_made_ || !evaluations_.empty()) return;
  std::error_code ignored;  // what cannot be removed stays and is continued next time
  std::filesystem::remove_all(directory_, ignored);
}

std::map<Cause, std::uint64_t> StudyRecord::failures() const {
  std::map<Cause, std::uint64_t> counts;
  for (const auto& [id, evaluation] : evaluations_) {
    if (evaluation.status != Cause::ok) ++counts[evaluation.status];
  }
  return counts;
}

std::uint64_t StudyRecord::failure_count() const {
  std::uint64_t sum = 0;
  for (const auto& [cause, count] : failures()) sum += count;
  return sum;
}

void StudyRecord::add_traces(TraceSet set) {
  journal_.append(set);
  auto& sets = set.evaluation < 0 ? results_.references : results_.traces;
  const auto found = std::ranges::find(sets, set.name, &TraceSet::name);
  if (found == sets.end()) {
    sets.push_back(std::move(set));
  } else {
    *found = std::move(set);
  }
}

// What is stored apart first: an evaluation that is in the journal has it there.
const Evaluation& StudyRecord::add(Evaluation evaluation) {
  const std::uint64_t id = evaluation.point.id;
  if (const auto before = attempts_before_.find(id); before != attempts_before_.end()) {
    evaluation.attempts += before->second;
  }
  for (const CaseTraces& set : std::exchange(evaluation.traces, {})) {
    add_traces({trace_name(id, set.load_case), static_cast<std::int64_t>(id), set.traces});
  }
  for (CaseTable& one : std::exchange(evaluation.contacts, {})) {
    one.table.name = trace_name(id, one.load_case);
    one.table.attributes = {{"evaluation", static_cast<std::int64_t>(id)}};
    journal_.append(contacts_text(one.table));
    std::erase_if(results_.contacts, [&](const Table& t) { return t.name == one.table.name; });
    results_.contacts.push_back(std::move(one.table));
  }
  if (!evaluation.derived.empty()) journal_.append(derived_set(evaluation));
  if (!evaluation.residuals.empty()) journal_.append(residuals_set(evaluation));
  journal_.append(evaluation);
  return evaluations_[evaluation.point.id] = std::move(evaluation);
}

void StudyRecord::add_references(const std::vector<CaseTraces>& references) {
  if (!results_.references.empty()) return;
  for (const CaseTraces& set : references) {
    add_traces({with_case("reference", set.load_case), -1, set.traces});
  }
}

void StudyRecord::add_reference(StoredReference reference) {
  journal_.append(reference);
  journal_.sync();
  references_.push_back(std::move(reference));
}

const StoredReference* StudyRecord::reference(const std::string& name) const {
  for (const auto* all : {&references_, &journal_.contents().references}) {
    const auto found = std::ranges::find(*all, name, &StoredReference::name);
    if (found != all->end()) return &*found;
  }
  return nullptr;
}

void StudyRecord::set_answer(AnswerKind kind, const std::string& json, std::vector<Table> tables) {
  const std::string name = slug_of(results_.description.name);
  results_.answers = {{kind, {name, {}, {{"answer", json}}, std::move(tables)}}};
  for (const NamedText& text : answer_texts(results_.answers.front())) journal_.append(text);
}

void StudyRecord::note_kernels() {
  const std::string written = written_text();
  NamedText now{"kernels", kernels_text()};
  if (!written.empty()) now.text += ", " + written + " on rank 0";
  note(std::move(now));
}

void StudyRecord::note(NamedText text) {
  const auto found = std::ranges::find(results_.texts, text.name, &NamedText::name);
  if (found != results_.texts.end() && found->text == text.text) return;
  journal_.append(text);
  if (found == results_.texts.end()) {
    results_.texts.push_back(std::move(text));
  } else {
    *found = std::move(text);
  }
}

std::string StudyRecord::write(RunStatus status) {
  note_kernels();
  journal_.sync();
  results_.status = status;
  results_.evaluations.clear();
  for (const auto& [id, evaluation] : evaluations_) results_.evaluations.push_back(evaluation);
  std::ranges::stable_sort(results_.traces, {}, &TraceSet::evaluation);
  return write_results(results_path(), results_);
}

void StudyRecord::write_if_due() {
  const auto begin = Clock::now();
  if (begin < next_write_) return;
  write(RunStatus::running);
  results_.evaluations = {};  // until they are written again, one copy is enough
  malloc_trim(0);
  const auto end = Clock::now();
  next_write_ = end + std::max<Clock::duration>(kFirstWrite, kWriteShare * (end - begin));
}

std::filesystem::path StudyRecord::results_path() const {
  return directory_ / kResultsName;
}

}  // namespace linkstudy

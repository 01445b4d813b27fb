// Rank 0's hold on a results directory while a study or tune runs: the journal, what is in it so
// far, and the files made from it.
#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "study/store/journal.h"
#include "study/store/results.h"

namespace linkstudy {

// A name as part of a path: "Lowest stiffness of RSRRP" -> "lowest-stiffness-of-rsrrp".
std::string slug_of(const std::string& name);

// Histories of an evaluation in a load case, or null.
const std::vector<Trace>* find_traces(const StudyResults& results, std::uint64_t evaluation,
                                      const std::string& load_case);

// Load cases in which an evaluation has histories; one empty name where there are no load cases.
std::vector<std::string> load_cases_with_traces(const StudyResults& results,
                                                std::uint64_t evaluation);

// The load case of a set of traces or of contacts of an evaluation, by its name.
std::string load_case_of(const std::string& name, std::int64_t evaluation);

// Evaluations of one study come from sets that round alike: with fused multiply-adds or without.
// Throws StoreError where this start does not.
void refuse_other_rounding(const JournalContents& contents, const ProvenanceRow& now,
                           const std::filesystem::path& directory);

struct StudyIdentity {
  StudyDescription description;
  std::string input_sha256;
  std::vector<NamedText> texts;
  ProvenanceRow start;  // event is filled in
};

class StudyRecord {
 public:
  // Prepares the directory and opens the journal (store/directory.h, store/journal.h say what is
  // refused). `fresh` overwrites what is there; but what an earlier start of the same job of a
  // queue left is continued: a requeued job has the same command line.
  StudyRecord(std::filesystem::path directory, const StudyIdentity& identity, bool fresh);
  // Removes a directory in which nothing was ever evaluated and that was made for this.
  void discard_if_empty();

  const std::filesystem::path& directory() const { return directory_; }
  Journal& journal() { return journal_; }
  bool is_resumed() const { return is_resumed_; }
  // `fresh` was asked for, and not done.
  bool keeps_own_job() const { return keeps_own_job_; }

  // By id; failed ones included.
  const std::map<std::uint64_t, Evaluation>& evaluations() const { return evaluations_; }
  std::map<Cause, std::uint64_t> failures() const;
  std::uint64_t failure_count() const;

  // Returns it as it is kept: its traces are among the results.
  const Evaluation& add(Evaluation evaluation);
  // Histories of the references, for the results.
  void add_references(const std::vector<CaseTraces>& references);
  // Synced at once: it may be all that a start achieves. `name` is that of the load case.
  void add_reference(StoredReference reference);
  const StoredReference* reference(const std::string& name) const;
  // What the verb concludes: the object of its --json, and tables.
  void set_answer(AnswerKind kind, const std::string& json, std::vector<Table> tables);

  // A text of this start for the provenance; the last of a name counts.
  void note(NamedText text);

  // Writes results.h5 and returns the results digest.
  std::string write(RunStatus status);
  // The same now and then, while the study runs: at most a fiftieth of the time.
  void write_if_due();

  // As last written.
  const StudyResults& results() const { return results_; }

  std::filesystem::path results_path() const;

 private:
  void add_traces(TraceSet set);
  void note_kernels();

  std::filesystem::path directory_;
  bool is_made_ = false;  // the directory did not exist before
  bool keeps_own_job_ = false;
  Journal journal_;
  bool is_resumed_ = false;
  StudyResults results_;  // evaluations are in evaluations_
  std::map<std::uint64_t, Evaluation> evaluations_;
  std::map<std::uint64_t, std::uint32_t> attempts_before_;  // of rows that are run again, by id
  std::vector<StoredReference> references_;  // of this start; earlier ones are in the journal
  std::chrono::steady_clock::time_point next_write_;
};

}  // namespace linkstudy

// DIR/results.h5: the results of a study as a file that xarray and h5py open. Layout:
//   /           format, format_version, status, input_sha256, results_digest, seed, ...
//   /study      axis evaluation; a dataset per parameter and response; status, message, attempts,
//               parent_evaluation. Failed rows stay, with NaN and their cause. What is derived of
//               the input has the role "derived".
//   /reference/<name>, /traces/<name>   time histories over their time
//   /contacts/<name>   the contacts of a run whose histories are there
//   /tuning/<name>, /calibration/<name>, /convergence/<name>, /statics/<name>, /kinematics/<name>
//               groups of columns, the answer as JSON
//   /runtime    wall time, rank, host of each evaluation: outside the digest
//   /provenance one row per start or resume; texts (input, resolved input, build, machine)
#pragma once

#include <filesystem>
#include <optional>

#include "study/record/table.h"
#include "study/store/journal.h"
#include "study/store/results.h"

namespace linkstudy {

// Results as far as a journal knows them: description, evaluations, traces, provenance, texts and
// input digest. Traces whose name begins with "reference" become references, those of derived_set
// and residuals_set go to their evaluation, and the texts of answer_texts become answers.
StudyResults results_from(const JournalContents& contents);

// How the journal keeps what is derived for an evaluation, its residuals (results.h5 has those of
// the best fit only), the contacts of a run, and an answer: its JSON object, and its tables.
TraceSet derived_set(const Evaluation& evaluation);
TraceSet residuals_set(const Evaluation& evaluation);
NamedText contacts_text(const Table& contacts);
std::vector<NamedText> answer_texts(const VerbAnswer& answer);
// Of which kind a text of answer_texts is; nothing where it is none.
std::optional<AnswerKind> answer_kind_of(const NamedText& text);

// Writes the file whole or not at all and returns the results digest in it.
std::string write_results(const std::filesystem::path& path, const StudyResults& results);

StudyResults read_results(const std::filesystem::path& path);

// Of a directory by its journal (and what older journals lack by its results.h5), or of a file.
StudyResults read_stored(const std::filesystem::path& path);

// The same without a file.
Table tree_of(const StudyResults& results);
StudyResults results_of(const Table& tree);

}  // namespace linkstudy

// DIR/results.h5: the results of a study as a file that xarray and h5py open. Layout:
//   /           format, format_version, status, input_sha256, results_digest, seed, ...
//   /study      axis evaluation; a dataset per parameter and response; status, message, attempts,
//               parent_evaluation. Failed rows stay, with NaN and their cause.
//   /reference/<name>, /traces/<name>   time histories over their time
//   /tuning/<name>, /convergence/<name> groups of columns, texts as attributes
//   /runtime    wall time, rank, host of each evaluation: outside the digest
//   /provenance one row per start or resume; texts (input, resolved input, build, machine)
#pragma once

#include <filesystem>

#include "study/store/data_group.h"
#include "study/store/journal.h"
#include "study/store/results.h"

namespace linkstudy {

// Results as far as a journal knows them: description, evaluations, traces, provenance, texts and
// input digest. Traces whose name begins with "reference" become references; a text named
// "tuning/<name>" becomes the attribute "certificate" of that tuning.
StudyResults results_from(const JournalContents& contents);

// Writes the file whole or not at all and returns the results digest in it.
std::string write_results(const std::filesystem::path& path, const StudyResults& results);

StudyResults read_results(const std::filesystem::path& path);

// The same without a file.
DataGroup tree_of(const StudyResults& results);
StudyResults results_of(const DataGroup& tree);

}  // namespace linkstudy

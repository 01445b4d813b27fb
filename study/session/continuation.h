// How a start goes on with a results directory whose rows may not all count as they are:
//   --retry-failed   rows that failed for a transient cause, or by a limit that is wider now, are
//                    struck out of the journal and so run again; other failures are not repeated
//   --extend         a larger design, or a search with a larger budget or wider ranges: rows keep
//                    their places, or the journal is set aside (journal_1.bin, ...), from where
//                    rows are taken by what they are (earlier_rows.h)
// All of it is in the journal before anything runs, so that any later start of the new input goes
// on without options.
#pragma once

#include "study/evaluate/evaluator.h"
#include "study/session/options.h"
#include "study/session/study_record.h"

namespace linkstudy {

// Rank 0, before the record is opened. What was done, in lines; empty: nothing. Throws StoreError
// where the rows are none of this input.
std::string prepare_continuation(const SessionOptions& options,
                                 const std::filesystem::path& directory,
                                 const StudyIdentity& identity, const Evaluator& evaluator);

// Of a directory that holds another study, with the options that might help.
[[noreturn]] void throw_other_input(const OtherInput& found, const SessionOptions& options);

}  // namespace linkstudy

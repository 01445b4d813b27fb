// The reference runs of a study: each is run once, by some rank, and kept in the journal, so that
// no later start repeats it; then all ranks are sent them.
#pragma once

#include <spdlog/logger.h>

#include "study/evaluate/evaluator.h"
#include "study/schedule/pool.h"
#include "study/session/known_rows.h"
#include "study/session/study_record.h"

namespace linkstudy {

// Rank 0: gives the evaluator those that the journal or an earlier study has; returns the others.
std::vector<std::size_t> take_references(Evaluator& evaluator, StudyRecord& record,
                                         KnownRows& known, spdlog::logger& log);

// What a rank does with a task of the pool below.
std::string run_reference_task(Evaluator& evaluator, const std::string& task);

// Rank 0: these are run, side by side in the lanes of the ranks, and put into the journal. Throws
// ReferenceFailure, and Interrupted: after a first stop signal or at the end of the wall time none
// is begun, at kStopCancel those in flight end.
void run_references(const std::vector<std::size_t>& load_cases, Evaluator& evaluator,
                    StudyRecord& record, KnownRows& known, Pool& pool, spdlog::logger& log);

// Collective, when rank 0 has them all.
void share_references(Evaluator& evaluator, Transport& transport);

}  // namespace linkstudy

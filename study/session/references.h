// The reference runs of a study: each is run once, by rank 0, and kept in the journal, so that no
// later start repeats it; the other ranks are sent them.
#pragma once

#include <spdlog/logger.h>

#include "study/evaluate/evaluator.h"
#include "study/schedule/transport.h"
#include "study/session/deadline.h"
#include "study/session/known_rows.h"
#include "study/session/study_record.h"

namespace linkstudy {

// Rank 0. Throws Interrupted, with what has ended in the journal: after a first stop signal or at
// the end of the wall time no further reference is begun, at kStopCancel the one in flight ends.
void run_references(Evaluator& evaluator, StudyRecord& record, KnownRows& known,
                    const RunDeadline& deadline, spdlog::logger& log);

// Collective, after run_references on rank 0.
void share_references(Evaluator& evaluator, Transport& transport);

}  // namespace linkstudy

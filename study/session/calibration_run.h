// A fit's view of a session: points become evaluations with ids in the order asked, so that a
// calibration that is started again takes the same path from the journal.
#pragma once

#include "study/calibrate/fit_report.h"
#include "study/session/evaluation_source.h"

namespace linkstudy {

// Throws as the source does.
calibration::FitReport fit_calibration(Evaluator& evaluator, const EvaluationSource& source);
// The same; its answer is among the results. Throws as StudySession::evaluate does.
calibration::FitReport run_calibration(StudySession& session);

}  // namespace linkstudy

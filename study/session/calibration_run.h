// A fit's view of a session: points become evaluations with ids in the order asked, so that a
// calibration that is started again takes the same path from the journal.
#pragma once

#include "study/calibrate/fit_report.h"
#include "study/session/session.h"

namespace linkstudy {

// Throws as StudySession::evaluate does.
calibration::FitReport run_calibration(StudySession& session);

}  // namespace linkstudy

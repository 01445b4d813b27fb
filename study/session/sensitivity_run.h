// A design of blocks in a session: evaluated as any design is, and judged when all points are
// there.
#pragma once

#include "study/sensitivity/sensitivity.h"
#include "study/session/session.h"

namespace linkstudy {

// Throws as StudySession::evaluate does.
sensitivity::Sensitivity run_sensitivity(StudySession& session);

}  // namespace linkstudy

// A refinement in a session: its levels are evaluated as a design is, and judged when all are
// there.
#pragma once

#include "study/converge/convergence.h"
#include "study/session/session.h"

namespace linkstudy {

// Throws as StudySession::evaluate does.
convergence::Convergence run_convergence(StudySession& session);

}  // namespace linkstudy

// Where the points of a search become evaluations, and where those are then found: in a session
// that runs what its journal does not have, or among stored results.
#pragma once

#include <functional>
#include <vector>

#include "study/session/session.h"

namespace linkstudy {

struct EvaluationSource {
  std::function<void(const std::vector<Point>& points)> evaluate;
  std::function<const Evaluation&(std::uint64_t id)> find;
};

EvaluationSource source_of(StudySession& session);

}  // namespace linkstudy

#include "study/session/evaluation_source.h"

namespace linkstudy {

EvaluationSource source_of(StudySession& session) {
  return {[&session](const std::vector<Point>& points) { session.evaluate(points); },
          [&session](std::uint64_t id) -> const Evaluation& {
            return session.record().evaluations().at(id);
          }};
}

}  // namespace linkstudy

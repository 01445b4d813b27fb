// How the work of a study or tune ends: its results written whatever happened, its exit code.
#pragma once

#include <functional>
#include <string>

#include "study/session/interrupted.h"
#include "study/session/session.h"

namespace linkstudy {

struct StudyEnd {
  int code = 0;
  std::string status;  // "complete", "interrupted", "failed"
  std::string digest;  // of what is there
};

// Evaluations, failures by cause, digest and place of the results: the object of `study --json`,
// and of a tune that has no answer.
// `sensitivity`: what a design of blocks tells, a JSON object, or empty.
std::string to_json(const StudyEnd& end, const StudyRecord& record,
                    const std::string& sensitivity = {});

StudyEnd end_study(StudySession& session, const std::function<void()>& work);

}  // namespace linkstudy

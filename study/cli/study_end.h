// How the work of a study or tune ends: its results written whatever happened, its exit code.
#pragma once

#include <functional>
#include <string>

#include "study/cli/study_session.h"

namespace linkstudy {

struct StudyEnd {
  int code = 0;
  std::string status;  // "complete", "interrupted", "failed"
  std::string digest;  // of what is there
};

StudyEnd end_study(StudySession& session, const std::function<void()>& work);

}  // namespace linkstudy

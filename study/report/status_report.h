// How far a results directory is, for people and for programs.
#pragma once

#include <string>

#include "study/store/status.h"

namespace linkstudy {

std::string status_text(const StudyStatus& status);
// The object of `status --json`.
std::string status_json(const StudyStatus& status);

}  // namespace linkstudy

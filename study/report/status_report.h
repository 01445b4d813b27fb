// How far a results directory is, for people and for programs.
#pragma once

#include <string>

#include "study/store/status.h"

namespace linkstudy {

// "12 of 65"; of a search that goes on "12 of at most 65".
std::string finished_text(const StudyStatus& status);

std::string status_text(const StudyStatus& status);
// The object of `status --json`.
std::string status_json(const StudyStatus& status);

}  // namespace linkstudy

// Exit codes of the program, the same on every rank.
#pragma once

#include <array>

#include "study/schedule/stop_signals.h"

namespace linkstudy {

inline constexpr int kDone = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kInputError = 2;
inline constexpr int kTooManyFailed = 3;
inline constexpr int kNotTuned = 4;
inline constexpr int kNotConverged = 5;

struct ExitStatus {
  int code;
  const char* meaning;
};

inline constexpr std::array kExitStatuses = {
    ExitStatus{kDone, "done"},
    ExitStatus{kInternalError, "internal error"},
    ExitStatus{kInputError, "usage or input error"},
    ExitStatus{kTooManyFailed, "too many cases failed, or a single run did"},
    ExitStatus{kNotTuned, "tuning found nothing, or results were refuted"},
    ExitStatus{kNotConverged, "a refined quantity shows no order of convergence"},
    ExitStatus{kExitResumable, "interrupted and resumable"}};

}  // namespace linkstudy

// Exit codes of the program, the same on every rank.
#pragma once

namespace linkstudy {

inline constexpr int kDone = 0;
inline constexpr int kInternalError = 1;
inline constexpr int kInputError = 2;
inline constexpr int kTooManyFailed = 3;
inline constexpr int kNotTuned = 4;

}  // namespace linkstudy

// Names of the laws of prescribed motion (core/laws/prescribed_motion.h).
#pragma once

#include <cstdint>

#include "core/base/words.h"

namespace linkstudy {

enum class MotionLaw : std::uint8_t { linear, smooth, polynomial_345, table, speed, sine };

template <>
inline constexpr auto kWords<MotionLaw> = make_words<MotionLaw>(
    {{MotionLaw::linear, "linear", "s"},
     {MotionLaw::smooth, "smooth", "3 s^2 - 2 s^3"},
     {MotionLaw::polynomial_345, "polynomial_345", "10 s^3 - 15 s^4 + 6 s^5"},
     {MotionLaw::table, "table", "cubic spline through `positions` at `times`"},
     {MotionLaw::speed, "speed", "at `speed`, after `rise`"},
     {MotionLaw::sine, "sine", "from + amplitude sin(2 pi frequency t + phase)"}});

}  // namespace linkstudy

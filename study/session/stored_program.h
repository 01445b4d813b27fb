// What a comparison with stored results has to know of the program and machine that they are of.
#pragma once

#include <optional>
#include <string>

#include "study/store/results.h"

namespace linkstudy {

// Relative, between instruction sets that round differently: integration multiplies roundings.
inline constexpr double kOtherRounding = 1e-6;

// A warning where they are of another revision.
std::optional<std::string> revision_warning(const StudyResults& results);

// A warning, without its end, where the last start that wrote them was on an instruction set that
// rounds otherwise than that of this process; nothing where bits must agree.
std::optional<std::string> rounding_warning(const StudyResults& results);

// With all digits; "nothing" for NaN.
std::string shown_number(double value);

}  // namespace linkstudy

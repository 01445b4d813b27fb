// Sequences of numbers an axis of a study is written with:
//   lin     x_i = from + (to - from) i / (count - 1)
//   log     x_i = from (to / from)^(i / (count - 1))
//   ladder  x_i = from ratio^i
// Ends are bitwise those given. Whole decades are shifted in decimal, so that 1e-6 .. 1e-2 in five
// points has exactly the bits of 1e-5, 1e-4 and 1e-3 as a person would have written them.
// Units are those of the arguments. Bad arguments raise std::invalid_argument with the remedy.
#pragma once

#include <cstddef>
#include <vector>

namespace linkstudy {

// More values than this on one axis, or points in one design, are a slip of the pen.
inline constexpr std::size_t kMaxPoints = 100'000'000;

// Needs finite ends and count >= 2, or count == 1 with from == to.
std::vector<double> linspace(double from, double to, std::size_t count);

// As linspace; both ends positive.
std::vector<double> logspace(double from, double to, std::size_t count);

// Needs from != 0, ratio > 0 and != 1, levels >= 1, and a last value that a double can hold.
std::vector<double> ladder(double from, double ratio, std::size_t levels);

// value * 10^decades, rounded once from the shortest decimal text of value.
double shift_decimal(double value, long decades);

}  // namespace linkstudy

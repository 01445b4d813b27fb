// The arithmetic that the step loop is written in. Every kernel is a template on Real; Real is
// `double` here, and any type that offers the same free functions and comparison results (a mask
// accepted by `select` and `any`) may take its place: a pack of SIMD lanes, one case a lane.
//   madd(a, b, c) = a b + c      msub(a, b, c) = a b - c      nmadd(a, b, c) = c - a b
//   select(mask, a, b) = mask ? a : b, lane by lane
// Branches on values are written with select; branches on structure are ordinary ifs.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace linkstudy {

template <class Real>
struct RealTraits;

template <>
struct RealTraits<double> {
  using Mask = bool;
  static constexpr int lanes = 1;
};

inline double madd(double a, double b, double c) {
  return a * b + c;
}
inline double msub(double a, double b, double c) {
  return a * b - c;
}
inline double nmadd(double a, double b, double c) {
  return c - a * b;
}
inline double select(bool mask, double a, double b) {
  return mask ? a : b;
}
inline bool any(bool mask) {
  return mask;
}
inline bool all(bool mask) {
  return mask;
}
inline double sqrt(double a) {
  return std::sqrt(a);
}
inline double abs(double a) {
  return std::fabs(a);
}
inline double min(double a, double b) {
  return a < b ? a : b;
}
inline double max(double a, double b) {
  return a > b ? a : b;
}
inline bool is_finite(double a) {
  return std::fabs(a) <= 1.7976931348623157e308;
}

// Of a whole number n below 2^51, held as the sum n + 1.5 2^52:
// a zero whose sign is bit k of n in two's complement, 0 <= k <= 1.
template <int k>
inline double sign_from_bit(double sum) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) << (63 - k) & (1ull << 63));
}
// a with its sign turned where the zero `sign` has one.
inline double turned(double a, double sign) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(a) ^
                               std::bit_cast<std::uint64_t>(sign));
}
inline bool has_sign(double a) {
  return std::bit_cast<std::int64_t>(a) < 0;
}

// 2^n for a whole number n from -1022 to 1023.
inline double power_of_two(double n) {
  return std::bit_cast<double>((static_cast<std::int64_t>(n) + 1023) << 52);
}

// A positive x = binary_fraction(x) * 2^binary_exponent(x), the fraction in [1, 2); numbers below
// 2^-1022 are not split so.
inline double binary_exponent(double a) {
  return static_cast<double>(std::bit_cast<std::int64_t>(a) >> 52) - 1023.0;
}
inline double binary_fraction(double a) {
  constexpr std::uint64_t digits = (std::uint64_t{1} << 52) - 1;
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(a) & digits) | (1023ull << 52));
}

// Lanes: a double is its own single lane. Bit i of lane_bits is set where lane i is true.
inline unsigned lane_bits(bool mask) {
  return mask ? 1u : 0u;
}
template <class Real>
inline constexpr unsigned kAllLanes = (1u << RealTraits<Real>::lanes) - 1u;
inline double lane(double a, int) {
  return a;
}
inline void set_lane(double& a, int, double x) {
  a = x;
}

}  // namespace linkstudy

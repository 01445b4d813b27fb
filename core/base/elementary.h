// Elementary functions without branches, the same for double and for packs.
//   sincos  Cody-Waite reduction by pi/2 in three parts, then the minimax polynomials of the Cephes
//           library on [-pi/4, pi/4]. Error below 1 unit in the last place for |x| < 1.6e6 rad (the
//           products n * kPi2a and n * kPi2b are exact for n < 2^20).
//   exp     x = n ln 2 + r with ln 2 in two parts, the series of e^r to r^13, and a power of two.
//           Error below 1 unit in the last place; 0 below -708 (no denormals), infinity above
//           709.78, and not a number for such an argument.
//   log     x = 2^k (1 + f) with 1 + f in [sqrt(1/2), sqrt(2)], ln(1 + f) = 2 artanh(f / (2 + f))
//   by
//           its series to the 21st power, arranged so that the leading f is added last. Error below
//           1 unit in the last place; -infinity at 0 and below 2^-1022 (no denormals), infinity at
//           infinity, not a number below 0.
//   quadrant_angle  the angle from 0 to pi/2 whose sine and cosine go as y and x, both not negative
//           and not both zero: reduced to |u| <= 0.66 by pi/4 or pi/2, then the rational function
//           of the Cephes library. Error below 2 units in the last place.
//   power   x^n = exp(n ln x), 0 for x <= 0 and for no number. Relative error below
//           (1 + |n ln x|) 2^-52.
#pragma once

#include <initializer_list>
#include <limits>

#include "core/base/real.h"

namespace linkstudy {

template <class Real>
struct SinCos {
  Real sin;
  Real cos;
};

namespace detail {

// pi/2 in parts of 33, 33 and 53 bits.
inline constexpr double kPi2a = 1.57079632673412561417e+00;
inline constexpr double kPi2b = 6.07710050630396597660e-11;
inline constexpr double kPi2c = 2.02226624879595063154e-21;
inline constexpr double kRound = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to integer

template <class Real>
inline Real sine_polynomial(Real r, Real tail, Real z) {
  Real p = madd(Real(1.58962301576546568060e-10), z, Real(-2.50507477628578072866e-8));
  p = madd(p, z, Real(2.75573136213857245213e-6));
  p = madd(p, z, Real(-1.98412698295895385996e-4));
  p = madd(p, z, Real(8.33333333332211858878e-3));
  p = madd(p, z, Real(-1.66666666666666307295e-1));
  return r + madd(p * z, r, tail);
}

template <class Real>
inline Real cosine_polynomial(Real r, Real tail, Real z) {
  Real p = madd(Real(-1.13585365213876817300e-11), z, Real(2.08757008419747316778e-9));
  p = madd(p, z, Real(-2.75573141792967388112e-7));
  p = madd(p, z, Real(2.48015872888517045348e-5));
  p = madd(p, z, Real(-1.38888888888730564116e-3));
  p = madd(p, z, Real(4.16666666666665929218e-2));
  const Real half = Real(0.5) * z;
  const Real w = Real(1.0) - half;
  return w + ((Real(1.0) - w - half) + msub(p * z, z, r * tail));
}

}  // namespace detail

template <class Real>
inline SinCos<Real> sincos(Real x) {
  const Real round(detail::kRound);
  const Real sum = madd(x, Real(6.36619772367581382433e-01), round);
  const Real n = sum - round;
  // r + tail = x - n pi/2 to about 70 bits
  const Real head = nmadd(n, Real(detail::kPi2a), x);
  const Real middle = n * Real(detail::kPi2b);
  const Real rest = head - middle;
  const Real low = nmadd(n, Real(detail::kPi2c), (head - rest) - middle);
  const Real r = rest + low;
  const Real tail = (rest - r) + low;
  const Real z = r * r;
  const Real s = detail::sine_polynomial(r, tail, z);
  const Real c = detail::cosine_polynomial(r, tail, z);
  // The quadrant n mod 4: the sine is negative in 2 and 3, the cosine in 1 and 2.
  const Real odd = sign_from_bit<0>(sum), upper = sign_from_bit<1>(sum);
  const auto swaps = has_sign(odd);
  return {turned(select(swaps, c, s), upper), turned(turned(select(swaps, s, c), upper), odd)};
}

namespace detail {

inline constexpr double kLn2a = 6.93147180369123816490e-01;  // 33 bits
inline constexpr double kLn2b = 1.90821492927058770002e-10;

// (e^r - 1 - r) / r^2 for |r| <= ln 2 / 2, the next term below 5e-18 of e^r.
template <class Real>
inline Real exponential_series(Real r) {
  Real p(1.0 / 6227020800.0);
  for (const double c : {479001600.0, 39916800.0, 3628800.0, 362880.0, 40320.0, 5040.0, 720.0,
                         120.0, 24.0, 6.0, 2.0}) {
    p = madd(p, r, Real(1.0 / c));
  }
  return p;
}

}  // namespace detail

template <class Real>
inline Real exp(Real x) {
  const auto low = x < Real(-708.0);
  const auto high = x > Real(709.78271289338397);
  const Real inside = select(low || high, Real(0.0), x);
  const Real round(detail::kRound);
  const Real n = madd(inside, Real(1.44269504088896338700), round) - round;
  const Real head = nmadd(n, Real(detail::kLn2a), inside);
  const Real r = nmadd(n, Real(detail::kLn2b), head);
  const Real lost = nmadd(n, Real(detail::kLn2b), head - r);  // of r, by rounding
  const Real y = Real(1.0) + (r + madd(r * r, detail::exponential_series(r), lost));
  // 2^1024 has no room: one factor 2 apart.
  const Real value = (y * Real(2.0)) * power_of_two(n - Real(1.0));
  const Real ends = select(low, Real(0.0), Real(std::numeric_limits<double>::infinity()));
  return select(x == x, select(low || high, ends, value), x);
}

namespace detail {

// 2 artanh(s) / s - 2 for s^2 = z < 0.0295, the next term below 1e-18 of the whole.
template <class Real>
inline Real artanh_series(Real z) {
  Real p(2.0 / 21.0);
  for (const double c : {19.0, 17.0, 15.0, 13.0, 11.0, 9.0, 7.0, 5.0, 3.0}) {
    p = madd(p, z, Real(2.0 / c));
  }
  return p * z;
}

}  // namespace detail

template <class Real>
inline Real log(Real x) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Real whole = binary_fraction(x);
  const auto upper = whole > Real(1.41421356237309504880);
  const Real k = binary_exponent(x) + select(upper, Real(1.0), Real(0.0));
  const Real f = select(upper, Real(0.5) * whole, whole) - Real(1.0);
  const Real s = f / (Real(2.0) + f);
  // ln(1 + f) = f - (f^2 / 2 - s (f^2 / 2 + R)): its parts shrink from left to right
  const Real half = Real(0.5) * f * f;
  const Real rest = madd(s, half + detail::artanh_series(s * s), k * Real(detail::kLn2b));
  const Real value = madd(k, Real(detail::kLn2a), f - (half - rest));
  const Real least(std::numeric_limits<double>::min());
  const Real below = select(x < Real(0.0), Real(infinity) - Real(infinity), Real(-infinity));
  const Real inside = select(x < least, below, value);
  return select(x < Real(infinity), inside, x);
}

namespace detail {

// (atan(u) / u - 1) / z for z = u^2 <= 0.44.
template <class Real>
inline Real arctangent_fraction(Real z) {
  Real p = madd(Real(-8.750608600031904122785e-1), z, Real(-1.615753718733365076637e1));
  p = madd(p, z, Real(-7.500855792314704667340e1));
  p = madd(p, z, Real(-1.228866684490136173410e2));
  p = madd(p, z, Real(-6.485021904942025371773e1));
  Real q = z + Real(2.485846490142306297962e1);
  q = madd(q, z, Real(1.650270098316988542046e2));
  q = madd(q, z, Real(4.328810604912902668951e2));
  q = madd(q, z, Real(4.853903996359136964868e2));
  q = madd(q, z, Real(1.945506571482613964425e2));
  return p / q;
}

}  // namespace detail

template <class Real>
inline Real quadrant_angle(Real y, Real x) {
  const auto high = y > Real(2.41421356237309504880) * x;  // tan(3 pi / 8)
  const auto low = y <= Real(0.66) * x;
  const Real u = select(high, -x, select(low, y, y - x)) / select(high, y, select(low, x, y + x));
  const Real z = u * u;
  const Real value = madd(u * z, detail::arctangent_fraction(z), u);
  const Real zero(0.0);
  const Real base = select(high, Real(1.57079632679489661923),  //
                           select(low, zero, Real(0.785398163397448309616)));
  const Real rest = select(high, Real(6.123233995736765886130e-17),
                           select(low, zero, Real(3.061616997868382943065e-17)));
  return base + (value + rest);
}

template <class Real>
inline Real power(Real x, Real n) {
  return select(x > Real(0.0), exp(n * log(x)), Real(0.0));
}

}  // namespace linkstudy

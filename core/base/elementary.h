// Sine and cosine of one argument, without branches: Cody-Waite reduction by pi/2 in three parts,
// then the minimax polynomials of the Cephes library on [-pi/4, pi/4]. Error below 1 unit in the
// last place for |x| < 1.6e6 rad (the products n * kPi2a and n * kPi2b are exact for n < 2^20).
#pragma once

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
  const Real n = madd(x, Real(6.36619772367581382433e-01), round) - round;
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
  // Quadrant n mod 4 in -2..2 without integers: sign flips and the swap of sine and cosine.
  const Real turns = madd(n, Real(0.25), round) - round;
  const Real quarter = madd(turns, Real(-4.0), n);
  const auto odd = abs(quarter) == Real(1.0);
  const auto half = abs(quarter) == Real(2.0);
  const Real sin0 = select(odd, c, s);
  const Real cos0 = select(odd, s, c);
  const auto flip_sin = half || (quarter == Real(-1.0));
  const auto flip_cos = half || (quarter == Real(1.0));
  return {select(flip_sin, -sin0, sin0), select(flip_cos, -cos0, cos0)};
}

}  // namespace linkstudy

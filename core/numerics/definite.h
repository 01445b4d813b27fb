// Linear systems with a symmetric matrix A, (n, n) row by row, lower triangle used, that is
// positive definite by a margin: A = L D L^T without pivoting, L unit lower. Of three unknowns, the
// commonest closure, the inverse is kept instead, from cofactors: one division in a row of
// operations that wait for each other, not three, and as exact for a matrix with such a margin.
#pragma once

#include "core/base/indices.h"
#include "core/base/real.h"

namespace linkstudy {

// A size that the compiler knows; other sizes are int.
using Three = std::integral_constant<int, 3>;

namespace detail {

// A := A^-1, (3, 3), lower triangle. Pivots are a00, m / a00 and det / m with m the leading minor.
template <class Real>
inline auto invert_definite_3(Real margin, Real* a) {
  const Real xx = a[0], xy = a[3], yy = a[4], xz = a[6], yz = a[7], zz = a[8];
  const Real limit = margin * max(xx, max(yy, zz));
  const Real minor = msub(xx, yy, xy * xy);
  const Real c00 = msub(yy, zz, yz * yz);
  const Real c10 = msub(xz, yz, xy * zz);
  const Real c20 = msub(xy, yz, xz * yy);
  const Real det = madd(xx, c00, madd(xy, c10, xz * c20));
  const auto clear = xx > limit && minor > limit * xx && det > limit * minor;
  const Real one(1.0);
  const Real inverse = one / select(clear, det, one);
  a[0] = c00 * inverse;
  a[3] = c10 * inverse;
  a[4] = msub(xx, zz, xz * xz) * inverse;
  a[6] = c20 * inverse;
  a[7] = msub(xy, xz, xx * yz) * inverse;
  a[8] = minor * inverse;
  return clear;
}

template <class Real>
inline void apply_symmetric_3(const Real* a, Real* b) {
  const Real x = b[0], y = b[1], z = b[2];
  b[0] = madd(a[0], x, madd(a[3], y, a[6] * z));
  b[1] = madd(a[3], x, madd(a[4], y, a[7] * z));
  b[2] = madd(a[6], x, madd(a[7], y, a[8] * z));
}

}  // namespace detail

// Overwrites the strict lower triangle of A with L; inverse[i] is 1 / D_i. True in the lanes where
// every pivot D_i is more than limit(i); other lanes hold no factor.
template <class Real, class Limit>
inline auto factorize_above(int n, const Limit& limit, Real* a, Real* inverse) {
  const Real one(1.0);
  auto definite = one > Real(0.0);
  for (const int j : indices(n)) {
    Real pivot = a[j * n + j];
    for (const int k : indices(j)) pivot = nmadd(a[j * n + k] * a[j * n + k], a[k * n + k], pivot);
    const auto clear = pivot > limit(j);
    definite = definite && clear;
    a[j * n + j] = select(clear, pivot, one);
    inverse[j] = one / a[j * n + j];
    for (const int i : indices(j + 1, n)) {
      Real x = a[i * n + j];
      for (const int k : indices(j)) x = nmadd(a[i * n + k] * a[j * n + k], a[k * n + k], x);
      a[i * n + j] = x * inverse[j];
    }
  }
  return definite;
}

// The same with all limits `margin` times the largest diagonal of A.
template <class Size, class Real>
inline auto factorize_definite(Size n, Real margin, Real* a, Real* inverse) {
  if constexpr (std::is_same_v<Size, Three>) {
    return detail::invert_definite_3(margin, a);
  } else {
    Real largest(0.0);
    for (const int j : indices(n)) largest = max(largest, a[j * n + j]);
    const Real limit = margin * largest;
    return factorize_above(
        n, [limit](int) { return limit; }, a, inverse);
  }
}

// b := A^-1 b
template <class Size, class Real>
inline void solve_definite(Size n, const Real* l, const Real* inverse, Real* b) {
  if constexpr (std::is_same_v<Size, Three>) return detail::apply_symmetric_3(l, b);
  for (const int i : indices(n)) {
    for (const int k : indices(i)) b[i] = nmadd(l[i * n + k], b[k], b[i]);
  }
  for (const int i : indices_down(n)) {
    Real x = b[i] * inverse[i];
    for (const int k : indices(i + 1, n)) x = nmadd(l[k * n + i], b[k], x);
    b[i] = x;
  }
}

}  // namespace linkstudy

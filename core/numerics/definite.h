// Linear systems with a symmetric matrix A, (n, n) row by row, lower triangle used, that is
// positive definite by a margin: A = L D L^T without pivoting, L unit lower.
#pragma once

#include "core/base/real.h"

namespace linkstudy {

// n is an int, or a std::integral_constant where the size is known to the compiler.

// Overwrites the strict lower triangle of A with L; inverse[i] is 1 / D_i. True in the lanes where
// every pivot is more than `margin` times the largest diagonal of A; other lanes hold no factor.
template <class Size, class Real>
inline auto factorize_definite(Size n, Real margin, Real* a, Real* inverse) {
  const Real one(1.0);
  Real largest(0.0);
  for (int j = 0; j < n; ++j) largest = max(largest, a[j * n + j]);
  const Real limit = margin * largest;
  auto definite = one > Real(0.0);
  for (int j = 0; j < n; ++j) {
    Real* row_j = a + j * n;
    Real pivot = row_j[j];
    for (int k = 0; k < j; ++k) pivot = nmadd(row_j[k] * row_j[k], a[k * n + k], pivot);
    const auto clear = pivot > limit;
    definite = definite && clear;
    row_j[j] = select(clear, pivot, one);
    inverse[j] = one / row_j[j];
    for (int i = j + 1; i < n; ++i) {
      Real* row_i = a + i * n;
      Real x = row_i[j];
      for (int k = 0; k < j; ++k) x = nmadd(row_i[k] * row_j[k], a[k * n + k], x);
      row_i[j] = x * inverse[j];
    }
  }
  return definite;
}

// b := A^-1 b
template <class Size, class Real>
inline void solve_definite(Size n, const Real* l, const Real* inverse, Real* b) {
  for (int i = 1; i < n; ++i) {
    for (int k = 0; k < i; ++k) b[i] = nmadd(l[i * n + k], b[k], b[i]);
  }
  for (int i = n - 1; i >= 0; --i) {
    Real x = b[i] * inverse[i];
    for (int k = i + 1; k < n; ++k) x = nmadd(l[k * n + i], b[k], x);
    b[i] = x;
  }
}

}  // namespace linkstudy

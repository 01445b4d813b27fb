// Linear systems with a symmetric positive semidefinite matrix A, (n, n) row by row, lower triangle
// used. A = L D L^T without pivoting, L unit lower; a column whose pivot falls below `tolerance`
// times the largest diagonal of A belongs to a dependent row and becomes zero. If any was dropped
// the solution is the one of least norm: with C = L sqrt(D), x = C (C^T C)^-2 C^T b; least squares
// where b is not in the range.
#pragma once

#include "core/base/real.h"

namespace linkstudy {

// n is an int, or a std::integral_constant where the size is known to the compiler.

// Overwrites the strict lower triangle of A with L and its diagonal with D. inverse[i] is 1 / D_i,
// or 0 for a dropped row. Returns true if any lane dropped a row.
template <class Size, class Real>
inline bool factorize_semidefinite(Size n, Real tolerance, Real* a, Real* inverse) {
  bool dropped = false;
  const Real zero(0.0), one(1.0);
  Real largest(0.0);
  for (int j = 0; j < n; ++j) largest = max(largest, a[j * n + j]);
  const Real limit = tolerance * largest;
  for (int j = 0; j < n; ++j) {
    Real* row_j = a + j * n;
    Real pivot = row_j[j];
    for (int k = 0; k < j; ++k) pivot = nmadd(row_j[k] * row_j[k], a[k * n + k], pivot);
    const auto keep = pivot > limit;
    dropped = dropped || !all(keep);
    row_j[j] = select(keep, pivot, zero);
    inverse[j] = select(keep, one / select(keep, pivot, one), zero);
    for (int i = j + 1; i < n; ++i) {
      Real* row_i = a + i * n;
      Real x = row_i[j];
      for (int k = 0; k < j; ++k) x = nmadd(row_i[k] * row_j[k], a[k * n + k], x);
      row_i[j] = x * inverse[j];
    }
  }
  return dropped;
}

// b := A^-1 b with all rows kept.
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

// b := A^+ b. gram, (n, n), and scratch, (2 n), are overwritten.
template <class Real>
inline void solve_least_norm(int n, const Real* l, const Real* inverse, Real* gram, Real* scratch,
                             Real* b) {
  Real* root = scratch;
  for (int i = 0; i < n; ++i) root[i] = sqrt(l[i * n + i]);
  const auto c = [&](int i, int j) { return i == j ? root[j] : l[i * n + j] * root[j]; };
  for (int i = 0; i < n; ++i) {  // C^T b, entry i needs b[i..]; and C^T C, 1 for a dropped row
    Real x(0.0);
    for (int k = i; k < n; ++k) x = madd(c(k, i), b[k], x);
    b[i] = x;
    for (int j = 0; j <= i; ++j) {
      Real g(0.0);
      for (int k = i; k < n; ++k) g = madd(c(k, i), c(k, j), g);
      gram[i * n + j] = g;
    }
    gram[i * n + i] = select(inverse[i] == Real(0.0), Real(1.0), gram[i * n + i]);
  }
  factorize_semidefinite(n, Real(0.0), gram, scratch + n);  // positive definite
  solve_definite(n, gram, scratch + n, b);
  solve_definite(n, gram, scratch + n, b);
  for (int i = n - 1; i >= 0; --i) {  // C u, entry i needs u[..i]
    Real x(0.0);
    for (int k = 0; k <= i; ++k) x = madd(c(i, k), b[k], x);
    b[i] = x;
  }
}

}  // namespace linkstudy

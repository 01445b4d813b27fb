// Linear systems with a symmetric positive semidefinite matrix A, (n, n) row by row, lower triangle
// used. Cholesky without pivoting, A = L L^T; a column whose pivot falls below `tolerance` times
// the diagonal of A belongs to a dependent row and becomes zero. If any was dropped the solution is
// the one of least norm, x = L (L^T L)^-2 L^T b, least squares where b is not in the range.
#pragma once

#include "core/base/real.h"

namespace linkstudy {

// Overwrites A with L. kept[i] is 1 for an independent row, 0 for a dropped one. Returns true if
// any lane dropped a row.
template <class Real>
inline bool factorize_semidefinite(int n, Real tolerance, Real* a, Real* kept) {
  bool dropped = false;
  for (int j = 0; j < n; ++j) {
    Real* row_j = a + j * n;
    const Real limit = tolerance * row_j[j];
    Real pivot = row_j[j];
    for (int k = 0; k < j; ++k) pivot = madd(Real(-row_j[k]), row_j[k], pivot);
    const auto keep = pivot > limit;
    kept[j] = select(keep, Real(1.0), Real(0.0));
    dropped = dropped || !all(keep);
    const Real root = sqrt(select(keep, pivot, Real(1.0)));
    const Real inverse = select(keep, Real(1.0) / root, Real(0.0));
    row_j[j] = select(keep, root, Real(0.0));
    for (int i = j + 1; i < n; ++i) {
      Real* row_i = a + i * n;
      Real x = row_i[j];
      for (int k = 0; k < j; ++k) x = madd(Real(-row_i[k]), row_j[k], x);
      row_i[j] = x * inverse;
    }
  }
  return dropped;
}

// b := A^-1 b with all rows kept.
template <class Real>
inline void solve_cholesky(int n, const Real* l, Real* b) {
  for (int i = 0; i < n; ++i) {
    Real x = b[i];
    for (int k = 0; k < i; ++k) x = madd(Real(-l[i * n + k]), b[k], x);
    b[i] = x / l[i * n + i];
  }
  for (int i = n - 1; i >= 0; --i) {
    Real x = b[i];
    for (int k = i + 1; k < n; ++k) x = madd(Real(-l[k * n + i]), b[k], x);
    b[i] = x / l[i * n + i];
  }
}

// b := A^+ b. gram, (n, n), and scratch, (n), are overwritten.
template <class Real>
inline void solve_least_norm(int n, const Real* l, const Real* kept, Real* gram, Real* scratch,
                             Real* b) {
  for (int i = 0; i < n; ++i) {  // y = L^T b, row i needs b[i..]
    Real x(0.0);
    for (int k = i; k < n; ++k) x = madd(l[k * n + i], b[k], x);
    b[i] = x;
    for (int j = 0; j <= i; ++j) {
      Real g(0.0);
      for (int k = i; k < n; ++k) g = madd(l[k * n + i], l[k * n + j], g);
      gram[i * n + j] = g;
    }
    gram[i * n + i] = gram[i * n + i] + (Real(1.0) - kept[i]);
  }
  factorize_semidefinite(n, Real(0.0), gram, scratch);  // positive definite
  solve_cholesky(n, gram, b);
  solve_cholesky(n, gram, b);
  for (int i = n - 1; i >= 0; --i) {  // x = L u, row i needs u[..i]
    Real x(0.0);
    for (int k = 0; k <= i; ++k) x = madd(l[i * n + k], b[k], x);
    b[i] = x;
  }
}

}  // namespace linkstudy

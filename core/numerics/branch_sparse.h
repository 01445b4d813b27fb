// Factorisation H = L^T D L of a symmetric positive definite matrix whose entry (k, i), i < k, is
// nonzero only where i is an ancestor of k, and its triangular solves. parent[k] < k is the next
// ancestor, or -1. H is (n, n) row by row, lower triangle; entries off the paths are never read.
// No fill-in arises ([Featherstone, Rigid Body Dynamics Algorithms, sec. 6.5]).
#pragma once

#include "core/base/real.h"

namespace linkstudy {

// Overwrites the strict lower triangle of H with L (unit diagonal) and writes 1 / D.
template <class Real>
inline void factorize_branch_sparse(int n, const int* parent, Real* h, Real* inverse_pivot) {
  for (int k = n - 1; k >= 0; --k) {
    const Real inverse = Real(1.0) / h[k * n + k];
    inverse_pivot[k] = inverse;
    for (int i = parent[k]; i >= 0; i = parent[i]) {
      const Real a = h[k * n + i] * inverse;
      for (int j = i; j >= 0; j = parent[j]) {
        h[i * n + j] = nmadd(a, h[k * n + j], h[i * n + j]);
      }
      h[k * n + i] = a;
    }
  }
}

// x := L^-T x
template <class Real>
inline void solve_branch_transposed(int n, const int* parent, const Real* h, Real* x) {
  for (int k = n - 1; k >= 0; --k) {
    for (int i = parent[k]; i >= 0; i = parent[i]) x[i] = nmadd(h[k * n + i], x[k], x[i]);
  }
}

// x := L^-1 x
template <class Real>
inline void solve_branch(int n, const int* parent, const Real* h, Real* x) {
  for (int k = 0; k < n; ++k) {
    for (int i = parent[k]; i >= 0; i = parent[i]) x[k] = nmadd(h[k * n + i], x[i], x[k]);
  }
}

}  // namespace linkstudy

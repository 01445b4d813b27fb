// Factorisation H = L^T D L of a symmetric positive definite matrix whose entry (k, i), i < k, is
// nonzero only where i is an ancestor of k, and its triangular solves. The tree has nv and
// v_parent: v_parent[k] < k is the next ancestor, or -1. H is (nv, nv) row by row, lower triangle;
// entries off the paths are never read. No fill-in arises ([Featherstone, Rigid Body Dynamics
// Algorithms, sec. 6.5]).
#pragma once

#include "core/base/indices.h"
#include "core/base/real.h"

namespace linkstudy {

// Overwrites the strict lower triangle of H with L (unit diagonal) and writes 1 / D.
template <class Tree, class Real>
inline void factorize_branch_sparse(const Tree& tree, Real* h, Real* inverse_pivot) {
  const int n = tree.nv;
  for (const int k : velocities_down(tree)) {
    const Real inverse = Real(1.0) / h[k * n + k];
    inverse_pivot[k] = inverse;
    for (const int i : ancestors(tree, k)) {
      const Real a = h[k * n + i] * inverse;
      for (const int j : path(tree, i)) h[i * n + j] = nmadd(a, h[k * n + j], h[i * n + j]);
      h[k * n + i] = a;
    }
  }
}

// x := L^-T x
template <class Tree, class Real>
inline void solve_branch_transposed(const Tree& tree, const Real* h, Real* x) {
  const int n = tree.nv;
  for (const int k : velocities_down(tree)) {
    for (const int i : ancestors(tree, k)) x[i] = nmadd(h[k * n + i], x[k], x[i]);
  }
}

// x := L^-1 x
template <class Tree, class Real>
inline void solve_branch(const Tree& tree, const Real* h, Real* x) {
  const int n = tree.nv;
  for (const int k : velocities(tree)) {
    for (const int i : ancestors(tree, k)) x[k] = nmadd(h[k * n + i], x[i], x[k]);
  }
}

}  // namespace linkstudy

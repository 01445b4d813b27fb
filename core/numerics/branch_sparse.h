// Factorisation H = L^T D L of a symmetric positive definite matrix whose entry (k, i), i < k, is
// nonzero only where i is an ancestor of k, and its triangular solves. The tree has v_parent:
// v_parent[k] < k is the next ancestor, or none; its indices are those of H and of vectors. H is an
// IndexedMatrixView, lower triangle; entries off the paths are never read. No fill-in arises
// ([Featherstone, Rigid Body Dynamics Algorithms, sec. 6.5]). Vectors are IndexedPointers.
#pragma once

#include "core/base/indices.h"
#include "core/base/real.h"
#include "core/base/typed_index.h"

namespace linkstudy {

// Overwrites the strict lower triangle of H with L (unit diagonal) and writes 1 / D.
template <class Tree, class Matrix, class Vector>
inline void factorize_branch_sparse(const Tree& tree, Matrix h, Vector inverse_pivot) {
  using Real = typename Matrix::value_type;
  for (const auto k : velocities_down(tree)) {
    const Real inverse = Real(1.0) / h(k, k);
    inverse_pivot[k] = inverse;
    for (const auto i : ancestors(tree, k)) {
      const Real a = h(k, i) * inverse;
      for (const auto j : path(tree, i)) h(i, j) = nmadd(a, h(k, j), h(i, j));
      h(k, i) = a;
    }
  }
}

// x := L^-T x
template <class Tree, class Matrix, class Vector>
inline void solve_branch_transposed(const Tree& tree, Matrix h, Vector x) {
  for (const auto k : velocities_down(tree)) {
    for (const auto i : ancestors(tree, k)) x[i] = nmadd(h(k, i), x[k], x[i]);
  }
}

// x := L^-1 x
template <class Tree, class Matrix, class Vector>
inline void solve_branch(const Tree& tree, Matrix h, Vector x) {
  for (const auto k : velocities(tree)) {
    for (const auto i : ancestors(tree, k)) x[k] = nmadd(h(k, i), x[i], x[k]);
  }
}

}  // namespace linkstudy

// Multipliers of constraint rows that depend on each other: A lambda = b with A = J M^-1 J^T
// singular, M = L^T D L, Y = L^-T J^T, so A = Y^T D^-1 Y.
//
// Which rows are dependent is a matter of J alone: masses must not decide it. With row scales s and
// column scales c that make J~ = S^-1 J C^-1 free of units and of size one,
//   J~^T P = Q [T^T; ~0]  (pivoted QR, rank r),   T = U W  (U orthonormal, n x r),
//   B = U^T P^T S^-1,   E = D^-1/2 Y B^T,   lambda = B^T (E^T E)^-1 B b.
// B J are r independent combinations of the rows; S lambda has the least norm among all multipliers
// of these forces, and S^-1 (A lambda - b) is least squares in the combinations left. Neither
// depends on c or on the order P, only the rank does. E^T E is never formed: no condition number is
// squared. The complete orthogonal decomposition of [Golub and Van Loan, sec. 5.4.7] without its Q.
//
// Every lane is a case with a rank and an order of its own. Combinations beyond the rank are zero.
// All storage is taken once; nothing here allocates afterwards.
#pragma once

#include <algorithm>
#include <vector>

#include "core/numerics/pivoted_qr.h"

namespace linkstudy {

template <class Real>
class RedundantSystem {
 public:
  RedundantSystem() = default;
  RedundantSystem(int rows, int columns)
      : rows_(rows), columns_(columns), most_(std::min(rows, columns)) {
    const auto n = static_cast<std::size_t>(rows), k = static_cast<std::size_t>(columns);
    const auto most = static_cast<std::size_t>(most_);
    for (auto* x : {&jacobian_, &factor_}) x->assign(n * k, Real(0.0));
    for (auto* x : {&column_scale_, &inverse_pivot_}) x->assign(k, Real(1.0));
    row_scale_.assign(n, Real(1.0));
    right_hand_side_.assign(n, Real(0.0));
    basis_.assign(most * n, Real(0.0));
    combined_.assign(most * k, Real(0.0));
    for (auto* x : {&exchanged_, &reduced_}) x->assign(most, Real(0.0));
  }

  // To be filled before reduce(), which overwrites the Jacobian: J by row, scales (> 0).
  Real* jacobian() { return jacobian_.data(); }
  Real* row_scale() { return row_scale_.data(); }
  Real* column_scale() { return column_scale_.data(); }
  // To be filled before factorize(), which overwrites the first: Y by row, (rows, columns); 1 / D.
  Real* factor() { return factor_.data(); }
  Real* inverse_pivot() { return inverse_pivot_.data(); }
  // To be filled before solve(), which overwrites it: b, then lambda, (rows).
  Real* right_hand_side() { return right_hand_side_.data(); }

  // The number of independent rows, whole.
  const Real& rank() const { return rank_; }

  // Finds B and the rank: rows of J~ whose part independent of rows already taken is not longer
  // than `tolerance` are dependent.
  void reduce(const Real& tolerance) {
    Real* j = jacobian_.data();
    for (int r = 0; r < rows_; ++r) {
      for (int k = 0; k < columns_; ++k) {
        Real& entry = j[r * columns_ + k];
        entry = entry / (row_scale_.data()[r] * column_scale_.data()[k]);
      }
    }
    rank_ = factorize_pivoted(columns_, rows_, tolerance, j, exchanged_.data());
    for (int i = 0; i < most_; ++i) {
      take_combination(i);
      orthonormalize(i);
    }
    for (int i = 0; i < most_; ++i) {
      Real* b = combination(i);
      for (int r = 0; r < rows_; ++r) b[r] = b[r] / row_scale_.data()[r];
    }
  }

  // For the B found: R of E.
  void factorize() {
    for (int k = 0; k < columns_; ++k) {
      const Real weight = sqrt(inverse_pivot_.data()[k]);
      for (int r = 0; r < rows_; ++r) {
        Real& y = factor_.data()[r * columns_ + k];
        y = y * weight;
      }
    }
    for (int i = 0; i < most_; ++i) combine(i);
    // Independent by reduce(): whatever the masses, no column is dropped.
    factorize_pivoted(columns_, most_, Real(0.0), combined_.data(), exchanged_.data());
    for (int s = 0; s < most_; ++s) {
      exchange_items(rows_, most_, s, exchanged_.data()[s], basis_.data());
    }
  }

  void solve() {
    Real* b = right_hand_side_.data();
    Real* x = reduced_.data();
    for (int i = 0; i < most_; ++i) x[i] = plain_dot(combination(i), b, 0, rows_);
    solve_upper_transposed(columns_, most_, rank_, combined_.data(), x);
    solve_upper(columns_, most_, rank_, combined_.data(), x);
    for (int r = 0; r < rows_; ++r) b[r] = Real(0.0);
    for (int i = 0; i < most_; ++i) {
      for (int r = 0; r < rows_; ++r) b[r] = b[r] + x[i] * combination(i)[r];
    }
  }

 private:
  Real* combination(int i) { return basis_.data() + i * rows_; }

  auto counts(int i) const { return Real(static_cast<double>(i)) < rank_; }

  // Column i of T in the order of the rows given: exchanges taken back, the last first.
  void take_combination(int i) {
    Real* t = combination(i);
    for (int r = 0; r < rows_; ++r) {
      t[r] = r < i ? Real(0.0) : select(counts(i), jacobian_.data()[r * columns_ + i], Real(0.0));
    }
    for (int s = most_ - 1; s >= 0; --s) exchange_items(1, rows_, s, exchanged_.data()[s], t);
  }

  // Gram-Schmidt, twice: column j of T against the ones before it. By the exchanges no column of T
  // depends nearly on earlier ones, and twice is enough.
  void orthonormalize(int j) {
    Real* u = combination(j);
    for (int pass = 0; pass < 2; ++pass) {
      for (int i = 0; i < j; ++i) {
        const Real* v = combination(i);
        const Real along = plain_dot(v, u, 0, rows_);
        for (int r = 0; r < rows_; ++r) u[r] = u[r] - along * v[r];
      }
      const Real norm = sqrt(plain_dot(u, u, 0, rows_));
      for (int r = 0; r < rows_; ++r) u[r] = select(counts(j), u[r] / norm, Real(0.0));
    }
  }

  // Column i of E.
  void combine(int i) {
    Real* e = combined_.data() + i * columns_;
    for (int k = 0; k < columns_; ++k) e[k] = Real(0.0);
    for (int r = 0; r < rows_; ++r) {
      const Real b = combination(i)[r];
      const Real* y = factor_.data() + r * columns_;
      for (int k = 0; k < columns_; ++k) e[k] = e[k] + b * y[k];
    }
  }

  int rows_ = 0;
  int columns_ = 0;
  int most_ = 0;  // the lesser of both: more cannot be independent
  Real rank_ = Real(0.0);
  std::vector<Real> jacobian_, factor_;  // (rows, columns)
  std::vector<Real> row_scale_, column_scale_, inverse_pivot_;
  std::vector<Real> basis_;            // (most, rows): U^T P^T, then B, at last in the order of R
  std::vector<Real> combined_;         // (most, columns): E by column, then R
  std::vector<Real> exchanged_;        // (most) of the last factorisation
  std::vector<Real> reduced_;          // (most)
  std::vector<Real> right_hand_side_;  // (rows)
};

}  // namespace linkstudy

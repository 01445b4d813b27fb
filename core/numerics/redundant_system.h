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
// All storage is taken once; nothing here allocates afterwards. One object serves one case.
#pragma once

#include <vector>

namespace linkstudy {

// Nothing is inline: callers compiled for a newer instruction set leave no copy of theirs behind.
class RedundantSystem {
 public:
  RedundantSystem();
  RedundantSystem(int rows, int columns);
  RedundantSystem(const RedundantSystem& other);
  RedundantSystem(RedundantSystem&& other) noexcept;
  RedundantSystem& operator=(const RedundantSystem& other);
  RedundantSystem& operator=(RedundantSystem&& other) noexcept;
  ~RedundantSystem();

  // To be filled before reduce(), which overwrites the Jacobian: J by row, scales (> 0).
  double* jacobian();
  double* row_scale();
  double* column_scale();
  // To be filled before factorize(), which overwrites the first: Y by row, (rows, columns); 1 / D.
  double* factor();
  double* inverse_pivot();

  // Finds B and returns the rank: rows of J~ whose part independent of rows already taken is not
  // longer than `tolerance` are dependent.
  int reduce(double tolerance);
  // For the B found: R of E.
  void factorize();
  // b := lambda, (rows); right_hand_side() is a place for it.
  void solve(double* b);
  double* right_hand_side();

  int rank() const;

 private:
  void orthonormalize(int j);

  int rows_ = 0;
  int columns_ = 0;
  int rank_ = 0;
  std::vector<double> jacobian_, factor_;  // (rows, columns)
  std::vector<double> row_scale_, column_scale_, inverse_pivot_;
  std::vector<double> basis_;               // (rank, rows): U^T P^T, then B
  std::vector<double> combined_;            // (rank, columns): E by column, then R
  std::vector<double> reduced_, permuted_;  // (rank)
  std::vector<double> right_hand_side_;     // (rows)
  std::vector<int> order_;
};

}  // namespace linkstudy

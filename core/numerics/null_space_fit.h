// The least of a + W^T n over the n that a matrix J does not feel: J^T n = 0, rank J given.
// With pivoted QR of J^T, (J^T) P = Q [R_1 R_2; 0 ~0], the columns of P [-R_1^-1 R_2; 1] span these
// n. Their effects W^T n are made orthonormal in the entries that count, and
//   change = W^T n = -sum_i (u_i . a) u_i.
// Which columns were taken as independent changes the basis only: the least is one, whatever the
// order of rows.
//
// All storage is taken once; nothing here allocates afterwards.
#pragma once

#include <vector>

namespace linkstudy {

// Nothing is inline: callers compiled for a newer instruction set leave no copy of theirs behind.
class NullSpaceFit {
 public:
  NullSpaceFit();
  // Of the `effects` entries of a the first `counted` are made least; the others follow.
  NullSpaceFit(int rows, int columns, int effects, int counted);
  NullSpaceFit(const NullSpaceFit& other);
  NullSpaceFit(NullSpaceFit&& other) noexcept;
  NullSpaceFit& operator=(const NullSpaceFit& other);
  NullSpaceFit& operator=(NullSpaceFit&& other) noexcept;
  ~NullSpaceFit();

  // To be filled before reduce(), which overwrites the first: J (rows, columns), W (rows, effects).
  double* jacobian();
  double* effects();
  // Finds the u_i; rank: independent rows of J.
  void reduce(int rank);

  // To be filled before fit(): a (effects). It leaves the change of a in change().
  double* given();
  void fit();
  const double* change() const;

 private:
  void find_effect(int rank, int dependent, double* u);
  bool orthonormalize(int i);

  int rows_ = 0, columns_ = 0, effects_count_ = 0, counted_ = 0;
  int dimension_ = 0;  // of the span of the u_i
  std::vector<double> jacobian_, effects_, given_, change_;
  std::vector<double> basis_;     // (rows, effects): u_i
  std::vector<double> combined_;  // (rows) R_1^-1 R_2 of one column
  std::vector<int> order_;
  std::vector<double> exchanged_;
};

}  // namespace linkstudy

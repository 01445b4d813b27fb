#include "core/numerics/redundant_system.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numerics/pivoted_qr.h"

namespace linkstudy {

RedundantSystem::RedundantSystem(int rows, int columns) : rows_(rows), columns_(columns) {
  const auto n = static_cast<std::size_t>(rows), k = static_cast<std::size_t>(columns);
  const std::size_t most = std::min(n, k);
  for (auto* x : {&jacobian_, &factor_}) x->resize(n * k);
  for (auto* x : {&column_scale_, &inverse_pivot_}) x->assign(k, 1.0);
  row_scale_.assign(n, 1.0);
  right_hand_side_.resize(n);
  basis_.resize(most * n);
  combined_.resize(most * k);
  for (auto* x : {&reduced_, &permuted_}) x->resize(most);
  order_.resize(n);
}

RedundantSystem::RedundantSystem() = default;
RedundantSystem::RedundantSystem(const RedundantSystem& other) = default;
RedundantSystem::RedundantSystem(RedundantSystem&& other) noexcept = default;
RedundantSystem& RedundantSystem::operator=(const RedundantSystem& other) = default;
RedundantSystem& RedundantSystem::operator=(RedundantSystem&& other) noexcept = default;
RedundantSystem::~RedundantSystem() = default;

double* RedundantSystem::jacobian() {
  return jacobian_.data();
}
double* RedundantSystem::row_scale() {
  return row_scale_.data();
}
double* RedundantSystem::column_scale() {
  return column_scale_.data();
}
double* RedundantSystem::factor() {
  return factor_.data();
}
double* RedundantSystem::inverse_pivot() {
  return inverse_pivot_.data();
}
double* RedundantSystem::right_hand_side() {
  return right_hand_side_.data();
}
int RedundantSystem::rank() const {
  return rank_;
}

int RedundantSystem::reduce(double tolerance) {
  double* j = jacobian_.data();
  for (int r = 0; r < rows_; ++r) {
    for (int k = 0; k < columns_; ++k) {
      j[r * columns_ + k] /= row_scale_.data()[r] * column_scale_.data()[k];
    }
  }
  int* order = order_.data();
  std::iota(order, order + rows_, 0);
  rank_ = factorize_pivoted(columns_, rows_, tolerance, j, order);
  for (int i = 0; i < rank_; ++i) {
    double* t = basis_.data() + i * rows_;  // column i of T in the order of the rows given
    for (int r = 0; r < rows_; ++r) t[order[r]] = r < i ? 0.0 : j[r * columns_ + i];
    orthonormalize(i);
  }
  for (int i = 0; i < rank_; ++i) {
    for (int r = 0; r < rows_; ++r) basis_.data()[i * rows_ + r] /= row_scale_.data()[r];
  }
  return rank_;
}

// Gram-Schmidt, twice: column j of T against the ones before it. By the exchanges no column of T
// depends nearly on earlier ones, and twice is enough.
void RedundantSystem::orthonormalize(int j) {
  double* u = basis_.data() + j * rows_;
  for (int pass = 0; pass < 2; ++pass) {
    for (int i = 0; i < j; ++i) {
      const double* v = basis_.data() + i * rows_;
      const double along = std::inner_product(v, v + rows_, u, 0.0);
      for (int r = 0; r < rows_; ++r) u[r] -= along * v[r];
    }
    const double norm = std::sqrt(std::inner_product(u, u + rows_, u, 0.0));
    for (int r = 0; r < rows_; ++r) u[r] /= norm;
  }
}

void RedundantSystem::factorize() {
  for (int k = 0; k < columns_; ++k) {
    const double weight = std::sqrt(inverse_pivot_.data()[k]);
    for (int r = 0; r < rows_; ++r) factor_.data()[r * columns_ + k] *= weight;
  }
  std::fill_n(combined_.begin(), rank_ * columns_, 0.0);
  for (int i = 0; i < rank_; ++i) {
    double* e = combined_.data() + i * columns_;
    for (int r = 0; r < rows_; ++r) {
      const double b = basis_.data()[i * rows_ + r];
      const double* y = factor_.data() + r * columns_;
      for (int k = 0; k < columns_; ++k) e[k] += b * y[k];
    }
  }
  std::iota(order_.begin(), order_.begin() + rank_, 0);
  // Independent by reduce(): whatever the masses, no column is dropped.
  factorize_pivoted(columns_, rank_, 0.0, combined_.data(), order_.data());
}

void RedundantSystem::solve(double* b) {
  for (int i = 0; i < rank_; ++i) {
    const double* combination = basis_.data() + i * rows_;
    reduced_.data()[i] = std::inner_product(combination, combination + rows_, b, 0.0);
  }
  const int* order = order_.data();
  for (int i = 0; i < rank_; ++i) permuted_.data()[i] = reduced_.data()[order[i]];
  solve_upper_transposed(columns_, rank_, combined_.data(), permuted_.data());
  solve_upper(columns_, rank_, combined_.data(), permuted_.data());
  std::fill_n(b, rows_, 0.0);
  for (int i = 0; i < rank_; ++i) {
    const double* combination = basis_.data() + order[i] * rows_;
    for (int r = 0; r < rows_; ++r) b[r] += permuted_.data()[i] * combination[r];
  }
}

}  // namespace linkstudy

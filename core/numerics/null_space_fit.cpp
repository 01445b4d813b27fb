#include "core/numerics/null_space_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/numerics/pivoted_qr.h"

namespace linkstudy {

NullSpaceFit::NullSpaceFit(int rows, int columns, int effects, int counted)
    : rows_(rows), columns_(columns), effects_count_(effects), counted_(counted) {
  const auto n = static_cast<std::size_t>(rows), e = static_cast<std::size_t>(effects);
  jacobian_.resize(n * static_cast<std::size_t>(columns));
  for (auto* x : {&effects_, &basis_}) x->resize(n * e);
  for (auto* x : {&given_, &change_}) x->resize(e);
  combined_.resize(n);
  order_.resize(n);
  exchanged_.resize(static_cast<std::size_t>(std::min(rows, columns)));
}

NullSpaceFit::NullSpaceFit() = default;
NullSpaceFit::NullSpaceFit(const NullSpaceFit& other) = default;
NullSpaceFit::NullSpaceFit(NullSpaceFit&& other) noexcept = default;
NullSpaceFit& NullSpaceFit::operator=(const NullSpaceFit& other) = default;
NullSpaceFit& NullSpaceFit::operator=(NullSpaceFit&& other) noexcept = default;
NullSpaceFit::~NullSpaceFit() = default;

double* NullSpaceFit::jacobian() {
  return jacobian_.data();
}
double* NullSpaceFit::effects() {
  return effects_.data();
}
double* NullSpaceFit::given() {
  return given_.data();
}
const double* NullSpaceFit::change() const {
  return change_.data();
}

void NullSpaceFit::reduce(int rank) {
  std::iota(order_.begin(), order_.end(), 0);
  // What lies beyond the rank given is factorised too; it leaves R_1 and R_2 as they are.
  const double found = factorize_pivoted(columns_, rows_, 0.0, jacobian_.data(), exchanged_.data());
  for (std::size_t s = 0; s < exchanged_.size(); ++s) {
    std::swap(order_[s], order_[static_cast<std::size_t>(exchanged_[s])]);
  }
  const int independent = std::min(rank, static_cast<int>(found));
  dimension_ = 0;
  for (int i = independent; i < rows_; ++i) {
    find_effect(independent, i, basis_.data() + dimension_ * effects_count_);
    if (orthonormalize(dimension_)) ++dimension_;
  }
}

void NullSpaceFit::fit() {
  std::fill(change_.begin(), change_.end(), 0.0);
  for (int i = 0; i < dimension_; ++i) {
    const double* u = basis_.data() + i * effects_count_;
    const double along = std::inner_product(u, u + counted_, given_.data(), 0.0);
    for (int e = 0; e < effects_count_; ++e) change_.data()[e] -= along * u[e];
  }
}

// W^T n of the n that row order[dependent] makes with the independent ones.
void NullSpaceFit::find_effect(int rank, int dependent, double* u) {
  const double* column = jacobian_.data() + dependent * columns_;
  std::copy(column, column + rank, combined_.begin());
  solve_upper(columns_, rank, static_cast<double>(rank), jacobian_.data(), combined_.data());
  const double* own = effects_.data() + order_.data()[dependent] * effects_count_;
  std::copy(own, own + effects_count_, u);
  for (int i = 0; i < rank; ++i) {
    const double* w = effects_.data() + order_.data()[i] * effects_count_;
    for (int e = 0; e < effects_count_; ++e) u[e] -= combined_.data()[i] * w[e];
  }
}

// Gram-Schmidt, twice, in the entries that count; false where nothing is left.
bool NullSpaceFit::orthonormalize(int i) {
  double* u = basis_.data() + i * effects_count_;
  for (int pass = 0; pass < 2; ++pass) {
    for (int k = 0; k < i; ++k) {
      const double* v = basis_.data() + k * effects_count_;
      const double along = std::inner_product(v, v + counted_, u, 0.0);
      for (int e = 0; e < effects_count_; ++e) u[e] -= along * v[e];
    }
    const double norm = std::sqrt(std::inner_product(u, u + counted_, u, 0.0));
    if (!(norm > 0.0)) return false;
    for (int e = 0; e < effects_count_; ++e) u[e] /= norm;
  }
  return true;
}

}  // namespace linkstudy

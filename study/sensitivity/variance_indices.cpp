#include "study/sensitivity/variance_indices.h"

#include <cmath>

namespace linkstudy::sensitivity {

VarianceIndices estimate_indices(const Eigen::MatrixXd& blocks, std::span<const std::size_t> rows) {
  const Eigen::Index k = blocks.cols() - 2;
  const auto n = static_cast<double>(rows.size());
  const auto at = [&](std::size_t row, Eigen::Index column) {
    return blocks(static_cast<Eigen::Index>(row), column);
  };
  VarianceIndices indices;
  for (const std::size_t row : rows) indices.mean += (at(row, 0) + at(row, k + 1)) / (2.0 * n);
  double squares = 0.0;
  for (const std::size_t row : rows) {
    squares += std::pow(at(row, 0) - indices.mean, 2) + std::pow(at(row, k + 1) - indices.mean, 2);
  }
  indices.variance = squares / (2.0 * n - 1.0);
  for (Eigen::Index i = 1; i <= k; ++i) {
    double first = 0.0;
    double total = 0.0;
    for (const std::size_t row : rows) {
      const double change = at(row, i) - at(row, 0);
      first += (at(row, k + 1) - indices.mean) * change;
      total += change * change;
    }
    indices.first.push_back(first / n / indices.variance);  // 0 / 0 is NaN
    indices.total.push_back(total / (2.0 * n) / indices.variance);
  }
  return indices;
}

}  // namespace linkstudy::sensitivity

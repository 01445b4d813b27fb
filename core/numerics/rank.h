// Numerical rank by singular values, with the gap that justifies it.
#pragma once

#include <Eigen/Core>

namespace linkstudy {

struct NumericalRank {
  int rank = 0;
  double smallest_kept = 0.0;    // relative to the largest singular value
  double largest_dropped = 0.0;  // relative to the largest singular value
};

NumericalRank numerical_rank(const Eigen::MatrixXd& a, double relative_tolerance);

// Orthonormal columns that span the null space of a by the same rank.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a, double relative_tolerance);

}  // namespace linkstudy

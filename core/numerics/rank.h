// Numerical rank by singular values, with the gap that justifies it.
#pragma once

#include <Eigen/Core>

namespace linkstudy {

struct NumericalRank {
  int rank = 0;
  double smallest_kept = 0.0;    // relative to the largest singular value
  double largest_dropped = 0.0;  // relative to the largest singular value
};

// Singular values count if they are above the tolerance times the largest one, or times `least`
// where all are smaller than that: a matrix of roundings has no rank.
NumericalRank numerical_rank(const Eigen::MatrixXd& a, double relative_tolerance,
                             double least = 0.0);

// Orthonormal columns that span the null space of a by the same rank.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& a, double relative_tolerance, double least = 0.0);

}  // namespace linkstudy

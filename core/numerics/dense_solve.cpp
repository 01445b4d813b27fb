#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include "core/numerics/dense.h"

namespace linkstudy {

using Eigen::MatrixXd;

Eigen::VectorXd solve_least_squares(const MatrixXd& a, const Eigen::VectorXd& b, double threshold) {
  // The threshold shapes the factorisation: it has to be known before.
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> factors(a.rows(), a.cols());
  if (threshold > 0.0) factors.setThreshold(threshold);
  factors.compute(a);
  return factors.solve(b);
}

MatrixXd solve_definite(const MatrixXd& a, const MatrixXd& b) {
  return a.ldlt().solve(b);
}

double determinant(const MatrixXd& a) {
  return a.determinant();
}

}  // namespace linkstudy

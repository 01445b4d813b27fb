#include <Eigen/Eigenvalues>

#include "core/numerics/dense.h"

namespace linkstudy {

using Eigen::MatrixXd;

SymmetricEigen decompose_symmetric(const MatrixXd& a) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

GeneralEigen decompose_general(const MatrixXd& a) {
  const Eigen::EigenSolver<MatrixXd> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

Eigen::VectorXcd eigenvalues_of(const MatrixXd& a) {
  return Eigen::EigenSolver<MatrixXd>(a, false).eigenvalues();
}

}  // namespace linkstudy

#include "core/numerics/continuation.h"

#include "core/numerics/dense.h"

namespace linkstudy {

using Eigen::VectorXd;

VectorXd unit_tangent(const Eigen::MatrixXd& jacobian, const VectorXd& sense) {
  const VectorXd t = decompose_singular(jacobian, SingularVectors::full).v.rightCols<1>();
  return t.dot(sense) < 0.0 ? VectorXd(-t) : t;
}

VectorXd least_correction(const Eigen::MatrixXd& jacobian, const VectorXd& residual, int rank) {
  const SingularValues svd = decompose_singular(jacobian, SingularVectors::full);
  VectorXd step = VectorXd::Zero(jacobian.cols());
  for (int k = 0; k < rank; ++k) {
    step -= svd.v.col(k) * (svd.u.col(k).dot(residual) / svd.values[k]);
  }
  return step;
}

}  // namespace linkstudy

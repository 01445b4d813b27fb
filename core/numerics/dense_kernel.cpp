#include <Eigen/LU>
#include <Eigen/QR>

#include "core/numerics/dense.h"

namespace linkstudy {

using Eigen::MatrixXd;

MatrixXd kernel_basis(const MatrixXd& a, double threshold) {
  if (a.rows() == 0) return MatrixXd::Identity(a.cols(), a.cols());
  Eigen::FullPivLU<MatrixXd> lu(a);
  lu.setThreshold(threshold);
  if (lu.rank() == a.cols()) return MatrixXd(a.cols(), 0);
  return lu.kernel().householderQr().householderQ() *
         MatrixXd::Identity(a.cols(), lu.dimensionOfKernel());
}

}  // namespace linkstudy

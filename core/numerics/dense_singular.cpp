#include <Eigen/SVD>

#include "core/numerics/dense.h"

namespace linkstudy {

using Svd = Eigen::JacobiSVD<Eigen::MatrixXd>;

SingularValues decompose_singular(const Eigen::MatrixXd& a, SingularVectors vectors) {
  if (vectors == SingularVectors::right) {
    const Svd svd(a, Eigen::ComputeFullV);
    return {svd.singularValues(), {}, svd.matrixV()};
  }
  const Svd svd(a, vectors == SingularVectors::full ? Eigen::ComputeFullU | Eigen::ComputeFullV
                                                    : Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Eigen::VectorXd singular_values(const Eigen::MatrixXd& a) {
  return Svd(a).singularValues();
}

}  // namespace linkstudy

#include "core/numerics/rank.h"

#include "core/numerics/dense.h"

namespace linkstudy {

NumericalRank numerical_rank(const Eigen::MatrixXd& a, double relative_tolerance, double least) {
  NumericalRank r;
  if (a.size() == 0) return r;
  const Eigen::VectorXd s = singular_values(a);
  const double largest = std::max(s[0], least);
  if (largest == 0.0) return r;
  for (Eigen::Index i = 0; i < s.size(); ++i) {
    const double relative = s[i] / largest;
    if (relative > relative_tolerance) {
      ++r.rank;
      r.smallest_kept = relative;
    } else {
      r.largest_dropped = std::max(r.largest_dropped, relative);
    }
  }
  return r;
}

Eigen::MatrixXd null_space(const Eigen::MatrixXd& a, double relative_tolerance, double least) {
  if (a.rows() == 0) return Eigen::MatrixXd::Identity(a.cols(), a.cols());
  const int rank = numerical_rank(a, relative_tolerance, least).rank;
  return decompose_singular(a, SingularVectors::right).v.rightCols(a.cols() - rank);
}

}  // namespace linkstudy

#include "core/kinematics/closure_jacobian.h"

namespace linkstudy {

Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const std::vector<Row>& rows,
                             const std::vector<RowState<double>>& states) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows j = Rows::Zero(static_cast<Eigen::Index>(rows.size()), m.nv);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    add_row_rates(m, p, w, rows[r].closure, rows[r], states[r],
                  j.row(static_cast<Eigen::Index>(r)).data());
  }
  return j;
}

}  // namespace linkstudy

#include "core/kinematics/closure_jacobian.h"

#include "core/spatial/to_eigen.h"

namespace linkstudy {

Eigen::Matrix<double, 6, 1> twist_of(const Mechanism& m, const Parameters<double>& p,
                                     const Workspace<double>& w, int k,
                                     const Eigen::Vector3d& point) {
  const auto i = static_cast<std::size_t>(k);
  const bool turns = m.velocities[i].kind != VelocityKind::translation;
  Eigen::Matrix<double, 6, 1> twist;
  twist.head<3>() = turns ? to_eigen(w.axes[i]) : Eigen::Vector3d::Zero();
  twist.tail<3>() = to_eigen(point_rate(m, p, w, k, {point.x(), point.y(), point.z()}));
  return twist;
}

Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const std::vector<Row>& rows,
                             const std::vector<RowState<double>>& states) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows j = Rows::Zero(static_cast<Eigen::Index>(rows.size()), m.nv);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    double* row = j.row(static_cast<Eigen::Index>(r)).data();
    if (is_of_coupling(rows[r].kind)) {
      add_coupling_rates(m, p, rows[r].closure, row);
    } else {
      add_row_rates(m, p, w, rows[r].closure, rows[r], states[r], row);
    }
  }
  return j;
}

}  // namespace linkstudy

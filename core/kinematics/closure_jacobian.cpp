#include "core/kinematics/closure_jacobian.h"

#include "core/spatial/to_eigen.h"

namespace linkstudy {

Eigen::Matrix<double, 6, 1> twist_of(const Mechanism& m, const Parameters<double>& p,
                                     const Workspace<double>& w, VelocityIndex k,
                                     const Eigen::Vector3d& point) {
  const bool turns = m.velocities[k].kind != VelocityKind::translation;
  Eigen::Matrix<double, 6, 1> twist;
  twist.head<3>() = turns ? to_eigen(w.axes[k]) : Eigen::Vector3d::Zero();
  twist.tail<3>() = to_eigen(point_rate(m, p, w, k, {point.x(), point.y(), point.z()}));
  return twist;
}

Eigen::MatrixXd row_jacobian(const Mechanism& m, const Parameters<double>& p,
                             const Workspace<double>& w, const IndexedVector<RowIndex, Row>& rows,
                             const IndexedVector<RowIndex, RowState<double>>& states) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Rows j = Rows::Zero(static_cast<Eigen::Index>(rows.size()), m.nv);
  for (const RowIndex r : indices_of(rows)) {
    double* row = j.row(r.value()).data();
    if (is_of_coupling(rows[r].kind)) {
      add_coupling_rates(m, p, rows[r].coupling, row);
    } else {
      add_row_rates(m, p, w, rows[r].closure, rows[r], states[r], row);
    }
  }
  return j;
}

}  // namespace linkstudy

#include "core/kinematics/scaled_closures.h"

#include <Eigen/Geometry>

#include "core/kinematics/closure_jacobian.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

using Eigen::VectorXd;

double find_extent(const Model& model, const Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  Eigen::AlignedBox3d box;
  for (const BodyIndex b : bodies_outwards(m)) {
    const Eigen::Vector3d origin = to_eigen(w.bodies[b].p_WB);
    box.extend(origin);
    box.extend(origin + to_eigen(w.bodies[b].inertia.h) / model.parameters.bodies[b].mass);
  }
  for (const auto& closure : w.closures) box.extend(to_eigen(closure.p_WS));
  const double diagonal = box.isEmpty() ? 0.0 : box.diagonal().norm();
  return diagonal > 0.0 ? diagonal : 1.0;
}

// Rotation vector of the second quaternion seen from the first.
Eigen::Vector3d turn_between(const double* a, const double* b) {
  const Eigen::Quaterniond qa(a[0], a[1], a[2], a[3]), qb(b[0], b[1], b[2], b[3]);
  const Eigen::AngleAxisd turn(qa.conjugate() * qb);
  return turn.angle() * turn.axis();
}

}  // namespace

ClosureScale find_closure_scale(const Model& closed, const State<double>& s) {
  const Mechanism& m = closed.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, closed.parameters, s.q.data(), s.v.data(), w);
  update_rows<RowStorage::cut>(m, closed.parameters, w);
  ClosureScale scale{find_extent(closed, w), VectorXd::Ones(m.cut_row_count()),
                     VectorXd::Ones(m.nv)};
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const bool is_length = !measures_turn(m.cut_rows[r].kind);
    if (is_length) scale.row[r.value()] = 1.0 / scale.extent;
  }
  for (const VelocityIndex k : velocities(m)) {
    const bool is_length = m.velocities[k].kind == VelocityKind::translation;
    if (is_length) scale.velocity[k.value()] = scale.extent;
  }
  return scale;
}

ScaledClosures compute_scaled_closures(const Model& closed, const ClosureScale& scale,
                                       const State<double>& s) {
  const Mechanism& m = closed.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, closed.parameters, s.q.data(), s.v.data(), w);
  update_rows<RowStorage::cut>(m, closed.parameters, w);
  const int rows = m.cut_row_count();
  ScaledClosures c{VectorXd(rows), VectorXd(rows), {}};
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const double size = scale.row[r.value()];
    c.residual[r.value()] = size * w.cut_rows[r].d;
    c.bias[r.value()] = size * w.cut_rows[r].bias;
  }
  c.jacobian = scale.row.asDiagonal() *
               row_jacobian(m, closed.parameters, w, m.cut_rows, w.cut_rows) *
               scale.velocity.asDiagonal();
  return c;
}

VectorXd scaled_difference(const Mechanism& m, const ClosureScale& scale, const State<double>& a,
                           const State<double>& b) {
  VectorXd d(m.nv);
  for (const Stage& stage : m.stages) {
    const double* qa = &a.q[stage.q];
    const double* qb = &b.q[stage.q];
    if (stage.motion == BasicMotion::ball) {
      d.segment<3>(stage.v.value()) = turn_between(qa, qb);
    } else {
      d[stage.v.value()] = *qb - *qa;
    }
  }
  return d.cwiseQuotient(scale.velocity);
}

Eigen::MatrixXd take_columns(const Eigen::MatrixXd& a, const std::vector<int>& columns) {
  Eigen::MatrixXd b(a.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    b.col(static_cast<Eigen::Index>(i)) = a.col(columns[i]);
  }
  return b;
}

VectorXd scatter_entries(const VectorXd& part, const std::vector<int>& at, int n) {
  VectorXd all = VectorXd::Zero(n);
  for (std::size_t i = 0; i < at.size(); ++i) all[at[i]] = part[static_cast<Eigen::Index>(i)];
  return all;
}

}  // namespace linkstudy

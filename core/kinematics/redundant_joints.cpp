#include "core/kinematics/redundant_joints.h"

#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/rank.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;

int rank_of(const MatrixXd& a) {
  return numerical_rank(a, kMobilityTolerance, kLeastRowSize).rank;
}

// Rates of all rows by three turns of a body about ground axes through its origin and three shifts,
// the bodies that it carries with it; without dimensions.
MatrixXd twist_columns(const Model& closed, const ClosureScale& scale, const Workspace<double>& w,
                       BodyIndex body) {
  const Mechanism& m = closed.mechanism;
  const Vec3<double> axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3<double>& origin = w.bodies[body].p_WB;
  MatrixXd t = MatrixXd::Zero(m.cut_row_count(), 6);
  for (const RowIndex r : indices_of(m.cut_rows)) {
    const Row& row = m.cut_rows[r];
    if (is_of_coupling(row.kind)) continue;  // a loose joint would have coordinates of its own
    const RowState<double>& state = w.cut_rows[r];
    const ClosureStructure& c = m.closures[row.closure];
    const ClosureState<double>& x = w.closures[row.closure];
    const Vec3<double>& point_1 = acts_at_both_points(row.kind) ? x.p_WF : x.p_WS;
    for (int k = 0; k < 6; ++k) {
      const bool turns = k < 3;
      const Velocity v{body, turns ? VelocityKind::rotation : VelocityKind::translation, {}};
      const auto rate = [&](const Vec3<double>& point) {
        return row_rate<double>(v, nullptr, axes[k % 3], origin, point, state);
      };
      const double first = carries(m, body, c.first) ? rate(point_1) : 0.0;
      const double second = carries(m, body, c.second) ? rate(x.p_WS) : 0.0;
      t(r.value(), k) = scale.row[r.value()] * (second - first) * (turns ? 1.0 : scale.extent);
    }
  }
  return t;
}

int count_in_tree_joint(const MatrixXd& j, const MatrixXd& twists) {
  MatrixXd wide(j.rows(), j.cols() + twists.cols());
  wide << j, twists;
  return rank_of(wide) - rank_of(j);
}

int count_in_rows(const MatrixXd& j, RowIndex begin, RowIndex end) {
  const int rows = end - begin;
  MatrixXd rest(j.rows() - rows, j.cols());
  rest << j.topRows(begin.value()), j.bottomRows(j.rows() - end.value());
  return rows - (rank_of(j) - rank_of(rest));
}

}  // namespace

std::vector<CarriedRedundancy> find_redundant_joints(const Model& closed, const ClosureScale& scale,
                                                     const State<double>& pose) {
  const Mechanism& m = closed.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, closed.parameters, pose.q.data(), pose.v.data(), w);
  update_rows<RowStorage::cut>(m, closed.parameters, w);
  const MatrixXd j = compute_scaled_closures(closed, scale, pose).jacobian;
  std::vector<CarriedRedundancy> found;
  const auto add = [&](const std::string& name, int count) {
    if (count > 0) found.push_back({name, count});
  };
  for (const BodyIndex b : bodies_outwards(m)) {
    add("joint." + m.joint_names[b], count_in_tree_joint(j, twist_columns(closed, scale, w, b)));
  }
  for (const ClosureIndex i : indices_of(m.closures)) {
    add("closure." + m.closure_names[i],
        count_in_rows(j, m.closures[i].row_begin, m.closures[i].row_end));
  }
  for (const CouplingIndex i : indices_of(m.couplings)) {
    add("coupling." + m.coupling_names[i],
        count_in_rows(j, m.couplings[i].row, m.couplings[i].row + 1));
  }
  return found;
}

}  // namespace linkstudy

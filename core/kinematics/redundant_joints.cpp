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
                       int body) {
  const Mechanism& m = closed.mechanism;
  const Vec3<double> axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const Vec3<double>& origin = w.bodies[static_cast<std::size_t>(body)].p;
  MatrixXd t = MatrixXd::Zero(m.cut_row_count(), 6);
  for (int r = 0; r < m.cut_row_count(); ++r) {
    const Row& row = m.cut_rows[static_cast<std::size_t>(r)];
    if (is_of_coupling(row.kind)) continue;  // a loose joint would have coordinates of its own
    const RowState<double>& state = w.cut_rows[static_cast<std::size_t>(r)];
    const ClosureStructure& c = m.closures[static_cast<std::size_t>(row.closure)];
    const ClosureState<double>& x = w.closures[static_cast<std::size_t>(row.closure)];
    const Vec3<double>& point_1 = acts_at_both_points(row.kind) ? x.p1 : x.p2;
    for (int k = 0; k < 6; ++k) {
      const bool turns = k < 3;
      const Velocity v{body, turns ? VelocityKind::rotation : VelocityKind::translation, 0};
      const auto rate = [&](const Vec3<double>& point) {
        return row_rate<double>(v, nullptr, axes[k % 3], origin, point, state);
      };
      const double first = carries(m, body, c.first) ? rate(point_1) : 0.0;
      const double second = carries(m, body, c.second) ? rate(x.p2) : 0.0;
      t(r, k) = scale.row[r] * (second - first) * (turns ? 1.0 : scale.extent);
    }
  }
  return t;
}

int count_in_tree_joint(const MatrixXd& j, const MatrixXd& twists) {
  MatrixXd wide(j.rows(), j.cols() + twists.cols());
  wide << j, twists;
  return rank_of(wide) - rank_of(j);
}

int count_in_rows(const MatrixXd& j, int begin, int end) {
  const int rows = end - begin;
  MatrixXd rest(j.rows() - rows, j.cols());
  rest << j.topRows(begin), j.bottomRows(j.rows() - end);
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
  for (int b = 1; b < m.body_count(); ++b) {
    add("joint." + m.joint_names[static_cast<std::size_t>(b)],
        count_in_tree_joint(j, twist_columns(closed, scale, w, b)));
  }
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    add("closure." + m.closure_names[i],
        count_in_rows(j, m.closures[i].row_begin, m.closures[i].row_end));
  }
  for (std::size_t i = 0; i < m.couplings.size(); ++i) {
    add("coupling." + m.coupling_names[i],
        count_in_rows(j, m.couplings[i].row, m.couplings[i].row + 1));
  }
  return found;
}

}  // namespace linkstudy

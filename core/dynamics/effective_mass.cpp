#include "core/dynamics/effective_mass.h"

#include <cmath>

#include "core/dynamics/motion.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/closure_jacobian.h"
#include "core/model/undriven.h"
#include "core/numerics/dense.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;

bool is_rotation(const Row& row) {
  return measures_turn(row.kind);
}

// `moving`: velocities that forces can change.
double effective(const MatrixXd& rows, const MatrixXd& mass, const std::vector<int>& moving) {
  if (rows.rows() == 0 || moving.empty()) return 0.0;
  const MatrixXd j = rows(Eigen::all, moving);
  const MatrixXd a = j * solve_definite(mass(moving, moving), j.transpose());
  const double largest = decompose_symmetric(a).values.maxCoeff();
  return largest > 0.0 ? 1.0 / largest : 0.0;
}

// Springs that are not along three axes resist any translation: J has all three ground axes then.
MatrixXd translation_jacobian(const Model& model, const Workspace<double>& w, ClosureIndex closure,
                              const MatrixXd& j) {
  const ClosureStructure& c = model.mechanism.closures[closure];
  const auto& rows = model.mechanism.sde_rows;
  int count = 0;
  bool along_axes = true;
  for (const RowIndex r : rows_of(c)) {
    const RowKind kind = rows[r].kind;
    if (measures_turn(kind)) continue;
    ++count;
    along_axes =
        along_axes && (kind == RowKind::translation_ground || kind == RowKind::translation_first);
  }
  if (count == 0 || along_axes) return j.middleRows(c.row_begin.value(), count);
  IndexedVector<RowIndex, Row> axes;
  for (int d = kX; d <= kZ; ++d) {
    axes.push_back({RowKind::translation_ground, closure, d, 0, 1.0, d});
  }
  return row_jacobian(model.mechanism, model.parameters, w, axes, make_rows<double>(axes));
}

}  // namespace

EffectiveMass compute_effective_mass(const Model& model, const State<double>& s,
                                     ClosureIndex closure) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  compute_motion(m, model.parameters, s, w);
  const MatrixXd j = row_jacobian(m, model.parameters, w, m.sde_rows, w.sde_rows);
  const MatrixXd mass = compute_mass_matrix(m, model.parameters, s);
  const ClosureStructure& c = m.closures[closure];
  int rotations = 0;  // after the translations in the rows of a closure
  for (const RowIndex r : rows_of(c))
    if (is_rotation(m.sde_rows[r])) ++rotations;
  const std::vector<int> moving = undriven_velocities(m);
  return {effective(translation_jacobian(model, w, closure, j), mass, moving),
          effective(j.middleRows(c.row_end.value() - rotations, rotations), mass, moving)};
}

void resolve_damping(const Linkage& linkage, const State<double>& s, Model& model) {
  for (const ClosureIndex i : indices_of(model.mechanism.closures)) {
    const Closure& closure = linkage.closures[static_cast<std::size_t>(i.value())];
    if (closure.model != ClosureModel::sde || !closure.sde.damping_ratio) continue;
    const EffectiveMass mass = compute_effective_mass(model, s, i);
    const ClosureStructure& c = model.mechanism.closures[i];
    for (const RowIndex r : rows_of(c)) {
      SpringParameters<double>& n = model.parameters.springs[r];
      const double m_eff =
          is_rotation(model.mechanism.sde_rows[r]) ? mass.rotation : mass.translation;
      n.damping = 2.0 * *closure.sde.damping_ratio * std::sqrt(n.stiffness * m_eff);
    }
  }
}

}  // namespace linkstudy

#include "core/dynamics/effective_mass.h"

#include <Eigen/Dense>
#include <cmath>

#include "core/dynamics/motion.h"
#include "core/kinematics/assembly.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;

bool is_rotation(const Row& row) {
  return row.kind == RowKind::rotation;
}

double effective(const MatrixXd& j, const MatrixXd& mass) {
  if (j.rows() == 0) return 0.0;
  const MatrixXd a = j * mass.ldlt().solve(j.transpose());
  const double largest = Eigen::SelfAdjointEigenSolver<MatrixXd>(a).eigenvalues().maxCoeff();
  return largest > 0.0 ? 1.0 / largest : 0.0;
}

}  // namespace

EffectiveMass compute_effective_mass(const Model& model, const State<double>& s, int closure) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  compute_motion(m, model.parameters, s, w);
  const MatrixXd j = row_jacobian(m, m.sde_rows, w.sde_rows, w.axes);
  const MatrixXd mass = compute_mass_matrix(m, model.parameters, s);
  const ClosureStructure& c = m.closures[static_cast<std::size_t>(closure)];
  int translations = 0;
  for (int r = c.row_begin; r < c.row_end; ++r) {
    if (!is_rotation(m.sde_rows[static_cast<std::size_t>(r)])) ++translations;
  }
  // Translations come first in the rows of a closure.
  const int rotations = c.row_end - c.row_begin - translations;
  return {effective(j.middleRows(c.row_begin, translations), mass),
          effective(j.middleRows(c.row_begin + translations, rotations), mass)};
}

void resolve_damping(const Linkage& linkage, const State<double>& s, Model& model) {
  for (std::size_t i = 0; i < linkage.closures.size(); ++i) {
    const Closure& closure = linkage.closures[i];
    if (closure.model != ClosureModel::sde || !closure.sde.damping_ratio) continue;
    const EffectiveMass mass = compute_effective_mass(model, s, static_cast<int>(i));
    const ClosureStructure& c = model.mechanism.closures[i];
    for (int r = c.row_begin; r < c.row_end; ++r) {
      const auto row = static_cast<std::size_t>(r);
      SpringParameters<double>& n = model.parameters.springs[row];
      const double m_eff =
          is_rotation(model.mechanism.sde_rows[row]) ? mass.rotation : mass.translation;
      n.damping = 2.0 * *closure.sde.damping_ratio * std::sqrt(n.stiffness * m_eff);
    }
  }
}

}  // namespace linkstudy

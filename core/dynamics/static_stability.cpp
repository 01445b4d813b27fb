#include "core/dynamics/static_stability.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/differences.h"
#include "core/dynamics/static_balance.h"
#include "core/kinematics/scaled_closures.h"
#include "core/numerics/dense.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kNeutral = 1e-12;  // relative to the largest stiffness
constexpr double kDoubts = 10.0;    // of the differences, that a stiffness must exceed
constexpr double kRank = 1e-7;      // of the closures' Jacobian

bool slides(const Mechanism& m, int velocity) {
  return m.velocities[VelocityIndex(velocity)].kind == VelocityKind::translation;
}

StiffnessUnit unit_of(const Mechanism& m, const std::vector<int>& free) {
  const auto sliding = std::count_if(free.begin(), free.end(), [&](int k) { return slides(m, k); });
  const auto all = static_cast<std::ptrdiff_t>(free.size());
  return sliding == 0     ? StiffnessUnit::rotation
         : sliding == all ? StiffnessUnit::translation
                          : StiffnessUnit::mixed;
}

void judge_eigenvalues(const VectorXd& e, double limit, StabilityReport& report) {
  report.smallest_stiffness = e[0];
  for (const double stiffness : e) {
    if (std::abs(stiffness) <= limit) {
      ++report.neutral;
    } else if (report.smallest_beyond == 0.0) {
      report.smallest_beyond = stiffness;
    }
  }
  report.stability = e[0] < -limit        ? Stability::unstable
                     : report.neutral > 0 ? Stability::neutral
                                          : Stability::stable;
}

}  // namespace

FreeDirections find_free_directions(const Model& model, const State<double>& s,
                                    const std::vector<int>& free, Workspace<double>& w) {
  FreeDirections f;
  const auto n = static_cast<Eigen::Index>(free.size());
  f.unit = unit_of(model.mechanism, free);
  f.extent = compute_extent(model, s).length;
  f.measure = VectorXd::Ones(n);
  for (Eigen::Index i = 0; i < n && f.unit == StiffnessUnit::mixed; ++i) {
    if (slides(model.mechanism, free[static_cast<std::size_t>(i)])) f.measure[i] = f.extent;
  }
  if (n == 0) return f;
  const MatrixXd j = take_columns(compute_balance(model, s, w).j, free);
  f.basis = kernel_basis(j * f.measure.asDiagonal(), kRank);
  return f;
}

StabilityReport judge_stability(const Model& model, const State<double>& s, const VectorXd& lambda,
                                const std::vector<int>& free, Workspace<double>& w) {
  const FreeDirections f = find_free_directions(model, s, free, w);
  StabilityReport report;
  report.stability = Stability::stable;  // a structure, unless something can move
  report.unit = f.unit;
  report.extent = f.extent;
  report.directions = static_cast<int>(f.basis.cols());
  if (report.directions == 0) return report;
  const ForceGradient gradient = compute_force_gradient(model, s, lambda, free, w);
  const auto& d = f.measure;
  MatrixXd k = -(d.asDiagonal() * gradient.value * d.asDiagonal());
  k = 0.5 * (k + k.transpose()).eval();
  const double doubt = (d.asDiagonal() * gradient.doubt * d.asDiagonal()).norm();
  const double weights = force_scale(model, s.t) * report.extent;
  const double stiffest = std::max(k.cwiseAbs().maxCoeff(), weights);
  const MatrixXd of_free = f.basis.transpose() * k * f.basis;
  const VectorXd e = decompose_symmetric(of_free).values;
  judge_eigenvalues(e, std::max(kNeutral * stiffest, kDoubts * doubt), report);
  return report;
}

}  // namespace linkstudy

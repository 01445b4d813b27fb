#include "core/dynamics/spectrum.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/motion.h"
#include "core/kinematics/assembly.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDisplacement = 1e-6;  // rad or m, of the differences

VectorXd accelerations(const Model& model, const State<double>& s, Workspace<double>& w) {
  compute_motion(model.mechanism, model.parameters, s, w);
  return Eigen::Map<const VectorXd>(w.qdd.data(), model.mechanism.nv);
}

double amplification(std::complex<double> z) {
  return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
}

}  // namespace

double stable_step(std::complex<double> lambda) {
  const std::complex<double> z(std::min(lambda.real(), 0.0), lambda.imag());
  const double size = std::abs(z);
  if (size == 0.0) return std::numeric_limits<double>::infinity();
  const std::complex<double> ray = z / size;
  constexpr double tolerance = 1.0 + 1e-10;
  double inside = 0.0;
  double outside = 0.0;
  for (double r = 0.01; r < 4.0 && outside == 0.0; r += 0.01) {
    (amplification(r * ray) <= tolerance ? inside : outside) = r;
  }
  for (int i = 0; i < 50 && outside > 0.0; ++i) {
    const double middle = 0.5 * (inside + outside);
    (amplification(middle * ray) <= tolerance ? inside : outside) = middle;
  }
  return inside / size;
}

Spectrum compute_spectrum(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Spectrum result;
  result.step_limit = std::numeric_limits<double>::infinity();
  if (m.nv == 0) return result;
  Workspace<double> w = make_workspace<double>(m);
  MatrixXd a = MatrixXd::Zero(2 * m.nv, 2 * m.nv);
  a.topRightCorner(m.nv, m.nv).setIdentity();
  for (int k = 0; k < m.nv; ++k) {
    VectorXd dq = VectorXd::Zero(m.nv);
    dq[k] = kDisplacement;
    const VectorXd plus = accelerations(model, displaced(m, s, dq), w);
    const VectorXd minus = accelerations(model, displaced(m, s, -dq), w);
    a.block(m.nv, k, m.nv, 1) = (plus - minus) / (2.0 * kDisplacement);
    State<double> fast = s;
    State<double> slow = s;
    fast.v[static_cast<std::size_t>(k)] += kDisplacement;
    slow.v[static_cast<std::size_t>(k)] -= kDisplacement;
    a.block(m.nv, m.nv + k, m.nv, 1) =
        (accelerations(model, fast, w) - accelerations(model, slow, w)) / (2.0 * kDisplacement);
  }
  if (!a.allFinite()) return result;
  const Eigen::VectorXcd eigenvalues = Eigen::EigenSolver<MatrixXd>(a, false).eigenvalues();
  for (const std::complex<double>& lambda : eigenvalues) {
    result.eigenvalues.push_back(lambda);
    result.omega_max = std::max(result.omega_max, std::abs(lambda));
    result.step_limit = std::min(result.step_limit, stable_step(lambda));
  }
  return result;
}

}  // namespace linkstudy

#include "core/dynamics/modes.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/differences.h"
#include "core/dynamics/spectrum.h"
#include "core/kinematics/assembly.h"
#include "core/model/undriven.h"
#include "core/numerics/dense.h"
#include "core/numerics/rank.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// A double zero splits by the square root of the rounding of the matrix.
constexpr double kSplit = 100.0;

// (nv, f): what cut joints, couplings and motions leave free.
MatrixXd free_directions(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  const std::vector<int> moving = undriven_velocities(m);
  const auto n = static_cast<Eigen::Index>(moving.size());
  MatrixXd null = MatrixXd::Identity(n, n);
  if (m.cut_row_count() > 0 && n > 0) {
    const MatrixXd j = compute_closure_equations(m, model.parameters, s).jacobian;
    null = null_space(j(Eigen::all, moving), kRankTolerance);
  }
  MatrixXd p = MatrixXd::Zero(m.nv, null.cols());
  for (Eigen::Index i = 0; i < n; ++i) p.row(moving[static_cast<std::size_t>(i)]) = null.row(i);
  return p;
}

MatrixXd reduced_system(const MatrixXd& a, const MatrixXd& p) {
  const Eigen::Index nv = p.rows(), f = p.cols(), nz = a.rows() - 2 * nv;
  MatrixXd b = MatrixXd::Zero(2 * f + nz, 2 * f + nz);
  b.block(0, f, f, f).setIdentity();
  b.block(f, 0, f, f) = p.transpose() * a.block(nv, 0, nv, nv) * p;
  b.block(f, f, f, f) = p.transpose() * a.block(nv, nv, nv, nv) * p;
  b.block(f, 2 * f, f, nz) = p.transpose() * a.block(nv, 2 * nv, nv, nz);
  b.block(2 * f, 0, nz, f) = a.block(2 * nv, 0, nz, nv) * p;
  b.block(2 * f, f, nz, f) = a.block(2 * nv, nv, nz, nv) * p;
  b.block(2 * f, 2 * f, nz, nz) = a.block(2 * nv, 2 * nv, nz, nz);
  return b;
}

// The largest entry 1, shifts over the extent.
Eigen::VectorXcd normalised(Eigen::VectorXcd shape, const Mechanism& m, double extent) {
  Eigen::Index largest = 0;
  double size = 0.0;
  for (Eigen::Index k = 0; k < shape.size(); ++k) {
    const bool slides = m.velocities[VelocityIndex(k)].kind == VelocityKind::translation;
    const double here = std::abs(shape[k]) / (slides ? extent : 1.0);
    if (here <= size * (1.0 + 1e-9)) continue;  // of equal ones the first
    size = here;
    largest = k;
  }
  if (size == 0.0) return shape;
  const std::complex<double> unit = shape[largest] / std::abs(shape[largest]);
  return shape / (unit * size);
}

}  // namespace

std::vector<Mode> compute_modes(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  const MatrixXd p = free_directions(model, s);
  if (p.cols() == 0) return {};
  const MatrixXd a = linear_system(model, s);
  if (!a.allFinite()) return {};
  const MatrixXd b = reduced_system(a, p);
  const GeneralEigen eigen = decompose_general(b);
  const double zero = kSplit * std::sqrt(std::numeric_limits<double>::epsilon() * b.norm());
  const double extent = compute_extent(model, s).length;
  std::vector<Mode> modes;
  int still = 0;
  for (Eigen::Index i = 0; i < b.rows(); ++i) {
    const std::complex<double> lambda = eigen.values[i];
    const bool is_still = std::abs(lambda) <= zero;
    if (!is_still && lambda.imag() < 0.0) continue;
    if (is_still && still++ % 2 != 0) continue;
    const double size = is_still ? 0.0 : std::abs(lambda);
    modes.push_back({is_still ? 0.0 : lambda, size, is_still ? 0.0 : -lambda.real() / size,
                     normalised(p * eigen.vectors.col(i).head(p.cols()), m, extent)});
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& x, const Mode& y) { return x.frequency < y.frequency; });
  return modes;
}

}  // namespace linkstudy

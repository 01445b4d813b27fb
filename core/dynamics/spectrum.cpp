#include "core/dynamics/spectrum.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/differences.h"
#include "core/dynamics/linear_springs.h"
#include "core/dynamics/motion.h"
#include "core/dynamics/motion_derivative.h"
#include "core/forces/contact_memory.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/joint_kinematics.h"
#include "core/model/bristles.h"
#include "core/numerics/dense.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// What acts is linear in bristles, but loads of joints follow it only so far: a part of what a
// bristle can be bent that changes no load by much.
constexpr double kBristleStep = 1e-6;
// Friction changes within its Stribeck speed, contacts within their depth.
constexpr double kRubbing = 1e-3;  // of the steps of velocities
constexpr double kOfDepth = 0.02;

bool is_shut(const ClosureState<double>& x) {
  const Vec3<double> gap = x.p_WS - x.p_WF;
  return dot(gap, gap) <= kClosedTolerance * kClosedTolerance;
}

// Appends row r of a model; a line of centres becomes the three ground axes.
void add_row(const Model& from, RowIndex r, bool shut, Mechanism& m, Parameters<double>& p) {
  const Row& row = from.mechanism.sde_rows[r];
  const bool spreads = shut && row.kind == RowKind::line_of_centres;
  for (int d = kX; d <= (spreads ? kZ : kX); ++d) {
    m.sde_rows.push_back(spreads ? Row{RowKind::translation_ground, row.closure, d, 0, 1.0, d}
                                 : row);
    p.springs.push_back(from.parameters.springs[r]);
  }
}

// The model with ground axes in place of the lines of centres whose gap is shut.
Model with_directions(const Model& model, const State<double>& s) {
  Workspace<double> w = make_workspace<double>(model.mechanism);
  compute_motion(model.mechanism, model.parameters, s, w);
  Model directed = model;
  Mechanism& m = directed.mechanism;
  m.sde_rows.clear();
  directed.parameters.springs.clear();
  for (const ClosureIndex i : indices_of(m.closures)) {
    ClosureStructure& c = m.closures[i];
    if (c.model != ClosureModel::sde) continue;
    const bool shut = c.has_line && is_shut(w.closures[i]);
    const RowIndex begin = m.sde_rows.end_index();
    for (const RowIndex r : rows_of(c)) add_row(model, r, shut, m, directed.parameters);
    c.row_begin = begin;
    c.row_end = m.sde_rows.end_index();
    if (!shut) continue;
    c.has_line = false;
    c.point_rows = true;  // the line is the first row of its closure
  }
  return directed;
}

// dq' = dv - omega x dq for the coordinates of balls, else dq' = dv.
void fill_kinematics(const Mechanism& m, const State<double>& s, MatrixXd& a) {
  a.block(0, m.nv, m.nv, m.nv).setIdentity();
  for (const Stage& stage : m.stages) {
    if (stage.motion != BasicMotion::ball) continue;
    const Eigen::Map<const Eigen::Vector3d> omega(&s.v[stage.v]);
    const int v = stage.v.value();
    for (int k = 0; k < 3; ++k) a.block<3, 1>(v, v + k) = -omega.cross(Eigen::Vector3d::Unit(k));
  }
}

// Accelerations (nv) and rates of bristles (nz); not a number where a joint jams.
VectorXd slopes(const Model& model, const State<double>& s, Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  compute_motion(m, model.parameters, s, w);
  VectorXd x(m.nv + m.nz);
  x << Eigen::Map<const VectorXd>(w.qdd.data(), m.nv),
      Eigen::Map<const VectorXd>(w.z_rate.data(), m.nz);
  if (w.jammed != 0) x.setConstant(std::numeric_limits<double>::quiet_NaN());
  return x;
}

void hold_contacts(const Mechanism& m, const std::vector<double>& approach, Workspace<double>& w) {
  hold_contacts_open(m, w);
  for (std::size_t i = 0; i < approach.size(); ++i) {
    if (approach[i] < 0.0) continue;
    w.memory[ContactIndex(i)] = {0.0, 0.0, 1.0, approach[i], 0.0};
  }
}

// Of the shut contacts, m; infinite without one.
double least_depth(const Model& model, const State<double>& s, Workspace<double>& w) {
  compute_motion(model.mechanism, model.parameters, s, w);
  double least = std::numeric_limits<double>::infinity();
  for (const ContactState<double>& c : w.contacts) {
    if (c.elastic > 0.0) least = std::min(least, c.depth);
  }
  return least;
}

struct Steps {
  VectorXd q, v, z;
};

Steps choose_steps(const Model& model, const State<double>& s, Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  const VectorXd smooth = difference_steps(model, s);
  Steps steps{smooth, smooth, VectorXd(m.nz)};
  const double depth = least_depth(model, s, w);
  if (std::isfinite(depth)) {
    const double part = kOfDepth * depth / std::max(compute_extent(model, s).length, 1.0);
    steps.q = smooth.cwiseMin(part);
  }
  if (m.nz > 0 || std::isfinite(depth)) steps.v *= kRubbing;
  const auto bend = [&](BristleIndex z, const LugreParameters<double>& law) {
    steps.z[z.value()] = kBristleStep * law.mu_k / law.sigma0;
  };
  for_bristles(m, model.parameters, bend);
  return steps;
}

// dq'/dv (nq, nv) at a pose.
MatrixXd position_rates_of(const Mechanism& m, const State<double>& s) {
  MatrixXd rates = MatrixXd::Zero(m.nq, m.nv);
  for (const Stage& stage : m.stages) {
    const int count = stage.motion == BasicMotion::ball ? 3 : 1;
    for (int k = 0; k < count; ++k) {
      const Eigen::Vector3d unit = Eigen::Vector3d::Unit(k);
      double* rate = &rates(stage.q.value(), stage.v.value() + k);
      position_rates(stage, &s.q[stage.q], unit.data(), rate);
    }
  }
  return rates;
}

// Rows of accelerations and bristles, exactly; false where that is not known. A bristle at rest
// sits on the corner of |v|, one side of which says little: differences reach across it.
bool fill_exactly(const Model& model, const State<double>& s, const Workspace<double>& w,
                  MatrixXd& a) {
  const Mechanism& m = model.mechanism;
  if (m.nz > 0) return false;
  MotionDerivative& derivative = derivative_of(model);
  if (!derivative.update(s.t, s.q.data(), s.v.data(), nullptr, w.memory)) return false;
  const auto rows = derivative.matrix().middleRows(m.nq, m.nv);
  a.bottomLeftCorner(m.nv, m.nv) = rows.leftCols(m.nq) * position_rates_of(m, s);
  a.bottomRightCorner(m.nv, m.nv) = rows.rightCols(m.nv);
  return true;
}

void fill_by_differences(const Model& model, const State<double>& s, Workspace<double>& w,
                         MatrixXd& a) {
  const Mechanism& m = model.mechanism;
  const Steps steps = choose_steps(model, s, w);
  for (const VelocityIndex k : velocities(m)) {
    const auto at_position = [&](double x) {
      return slopes(model, displaced(m, s, x * VectorXd::Unit(m.nv, k.value())), w);
    };
    const auto at_velocity = [&](double x) {
      State<double> moved = s;
      moved.v[k] += x;
      return slopes(model, moved, w);
    };
    a.block(m.nv, k.value(), m.nv + m.nz, 1) = differentiate(at_position, steps.q[k.value()]).value;
    a.block(m.nv, m.nv + k.value(), m.nv + m.nz, 1) =
        differentiate(at_velocity, steps.v[k.value()]).value;
  }
  for (int i = 0; i < m.nz; ++i) {
    const auto at_bristle = [&](double x) {
      State<double> moved = s;
      moved.z[BristleIndex(i)] += x;
      return slopes(model, moved, w);
    };
    a.block(m.nv, 2 * m.nv + i, m.nv + m.nz, 1) = differentiate(at_bristle, steps.z[i]).value;
  }
}

MatrixXd directed_system(const Model& model, const State<double>& s,
                         const std::vector<double>& approach) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  hold_contacts(m, approach, w);
  MatrixXd a = MatrixXd::Zero(2 * m.nv + m.nz, 2 * m.nv + m.nz);
  fill_kinematics(m, s, a);
  if (!fill_exactly(model, s, w, a)) fill_by_differences(model, s, w, a);
  return a;
}

double amplification(std::complex<double> z) {
  return std::abs(1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0))));
}

}  // namespace

MatrixXd linear_system(const Model& model, const State<double>& s,
                       const std::vector<double>& approach) {
  Workspace<double> w = make_workspace<double>(model.mechanism);
  const std::optional<Model> linear = with_linear_springs(model, s, w);
  return directed_system(with_directions(linear ? *linear : model, s), s, approach);
}

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

Spectrum spectrum_of(std::vector<std::complex<double>> eigenvalues) {
  Spectrum result;
  result.step_limit = std::numeric_limits<double>::infinity();
  result.eigenvalues = std::move(eigenvalues);
  for (const std::complex<double>& lambda : result.eigenvalues) {
    result.omega_max = std::max(result.omega_max, std::abs(lambda));
    result.step_limit = std::min(result.step_limit, stable_step(lambda));
  }
  return result;
}

Spectrum compute_spectrum(const Model& model, const State<double>& s,
                          const std::vector<double>& approach) {
  if (model.mechanism.nv == 0) return spectrum_of({});
  const MatrixXd a = linear_system(model, s, approach);
  if (!a.allFinite()) {
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    return {{}, unknown, unknown};
  }
  const Eigen::VectorXcd lambda = eigenvalues_of(a);
  return spectrum_of({lambda.begin(), lambda.end()});
}

}  // namespace linkstudy

#include "core/dynamics/statics.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/dynamics/differences.h"
#include "core/dynamics/motion.h"
#include "core/forces/applied_forces.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/closure_jacobian.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 100;
constexpr double kLongestStep = 0.2;      // rad or m, of one iteration
constexpr double kForceTolerance = 1e-9;  // relative to the weights and loads at play
constexpr double kNeutral = 1e-12;        // relative to the largest stiffness
constexpr double kDoubts = 10.0;          // of the differences, that a stiffness must exceed

struct Balance {
  VectorXd tau;  // (nv)
  VectorXd phi;  // (nc)
  MatrixXd j;    // (nc, nv)
};

Balance compute_balance(const Model& model, const State<double>& s, Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  compute_motion(m, model.parameters, s, w);
  Balance b{Eigen::Map<const VectorXd>(w.tau.data(), m.nv), VectorXd(m.cut_row_count()),
            row_jacobian(m, model.parameters, w, m.cut_rows, w.cut_rows)};
  for (std::size_t r = 0; r < w.cut_rows.size(); ++r) {
    b.phi[static_cast<Eigen::Index>(r)] = w.cut_rows[r].d;
  }
  return b;
}

VectorXd net_force(const Balance& b, const VectorXd& lambda) {
  return b.tau - b.j.transpose() * lambda;
}

// d(tau - J^T lambda)/dq
struct ForceGradient {
  MatrixXd value;
  double doubt = 0.0;  // norm of the differences' own doubt
};

ForceGradient force_gradient(const Model& model, const State<double>& s, const VectorXd& lambda,
                             Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  const VectorXd steps = difference_steps(model, s);
  ForceGradient g{MatrixXd(m.nv, m.nv)};
  for (int k = 0; k < m.nv; ++k) {
    const auto force = [&](double x) {
      const State<double> moved = displaced(m, s, x * VectorXd::Unit(m.nv, k));
      return net_force(compute_balance(model, moved, w), lambda);
    };
    const Derivative column = differentiate(force, steps[k]);
    g.value.col(k) = column.value;
    g.doubt = std::hypot(g.doubt, column.doubt.norm());
  }
  return g;
}

VectorXd newton_step(const MatrixXd& gradient, const Balance& b, const VectorXd& force) {
  const Eigen::Index n = gradient.rows();
  const Eigen::Index c = b.phi.size();
  MatrixXd a = MatrixXd::Zero(n + c, n + c);
  a.topLeftCorner(n, n) = gradient;
  a.topRightCorner(n, c) = -b.j.transpose();
  a.bottomLeftCorner(c, n) = b.j;
  VectorXd r(n + c);
  r << -force, -b.phi;
  // Stiffness and geometry differ by many decades: scale the rows and columns of the constraints.
  const double scale = std::max(1.0, gradient.cwiseAbs().maxCoeff());
  a.rightCols(c) *= scale;
  a.bottomRows(c) *= scale;
  r.tail(c) *= scale;
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> cod(a.rows(), a.cols());
  cod.setThreshold(1e-13);
  cod.compute(a);
  VectorXd x = cod.solve(r);
  x.tail(c) *= scale;
  return x;
}

// Forces that equilibrium balances: the weights and, at the time of the state, the loads.
// Resistances rest.
double force_scale(const Model& model, double t) {
  const Parameters<double>& p = model.parameters;
  double scale = 1e-6;
  for (std::size_t b = 1; b < p.bodies.size(); ++b) {
    scale = std::max(scale, p.bodies[b].mass * sqrt(dot(p.gravity, p.gravity)));
  }
  for (std::size_t i = 0; i < p.loads.size(); ++i) {
    const LoadStructure& load = model.mechanism.loads[i];
    if (load.type == LoadType::resistance) continue;
    const double value = course_value(load, p.loads[i], p.segments.data(), t);
    scale = std::max(scale, std::abs(value));
  }
  return scale;
}

// Stiffness times the rounding of positions, far from the origin too, on the levers at play: no
// smaller force residual can be asked for.
double rounding_floor(const Model& model, const State<double>& s) {
  const Extent extent = compute_extent(model, s);
  const double reach = std::max(extent.farthest, extent.length) * std::max(extent.length, 1.0);
  double largest = 0.0;
  for (std::size_t r = 0; r < model.mechanism.sde_rows.size(); ++r) {
    const bool turns = model.mechanism.sde_rows[r].kind == RowKind::rotation;
    largest = std::max(largest, model.parameters.springs[r].stiffness * (turns ? 1.0 : reach));
  }
  for (const JointSpringParameters<double>& spring : model.parameters.joint_springs) {
    largest = std::max(largest, spring.stiffness * std::max(1.0, std::abs(spring.rest)));
  }
  return 8.0 * std::numeric_limits<double>::epsilon() * largest;
}

void judge_stability(const Model& model, const State<double>& s, const VectorXd& lambda,
                     Workspace<double>& w, StaticsReport& report) {
  if (model.mechanism.nv == 0) {
    report.stability = Stability::stable;  // a structure: nothing can move
    return;
  }
  const Balance b = compute_balance(model, s, w);
  const ForceGradient gradient = force_gradient(model, s, lambda, w);
  MatrixXd k = -gradient.value;
  k = 0.5 * (k + k.transpose()).eval();
  const double weights = force_scale(model, s.t) * compute_extent(model, s).length;
  const double stiffest = std::max(k.cwiseAbs().maxCoeff(), weights);
  if (b.j.rows() > 0) {
    Eigen::FullPivLU<MatrixXd> lu(b.j);
    lu.setThreshold(1e-7);
    if (lu.rank() == k.rows()) {
      report.stability = Stability::stable;  // a structure: nothing can move
      return;
    }
    const MatrixXd null = lu.kernel().householderQr().householderQ() *
                          MatrixXd::Identity(k.rows(), lu.dimensionOfKernel());
    k = (null.transpose() * k * null).eval();
  }
  if (k.rows() == 0) return;
  const VectorXd e = Eigen::SelfAdjointEigenSolver<MatrixXd>(k).eigenvalues();
  report.smallest_stiffness = e[0];
  const double limit = std::max(kNeutral * stiffest, kDoubts * gradient.doubt);
  report.stability = e[0] > limit    ? Stability::stable
                     : e[0] < -limit ? Stability::unstable
                                     : Stability::neutral;
}

}  // namespace

StaticsReport solve_statics(const Model& model, State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  State<double> x = s;
  std::fill(x.v.begin(), x.v.end(), 0.0);
  StaticsReport report;
  const double tolerance =
      std::max(kForceTolerance * force_scale(model, x.t), rounding_floor(model, x));
  Balance b = compute_balance(model, x, w);
  VectorXd lambda = b.j.rows() > 0
                        ? VectorXd(b.j.transpose().completeOrthogonalDecomposition().solve(b.tau))
                        : VectorXd();
  for (;; ++report.iterations) {
    const VectorXd force = net_force(b, lambda);
    report.force_residual = force.size() > 0 ? force.lpNorm<Eigen::Infinity>() : 0.0;
    report.closure_residual = b.phi.norm();
    report.converged =
        report.force_residual <= tolerance && report.closure_residual <= kClosedTolerance;
    if (report.converged || report.iterations == kMaxIterations) break;
    if (!force.allFinite()) break;
    VectorXd step = newton_step(force_gradient(model, x, lambda, w).value, b, force);
    const double longest = step.head(m.nv).lpNorm<Eigen::Infinity>();
    const double part = longest > kLongestStep ? kLongestStep / longest : 1.0;
    x = displaced(m, x, part * step.head(m.nv));
    lambda += part * step.tail(b.phi.size());
    b = compute_balance(model, x, w);
  }
  if (!report.converged) return report;
  for (std::size_t i = 0; i < s.q.size(); ++i) {
    report.displacement = std::max(report.displacement, std::abs(x.q[i] - s.q[i]));
  }
  report.multipliers = lambda;
  judge_stability(model, x, lambda, w, report);
  s = x;
  return report;
}

}  // namespace linkstudy

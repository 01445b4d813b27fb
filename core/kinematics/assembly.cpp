#include "core/kinematics/assembly.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>

#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/rank.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 100;
constexpr int kMaxRestarts = 24;
constexpr double kLongestStep = 0.5;  // rad or m, of one iteration
constexpr double kPolished = 1e-14;   // residual at which iteration stops

std::vector<int> free_velocities(const Model& model) {
  std::vector<int> free;
  for (int k = 0; k < model.mechanism.nv; ++k) {
    const bool held = std::find(model.held.begin(), model.held.end(), k) != model.held.end();
    if (!held) free.push_back(k);
  }
  return free;
}

MatrixXd columns_of(const MatrixXd& a, const std::vector<int>& columns) {
  MatrixXd b(a.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i) {
    b.col(static_cast<Eigen::Index>(i)) = a.col(columns[i]);
  }
  return b;
}

VectorXd scatter(const VectorXd& part, const std::vector<int>& columns, int n) {
  VectorXd all = VectorXd::Zero(n);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    all[columns[i]] = part[static_cast<Eigen::Index>(i)];
  }
  return all;
}

// Step of least norm that minimises |r + J x|^2 + mu |x|^2.
VectorXd damped_step(const MatrixXd& j, const VectorXd& r, double mu) {
  if (mu == 0.0) return j.completeOrthogonalDecomposition().solve(-r);
  const MatrixXd normal = j.transpose() * j + mu * MatrixXd::Identity(j.cols(), j.cols());
  return normal.ldlt().solve(-(j.transpose() * r));
}

struct Closing {
  State<double> state;
  double residual;
  int iterations;
};

Closing close_loops(const Model& model, const std::vector<int>& free, State<double> s) {
  const Mechanism& m = model.mechanism;
  ClosureEquations e = compute_closure_equations(m, model.parameters, s);
  double residual = e.residual.norm();
  double mu = 0.0;
  int iteration = 0;
  for (; !free.empty() && iteration < kMaxIterations && residual > kPolished; ++iteration) {
    VectorXd x = damped_step(columns_of(e.jacobian, free), e.residual, mu);
    const double longest = x.lpNorm<Eigen::Infinity>();
    if (longest > kLongestStep) x *= kLongestStep / longest;
    const State<double> trial = displaced(m, s, scatter(x, free, m.nv));
    ClosureEquations et = compute_closure_equations(m, model.parameters, trial);
    if (et.residual.norm() < residual) {
      s = trial;
      e = std::move(et);
      residual = e.residual.norm();
      mu = mu < 1e-10 ? 0.0 : mu / 10.0;
    } else {
      if (residual < kClosedTolerance * 1e-2 || mu > 1e8) break;
      mu = mu == 0.0 ? 1e-6 : mu * 10.0;
    }
  }
  return {s, residual, iteration};
}

// Sense of the axes of every closure, x_1 . x_2 and y_1 . y_2 as far as the closure aligns them:
// rotation rows vanish for opposite axes too.
std::vector<bool> axis_senses(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, s.q.data(), s.v.data(), w);
  std::vector<bool> senses;
  for (std::size_t i = 0; i < m.closures.size(); ++i) {
    const ClosureStructure& c = m.closures[i];
    unsigned aligned = 0;
    for (int r = c.row_begin; r < c.row_end; ++r) {
      aligned |= 1u << m.cut_rows[static_cast<std::size_t>(r)].direction;
    }
    ClosureState<double>& x = w.closures[i];
    update_closure_pose(m, c, model.parameters.closures[i], w.bodies.data(), x);
    const bool tilts = (aligned >> kTheta & 1u) && (aligned >> kPsi & 1u);
    if (tilts) senses.push_back(dot(x.r1.x, x.r2.x) > 0.0);
    if (tilts && (aligned >> kPhi & 1u)) senses.push_back(dot(x.r1.y, x.r2.y) > 0.0);
  }
  return senses;
}

// Restart i: every free coordinate moved at random by up to a reach that grows with i.
State<double> perturbed(const Model& model, const std::vector<int>& free, const State<double>& s,
                        int restart) {
  std::mt19937_64 random(static_cast<std::uint64_t>(restart));
  const double reach = 3.0 * restart / kMaxRestarts;
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53 * 2.0 - 1.0; };
  VectorXd dq(static_cast<Eigen::Index>(free.size()));
  for (auto& x : dq) x = reach * unit();
  return displaced(model.mechanism, s, scatter(dq, free, model.mechanism.nv));
}

double distance(const Mechanism& m, const State<double>& a, const State<double>& b) {
  double square = 0.0;
  for (int i = 0; i < m.nq; ++i) {
    const auto k = static_cast<std::size_t>(i);
    square += (a.q[k] - b.q[k]) * (a.q[k] - b.q[k]);
  }
  return std::sqrt(square);
}

void find_branch(const Model& model, const MatrixXd& jacobian, AssemblyReport& report) {
  report.rows = static_cast<int>(jacobian.rows());
  report.rank = numerical_rank(jacobian, kRankTolerance).rank;
  report.mobility = model.mechanism.nv - report.rank;
  if (report.rank == 0 || report.rank < report.rows) return;
  const std::vector<int> free = free_velocities(model);
  const MatrixXd j = columns_of(jacobian, free);
  if (j.cols() < j.rows()) return;
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(j);
  std::vector<int> chosen;
  for (Eigen::Index i = 0; i < j.rows(); ++i) {
    chosen.push_back(free[static_cast<std::size_t>(qr.colsPermutation().indices()[i])]);
  }
  std::sort(chosen.begin(), chosen.end());
  const double det = columns_of(jacobian, chosen).determinant();
  report.dependent = chosen;
  report.branch = det > 0.0 ? 1 : det < 0.0 ? -1 : 0;
}

void name_worst_closure(const Model& model, const VectorXd& residual, AssemblyReport& report) {
  double worst = -1.0;
  for (std::size_t i = 0; i < model.mechanism.closures.size(); ++i) {
    const ClosureStructure& c = model.mechanism.closures[i];
    const double r = residual.segment(c.row_begin, c.row_end - c.row_begin).norm();
    if (r <= worst) continue;
    worst = r;
    report.worst_closure = model.mechanism.closure_names[i];
  }
}

void assemble_velocities(const Model& model, const MatrixXd& jacobian, State<double>& s,
                         AssemblyReport& report) {
  const std::vector<int> free = free_velocities(model);
  Eigen::Map<VectorXd> v(s.v.data(), model.mechanism.nv);
  const VectorXd rate = jacobian * v;
  const double scale = std::max(1.0, v.lpNorm<Eigen::Infinity>());
  if (free.empty() || rate.norm() <= kClosedTolerance * scale) {
    report.velocity_residual = rate.norm() / scale;
    return;
  }
  Eigen::CompleteOrthogonalDecomposition<MatrixXd> j(columns_of(jacobian, free));
  j.setThreshold(kRankTolerance);
  v += scatter(j.solve(-rate), free, model.mechanism.nv);
  report.velocity_residual = (jacobian * v).norm() / scale;
}

}  // namespace

Model compile_closed(const Linkage& linkage) {
  Linkage closed = linkage;
  for (Closure& c : closed.closures) c.model = ClosureModel::cut;
  return compile(closed);
}

State<double> displaced(const Mechanism& m, const State<double>& s, const VectorXd& dq) {
  State<double> moved = s;
  displace(m, dq.data(), moved.q.data());
  return moved;
}

ClosureEquations compute_closure_equations(const Mechanism& m, const Parameters<double>& p,
                                           const State<double>& s) {
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, p, s.q.data(), s.v.data(), w);
  update_rows(m, p, ClosureModel::cut, w);
  ClosureEquations e{VectorXd(m.cut_row_count()), row_jacobian(m, p, w, m.cut_rows, w.cut_rows)};
  for (std::size_t r = 0; r < w.cut_rows.size(); ++r) {
    e.residual[static_cast<Eigen::Index>(r)] = w.cut_rows[r].d;
  }
  return e;
}

AssemblyReport assemble_start(const Model& closed, State<double>& start) {
  const Mechanism& m = closed.mechanism;
  AssemblyReport report;
  normalize_quaternions(m, start.q.data());
  const State<double> given = start;
  ClosureEquations e = compute_closure_equations(m, closed.parameters, start);
  report.residual_given = report.residual = e.residual.norm();
  if (report.residual > kClosedTolerance) {
    const std::vector<int> free = free_velocities(closed);
    const std::vector<bool> senses = axis_senses(closed, given);
    Closing best = close_loops(closed, free, given);
    report.iterations = best.iterations;
    if (axis_senses(closed, best.state) != senses) best = {given, report.residual, best.iterations};
    while (best.residual > kClosedTolerance && report.restarts < kMaxRestarts && !free.empty()) {
      const Closing next =
          close_loops(closed, free, perturbed(closed, free, given, ++report.restarts));
      report.iterations += next.iterations;
      const bool same_sense = axis_senses(closed, next.state) == senses;
      if (same_sense && next.residual < best.residual) best = next;
    }
    if (best.residual < report.residual) start.q = best.state.q;
    e = compute_closure_equations(m, closed.parameters, start);
    report.residual = e.residual.norm();
    report.displacement = distance(m, given, start);
  }
  report.closed = report.residual <= kClosedTolerance;
  find_branch(closed, e.jacobian, report);
  if (report.closed) {
    assemble_velocities(closed, e.jacobian, start, report);
  } else {
    name_worst_closure(closed, e.residual, report);
  }
  return report;
}

}  // namespace linkstudy

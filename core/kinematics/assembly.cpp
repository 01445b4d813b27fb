#include "core/kinematics/assembly.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <numeric>
#include <random>
#include <sstream>

#include "core/kinematics/closure_jacobian.h"
#include "core/kinematics/cut_joint.h"
#include "core/kinematics/scaled_closures.h"
#include "core/kinematics/three_turns.h"
#include "core/numerics/dense.h"
#include "core/numerics/rank.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kMaxIterations = 100;
constexpr int kMaxRestarts = 24;
constexpr double kLongestStep = 0.5;  // rad or m, of one iteration
constexpr double kPolished = 1e-14;   // residual at which iteration stops

// Step of least norm that minimises |r + J x|^2 + mu |x|^2.
VectorXd damped_step(const MatrixXd& j, const VectorXd& r, double mu) {
  if (mu == 0.0) return solve_least_squares(j, -r);
  const MatrixXd normal = j.transpose() * j + mu * MatrixXd::Identity(j.cols(), j.cols());
  return solve_definite(normal, -(j.transpose() * r));
}

struct Closing {
  State<double> state;
  double residual;
  int iterations;
};

// `equations` of a state are to vanish.
template <class Equations>
Closing solve(const Mechanism& m, const Equations& equations, const std::vector<int>& free,
              State<double> s) {
  ClosureEquations e = equations(s);
  double residual = e.residual.norm();
  double mu = 0.0;
  int iteration = 0;
  for (; !free.empty() && iteration < kMaxIterations && residual > kPolished; ++iteration) {
    VectorXd x = damped_step(take_columns(e.jacobian, free), e.residual, mu);
    const double longest = x.lpNorm<Eigen::Infinity>();
    if (longest > kLongestStep) x *= kLongestStep / longest;
    const State<double> trial = displaced(m, s, scatter_entries(x, free, m.nv));
    ClosureEquations et = equations(trial);
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

// Axes that closure i aligns, of its first and second frame in turn: x, or x and y, or none.
struct AxisPair {
  Eigen::Vector3d first, second;
};
std::vector<AxisPair> aligned_axes(const Model& model, Workspace<double>& w, ClosureIndex i) {
  const Mechanism& m = model.mechanism;
  const ClosureStructure& c = m.closures[i];
  ClosureState<double>& pose = w.closures[i];
  update_closure_pose(m, c, model.parameters.closures[i], w.bodies, pose);
  const unsigned blocked = blocked_directions(m, c);
  const bool x = (blocked >> kTheta & 1u) && (blocked >> kPsi & 1u);
  const bool y = x && (blocked >> kPhi & 1u);
  const auto pair = [](const Vec3<double>& a, const Vec3<double>& b) {
    return AxisPair{{a.x, a.y, a.z}, {b.x, b.y, b.z}};
  };
  std::vector<AxisPair> pairs;
  if (x) pairs.push_back(pair(pose.R_WF.x, pose.R_WS.x));
  if (y) pairs.push_back(pair(pose.R_WF.y, pose.R_WS.y));
  return pairs;
}

struct Flipped {
  ClosureIndex closure;
  bool is_turned;  // it holds the whole orientation: its ends are another way round than described
};
std::vector<Flipped> flipped_closures(const Model& model, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, s.q.data(), s.v.data(), w);
  std::vector<Flipped> flipped;
  for (const ClosureIndex i : indices_of(m.closures)) {
    const std::vector<AxisPair> pairs = aligned_axes(model, w, i);
    const bool opposite = std::any_of(
        pairs.begin(), pairs.end(), [](const AxisPair& p) { return p.first.dot(p.second) < 0.0; });
    if (opposite) flipped.push_back({i, pairs.size() > 1});
  }
  return flipped;
}

// Rows in metres over the extent of the mechanism: what counts as closed does not depend on its
// size.
ClosureEquations scaled_equations(const Model& model, const ClosureScale& scale,
                                  const State<double>& s) {
  ClosureEquations e = compute_closure_equations(model.mechanism, model.parameters, s);
  e.residual = scale.row.cwiseProduct(e.residual);
  e.jacobian = scale.row.asDiagonal() * e.jacobian;
  return e;
}

// The scaled rows and, for every pair of axes that is to be aligned, the difference of the two:
// that one vanishes for the same sense only.
VectorXd aligning_residual(const Model& model, const ClosureScale& scale, const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, s.q.data(), s.v.data(), w);
  const VectorXd rows = scaled_equations(model, scale, s).residual;
  std::vector<double> r(rows.begin(), rows.end());
  for (const ClosureIndex i : indices_of(m.closures)) {
    for (const AxisPair& p : aligned_axes(model, w, i)) {
      for (int k = 0; k < 3; ++k) r.push_back(p.second[k] - p.first[k]);
    }
  }
  return Eigen::Map<const VectorXd>(r.data(), static_cast<Eigen::Index>(r.size()));
}

ClosureEquations aligning_equations(const Model& model, const ClosureScale& scale,
                                    const State<double>& s) {
  constexpr double h = 1e-6;  // rad or m: steps need no exact Jacobian
  const Mechanism& m = model.mechanism;
  ClosureEquations e{aligning_residual(model, scale, s), {}};
  e.jacobian.resize(e.residual.size(), m.nv);
  for (const VelocityIndex k : velocities(m)) {
    const VectorXd dq = h * VectorXd::Unit(m.nv, k.value());
    e.jacobian.col(k.value()) = (aligning_residual(model, scale, displaced(m, s, dq)) -
                                 aligning_residual(model, scale, displaced(m, s, -dq))) /
                                (2.0 * h);
  }
  return e;
}

// Closed with aligned axes before closed before open; the smaller residual then.
bool is_better(const Model& model, const Closing& a, const Closing& b) {
  const auto rank = [&](const Closing& c) {
    if (c.residual > kClosedTolerance) return 2;
    return flipped_closures(model, c.state).empty() ? 0 : 1;
  };
  const int rank_a = rank(a), rank_b = rank(b);
  return rank_a != rank_b ? rank_a < rank_b : rank_a == 2 && a.residual < b.residual;
}

// Closes the loops from s; from there with axes aligned first, if they end up opposite.
Closing close_loops(const Model& model, const ClosureScale& scale, const std::vector<int>& free,
                    const State<double>& s) {
  const Mechanism& m = model.mechanism;
  const auto rows = [&](const State<double>& x) { return scaled_equations(model, scale, x); };
  Closing direct = solve(m, rows, free, s);
  if (direct.residual > kClosedTolerance || flipped_closures(model, direct.state).empty()) {
    return direct;
  }
  const auto aligning = [&](const State<double>& x) { return aligning_equations(model, scale, x); };
  const Closing turned = solve(m, aligning, free, s);
  Closing aligned = solve(m, rows, free, turned.state);
  aligned.iterations += turned.iterations + direct.iterations;
  direct.iterations = aligned.iterations;
  return is_better(model, aligned, direct) ? aligned : direct;
}

// Restart i: every free coordinate moved at random by up to a reach that grows with i.
State<double> perturbed(const Model& model, const std::vector<int>& free, const State<double>& s,
                        int restart) {
  std::mt19937_64 random(static_cast<std::uint64_t>(restart));
  const double reach = 3.0 * restart / kMaxRestarts;
  const auto unit = [&] { return static_cast<double>(random() >> 11) * 0x1.0p-53 * 2.0 - 1.0; };
  VectorXd dq(static_cast<Eigen::Index>(free.size()));
  for (auto& x : dq) x = reach * unit();
  return displaced(model.mechanism, s, scatter_entries(dq, free, model.mechanism.nv));
}

double distance(const State<double>& a, const State<double>& b) {
  double square = 0.0;
  for (const PositionIndex i : indices_of(a.q)) square += (a.q[i] - b.q[i]) * (a.q[i] - b.q[i]);
  return std::sqrt(square);
}

// As many columns as rows, each with the largest part independent of those before; of equal ones
// the first, so that rounding does not choose. Rising.
std::vector<int> independent_columns(MatrixXd j) {
  constexpr double kEqual = 1e-6;
  std::vector<int> chosen;
  for (Eigen::Index i = 0; i < j.rows(); ++i) {
    const VectorXd sizes = j.colwise().norm();
    Eigen::Index k = 0;
    while (sizes[k] < (1.0 - kEqual) * sizes.maxCoeff()) ++k;
    const VectorXd direction = j.col(k).normalized();
    j -= direction * (direction.transpose() * j);
    j.col(k).setZero();
    chosen.push_back(static_cast<int>(k));
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

void find_branch(const Model& model, const State<double>& s, const MatrixXd& jacobian,
                 AssemblyReport& report) {
  report.rows = static_cast<int>(jacobian.rows());
  report.rank = numerical_rank(jacobian, kRankTolerance).rank;
  report.mobility = model.mechanism.nv - report.rank;
  if (report.rank == 0 || report.rank < report.rows) return;
  const std::vector<int> free = free_velocities(model);
  const MatrixXd j = take_columns_by_turns(model, s, jacobian, free);
  if (j.cols() < j.rows()) return;
  std::vector<int> chosen = independent_columns(j);  // places among the free ones
  const double det = determinant(take_columns(j, chosen));
  for (int& k : chosen) k = free[static_cast<std::size_t>(k)];
  report.dependent = chosen;
  report.branch = det > 0.0 ? 1 : det < 0.0 ? -1 : 0;
}

void name_worst_closure(const Model& model, const VectorXd& residual, AssemblyReport& report) {
  double worst = -1.0;
  for (const ClosureIndex i : indices_of(model.mechanism.closures)) {
    const ClosureStructure& c = model.mechanism.closures[i];
    const double r = residual.segment(c.row_begin.value(), c.row_end - c.row_begin).norm();
    if (r <= worst) continue;
    worst = r;
    report.worst_closure = model.mechanism.closure_names[i];
    double gap = 0.0, tilt = 0.0;
    for (const RowIndex row : rows_of(c)) {
      const bool turns = measures_turn(model.mechanism.cut_rows[row].kind);
      (turns ? tilt : gap) += residual[row.value()] * residual[row.value()];
    }
    report.worst_gap = std::sqrt(gap);
    report.worst_tilt = std::asin(std::min(1.0, std::sqrt(tilt)));
  }
  for (const CouplingIndex i : indices_of(model.mechanism.couplings)) {
    const double r = std::abs(residual[model.mechanism.couplings[i].row.value()]);
    if (r <= worst) continue;
    worst = r;
    report.worst_closure.clear();
    report.worst_coupling = model.mechanism.coupling_names[i];
    report.worst_gap = r;
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
  const VectorXd change = solve_least_squares(take_columns(jacobian, free), -rate, kRankTolerance);
  v += scatter_entries(change, free, model.mechanism.nv);
  report.velocity_residual = (jacobian * v).norm() / scale;
}

// From the given start, then by restarts until a pose is closed with aligned axes. `restarts` of
// the report says which one led to the returned pose, or how many were tried in vain.
Closing search(const Model& model, const ClosureScale& scale, const std::vector<int>& free,
               const State<double>& given, AssemblyReport& report) {
  Closing best = close_loops(model, scale, free, given);
  report.iterations = best.iterations;
  const auto is_done = [&] {
    return best.residual <= kClosedTolerance && flipped_closures(model, best.state).empty();
  };
  for (int i = 1; i <= kMaxRestarts && !free.empty() && !is_done(); ++i) {
    const Closing next = close_loops(model, scale, free, perturbed(model, free, given, i));
    report.iterations += next.iterations;
    const bool is_open = best.residual > kClosedTolerance;
    if (is_open) report.restarts = i;
    if (!is_better(model, next, best)) continue;
    best = next;
    report.restarts = i;
  }
  return best;
}

// Closed by its equations, but another way round.
std::string turned_text(const std::vector<std::string>& closures) {
  std::string text;
  for (const std::string& name : closures)
    text += (text.empty() ? "closure." : ", closure.") + name;
  return text +
         ": its ends are turned against each other by half a turn, which is not the joint that is "
         "described; turn one of its frames by 180 deg, or start nearer to the pose you mean";
}

}  // namespace

std::vector<std::string> flipped_texts(const AssemblyReport& report) {
  std::vector<std::string> texts;
  for (const std::string& name : report.flipped) {
    texts.push_back("closure '" + name +
                    "': the axes of its two ends point against each other at the start; turn one "
                    "of its frames by 180 deg, or start nearer to the pose you mean");
  }
  return texts;
}

std::string open_text(const AssemblyReport& report) {
  constexpr double kSlight = 1e-3;  // m and rad: dimensions are rounded
  const auto number = [](double x) {
    std::ostringstream text;
    text << std::setprecision(3) << x;
    return text.str();
  };
  if (!report.worst_coupling.empty()) {
    return "coupling." + report.worst_coupling + " is off by " + number(report.worst_gap) +
           "; leave out its offset to take the pose that is described";
  }
  if (report.worst_closure.empty()) return turned_text(report.turned);
  std::string text = "closure." + report.worst_closure + " stays open: gap " +
                     number(report.worst_gap) + " m, axes apart by " + number(report.worst_tilt) +
                     " rad";
  if (report.worst_gap < kSlight && report.worst_tilt < kSlight) {
    return text +
           "; an overconstrained loop closes only if its dimensions are exact (\"-90 deg\", "
           "not -1.5708)";
  }
  if (report.worst_tilt > 0.5) {
    return text + "; the axis of a closure is x of its frames, that of a tree joint z";
  }
  return text;
}

std::vector<int> free_velocities(const Model& model) {
  std::vector<int> free;
  for (const VelocityIndex k : velocities(model.mechanism)) {
    const bool held = std::find(model.held.begin(), model.held.end(), k) != model.held.end();
    if (!held) free.push_back(k.value());
  }
  return free;
}

Model compile_closed(const Linkage& linkage) {
  Linkage closed = linkage;
  for (Closure& c : closed.closures) c.model = ClosureModel::cut;
  closed.motions.clear();
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
  update_rows<RowStorage::cut>(m, p, w);
  ClosureEquations e{VectorXd(m.cut_row_count()), row_jacobian(m, p, w, m.cut_rows, w.cut_rows)};
  for (const RowIndex r : indices_of(w.cut_rows)) e.residual[r.value()] = w.cut_rows[r].d;
  return e;
}

int closure_rank(const Mechanism& m, const Parameters<double>& p, const State<double>& s) {
  if (m.cut_rows.empty()) return 0;
  return numerical_rank(compute_closure_equations(m, p, s).jacobian, kRankTolerance).rank;
}

double close_from(const Model& closed, const ClosureScale& scale, State<double>& s) {
  const Mechanism& m = closed.mechanism;
  const auto rows = [&](const State<double>& x) { return scaled_equations(closed, scale, x); };
  std::vector<int> all(static_cast<std::size_t>(m.nv));
  std::iota(all.begin(), all.end(), 0);
  const Closing closing = solve(m, rows, all, s);
  s = closing.state;
  return closing.residual;
}

AssemblyReport assemble_start(const Model& closed, State<double>& start) {
  const Mechanism& m = closed.mechanism;
  AssemblyReport report;
  normalize_quaternions(m, start.q.data());
  const State<double> given = start;
  const ClosureScale scale = find_closure_scale(closed, start);
  ClosureEquations e = compute_closure_equations(m, closed.parameters, start);
  double scaled = scale.row.cwiseProduct(e.residual).norm();
  report.residual_given = report.residual = e.residual.norm();
  if (scaled > kClosedTolerance) {
    const std::vector<int> free = free_velocities(closed);
    const Closing best = search(closed, scale, free, given, report);
    if (best.residual < scaled) start.q = best.state.q;
    scaled = std::min(scaled, best.residual);
    e = compute_closure_equations(m, closed.parameters, start);
    report.residual = e.residual.norm();
    report.displacement = distance(given, start);
  }
  report.closed = scaled <= kClosedTolerance;
  for (const Flipped& f : flipped_closures(closed, start)) {
    (f.is_turned ? report.turned : report.flipped).push_back(m.closure_names[f.closure]);
  }
  report.closed = report.closed && report.turned.empty();
  find_branch(closed, start, e.jacobian, report);
  if (report.closed) {
    assemble_velocities(closed, e.jacobian, start, report);
  } else if (scaled > kClosedTolerance) {
    name_worst_closure(closed, e.residual, report);
  }
  return report;
}

}  // namespace linkstudy

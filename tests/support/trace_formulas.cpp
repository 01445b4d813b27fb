#include "tests/support/trace_formulas.h"

#include <cmath>
#include <stdexcept>

namespace linkstudy::testing {
namespace {

// Singular values below this part of the largest count as zero: far above rounding and above the
// assembly error of a redundant loop, far below any genuine row.
constexpr double kRankTolerance = 1e-8;

struct CutClosure {
  int index = 0;
  ClosureFrames frames;
  std::vector<ClosureRow> rows;
};

struct Solution {
  Vector qdd, multipliers;
  bool redundant = false;
};

double baumgarte_terms(const Closure& closure, const ClosureRow& row) {
  if (closure.stabilization != Stabilization::baumgarte) return 0.0;
  return -2.0 * closure.alpha * row.d_dot - closure.beta * closure.beta * row.d;
}

// min (qdd - x0)^T a (qdd - x0) subject to J qdd = gamma, in y = L^T qdd with a = L L^T.
Solution least_constraint(const Matrix& a, const Matrix& J, const Vector& force,
                          const Vector& gamma) {
  const Eigen::LLT<Matrix> cholesky(a);
  const Matrix W = cholesky.matrixL().solve(J.transpose()).transpose();
  const Vector y0 = cholesky.matrixL().solve(force);
  Eigen::CompleteOrthogonalDecomposition<Matrix> cod;
  cod.setThreshold(kRankTolerance);
  cod.compute(W);
  const Vector y = y0 + cod.solve(gamma - W * y0);
  cod.compute(W.transpose());
  return {cholesky.matrixU().solve(y), cod.solve(y0 - y), cod.rank() < J.rows()};
}

Solution solve(const Matrix& a, const Matrix& J, const Vector& force, const Vector& gamma) {
  const auto n = a.rows();
  const auto m = J.rows();
  Matrix system = Matrix::Zero(n + m, n + m);
  system.topLeftCorner(n, n) = a;
  system.topRightCorner(n, m) = J.transpose();
  system.bottomLeftCorner(m, n) = J;
  Vector right(n + m);
  right << force, gamma;
  const Eigen::PartialPivLU<Matrix> gauss(system);
  const auto pivots = gauss.matrixLU().diagonal().cwiseAbs();
  if (m > 0 && pivots.minCoeff() < kRankTolerance * pivots.maxCoeff()) {
    return least_constraint(a, J, force, gamma);
  }
  const Vector x = gauss.solve(right);
  return {x.head(n), x.tail(m), false};
}

// Rows that hold: those of the cut joint, or what a planar clearance leaves of it.
std::vector<ClosureRow> held_rows(const Closure& closure, const ClosureFrames& frames) {
  const bool loose = closure.model == ClosureModel::clearance;
  return cut_rows(frames, loose ? JointType::planar : closure.type);
}

// Columns of joints that may not move are cleared.
Matrix without_held(const TraceModel& model, Matrix J) {
  for (const Joint& joint : model.linkage.joints) {
    if (!joint.hold) continue;
    J.middleCols(coordinate_index(model, joint.name), static_cast<int>(basic_motions(joint).size()))
        .setZero();
  }
  return J;
}

Vector minimum_norm(const Matrix& J, const Vector& right) {
  Eigen::CompleteOrthogonalDecomposition<Matrix> cod;
  cod.setThreshold(kRankTolerance);
  cod.compute(J);
  return cod.solve(right);
}

}  // namespace

OracleResult oracle_acceleration(const TraceModel& model, double t, const Vector& q,
                                 const Vector& v, const std::vector<OracleContact>& contacts) {
  const std::vector<LinkTransform> transforms = link_transforms(model, q);
  const TreeEquations tree = tree_equations(model, transforms, v);
  Vector force = generalised_loads(model, transforms, t, v) + joint_springs(model, q, v) -
                 tree.velocity - tree.gravity;

  OracleResult result;
  result.closures.resize(model.closures.size());
  result.contacts.resize(model.closures.size());
  std::vector<CutClosure> cuts;
  int row_count = 0;
  for (std::size_t c = 0; c < model.closures.size(); ++c) {
    const TraceClosure& closure = model.closures[c];
    ClosureFrames frames = closure_frames(model, closure, transforms, v);
    if (closure.closure.model == ClosureModel::sde) {
      result.closures[c] = sde_result(closure, frames);
      force += result.closures[c].generalised;
    } else {
      if (closure.closure.model == ClosureModel::clearance) {
        result.contacts[c] =
            contact_result(closure, frames, contacts.empty() ? OracleContact{} : contacts.at(c));
        force += result.contacts[c].generalised;
      }
      std::vector<ClosureRow> rows = held_rows(closure.closure, frames);
      row_count += static_cast<int>(rows.size());
      cuts.push_back({static_cast<int>(c), std::move(frames), std::move(rows)});
    }
  }

  Matrix J(row_count, model.dof);
  Vector gamma(row_count);
  int r = 0;
  for (const CutClosure& cut : cuts) {
    for (const ClosureRow& row : cut.rows) {
      J.row(r) = row.d_q.transpose();
      gamma[r++] = -row.d_vv + baumgarte_terms(model.closures[cut.index].closure, row);
    }
  }
  const Solution solution = solve(tree.mass_matrix, J, force, gamma);
  result.qdd = solution.qdd;
  result.multipliers = solution.multipliers;
  result.redundant = solution.redundant;
  r = 0;
  for (const CutClosure& cut : cuts) {
    const int m = static_cast<int>(cut.rows.size());
    result.closures[cut.index] = cut_result(model.closures[cut.index], cut.frames, cut.rows,
                                            result.multipliers.segment(r, m));
    r += m;
  }
  return result;
}

OracleResult oracle_acceleration(const Linkage& linkage, double t, const Vector& q,
                                 const Vector& v) {
  return oracle_acceleration(make_trace_model(linkage), t, q, v);
}

Constraints cut_constraints(const TraceModel& model, const Vector& q, const Vector& v) {
  const std::vector<LinkTransform> transforms = link_transforms(model, q);
  std::vector<ClosureRow> rows;
  for (const TraceClosure& closure : model.closures) {
    if (closure.closure.model == ClosureModel::sde) continue;
    const ClosureFrames frames = closure_frames(model, closure, transforms, v);
    for (ClosureRow& row : held_rows(closure.closure, frames)) rows.push_back(std::move(row));
  }
  const int m = static_cast<int>(rows.size());
  Constraints constraints{Vector(m), Matrix(m, model.dof), Vector(m)};
  for (int r = 0; r < m; ++r) {
    constraints.value[r] = rows[r].d;
    constraints.jacobian.row(r) = rows[r].d_q.transpose();
    constraints.velocity_terms[r] = rows[r].d_vv;
  }
  return constraints;
}

OracleState start_state(const TraceModel& model) {
  return {0.0, model.q0, model.v0};
}

void rk4_step(const TraceModel& model, double h, OracleState& state) {
  const auto qdd = [&](double dt, const Vector& q, const Vector& v) {
    return oracle_acceleration(model, state.t + dt, q, v).qdd;
  };
  const Vector& q = state.q;
  const Vector& v = state.v;
  const Vector a1 = qdd(0.0, q, v);
  const Vector v2 = v + 0.5 * h * a1;
  const Vector a2 = qdd(0.5 * h, q + 0.5 * h * v, v2);
  const Vector v3 = v + 0.5 * h * a2;
  const Vector a3 = qdd(0.5 * h, q + 0.5 * h * v2, v3);
  const Vector v4 = v + h * a3;
  const Vector a4 = qdd(h, q + h * v3, v4);
  state.q += h / 6.0 * (v + 2.0 * v2 + 2.0 * v3 + v4);
  state.v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
  state.t += h;
}

OracleState rk4(const TraceModel& model, double h, long steps, OracleState state) {
  const double t0 = state.t;
  for (long k = 0; k < steps; ++k) {
    state.t = t0 + static_cast<double>(k) * h;
    rk4_step(model, h, state);
  }
  return state;
}

double total_energy(const TraceModel& model, const OracleState& state) {
  double energy = kinetic_energy(model, state.q, state.v) + gravity_energy(model, state.q) +
                  spring_energy(model, state.q);
  const std::vector<LinkTransform> transforms = link_transforms(model, state.q);
  for (const TraceClosure& closure : model.closures) {
    const ClosureFrames frames = closure_frames(model, closure, transforms, state.v);
    if (closure.closure.model == ClosureModel::sde) energy += sde_result(closure, frames).energy;
    if (closure.closure.model == ClosureModel::clearance) {
      energy += contact_result(closure, frames, {}).stored;
    }
  }
  return energy;
}

OracleState closed_state(const TraceModel& model, const OracleState& state) {
  OracleState closed = state;
  double gap = 1.0;
  for (int iteration = 0; iteration < 50 && gap > 1e-14; ++iteration) {
    const Constraints c = cut_constraints(model, closed.q, closed.v);
    if (c.value.size() == 0) return closed;
    closed.q -= minimum_norm(without_held(model, c.jacobian), c.value);
    gap = c.value.cwiseAbs().maxCoeff();
  }
  if (!(gap < 1e-10)) throw std::runtime_error("oracle: the closures do not close");
  const Matrix J = cut_constraints(model, closed.q, closed.v).jacobian;
  closed.v -= minimum_norm(without_held(model, J), J * closed.v);
  return closed;
}

}  // namespace linkstudy::testing

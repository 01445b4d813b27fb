#include "core/dynamics/static_balance.h"

#include <algorithm>
#include <cmath>

#include "core/dynamics/differences.h"
#include "core/dynamics/linear_springs.h"
#include "core/dynamics/motion.h"
#include "core/forces/applied_forces.h"
#include "core/kinematics/assembly.h"
#include "core/kinematics/closure_jacobian.h"
#include "core/kinematics/scaled_closures.h"
#include "core/numerics/dense.h"

namespace linkstudy {

using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

// Of a course at this time, in whatever position.
double greatest_value(const Model& model, const CourseStructure& c,
                      const CourseParameters<double>& n, double t) {
  const auto& segments = model.parameters.segments;
  if (!c.q.exists()) {
    return std::abs(course_value(c, n, segments, course_argument<double>(c, n, t, nullptr)));
  }
  double value = n.value, greatest = std::abs(value);
  for (const SegmentIndex i : indices(c.begin, c.end)) {
    const SegmentParameters<double>& segment = segments[i];
    value += segment.length * segment.slope;
    greatest = std::max(greatest, std::abs(value));
  }
  return greatest;
}

}  // namespace

Balance compute_balance(const Model& model, const State<double>& s, Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  compute_motion(m, model.parameters, s, w);
  Balance b{Eigen::Map<const VectorXd>(w.tau.data(), m.nv), VectorXd(m.cut_row_count()),
            row_jacobian(m, model.parameters, w, m.cut_rows, w.cut_rows)};
  for (const RowIndex r : indices_of(w.cut_rows)) b.phi[r.value()] = w.cut_rows[r].d;
  return b;
}

VectorXd least_multipliers(const Balance& b, const std::vector<int>& free) {
  if (b.j.rows() == 0) return {};
  const MatrixXd jt = take_columns(b.j, free).transpose();
  return solve_least_squares(jt, take_entries(b.tau, free));
}

VectorXd net_force(const Balance& b, const VectorXd& lambda) {
  return b.tau - b.j.transpose() * lambda;
}

VectorXd take_entries(const VectorXd& all, const std::vector<int>& at) {
  VectorXd part(static_cast<Eigen::Index>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i) part[static_cast<Eigen::Index>(i)] = all[at[i]];
  return part;
}

ForceGradient compute_force_gradient(const Model& model, const State<double>& s,
                                     const VectorXd& lambda, const std::vector<int>& free,
                                     Workspace<double>& w) {
  const Mechanism& m = model.mechanism;
  const std::optional<Model> linear = with_linear_forces(model, s, w);
  const Model& near = linear ? *linear : model;
  const VectorXd steps = difference_steps(model, s);
  const auto n = static_cast<Eigen::Index>(free.size());
  ForceGradient g{MatrixXd(n, n), MatrixXd(n, n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const int k = free[static_cast<std::size_t>(i)];
    const auto force = [&](double x) {
      const State<double> moved = displaced(m, s, x * VectorXd::Unit(m.nv, k));
      return take_entries(net_force(compute_balance(near, moved, w), lambda), free);
    };
    const Derivative column = differentiate(force, steps[k]);
    g.value.col(i) = column.value;
    g.doubt.col(i) = column.doubt;
  }
  return g;
}

BalanceSystem make_balance_system(const MatrixXd& gradient, const Balance& b, const VectorXd& force,
                                  const std::vector<int>& free) {
  const Eigen::Index n = gradient.rows();
  const Eigen::Index c = b.phi.size();
  const MatrixXd j = take_columns(b.j, free);
  BalanceSystem s{MatrixXd::Zero(n + c, n + c), VectorXd(n + c),
                  n == 0 ? 1.0 : std::max(1.0, gradient.cwiseAbs().maxCoeff())};
  s.a.topLeftCorner(n, n) = gradient;
  s.a.topRightCorner(n, c) = -j.transpose();
  s.a.bottomLeftCorner(c, n) = j;
  s.r << -force, -b.phi;
  s.a.rightCols(c) *= s.scale;
  s.a.bottomRows(c) *= s.scale;
  s.r.tail(c) *= s.scale;
  return s;
}

double force_scale(const Model& model, double t) {
  const Parameters<double>& p = model.parameters;
  double scale = 1e-6;
  for (const BodyIndex b : bodies_outwards(model.mechanism)) {
    scale = std::max(scale, p.bodies[b].mass * sqrt(dot(p.gravity, p.gravity)));
  }
  for (const LoadIndex i : indices_of(p.loads)) {
    const LoadStructure& load = model.mechanism.loads[i];
    if (load.type == LoadType::resistance) continue;
    scale = std::max(scale, greatest_value(model, load.course, p.loads[i].course, t));
  }
  for (const PointSpringIndex i : indices_of(p.point_springs)) {
    const PointSpringStructure& spring = model.mechanism.point_springs[i];
    if (!spring.is_driven) continue;
    scale = std::max(scale, greatest_value(model, spring.course, p.point_springs[i].course, t));
  }
  return scale;
}

std::string velocity_name(const Mechanism& m, VelocityIndex velocity) {
  const BodyIndex body = m.velocities[velocity].body;
  const Body& b = m.bodies[body];
  const std::string name = "joint." + m.joint_names[body];
  return b.v_count == 1 ? name : name + "." + std::to_string(velocity - b.v_begin);
}

const char* effort_unit(const Mechanism& m, VelocityIndex velocity) {
  const VelocityKind kind = m.velocities[velocity].kind;
  return kind == VelocityKind::translation ? "N" : "N m";
}

}  // namespace linkstudy

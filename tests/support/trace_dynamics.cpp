#include "tests/support/trace_dynamics.h"

namespace linkstudy::testing {
namespace {

void add_link(const TraceLink& link, const LinkTransform& moving, const Vector& g_vec,
              const Vector& v, TreeEquations& equations) {
  const std::size_t n = link.path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const int row = link.path[i];
    const Transform T_i_H = moving.T_i[i] * link.H;
    for (std::size_t j = 0; j < n; ++j) {
      equations.mass_matrix(row, link.path[j]) += (T_i_H * moving.T_i[j].transpose()).trace();
    }
    for (std::size_t m = 0; m < n; ++m) {
      for (std::size_t k = 0; k < n; ++k) {
        equations.velocity[row] +=
            (T_i_H * moving.T_ij[m][k].transpose()).trace() * v[link.path[m]] * v[link.path[k]];
      }
    }
    equations.gravity[row] -= link.mass * g_vec.dot(moving.T_i[i] * link.r_C);
  }
}

Vector homogeneous_direction(const Eigen::Vector3d& direction) {
  Vector d(4);
  d << direction, 0.0;
  return d;
}

}  // namespace

TreeEquations tree_equations(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                             const Vector& v) {
  TreeEquations equations{Matrix::Zero(model.dof, model.dof), Vector::Zero(model.dof),
                          Vector::Zero(model.dof)};
  const Vector g_vec = homogeneous_direction(model.linkage.gravity);
  for (std::size_t p = 0; p < model.links.size(); ++p) {
    add_link(model.links[p], transforms[p], g_vec, v, equations);
  }
  return equations;
}

double kinetic_energy(const TraceModel& model, const Vector& q, const Vector& v) {
  const std::vector<LinkTransform> transforms = link_transforms(model, q);
  double energy = 0.0;
  for (std::size_t p = 0; p < model.links.size(); ++p) {
    Transform T_dot = Transform::Zero(4, 4);
    for (std::size_t i = 0; i < model.links[p].path.size(); ++i) {
      T_dot += transforms[p].T_i[i] * v[model.links[p].path[i]];
    }
    energy += 0.5 * (T_dot * model.links[p].H * T_dot.transpose()).trace();
  }
  return energy;
}

double gravity_energy(const TraceModel& model, const Vector& q) {
  const std::vector<LinkTransform> transforms = link_transforms(model, q);
  const Vector g_vec = homogeneous_direction(model.linkage.gravity);
  double energy = 0.0;
  for (std::size_t p = 0; p < model.links.size(); ++p) {
    energy -= model.links[p].mass * g_vec.dot(transforms[p].T * model.links[p].r_C);
  }
  return energy;
}

}  // namespace linkstudy::testing

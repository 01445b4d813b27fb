// The trace formulas of a tree against Newton-Euler in ground-axes vectors and against Lagrange's
// equations by finite differences: random branching trees of all joint types.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/mechanisms/random_linkages.h"
#include "tests/support/free_bodies.h"
#include "tests/support/near.h"
#include "tests/support/trace_formulas.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::oracle_tree_test {
namespace {

constexpr int kTrees = 40;
constexpr double kStep = 1e-6;  // central differences: error about 1e-12 truncation, 1e-10 rounding

struct RandomMotion {
  Linkage linkage;
  TraceModel model;
  Vector q, v, a;
};

RandomMotion random_motion(std::uint64_t seed) {
  RandomMotion m;
  m.linkage = random_tree(seed);
  m.model = make_trace_model(m.linkage);
  m.q = m.model.q0;
  m.v = m.model.v0;
  m.a = (17.0 * m.q + 5.0 * m.v).array().sin();  // any numbers of order one
  return m;
}

Matrix mass_matrix(const TraceModel& model, const Vector& q) {
  return tree_equations(model, link_transforms(model, q), Vector::Zero(model.dof)).mass_matrix;
}

// Power of a link's inertial and weight wrench at another velocity field.
double power(const Link& body, const LinkMotion& link, const LinkMotion& virtual_link,
             const Eigen::Vector3d& gravity) {
  const Eigen::Vector3d a_C = point_motion(link, body.center_of_mass).a;
  const Eigen::Vector3d v_C = point_motion(virtual_link, body.center_of_mass).v;
  const Eigen::Matrix3d I = link.R * body.inertia * link.R.transpose();
  return body.mass * (a_C - gravity).dot(v_C) +
         (I * link.alpha + link.omega.cross(I * link.omega)).dot(virtual_link.omega);
}

// a qdd + h + g by Jourdain's principle over free bodies.
Vector inverse_dynamics(const RandomMotion& m) {
  const auto motions = link_motions(m.linkage, m.q, m.v, m.a);
  Vector Q = Vector::Zero(m.model.dof);
  for (int i = 0; i < m.model.dof; ++i) {
    const auto unit = link_motions(m.linkage, m.q, Vector::Unit(m.model.dof, i), 0.0 * m.a);
    for (const Link& body : m.linkage.links) {
      Q[i] +=
          power(body, motion_of(motions, body.name), motion_of(unit, body.name), m.linkage.gravity);
    }
  }
  return Q;
}

}  // namespace

TEST(OracleTree, Velocities_are_stacked_as_listed_once_parents_are_placed) {
  Linkage linkage;
  const auto add = [&](const std::string& parent, const std::string& child) {
    Joint joint;
    joint.name = parent + "-" + child;
    joint.parent = parent;
    joint.child = child;
    linkage.joints.push_back(joint);
  };
  add("c", "d");
  add("a", "b");
  add(kGround, "a");
  add("b", "c");
  add(kGround, "e");
  EXPECT_EQ(tree_order(linkage), (std::vector<int>{2, 1, 3, 0, 4}));
  add("nowhere", "f");
  EXPECT_THROW(tree_order(linkage), std::invalid_argument);
}

TEST(OracleTree, Second_derivatives_are_the_derivatives_of_the_first) {
  const RandomMotion m = random_motion(3);
  for (int k = 0; k < m.model.dof; ++k) {
    const Vector dq = kStep * Vector::Unit(m.model.dof, k);
    const auto plus = link_transforms(m.model, m.q + dq);
    const auto minus = link_transforms(m.model, m.q - dq);
    const auto here = link_transforms(m.model, m.q);
    for (std::size_t p = 0; p < here.size(); ++p) {
      const std::vector<int>& path = m.model.links[p].path;
      const auto at = std::find(path.begin(), path.end(), k) - path.begin();
      if (at == static_cast<long>(path.size())) continue;
      EXPECT_TRUE(near_absolute((plus[p].T - minus[p].T) / (2 * kStep), here[p].T_i[at], 1e-8));
      for (std::size_t i = 0; i < path.size(); ++i) {
        EXPECT_TRUE(near_absolute((plus[p].T_i[i] - minus[p].T_i[i]) / (2 * kStep),
                                  here[p].T_ij[i][at], 1e-8));
      }
    }
  }
}

TEST(OracleTree, The_mass_matrix_is_the_kinetic_energy_of_free_bodies) {
  for (int seed = 0; seed < kTrees; ++seed) {
    const RandomMotion m = random_motion(seed);
    const int n = m.model.dof;
    const auto energy = [&](const Vector& v) {
      return kinetic_energy(m.linkage, link_motions(m.linkage, m.q, v, 0.0 * v));
    };
    Matrix M(n, n);
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const Vector e_i = Vector::Unit(n, i), e_j = Vector::Unit(n, j);
        M(i, j) = energy(e_i + e_j) - energy(e_i) - energy(e_j);
      }
    }
    EXPECT_TRUE(near_relative(mass_matrix(m.model, m.q), M, 1e-13)) << "seed " << seed;
    EXPECT_NEAR(kinetic_energy(m.model, m.q, m.v), energy(m.v), 1e-13 * energy(m.v));
  }
}

TEST(OracleTree, The_equations_of_motion_are_those_of_free_bodies) {
  for (int seed = 0; seed < kTrees; ++seed) {
    const RandomMotion m = random_motion(seed);
    const TreeEquations tree = tree_equations(m.model, link_transforms(m.model, m.q), m.v);
    EXPECT_TRUE(near_relative(tree.mass_matrix * m.a + tree.velocity + tree.gravity,
                              inverse_dynamics(m), 1e-13))
        << "seed " << seed;
  }
}

TEST(OracleTree, Velocity_terms_are_Lagranges) {
  for (int seed = 0; seed < kTrees; ++seed) {
    const RandomMotion m = random_motion(seed);
    const int n = m.model.dof;
    const Matrix M_dot =
        (mass_matrix(m.model, m.q + kStep * m.v) - mass_matrix(m.model, m.q - kStep * m.v)) /
        (2 * kStep);
    Vector h = M_dot * m.v;
    Vector g(n);
    for (int i = 0; i < n; ++i) {
      const Vector dq = kStep * Vector::Unit(n, i);
      h[i] -= (kinetic_energy(m.model, m.q + dq, m.v) - kinetic_energy(m.model, m.q - dq, m.v)) /
              (2 * kStep);
      g[i] = (gravity_energy(m.model, m.q + dq) - gravity_energy(m.model, m.q - dq)) / (2 * kStep);
    }
    const TreeEquations tree = tree_equations(m.model, link_transforms(m.model, m.q), m.v);
    EXPECT_TRUE(near_absolute(tree.velocity, h, 1e-8 * (1 + h.norm()))) << "seed " << seed;
    EXPECT_TRUE(near_absolute(tree.gravity, g, 1e-8 * (1 + g.norm()))) << "seed " << seed;
  }
}

TEST(OracleTree, Jacobians_give_the_velocities_of_free_bodies) {
  for (int seed = 0; seed < kTrees; ++seed) {
    const RandomMotion m = random_motion(seed);
    const auto transforms = link_transforms(m.model, m.q);
    const Eigen::Vector3d point(0.1, -0.4, 0.3);
    for (const LinkMotion& link : link_motions(m.linkage, m.q, m.v, m.a)) {
      const int p = link_index(m.model, link.link);
      const PointMotion moving = point_motion(link, point);
      EXPECT_TRUE(near_absolute(point_position(m.model, transforms, p, point), moving.p, 1e-13));
      EXPECT_TRUE(
          near_absolute(point_jacobian(m.model, transforms, p, point) * m.v, moving.v, 1e-13));
      EXPECT_TRUE(
          near_absolute(rotation_jacobian(m.model, transforms, p) * m.v, link.omega, 1e-13));
    }
  }
}

TEST(OracleTree, Loads_on_links_have_the_power_of_their_wrenches) {
  for (int seed = 0; seed < kTrees; ++seed) {
    RandomMotion m = random_motion(seed);
    std::erase_if(m.model.loads, [](const TraceLoad& load) {
      return load.load.type == LoadType::drive || load.load.type == LoadType::resistance;
    });
    const double t = 0.3;
    const auto motions = link_motions(m.linkage, m.q, m.v, m.a);
    double expected = 0.0;
    for (const ExternalWrench& wrench : load_wrenches(m.linkage, motions, t)) {
      const LinkMotion& link = motion_of(motions, wrench.link);
      const Eigen::Vector3d velocity = link.v + link.omega.cross(wrench.point - link.p);
      expected += wrench.force.dot(velocity) + wrench.torque.dot(link.omega);
    }
    const Vector Q = generalised_loads(m.model, link_transforms(m.model, m.q), t, m.v);
    EXPECT_NEAR(Q.dot(m.v), expected, 1e-12 * (1 + std::abs(expected))) << "seed " << seed;
  }
}

TEST(OracleTree, Courses_and_resistances_take_their_named_values) {
  const Course ramp{CourseShape::ramp, 10.0, 5.0, {}, {}};
  EXPECT_DOUBLE_EQ(course_value(ramp, 1.25), 2.5);
  EXPECT_DOUBLE_EQ(course_value(ramp, 9.0), 10.0);
  const Course smooth{CourseShape::smooth, 10.0, 4.0, {}, {}};
  EXPECT_DOUBLE_EQ(course_value(smooth, 1.0), 10.0 * (3.0 / 16 - 2.0 / 64));
  const Course table{CourseShape::table, 0.0, 0.0, {1.0, 3.0}, {4.0, 8.0}};
  EXPECT_DOUBLE_EQ(course_value(table, 2.5), 7.0);
  EXPECT_DOUBLE_EQ(course_value(table, 0.0), 4.0);
  EXPECT_DOUBLE_EQ(course_value(table, 5.0), 8.0);
  EXPECT_DOUBLE_EQ(resistance_value({ResistanceShape::linear, 10.0, 9.0}, -4.5), -5.0);
  EXPECT_DOUBLE_EQ(resistance_value({ResistanceShape::quadratic, 10.0, 9.0}, -4.5), -2.5);
}

TEST(OracleTree, A_quaternion_describes_the_same_motion_as_its_angles) {
  for (int seed = 0; seed < kTrees; ++seed) {
    const RandomMotion m = random_motion(seed);
    const Linkage quaternions = with_quaternions(m.linkage);
    const QuaternionMotion mapped = quaternion_motion(quaternions, m.q, m.v, m.a);
    const auto zyx = link_motions(m.linkage, m.q, m.v, m.a);
    const auto same = link_motions(quaternions, mapped.q, mapped.v, mapped.a);
    for (std::size_t p = 0; p < zyx.size(); ++p) {
      EXPECT_TRUE(near_absolute(same[p].R, zyx[p].R, 1e-13));
      EXPECT_TRUE(near_absolute(same[p].p, zyx[p].p, 1e-13));
      EXPECT_TRUE(near_absolute(same[p].omega, zyx[p].omega, 1e-13));
      EXPECT_TRUE(near_absolute(same[p].alpha, zyx[p].alpha, 1e-11)) << "seed " << seed;
      EXPECT_TRUE(near_absolute(same[p].a, zyx[p].a, 1e-11)) << "seed " << seed;
    }
    const TraceModel back = make_trace_model(with_zyx(quaternions));
    EXPECT_TRUE(near_absolute(back.q0, m.model.q0, 1e-14));
    EXPECT_TRUE(near_absolute(back.v0, m.model.v0, 1e-14));
  }
}

TEST(OracleTree, An_unloaded_tree_keeps_its_energy) {
  RandomTree options;
  options.loads = false;
  for (int seed = 0; seed < 5; ++seed) {
    const TraceModel model = make_trace_model(random_tree(seed, options));
    const OracleState start = start_state(model);
    const double before = total_energy(model, start);
    const double coarse = total_energy(model, rk4(model, 4e-3, 25, start)) - before;
    const double fine = total_energy(model, rk4(model, 2e-3, 50, start)) - before;
    EXPECT_LT(std::abs(fine), 1e-7 * (1 + std::abs(before))) << "seed " << seed;
    EXPECT_LT(std::abs(fine), std::abs(coarse) / 10 + 1e-11) << "only the integrator loses energy";
  }
}

}  // namespace linkstudy::testing::oracle_tree_test

// Exact derivatives of the equations of motion against differences of sixth order.
#include "core/dynamics/motion_derivative.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/dynamics/equations_of_motion.h"
#include "core/simulation/prepare.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/derivatives.h"

namespace linkstudy::testing::motion_derivative_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

// x' and the powers at x = (q, v, z), in plain doubles.
class Rates {
 public:
  explicit Rates(const Model& model) : model_(model), w(make_workspace<double>(model.mechanism)) {}

  VectorXd at(double t, const VectorXd& x) {
    const Mechanism& m = model_.mechanism;
    const double* q = x.data();
    const double* v = q + m.nq;
    for (int i = 0; i < m.nz; ++i) w.z[BristleIndex(i)] = v[m.nv + i];
    evaluate(m, model_.parameters, t, q, v, w);
    VectorXd rates(x.size() + 2);
    for (const Stage& s : m.stages) {
      position_rates(s, q + s.q.value(), v + s.v.value(), rates.data() + s.q.value());
    }
    for (int k = 0; k < m.nv; ++k) rates[m.nq + k] = w.qdd[VelocityIndex(k)];
    for (int i = 0; i < m.nz; ++i) rates[m.nq + m.nv + i] = w.z_rate[BristleIndex(i)];
    rates.tail<2>() << w.supplied_power, w.dissipated_power;
    return rates;
  }

 private:
  const Model& model_;

 public:
  Workspace<double> w;
};

VectorXd state_of(const Model& model) {
  const State<double>& s = model.start;
  VectorXd x(static_cast<Eigen::Index>(s.q.size() + s.v.size()) + model.mechanism.nz);
  x << Eigen::Map<const VectorXd>(s.q.data(), model.mechanism.nq),
      Eigen::Map<const VectorXd>(s.v.data(), model.mechanism.nv),
      VectorXd::Zero(model.mechanism.nz);
  return x;
}

// By differences; `step`: of each unknown, times the larger of its size and 1.
MatrixXd differences(Rates& rates, double t, const VectorXd& x, double step) {
  MatrixXd j(x.size() + 2, x.size());
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    const double h = step * std::max(1.0, std::fabs(x[k]));
    const auto moved = [&](double by) {
      VectorXd to = x;
      to[k] += by;
      return rates.at(t, to);
    };
    const auto central = [&](double by) -> VectorXd {
      return (moved(by) - moved(-by)) / (2.0 * by);
    };
    j.col(k) = 1.5 * central(h) - 0.6 * central(2.0 * h) + 0.1 * central(3.0 * h);
  }
  return j;
}

void expect_exact(const Model& model, double t, const VectorXd& x, double step,
                  double tolerance = 1e-8,
                  const std::function<void(Workspace<double>&)>& remember = nullptr) {
  const Mechanism& m = model.mechanism;
  Rates rates(model);
  if (remember) remember(rates.w);
  MotionDerivative derivative(m, model.parameters);
  ASSERT_TRUE(
      derivative.update(t, x.data(), x.data() + m.nq, x.data() + m.nq + m.nv, rates.w.memory));
  const MatrixXd expected = differences(rates, t, x, step);
  ASSERT_EQ(derivative.matrix().rows(), expected.rows());
  for (Eigen::Index i = 0; i < expected.rows(); ++i) {
    const double size = std::max(1e-3, expected.row(i).lpNorm<Eigen::Infinity>());
    for (Eigen::Index k = 0; k < expected.cols(); ++k) {
      EXPECT_NEAR(derivative.matrix()(i, k), expected(i, k), tolerance * size) << i << ", " << k;
    }
  }
}

}  // namespace

TEST(MotionDerivative, A_pendulum_has_that_of_its_sine) {
  Linkage linkage;
  linkage.gravity = {0.0, -9.81, 0.0};
  linkage.links = {{"arm", 2.0, {0.5, 0.0, 0.0}, Eigen::Vector3d(0.1, 0.1, 0.1).asDiagonal()}};
  Joint joint;
  joint.name = "A";
  joint.type = JointType::revolute;
  joint.parent = kGround;
  joint.child = "arm";
  joint.position = {0.3};
  linkage.joints = {joint};
  const Model model = compile(linkage);
  MotionDerivative derivative(model.mechanism, model.parameters);
  const double q = 0.3, v = 1.7;
  ASSERT_TRUE(derivative.update(0.0, &q, &v, nullptr, {}));
  // I q'' = -m g l cos q
  EXPECT_EQ(derivative.matrix()(0, 0), 0.0);
  EXPECT_EQ(derivative.matrix()(0, 1), 1.0);
  EXPECT_NEAR(derivative.matrix()(1, 0), 2.0 * 9.81 * 0.5 / 0.6 * std::sin(q), 1e-13);
  EXPECT_NEAR(derivative.matrix()(1, 1), 0.0, 1e-14);
}

TEST(MotionDerivative, Trees_of_all_joints_agree_with_differences) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Model model = compile(random_tree(seed));
    expect_exact(model, 0.37, state_of(model), 3e-3, 1e-7);
  }
}

TEST(MotionDerivative, Loops_of_all_kinds_agree_with_differences) {
  for (const JointType type : {JointType::spherical, JointType::revolute, JointType::universal,
                               JointType::cylindrical, JointType::prismatic}) {
    for (const ClosureModel closure : {ClosureModel::cut, ClosureModel::sde}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const Model model = compile(random_closed_linkage(seed, type, closure));
        // Quadratic resistances have a corner 2.9e-3 rad/s away.
        expect_exact(model, 0.37, state_of(model), 8e-4, 1e-7);
      }
    }
  }
}

TEST(MotionDerivative, A_loose_pin_with_friction_agrees_while_it_presses) {
  const Model model = compile(rsup({.clearance = ClearanceKind::planar}));
  VectorXd x = state_of(model);
  // Out of the middle of the bearing by more than the clearance, and sliding.
  const Mechanism& m = model.mechanism;
  x[2] += 0.0021;
  for (int k = 0; k < m.nv; ++k) x[m.nq + k] = 0.2 + 0.1 * k;
  for (int i = 0; i < m.nz; ++i) x[m.nq + m.nv + i] = 1e-6;
  const auto touch = [](Workspace<double>& w) {
    for (ContactMemory<double>& one : w.memory) one = {0.0, 0.0, 1.0, 0.1, 0.0};
  };
  Rates rates(model);
  touch(rates.w);
  rates.at(1.0, x);
  ASSERT_GT(rates.w.contacts.front().normal, 0.0);
  expect_exact(model, 1.0, x, 1e-6, 1e-5, touch);
}

// Along the motion, where the rows stay as dependent as they are: d(x', P)/dt = J x'.
TEST(MotionDerivative, Where_cut_rows_depend_on_each_other_it_holds_along_the_motion) {
  Linkage linkage = bennett();
  for (Joint& joint : linkage.joints)
    if (joint.parent == kGround) joint.velocity = {2.0};
  const Preparation p = prepare(linkage, {});
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  const Model& model = p.model;
  const Mechanism& m = model.mechanism;
  const VectorXd x = state_of(model);
  Rates rates(model);
  const VectorXd rate = rates.at(0.0, x).head(x.size());
  ASSERT_GT(rate.norm(), 1.0);
  ASSERT_LT(rates.w.kept_rows, m.cut_row_count());  // they do depend
  MotionDerivative derivative(m, model.parameters);
  ASSERT_TRUE(derivative.update(0.0, x.data(), x.data() + m.nq, nullptr, {}));
  const double h = 1e-5;
  const VectorXd expected = (rates.at(0.0, x + h * rate) - rates.at(0.0, x - h * rate)) / (2.0 * h);
  const VectorXd found = derivative.matrix() * rate;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], 1e-6 * expected.lpNorm<Eigen::Infinity>()) << i;
  }
}

TEST(MotionDerivative, Other_numbers_of_one_structure_need_no_new_trace) {
  Linkage linkage = rsrrp_test_vector(ClosureModel::sde);
  const Model soft = compile(linkage);
  for (double& stiffness : linkage.closures[0].sde.stiffness) stiffness *= 1e3;
  const Model stiff = compile(linkage);
  const VectorXd x = state_of(soft);
  const int nq = soft.mechanism.nq, nv = soft.mechanism.nv;
  MotionDerivative one(soft.mechanism, soft.parameters), other(stiff.mechanism, stiff.parameters);
  one.set_parameters(stiff.parameters);
  ASSERT_TRUE(one.update(0.1, x.data(), x.data() + nq, x.data() + nq + nv, {}));
  ASSERT_TRUE(other.update(0.1, x.data(), x.data() + nq, x.data() + nq + nv, {}));
  EXPECT_EQ(one.matrix(), other.matrix());
}

}  // namespace linkstudy::testing::motion_derivative_test

// Flexible links in motion: a stiff one moves as a rigid one, energy is accounted for, vibration
// fades at the rate of the material.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "core/dynamics/motion.h"
#include "core/flexible/rigid_finite_elements.h"
#include "tests/mechanisms/cantilever.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::flexible_links_test {
namespace {

using Eigen::Vector3d;

// The coupler of 0.5 m with bending stiffness in N m^2, in both planes; 2000 is a steel rod of
// 21 mm.
Linkage with_flexible_coupler(Linkage linkage, double bending, double retardation = 0.0) {
  const double young = 2e11;
  linkage.links[3].flexible = FlexibleBeam{.segments = 2,
                                           .begin = Vector3d::Zero(),
                                           .end = Vector3d(0, 0.5, 0),
                                           .across = Vector3d::UnitX(),
                                           .young = young,
                                           .shear = 0.4 * young,
                                           .second_moment_y = bending / young,
                                           .second_moment_z = bending / young,
                                           .torsion_constant = bending / 10.0 / young,
                                           .retardation = retardation,
                                           .position = {},
                                           .velocity = {}};
  return expand_flexible_links(linkage);
}

const std::vector<std::string> kPositions = {"joint.A.q", "joint.P.q"};

// At rest with the crank at psi.
Linkage rsrrp_at(double psi) {
  Linkage linkage = rsrrp();
  const RsrrpPose pose = rsrrp_pose(psi);
  linkage.joints[0].position = {pose.psi};
  linkage.joints[1].position = {pose.d};
  linkage.joints[2].position = {pose.psi22};
  linkage.joints[3].position = {pose.psi23};
  return linkage;
}

// Largest difference from the motion with a rigid coupler while the crank falls for half a second,
// rad and m.
double difference_from_rigid(double bending, double step) {
  const Linkage linkage = rsrrp_at(0.5);
  const Samples rigid = run(compile(linkage), steps_of(1e-4, 0.5, 0.01), kPositions);
  EXPECT_GT(rigid.values(rigid.values.rows() - 1, 0), 1.0);
  const Samples bent =
      run(compile(with_flexible_coupler(linkage, bending)), steps_of(step, 0.5, 0.01), kPositions);
  EXPECT_EQ(bent.outcome.cause, Cause::ok) << bent.outcome.message;
  EXPECT_EQ(bent.values.rows(), rigid.values.rows());
  return (bent.values - rigid.values).cwiseAbs().maxCoeff();
}

struct Mode {
  double omega;  // rad/s
  Vector shape;  // (nv)
};

// First mode of an expanded linkage whose only coordinates are those of springs.
Mode first_mode(const Linkage& linkage) {
  const Model model = compile(linkage);
  const Matrix mass = compute_mass_matrix(model.mechanism, model.parameters, model.start);
  Vector stiffness(mass.rows());
  Eigen::Index k = 0;
  for (const Joint& joint : linkage.joints) {
    for (const double c : joint.stiffness) stiffness[k++] = c;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> solver(Matrix(stiffness.asDiagonal()),
                                                                mass);
  return {std::sqrt(solver.eigenvalues()[0]), solver.eigenvectors().col(0)};
}

}  // namespace

TEST(FlexibleLinks, A_stiff_coupler_moves_as_the_rigid_one_and_the_stiffer_the_nearer) {
  const double soft = difference_from_rigid(20.0, 5e-5);
  const double stiff = difference_from_rigid(2000.0, 5e-5);
  const double stiffest = difference_from_rigid(200000.0, 1e-5);
  EXPECT_GT(soft, 1e-4);
  EXPECT_LT(stiff, soft / 30);
  EXPECT_NEAR(stiff / stiffest, 100.0, 30.0);  // in inverse proportion to the stiffness
}

TEST(FlexibleLinks, The_energy_ledger_balances_with_and_without_damping) {
  for (const double retardation : {0.0, 1e-4}) {
    const Linkage linkage = with_flexible_coupler(rsrrp(), 200.0, retardation);
    const SimulationOutcome end = run(compile(linkage), steps_of(2e-5, 1.0, 1e-2));
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    EXPECT_LT(end.energy_residual_max, 1e-9 * end.energy_scale);
    EXPECT_GT(end.energy_scale, 0.1);
  }
}

TEST(FlexibleLinks, The_elastic_energy_and_what_damping_takes_are_those_of_the_springs) {
  BeamData data;
  data.retardation = 1e-4;
  Linkage linkage = expand_flexible_links(cantilever(data, 2));
  linkage.joints[1].position = {0.02, -0.03, 0.05};
  linkage.joints[2].position = {-0.01, 0.04, 0.02};
  const Model model = compile(linkage);
  const double stored = [&] {
    double sum = 0.0;
    for (const Joint& joint : linkage.joints) {
      for (std::size_t i = 0; i < joint.stiffness.size(); ++i) {
        sum += 0.5 * joint.stiffness[i] * joint.position[i] * joint.position[i];
      }
    }
    return sum;
  }();
  const Samples s = run(model, steps_of(2e-6, 0.05, 0.05),
                        {"energy.potential", "energy.kinetic", "energy.dissipated"});
  EXPECT_NEAR(s.values(0, 0), stored, 1e-12 * stored);
  const double left = s.values(1, 0) + s.values(1, 1);
  EXPECT_LT(left, 0.9 * stored);
  EXPECT_NEAR(left + s.values(1, 2), stored, 1e-8 * stored);
}

// The coupler sags in a plane in which it may turn: only the shortening of its chord moves the
// slider, by the square of the sag, and of the compliance.
TEST(FlexibleLinks, A_sagging_coupler_draws_the_slider_at_rest_in_by_the_square_of_its_compliance) {
  const Linkage linkage = rsrrp_at(2.9);
  const auto slider_at_rest = [](const Linkage& l) {
    const Model model = compile(l);
    State<double> s = model.start;
    const StaticsReport report = solve_statics(model, s);
    EXPECT_TRUE(report.converged);
    EXPECT_EQ(report.stability, Stability::stable);
    return s.q[PositionIndex(1)];
  };
  const double rigid = slider_at_rest(linkage);
  EXPECT_NEAR(rigid, rsrrp_pose(M_PI).d, 1e-8);
  const double soft = slider_at_rest(with_flexible_coupler(linkage, 20.0)) - rigid;
  const double stiff = slider_at_rest(with_flexible_coupler(linkage, 200.0)) - rigid;
  EXPECT_LT(soft, -1e-7);
  EXPECT_NEAR(soft / stiff, 100.0, 10.0);
}

TEST(FlexibleLinks, Vibration_fades_with_the_logarithmic_decrement_of_the_material) {
  BeamData data;
  data.retardation = 4e-4;
  const Linkage linkage = expand_flexible_links(cantilever(data, 3));
  const Mode mode = first_mode(linkage);
  const double zeta = data.retardation * mode.omega / 2.0;
  const double period = 2.0 * M_PI / (mode.omega * std::sqrt(1.0 - zeta * zeta));
  Model model = compile(linkage);
  for (std::size_t k = 0; k < model.start.q.size(); ++k) {
    model.start.q[PositionIndex(k)] =
        1e-4 / mode.shape.cwiseAbs().maxCoeff() * mode.shape[static_cast<Eigen::Index>(k)];
  }
  const Samples s =
      run(model, steps_of(period / 2000, 5 * period, period), {"joint.beam_sde1.q.1"});
  ASSERT_EQ(s.values.rows(), 6);
  for (Eigen::Index k = 0; k < 5; ++k) {
    const double decrement = std::log(s.values(k, 0) / s.values(k + 1, 0));
    EXPECT_NEAR(decrement, 2.0 * M_PI * zeta / std::sqrt(1.0 - zeta * zeta), 1e-6 * decrement);
  }
}

// The crank is moved and given a speed: joints close the loop, the coupler stays straight.
TEST(FlexibleLinks, A_start_is_closed_by_joints_and_not_by_bending_links) {
  Linkage linkage = rsup({.segments = 4});
  linkage.joints[0].position = {0.1};
  linkage.joints[0].velocity = {9.0};
  linkage.joints[0].hold = true;
  const Preparation p = prepare(linkage, steps_of(1e-5, 0.01));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_GT(p.assembly.displacement, 1e-3);
  int elements = 0;
  const Mechanism& m = p.model.mechanism;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    if (m.joint_names[BodyIndex(b)].find("_sde") == std::string::npos) continue;
    ++elements;
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(p.model.start.q[m.bodies[BodyIndex(b)].q_begin + i], 0.0);
      EXPECT_EQ(p.model.start.v[m.bodies[BodyIndex(b)].v_begin + i], 0.0);
    }
  }
  EXPECT_EQ(elements, 4);
}

}  // namespace linkstudy::testing::flexible_links_test

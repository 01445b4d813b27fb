// Replacement joints that measure turns by the rotation vector: closed motions at large turns, the
// energy ledger with unlike stiffnesses, and what the sines of the other measures make of the same.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/dynamics/effective_mass.h"
#include "core/dynamics/spectrum.h"
#include "core/flexible/rigid_finite_elements.h"
#include "core/topology/check_linkage.h"
#include "tests/mechanisms/bushing.h"
#include "tests/mechanisms/cantilever.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::rotation_vector_sde_test {
namespace {

using Eigen::Vector3d;

// Turn about x of the body at the end of a run.
double turn_about_x(const State<double>& s) {
  return 2.0 * std::atan2(s.q[PositionIndex(1)], s.q[PositionIndex(0)]);
}

// Undamped modes of this frequency.
int count_of(const Spectrum& s, double omega) {
  int count = 0;
  for (const std::complex<double>& lambda : s.eigenvalues) {
    if (std::abs(lambda - std::complex<double>(0.0, omega)) < 1e-5) ++count;
  }
  return count;
}

}  // namespace

TEST(RotationVectorSde,
     About_one_axis_the_moment_is_the_stiffness_times_the_angle_up_to_half_a_turn) {
  for (const double phi : {1e-9, 0.3, 0.8, 1.6, 3.0, M_PI - 1e-6}) {
    for (int i = 0; i < 3; ++i) {
      Bushing data;
      data.stiffness = {5, 7, 11};
      data.turn = phi * Vector3d::Unit(i);
      EngineProbe engine(bushing(data));
      const double k = data.stiffness[i];
      // The ground, first of the two, is turned after the body.
      EXPECT_TRUE(near_absolute(engine.vector("closure.B.torque"),
                                Vector3d(k * phi * Vector3d::Unit(i)), 1e-13))
          << phi << " " << i;
      EXPECT_NEAR(engine.at("energy.potential"), 0.5 * k * phi * phi, 1e-13);
    }
  }
}

TEST(RotationVectorSde,
     The_other_measures_bear_half_the_stiffness_times_the_sine_of_twice_the_angle) {
  for (const TiltMeasure tilt : {TiltMeasure::axis, TiltMeasure::linearized}) {
    for (const double phi : {0.3, M_PI / 4, 1.2}) {
      Bushing data;
      data.tilt = tilt;
      data.turn = {phi, 0, 0};
      EngineProbe engine(bushing(data));
      EXPECT_NEAR(engine.at("closure.B.torque.x"), 2.5 * std::sin(2 * phi), 1e-14);
      EXPECT_NEAR(engine.at("energy.potential"), 2.5 * std::pow(std::sin(phi), 2), 1e-14);
    }
  }
}

// Equal stiffnesses: the moment is along the rotation vector, whatever its direction.
TEST(RotationVectorSde, Equal_stiffnesses_pull_along_the_rotation_vector) {
  for (const Vector3d& n : {Vector3d(1, 2, -2), Vector3d(-3, 1, 0.5), Vector3d(0, -1, 1)}) {
    Bushing data;
    data.turn = 2.9 * n.normalized();
    EngineProbe engine(bushing(data));
    EXPECT_TRUE(near_absolute(engine.vector("closure.B.torque"), 5.0 * data.turn, 1e-13));
  }
}

// phi = A cos(w t): harmonic at any amplitude, which no sine of an angle is.
TEST(RotationVectorSde, A_swing_over_nearly_half_a_turn_stays_harmonic) {
  Bushing data;
  data.turn = {3.0, 0, 0};
  const double w = std::sqrt(5.0 / 0.1);
  for (const double t : {0.1, 0.31, 1.0}) {
    const SimulationOutcome end = run(compile(bushing(data)), steps_of(1e-4, t));
    EXPECT_NEAR(turn_about_x(end.final_state), 3.0 * std::cos(w * t), 1e-9) << t;
    EXPECT_NEAR(end.final_state.v[VelocityIndex(0)], -3.0 * w * std::sin(w * t), 1e-8) << t;
  }
}

TEST(RotationVectorSde, Its_damper_takes_the_energy_of_the_closed_motion) {
  const double k = 5.0, I = 0.1, b = 0.2, A = 2.5, t = 0.4;
  Bushing data;
  data.turn = {A, 0, 0};
  data.damping = {b, b, b};
  const SimulationOutcome end = run(compile(bushing(data)), steps_of(1e-4, t));
  const double s = b / (2 * I), w = std::sqrt(k / I - s * s);
  const double x = std::exp(-s * t) * A * (std::cos(w * t) + s / w * std::sin(w * t));
  const double v = -std::exp(-s * t) * A * (w + s * s / w) * std::sin(w * t);
  EXPECT_NEAR(turn_about_x(end.final_state), x, 1e-9);
  const double lost = 0.5 * k * (A * A - x * x) - 0.5 * I * v * v;
  EXPECT_NEAR(end.final_state.dissipated, lost, 1e-8 * lost);
}

TEST(RotationVectorSde, A_tumbling_body_on_unlike_stiffnesses_keeps_its_energy) {
  Bushing data;
  data.stiffness = {3, 8, 20};
  data.turn = {0.9, -1.1, 0.4};
  data.rate = {4, -3, 5};
  const Model model = compile(bushing(data));
  const SimulationOutcome end = run(model, steps_of(1e-4, 3.0, 1e-2));
  ASSERT_EQ(end.cause, Cause::ok) << end.message;
  EXPECT_LT(end.energy_residual_max, 1e-8 * end.energy_scale);  // fourth order: 2^-4 with h / 2
  const SimulationOutcome coarse = run(model, steps_of(2e-3, 3.0, 1e-2));
  const SimulationOutcome fine = run(model, steps_of(1e-3, 3.0, 1e-2));
  EXPECT_GT(coarse.energy_residual_max, 12.0 * fine.energy_residual_max);
}

TEST(RotationVectorSde, The_deflected_body_swings_with_the_same_frequency_in_the_spectrum) {
  Bushing data;
  data.turn = {0.7, 0, 0};
  const Model model = compile(bushing_under({3.5, 0, 0}, data));
  const Spectrum s = compute_spectrum(model, model.start);
  const double w = std::sqrt(5.0 / 0.1);
  EXPECT_NEAR(s.omega_max, w, 1e-6 * w);
  EXPECT_EQ(count_of(s, w), 1);
  data.tilt = TiltMeasure::axis;  // its slope is k cos 2 phi
  const Model sines = compile(bushing_under({2.5 * std::sin(1.4), 0, 0}, data));
  const Spectrum softened = compute_spectrum(sines, sines.start);
  EXPECT_EQ(count_of(softened, w), 0);
  EXPECT_EQ(count_of(softened, w * std::sqrt(std::cos(1.4))), 1);
}

TEST(RotationVectorSde, Its_effective_mass_is_the_least_moment_of_inertia) {
  for (const double turn : {0.0, 0.5}) {
    Bushing data;
    data.turn = {turn, 0, 0};
    const Model model = compile(bushing(data));
    const double mass = compute_effective_mass(model, model.start, ClosureIndex(0)).rotation;
    // About the axis of the turn the gradient is one; across it 1 + (phi / 2)^2 / 3 and more, over
    // a larger inertia.
    EXPECT_NEAR(mass, 0.1, 1e-12) << turn;
  }
}

TEST(RotationVectorSde, A_flexible_beam_that_ends_in_a_bushing_balances_its_energy) {
  BeamData data;
  data.retardation = 1e-5;
  Linkage linkage = cantilever(data, 3);
  linkage.gravity = {0, -9.81, 2.0};
  Closure element;
  element.name = "B";
  element.type = JointType::fixed;
  element.model = ClosureModel::sde;
  element.first = {"beam", {Eigen::Matrix3d::Identity(), Vector3d(0.8, 0, 0)}};
  element.second = {kGround,
                    {Eigen::AngleAxisd(0.9, Vector3d(1, 1, 0).normalized()).toRotationMatrix(),
                     Vector3d(0.8, 0, 0)}};
  element.sde.tilt = TiltMeasure::angle;
  element.sde.start = SdeStart::given;
  element.sde.stiffness = {1e4, 1e4, 1e4, 30, 50, 80};
  linkage.closures = {element};
  const Preparation p = prepare(expand_flexible_links(linkage), steps_of(1e-5, 0.1));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  const SimulationOutcome coarse = run(p.model, steps_of(2e-5, 0.1, 1e-3));
  const SimulationOutcome fine = run(p.model, steps_of(1e-5, 0.1, 1e-3));
  ASSERT_EQ(fine.cause, Cause::ok) << fine.message;
  EXPECT_GT(fine.energy_scale, 0.5);
  // What is left is the method's error on the beam's torsion, of fourth order at least.
  EXPECT_LT(fine.energy_residual_max, 1e-7 * fine.energy_scale);
  EXPECT_GT(coarse.energy_residual_max, 12.0 * fine.energy_residual_max);
}

TEST(RotationVectorSde, Joints_that_turn_freely_may_not_be_measured_so) {
  for (const JointType type : {JointType::revolute, JointType::cylindrical, JointType::planar,
                               JointType::universal, JointType::fixed, JointType::spherical}) {
    Linkage linkage = bushing();
    linkage.closures[0].type = type;
    linkage.closures[0].sde.axes = SdeAxes::first;
    const bool sound = type == JointType::fixed || type == JointType::spherical;
    const std::vector<Problem> problems = check(linkage);
    EXPECT_EQ(problems.empty(), sound);
    if (!sound && !problems.empty()) {
      EXPECT_EQ(problems[0].path, "closure.B.sde.tilt");
    }
  }
}

}  // namespace linkstudy::testing::rotation_vector_sde_test

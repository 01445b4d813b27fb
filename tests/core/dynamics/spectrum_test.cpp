// Eigenfrequencies and step limits against closed forms.
#include "core/dynamics/spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "tests/mechanisms/mass_on_spring.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::spectrum_test {
namespace {

// Off its rest, where the element has a length.
Linkage stretched_spring(double mass, double stiffness, double damping) {
  Linkage linkage = mass_on_spring(mass, stiffness, damping);
  linkage.joints[0].position = {0.01};
  return linkage;
}

// A body free in space, held at its centre of mass by an element along the line of centres.
Linkage body_on_line(double mass, double stiffness, double damping) {
  Linkage linkage;
  linkage.links = {{"body", mass, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()}};
  Joint joint;
  joint.name = "free";
  joint.type = JointType::free;
  joint.parent = kGround;
  joint.child = "body";
  linkage.joints = {joint};
  Closure line;
  line.name = "line";
  line.model = ClosureModel::sde;
  line.first.link = "body";
  line.second.link = kGround;
  line.sde.form = SdeForm::line_of_centres;
  line.sde.stiffness[kX] = stiffness;
  line.sde.damping[kX] = damping;
  linkage.closures = {line};
  return linkage;
}

// How many eigenvalues lie within `tolerance` of lambda.
std::ptrdiff_t count_near(const Spectrum& s, std::complex<double> lambda, double tolerance) {
  return std::count_if(s.eigenvalues.begin(), s.eigenvalues.end(),
                       [&](std::complex<double> e) { return std::abs(e - lambda) <= tolerance; });
}

Spectrum spectrum_of(const Linkage& linkage) {
  const Model model = compile(linkage);
  return compute_spectrum(model, model.start);
}

}  // namespace

TEST(Spectrum, A_mass_on_a_spring_swings_at_the_root_of_stiffness_over_mass) {
  const Spectrum s = spectrum_of(stretched_spring(2.0, 5e5, 0.0));
  EXPECT_NEAR(s.omega_max, 500.0, 1e-5);
  ASSERT_EQ(s.eigenvalues.size(), 2u);
  EXPECT_NEAR(std::abs(s.eigenvalues[0].imag()), 500.0, 1e-5);
  EXPECT_NEAR(s.step_limit, std::sqrt(8.0) / 500.0, 1e-6 / 500.0);
}

TEST(Spectrum, A_damper_moves_the_pair_to_its_ratio) {
  const double m = 2.0, c = 5e5, zeta = 0.3, w = 500.0;
  const Spectrum s = spectrum_of(stretched_spring(m, c, 2 * zeta * std::sqrt(c * m)));
  for (const std::complex<double>& lambda : s.eigenvalues) {
    EXPECT_NEAR(lambda.real(), -zeta * w, 1e-4);
    EXPECT_NEAR(std::abs(lambda.imag()), w * std::sqrt(1 - zeta * zeta), 1e-4);
  }
}

TEST(Spectrum, Strong_damping_limits_the_step_by_its_fast_real_eigenvalue) {
  const double m = 1.0, c = 1e4, b = 1000.0;  // aperiodic
  const Spectrum s = spectrum_of(stretched_spring(m, c, b));
  const double fast = b / (2 * m) + std::sqrt(b * b / (4 * m * m) - c / m);
  EXPECT_NEAR(s.omega_max, fast, 1e-4);
  EXPECT_NEAR(s.step_limit * fast, 2.785293563405282, 1e-5);
}

TEST(Spectrum, An_inverted_pendulum_limits_the_step_by_its_falling_eigenvalue_only) {
  Linkage linkage = pendulum();
  linkage.joints[0].position = {M_PI / 2};
  const Spectrum s = spectrum_of(linkage);
  EXPECT_NEAR(s.omega_max, std::sqrt(9.81), 1e-6);
  EXPECT_NEAR(s.step_limit, 2.785293563405282 / std::sqrt(9.81), 1e-6);
}

TEST(Spectrum, Damping_along_the_line_of_centres_shows_in_every_direction_while_the_gap_is_shut) {
  const double m = 2.0, c = 5e5, zeta = 0.3, w = 500.0;
  const Spectrum s = spectrum_of(body_on_line(m, c, 2 * zeta * std::sqrt(c * m)));
  const std::complex<double> damped(-zeta * w, w * std::sqrt(1 - zeta * zeta));
  EXPECT_EQ(count_near(s, damped, 1e-3), 3);
  EXPECT_EQ(count_near(s, std::conj(damped), 1e-3), 3);
}

TEST(Spectrum, Damping_along_the_line_of_centres_is_along_the_line_once_the_gap_is_open) {
  const double m = 2.0, c = 5e5, zeta = 0.3, w = 500.0;
  Linkage linkage = body_on_line(m, c, 2 * zeta * std::sqrt(c * m));
  linkage.joints[0].position = {2e-2, -1e-2, 3e-2, 0, 0, 0};
  const Spectrum s = spectrum_of(linkage);
  const std::complex<double> damped(-zeta * w, w * std::sqrt(1 - zeta * zeta));
  EXPECT_EQ(count_near(s, damped, 1e-3), 1);
  EXPECT_EQ(count_near(s, {0.0, w}, 1e-3), 2);
}

// Of a top about its axis: one pair in the body, nutation; one pair because the body's own axes,
// in which the disturbance is measured, turn past it.
TEST(Spectrum, A_spinning_top_in_quaternions_has_its_nutation_and_its_turning_axes) {
  const double transverse = 0.3, axial = 0.45, omega = 20.0;
  Linkage linkage;
  linkage.links = {{"top", 1.0, Eigen::Vector3d::Zero(),
                    Eigen::Vector3d(transverse, transverse, axial).asDiagonal()}};
  Joint joint;
  joint.name = "ball";
  joint.type = JointType::spherical;
  joint.coordinates = RotationCoordinates::quaternion;
  joint.parent = kGround;
  joint.child = "top";
  joint.velocity = {0, 0, omega};
  linkage.joints = {joint};
  const Spectrum s = spectrum_of(linkage);
  const double nutation = (axial / transverse - 1.0) * omega;
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_EQ(count_near(s, {0.0, sign * omega}, 1e-8), 1);
    EXPECT_EQ(count_near(s, {0.0, sign * nutation}, 1e-8), 1);
  }
  EXPECT_EQ(count_near(s, {0.0, 0.0}, 1e-5), 2);
  EXPECT_NEAR(s.omega_max, omega, 1e-8);
}

// A point mass on a turning rail: r'' = omega^2 r, omega' = -2 r' omega / r, a few micrometres from
// the axis.
TEST(Spectrum, A_mechanism_of_micrometres_has_the_spectrum_of_its_equations) {
  const double r = 4e-6, rate = 3e-5, omega = 2.0;
  Linkage linkage;
  linkage.links = {{"rail", 1e-30, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()},
                   {"mass", 1.0, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Zero()}};
  Joint turn;
  turn.name = "turn";
  turn.parent = kGround;
  turn.child = "rail";
  turn.velocity = {omega};
  Joint slide;
  slide.name = "slide";
  slide.type = JointType::prismatic;
  slide.parent = "rail";
  slide.child = "mass";
  slide.frame.rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;  // z along the rail's x
  slide.position = {r};
  slide.velocity = {rate};
  linkage.joints = {turn, slide};
  Eigen::Matrix4d a = Eigen::Matrix4d::Zero();  // of (angle, r, omega, r')
  a.topRightCorner<2, 2>().setIdentity();
  a.row(2) << 0, 2 * rate * omega / (r * r), -2 * rate / r, -2 * omega / r;
  a.row(3) << 0, omega * omega, 2 * omega * r, 0;
  const Eigen::VectorXcd exact = a.eigenvalues();
  const Spectrum s = spectrum_of(linkage);
  ASSERT_EQ(s.eigenvalues.size(), 4u);
  for (const std::complex<double>& lambda : exact) {
    EXPECT_GE(count_near(s, lambda, 1e-5 * s.omega_max), 1) << lambda;
  }
}

TEST(StableStep, Growth_that_belongs_to_the_motion_limits_no_step) {
  EXPECT_TRUE(std::isinf(stable_step({5.0, 0.0})));
  EXPECT_NEAR(stable_step({5.0, 0.1}), 2.0 * std::sqrt(2.0) / 0.1, 1e-5);
  EXPECT_NEAR(stable_step({1e-6, -300.0}), 2.0 * std::sqrt(2.0) / 300.0, 1e-8);
}

TEST(StableStep, The_region_of_Runge_Kutta_ends_where_books_say) {
  EXPECT_NEAR(stable_step({-1.0, 0.0}), 2.785293563405282, 1e-8);
  EXPECT_NEAR(stable_step({0.0, 1.0}), 2.0 * std::sqrt(2.0), 1e-7);
  EXPECT_NEAR(stable_step({0.0, -1.0}), 2.0 * std::sqrt(2.0), 1e-7);
  EXPECT_NEAR(stable_step({-200.0, 0.0}), 2.785293563405282 / 200.0, 1e-9);
  EXPECT_TRUE(std::isinf(stable_step({0.0, 0.0})));
}

TEST(StableStep, Just_below_it_the_method_does_not_grow_and_just_above_it_does) {
  for (int k = 0; k <= 60; ++k) {
    const double angle = M_PI / 2 + k * M_PI / 120;
    const std::complex<double> ray = std::polar(1.0, angle);
    const double limit = stable_step(ray);
    const auto growth = [&](double r) {
      const std::complex<double> z = r * ray;
      return std::abs(1.0 + z + z * z / 2.0 + z * z * z / 6.0 + z * z * z * z / 24.0);
    };
    EXPECT_LE(growth(0.9999 * limit), 1.0 + 1e-9) << angle;
    EXPECT_GT(growth(1.0001 * limit), 1.0) << angle;
  }
}

TEST(StepLimit, A_run_just_below_it_stays_bounded_and_just_above_it_ends_with_a_cause) {
  for (const double damping : {0.0, 100.0}) {
    const Linkage linkage = stretched_spring(1.0, 1e6, damping);
    const double limit = spectrum_of(linkage).step_limit;
    const Model model = compile(linkage);
    const SimulationOutcome below = run(model, steps_of(0.995 * limit, 20.0, 0.01));
    EXPECT_EQ(below.cause, Cause::ok) << below.message;
    EXPECT_LT(std::abs(below.final_state.q[PositionIndex(0)]), 0.011);
    const SimulationOutcome above = run(model, steps_of(1.02 * limit, 20.0, 0.01));
    EXPECT_TRUE(above.cause == Cause::diverged || above.cause == Cause::energy_blowup)
        << name_of(above.cause);
    EXPECT_GT(above.end_time, 0.0);
    EXPECT_LT(above.end_time, 20.0);
    EXPECT_NE(above.message.find("at t = "), std::string::npos) << above.message;
  }
}

TEST(StepLimit, The_replaced_linkage_runs_below_its_limit_and_fails_above) {
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.damping = {};
  const double limit = spectrum_of(linkage).step_limit;
  const Model model = compile(linkage);
  EXPECT_EQ(run(model, steps_of(0.95 * limit, 0.2, 0.01)).cause, Cause::ok);
  const SimulationOutcome above = run(model, steps_of(1.1 * limit, 0.5, 0.01));
  EXPECT_TRUE(above.cause == Cause::diverged || above.cause == Cause::energy_blowup);
}

}  // namespace linkstudy::testing::spectrum_test

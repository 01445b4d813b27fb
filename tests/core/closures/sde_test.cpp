// Spring-damping elements by routes that share nothing with their code: gradients by finite
// differences, closed motions, masses by hand.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/dynamics/effective_mass.h"
#include "core/kinematics/assembly.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::sde_test {
namespace {

using Eigen::Vector3d;

// Two bodies on parallel rails along z, joined by a spring; body 1 at z = 0, body 2 at z = gap.
Linkage two_bodies(double m1, double m2, double gap, double stiffness) {
  Linkage linkage;
  for (int k = 0; k < 2; ++k) {
    const std::string name = "body" + std::to_string(k + 1);
    linkage.links.push_back({name, k == 0 ? m1 : m2, Vector3d::Zero(), Eigen::Matrix3d::Zero()});
    Joint rail;
    rail.name = "rail" + std::to_string(k + 1);
    rail.type = JointType::prismatic;
    rail.parent = kGround;
    rail.child = name;
    rail.position = {k * gap};
    rail.velocity = {0.0};
    linkage.joints.push_back(rail);
  }
  Closure spring;
  spring.name = "E";
  spring.model = ClosureModel::sde;
  spring.first.link = "body1";
  spring.second.link = "body2";
  spring.sde.stiffness[kZ] = stiffness;
  linkage.closures = {spring};
  return linkage;
}

// A free body whose revolute element towards the ground sees it turned by `turn` about the free x
// axis, then tilted by a small angle about y (1) or z (2) of the first frame.
Linkage tilted_body(TiltMeasure measure, double turn, int axis, double tilt) {
  Linkage linkage;
  linkage.links = {{"body", 1.0, Vector3d::Zero(), 0.1 * Eigen::Matrix3d::Identity()}};
  Joint joint;
  joint.name = "F";
  joint.type = JointType::free;
  joint.coordinates = RotationCoordinates::quaternion;
  joint.parent = kGround;
  joint.child = "body";
  const Eigen::Quaterniond h =
      Eigen::AngleAxisd(tilt, Vector3d::Unit(axis)) * Eigen::AngleAxisd(turn, Vector3d::UnitX());
  joint.position = {0, 0, 0, h.w(), h.x(), h.y(), h.z()};
  linkage.joints = {joint};
  Closure closure;
  closure.name = "E";
  closure.type = JointType::revolute;
  closure.model = ClosureModel::sde;
  closure.first.link = kGround;
  closure.second.link = "body";
  closure.sde.tilt = measure;
  closure.sde.stiffness = {0, 0, 0, 0, 100, 100};
  linkage.closures = {closure};
  return linkage;
}

Sde askew(SdeForm form, SdeAxes axes, TiltMeasure tilt) {
  Sde sde;
  sde.form = form;
  sde.axes = axes;
  sde.tilt = tilt;
  sde.stiffness = {300, 500, 700, 20, 30, 40};
  if (form == SdeForm::line_of_centres) sde.stiffness[kY] = sde.stiffness[kZ] = 0.0;
  sde.directions << 1, 0, 0, 0.6, 0.8, 0, 0, 0.6, 0.8;
  return sde;
}

}  // namespace

TEST(Sde, Its_generalised_force_is_the_downhill_gradient_of_its_energy) {
  const double h = 1e-6;  // central differences: 1e-12 truncation, 1e-10 rounding
  for (const SdeForm form :
       {SdeForm::directional, SdeForm::line_of_centres, SdeForm::three_springs}) {
    for (const SdeAxes axes : {SdeAxes::ground, SdeAxes::first}) {
      for (const TiltMeasure tilt :
           {TiltMeasure::axis, TiltMeasure::linearized, TiltMeasure::angle}) {
        for (std::uint64_t seed = 0; seed < 5; ++seed) {
          Linkage pair = sde_pair(seed, JointType::fixed, askew(form, axes, tilt), 0.3);
          for (Joint& joint : pair.joints) std::fill_n(joint.velocity.begin(), 6, 0.0);
          EngineProbe engine(pair);
          const State<double> here = engine.state();
          const Vector force = engine.tau();  // at rest, weightless: the element only
          Vector gradient(force.size());
          for (Eigen::Index k = 0; k < force.size(); ++k) {
            const Vector dq = h * Vector::Unit(force.size(), k);
            const Mechanism& m = engine.model().mechanism;
            engine.evaluate_at(displaced(m, here, dq));
            const double plus = engine.at("energy.potential");
            engine.evaluate_at(displaced(m, here, -dq));
            gradient[k] = (plus - engine.at("energy.potential")) / (2 * h);
          }
          EXPECT_GT(gradient.norm(), 1.0);
          EXPECT_TRUE(near_relative(force, -gradient, 1e-7)) << "seed " << seed;
        }
      }
    }
  }
}

TEST(Sde, Both_axes_agree_for_equal_stiffnesses_without_damping) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Sde sde;
    sde.stiffness = {400, 400, 400, 0, 0, 0};
    EngineProbe ground(sde_pair(seed, JointType::spherical, sde, 0.5));
    sde.axes = SdeAxes::first;
    EngineProbe first(sde_pair(seed, JointType::spherical, sde, 0.5));
    EXPECT_TRUE(near_relative(first.qdd(), ground.qdd(), 1e-11));
    EXPECT_TRUE(
        near_relative(first.vector("closure.E.force"), ground.vector("closure.E.force"), 1e-13));
  }
}

TEST(Sde, Both_axes_differ_for_unequal_stiffnesses) {
  Sde sde;
  sde.stiffness = {400, 800, 1600, 0, 0, 0};
  EngineProbe ground(sde_pair(1, JointType::spherical, sde, 0.5));
  sde.axes = SdeAxes::first;
  EngineProbe first(sde_pair(1, JointType::spherical, sde, 0.5));
  EXPECT_GT((first.vector("closure.E.force") - ground.vector("closure.E.force")).norm(), 1.0);
}

TEST(Sde, The_axis_measure_resists_both_tilts_at_any_turn) {
  const double tilt = 1e-3;
  for (const double degrees : {0.0, 45.0, 90.0, 135.0, 170.0}) {
    for (const int axis : {1, 2}) {
      EngineProbe engine(tilted_body(TiltMeasure::axis, degrees * M_PI / 180, axis, tilt));
      // The second frame is tilted forward about `axis`: the torque on the ground follows it.
      const Vector3d expected = 100.0 * tilt * Vector3d::Unit(axis);
      EXPECT_TRUE(near_absolute(engine.vector("closure.E.torque"), expected, 100 * tilt * tilt))
          << degrees << " " << axis;
    }
  }
}

// With the free rotation a the printed measures of a tilt (t_y, t_z) are t_y cos a + t_z sin a and
// t_z: t_y is measured by cos a only.
TEST(Sde, The_linearized_measure_provably_loses_a_tilt_at_ninety_degrees) {
  const double tilt = 1e-3;
  const auto stored = [&](double degrees, int axis) {
    EngineProbe e(tilted_body(TiltMeasure::linearized, degrees * M_PI / 180, axis, tilt));
    return e.at("energy.potential") / (0.5 * 100 * tilt * tilt);
  };
  for (const double degrees : {0.0, 45.0, 90.0, 170.0}) {
    const double a = degrees * M_PI / 180;
    EXPECT_NEAR(stored(degrees, 1), std::pow(std::cos(a), 2), 2e-3) << degrees;
    EXPECT_NEAR(stored(degrees, 2), 1 + std::pow(std::sin(a), 2), 2e-3) << degrees;
  }
  EngineProbe lost(tilted_body(TiltMeasure::linearized, M_PI / 2, 1, tilt));
  EXPECT_LT(lost.vector("closure.E.torque").norm(), 100 * tilt * 2e-3);
}

TEST(Sde, Two_bodies_move_their_reduced_mass) {
  const double m1 = 3.0, m2 = 1.5;
  const Linkage linkage = two_bodies(m1, m2, 0.0, 1200.0);
  const Model model = compile(linkage);
  EXPECT_NEAR(compute_effective_mass(model, model.start, ClosureIndex(0)).translation,
              m1 * m2 / (m1 + m2), 1e-14);
}

TEST(Sde, A_damping_ratio_gives_the_damping_of_the_reduced_mass) {
  const double m1 = 3.0, m2 = 1.5, c = 1200.0, zeta = 0.7;
  Linkage linkage = two_bodies(m1, m2, 0.0, c);
  linkage.closures[0].sde.damping_ratio = zeta;
  linkage.joints[1].velocity = {2.0};
  EngineProbe engine(linkage);
  const double b = 2 * zeta * std::sqrt(c * m1 * m2 / (m1 + m2));
  // Only the damper works at d = 0: body 1 is dragged along by b times the relative speed.
  EXPECT_NEAR(engine.at("closure.E.force.z"), 2.0 * b, 1e-12 * b);
  EXPECT_NEAR(engine.at("joint.rail1.a"), 2.0 * b / m1, 1e-12 * b);
  EXPECT_NEAR(engine.at("joint.rail2.a"), -2.0 * b / m2, 1e-12 * b);
}

// Reduced mass m, gap x(t) = e^{-s t} (x0 cos w t + s x0 / w sin w t) from rest.
TEST(Sde, A_damper_takes_what_the_closed_motion_of_two_bodies_loses) {
  const double m1 = 3.0, m2 = 1.5, c = 1200.0, b = 25.0, x0 = 0.1, t = 0.4;
  Linkage linkage = two_bodies(m1, m2, x0, c);
  linkage.closures[0].sde.damping[kZ] = b;
  const SimulationOutcome end = run(compile(linkage), steps_of(1e-4, t));
  const double m = m1 * m2 / (m1 + m2), s = b / (2 * m), w = std::sqrt(c / m - s * s);
  const double x = std::exp(-s * t) * x0 * (std::cos(w * t) + s / w * std::sin(w * t));
  const double v = -std::exp(-s * t) * x0 * (w + s * s / w) * std::sin(w * t);
  EXPECT_NEAR(end.final_state.q[PositionIndex(1)] - end.final_state.q[PositionIndex(0)], x, 1e-9);
  EXPECT_NEAR(end.final_state.v[VelocityIndex(1)] - end.final_state.v[VelocityIndex(0)], v, 1e-8);
  const double lost = 0.5 * c * (x0 * x0 - x * x) - 0.5 * m * v * v;
  EXPECT_NEAR(end.final_state.dissipated, lost, 1e-8 * lost);
  EXPECT_EQ(end.final_state.supplied, 0.0);
}

TEST(Sde, Dampers_of_every_form_take_what_the_pair_loses) {
  for (const SdeForm form :
       {SdeForm::directional, SdeForm::line_of_centres, SdeForm::three_springs}) {
    for (const SdeAxes axes : {SdeAxes::ground, SdeAxes::first}) {
      Sde sde = askew(form, axes, TiltMeasure::angle);
      for (int d = 0; d < kDirections; ++d) {
        sde.damping[static_cast<std::size_t>(d)] =
            0.02 * sde.stiffness[static_cast<std::size_t>(d)];
      }
      const Model model = compile(sde_pair(3, JointType::fixed, sde, 0.3));
      const Samples s = run(model, steps_of(1e-4, 0.2), {"energy.kinetic", "energy.potential"});
      const double lost = s.values.row(0).sum() - s.values.row(s.values.rows() - 1).sum();
      EXPECT_GT(lost, 1e-2);
      EXPECT_NEAR(s.outcome.final_state.dissipated, lost, 1e-7 * lost);
    }
  }
}

TEST(Sde, Each_force_pulls_the_first_link_towards_the_second) {
  EngineProbe engine(two_bodies(1.0, 1.0, 0.25, 100.0));
  EXPECT_TRUE(near_absolute(engine.vector("closure.E.force"), Vector3d(0, 0, 25), 1e-12));
  EXPECT_TRUE(near_absolute(engine.vector("closure.E.gap"), Vector3d(0, 0, 0.25), 1e-15));
  EXPECT_NEAR(engine.at("joint.rail1.a"), 25.0, 1e-12);
  EXPECT_NEAR(engine.at("joint.rail2.a"), -25.0, 1e-12);
}

}  // namespace linkstudy::testing::sde_test

// Where a run with replacement joints begins: only what is stiff is shut, and on request it begins
// deflected and moving. Closed forms of one mass on a spring; statics with joints that are held.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/simulation/prepare.h"
#include "tests/mechanisms/bushing.h"
#include "tests/mechanisms/mass_on_spring.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::start_test {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A mass on a rail along ground z, 0.2 m beside the origin, whose element holds z only.
Linkage beside_its_spring(SdeForm form, SdeAxes axes) {
  Linkage linkage = mass_on_spring(1.0, 1000.0);
  linkage.joints[0].frame.position = {0.2, -0.1, 0.0};
  linkage.joints[0].position = {0.03};
  Sde& sde = linkage.closures[0].sde;
  sde.form = form;
  sde.axes = axes;
  if (form == SdeForm::three_springs) {  // the first of three, along z
    sde.directions << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    sde.stiffness = {1000.0, 0, 0, 0, 0, 0};
  }
  return linkage;
}

Linkage deflected(double position, double velocity) {
  Linkage linkage = mass_on_spring(1.0, 1000.0);
  linkage.joints[0].position = {position};
  linkage.joints[0].velocity = {velocity};
  linkage.closures[0].sde.start = SdeStart::given;
  return linkage;
}

}  // namespace

TEST(Start, Only_the_stiff_directions_of_a_replacement_joint_are_shut) {
  for (const SdeForm form : {SdeForm::directional, SdeForm::three_springs}) {
    for (const SdeAxes axes : {SdeAxes::ground, SdeAxes::first}) {
      const Preparation p = prepare(beside_its_spring(form, axes), steps_of(1e-3, 1.0));
      ASSERT_EQ(p.cause, Cause::ok) << p.message;
      EXPECT_NEAR(p.model.start.q[PositionIndex(0)], 0.0, 1e-14);
      EXPECT_EQ(p.assembly.rows, 1);
      EXPECT_EQ(p.assembly.mobility, 0);
    }
  }
}

// Stiff along all axes the element holds the point, and the rail cannot reach it.
TEST(Start, A_stiff_direction_that_cannot_be_shut_still_fails) {
  Linkage linkage = beside_its_spring(SdeForm::directional, SdeAxes::ground);
  linkage.closures[0].sde.stiffness[kX] = 1e-3;
  const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
  EXPECT_EQ(p.cause, Cause::assembly_failed);
  EXPECT_THAT(p.message, HasSubstr("closure.spring stays open: gap 0.2 m"));
  linkage.closures[0].sde.stiffness[kX] = 0.0;
  linkage.closures[0].sde.damping[kX] = 5.0;  // dampers hold nothing at rest
  EXPECT_EQ(prepare(linkage, steps_of(1e-3, 1.0)).cause, Cause::ok);
}

TEST(Start, A_line_of_centres_is_shut_in_every_direction) {
  Linkage linkage = beside_its_spring(SdeForm::line_of_centres, SdeAxes::ground);
  linkage.closures[0].sde.stiffness = {1000.0, 0, 0, 0, 0, 0};
  EXPECT_EQ(prepare(linkage, steps_of(1e-3, 1.0)).cause, Cause::assembly_failed);
  linkage.joints[0].frame.position.setZero();
  const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_NEAR(p.model.start.q[PositionIndex(0)], 0.0, 1e-14);
}

TEST(Start, A_fully_stiff_element_begins_where_the_cut_joint_does) {
  Linkage linkage = rsrrp();
  for (Joint& joint : linkage.joints) joint.position[0] += 0.01;
  const Preparation cut = prepare(linkage, steps_of(1e-4, 1.0));
  linkage.closures[0].model = ClosureModel::sde;
  const Preparation sde = prepare(linkage, steps_of(1e-4, 1.0));
  ASSERT_EQ(cut.cause, Cause::ok) << cut.message;
  ASSERT_EQ(sde.cause, Cause::ok) << sde.message;
  EXPECT_EQ(sde.model.start.q, cut.model.start.q);
  EXPECT_EQ(sde.assembly.branch, cut.assembly.branch);
}

TEST(Start, A_spring_begins_deflected_and_moving_where_that_is_given) {
  const double x0 = 0.01, v0 = 1.0, w = std::sqrt(1000.0), t = 0.5;
  const Preparation p = prepare(deflected(x0, v0), steps_of(1e-4, t));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_THAT(p.warnings, IsEmpty());
  const SimulationOutcome end = run(p.model, steps_of(1e-4, t));
  EXPECT_NEAR(end.final_state.q[PositionIndex(0)], x0 * std::cos(w * t) + v0 / w * std::sin(w * t),
              1e-9);
  EXPECT_NEAR(end.final_state.v[VelocityIndex(0)], v0 * std::cos(w * t) - x0 * w * std::sin(w * t),
              1e-8);
}

TEST(Start, A_velocity_that_a_shut_spring_takes_away_is_said) {
  Linkage linkage = deflected(0.0, 1.0);
  linkage.closures[0].sde.start = SdeStart::closed;
  const Preparation p = prepare(linkage, steps_of(1e-4, 1.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_NEAR(p.model.start.v[VelocityIndex(0)], 0.0, 1e-15);
  EXPECT_THAT(p.warnings, ElementsAre(::testing::AllOf(
                              HasSubstr("joint.rail: its initial velocity is"),
                              HasSubstr("instead of the given 1"), HasSubstr("sde.start"))));
  linkage.joints[0].hold = true;
  EXPECT_EQ(prepare(linkage, steps_of(1e-4, 1.0)).cause, Cause::assembly_failed);
}

// 4 N m on 5 N m/rad: 0.8 rad by the angle; a sine of it bears 2.5 N m at most.
TEST(Start, A_bushing_rests_at_torque_over_stiffness_and_sines_cannot_bear_it) {
  SimulationOptions options = steps_of(1e-3, 0.01);
  options.start = Start::equilibrium;
  const Preparation p = prepare(bushing_under({4, 0, 0}), options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_NEAR(
      2.0 * std::atan2(p.model.start.q[PositionIndex(1)], p.model.start.q[PositionIndex(0)]), 0.8,
      1e-10);
  EXPECT_EQ(p.statics->stability, Stability::stable);
  // k along the turn; across it the second derivative of k/2 |phi|^2 is k h cot h, h = phi / 2.
  EXPECT_NEAR(p.statics->smallest_stiffness, 5.0 * 0.4 / std::tan(0.4), 1e-6);
  const Preparation sines = prepare(bushing_under({4, 0, 0}, {.tilt = TiltMeasure::axis}), options);
  EXPECT_EQ(sines.cause, Cause::statics_failed);
  EXPECT_THAT(sines.message, HasSubstr("balance is missed by 1.5 N m at joint.S.0"));
  EXPECT_THAT(sines.message, HasSubstr("tilt = \"angle\" bears k phi"));
}

TEST(Start, A_large_turn_near_the_end_of_the_law_is_warned_about) {
  for (const double turn : {2.5, 2.7}) {
    const Preparation p = prepare(bushing({.turn = {0, turn, 0}}), steps_of(1e-3, 1.0));
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    EXPECT_EQ(p.warnings.size(), turn > 150.0 * M_PI / 180 ? 1u : 0u);
  }
}

TEST(Start, A_held_joint_stays_in_equilibrium_and_its_effort_is_said) {
  Linkage linkage = deflected(0.02, 0.0);
  linkage.gravity = {0, 0, -9.81};
  linkage.joints[0].hold = true;
  SimulationOptions options = steps_of(1e-3, 0.01);
  options.start = Start::equilibrium;
  const Preparation p = prepare(linkage, options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_EQ(p.model.start.q[PositionIndex(0)], 0.02);
  EXPECT_NEAR(p.statics->holding[0], 9.81 + 0.02 * 1000.0, 1e-10);
  EXPECT_THAT(p.warnings, Contains(HasSubstr("holds joint.rail with 29.81 N")));
}

TEST(Start, Loads_of_the_equilibrium_are_those_of_the_time_asked_for) {
  Linkage linkage = mass_on_spring(1.0, 1000.0);
  Load push;
  push.name = "push";
  push.joint = "rail";
  push.course = {CourseShape::ramp, 30.0, 2.0, {}, {}};
  linkage.loads = {push};
  SimulationOptions options = steps_of(1e-3, 0.01);
  options.start = Start::equilibrium;
  for (const double t : {0.0, 0.5, 5.0}) {
    options.statics_time = t;
    const Preparation p = prepare(linkage, options);
    ASSERT_EQ(p.cause, Cause::ok) << p.message;
    EXPECT_NEAR(p.model.start.q[PositionIndex(0)], 30.0 * std::min(t / 2.0, 1.0) / 1000.0, 1e-12);
    EXPECT_EQ(p.model.start.t, 0.0) << "a run begins at zero all the same";
    EXPECT_EQ(p.statics->time, t);
  }
}

}  // namespace linkstudy::testing::start_test

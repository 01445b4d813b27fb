// A journal that is pushed while it touches: there the speed at which the contact began and the
// greatest speed so far are different laws. Against m x'' = F - K d^1.5 (1 + D d' / v0), integrated
// apart from the engine.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/laws/normal_contact.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/support/engine_probe.h"
#include "tests/support/fixed_step.h"

namespace linkstudy::testing::pushed_contact_test {
namespace {

constexpr double kRadial = 1e-3;          // m, of loose_bearing()
constexpr double kStiffness = 2.1446e10;  // N/m^1.5: steel
constexpr double kPush = 300.0;           // N
constexpr double kSpeed = 0.02;           // m/s, at the wall

struct Push {
  double depth, rate;  // at the start
  ApproachSpeed approach;
};

// 1 kg pushed along y against the wall of its bearing.
Linkage pushed(const Push& push) {
  JournalInBearing journal;
  journal.position.y() = kRadial + push.depth;
  journal.velocity.y() = push.rate;
  Clearance clearance = loose_bearing();
  clearance.stiffness = kStiffness;
  clearance.least_speed = 1e-3;
  clearance.approach = push.approach;
  Linkage linkage = journal_in_bearing(journal, clearance);
  Load load;
  load.name = "push";
  load.type = LoadType::link_force;
  load.link = "journal";
  load.direction = Eigen::Vector3d::UnitY();
  load.course.shape = CourseShape::constant;
  load.course.value = kPush;
  linkage.loads.push_back(load);
  return linkage;
}

struct Course {
  double force = 0.0, depth = 0.0;  // greatest
  double end_depth = 0.0, end_rate = 0.0;
};

// v0 = |rate at the start|; steps of 10 ns, whose error is far below what is asked for.
Course integrate(const Push& push, double end_time) {
  const double d = contact_damping(ContactLaw::lankarani_nikravesh, 0.9);
  double v0 = std::fabs(push.rate);
  const auto force = [&](double depth, double rate) {
    const double v = push.approach == ApproachSpeed::greatest ? std::max(v0, std::fabs(rate)) : v0;
    return kStiffness * std::pow(std::max(depth, 0.0), 1.5) * std::max(1.0 + d * rate / v, 0.0);
  };
  const auto motion = [&](double, const double* y, double* dy) {
    dy[0] = y[1];
    dy[1] = kPush - force(y[0], y[1]);
  };
  Course course;
  std::array<double, 2> y{push.depth, push.rate};
  const double h = 1e-8;
  for (long k = 0; k < std::lround(end_time / h); ++k) {
    if (push.approach == ApproachSpeed::greatest) v0 = std::max(v0, std::fabs(y[1]));
    course.force = std::max(course.force, force(y[0], y[1]));
    course.depth = std::max(course.depth, y[0]);
    fixed_step(0.0, h, y, motion);
  }
  course.end_depth = y[0];
  course.end_rate = y[1];
  return course;
}

Course engine(const Push& push, SimulationOptions options) {
  const Samples s = run(compile(pushed(push)), options,
                        {"closure.B.normal_force.0", "closure.B.penetration.0", "joint.F.v.1"});
  EXPECT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  return {s.values.col(0).maxCoeff(), s.values.col(1).maxCoeff(),
          s.outcome.final_state.q[PositionIndex(1)] - kRadial,
          s.outcome.final_state.v[VelocityIndex(1)]};
}

SimulationOptions located(double end_time) {
  SimulationOptions options = steps_of(1e-6, end_time, 1e-6);
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = 1e-11;
  options.absolute_tolerance = 1e-13;
  return options;
}

}  // namespace

// 677.83 N and 9.644983 um by the printed law; a running maximum of the speed gives 727.63 N. Peaks
// are those of instants 1 us apart, hence at most (1 us / 0.3 ms)^2 off the true ones.
TEST(PushedContact, The_printed_law_divides_by_the_speed_at_which_the_contact_began) {
  for (const ApproachSpeed approach : {ApproachSpeed::begin, ApproachSpeed::greatest}) {
    const Push push{0.0, kSpeed, approach};
    const Course exact = integrate(push, 1.5e-3);
    const bool printed = approach == ApproachSpeed::begin;
    EXPECT_NEAR(exact.force, printed ? 677.83 : 727.63, 0.01);
    // Constant steps see the corners of a law to their own length, and a running maximum is that
    // over steps: what it misses of the top grows as their square.
    for (const auto& [options, tolerance] : {std::pair(located(1.5e-3), printed ? 1e-6 : 1e-4),
                                             std::pair(steps_of(1e-6, 1.5e-3, 1e-6), 2e-4),
                                             std::pair(steps_of(2e-7, 1.5e-3, 1e-6), 4e-5)}) {
      const Course here = engine(push, options);
      EXPECT_NEAR(here.force / exact.force, 1.0, 1e-5);
      EXPECT_NEAR(here.depth / exact.depth, 1.0, 1e-5);
      EXPECT_NEAR(here.end_depth, exact.end_depth, tolerance * exact.depth);
      EXPECT_NEAR(here.end_rate, exact.end_rate, tolerance * kSpeed);
    }
  }
  EXPECT_NEAR(integrate({0.0, kSpeed, ApproachSpeed::begin}, 1.5e-3).depth, 9.644983e-6, 1e-10);
}

// A contact that is there when a run starts begins there, with the rate it has.
TEST(PushedContact, A_contact_at_the_start_begins_with_its_rate_however_it_is_integrated) {
  for (const double rate : {0.02, -0.01}) {
    const Push push{2e-6, rate, ApproachSpeed::begin};
    const Course exact = integrate(push, 1e-4);
    for (const SimulationOptions& options : {located(1e-4), steps_of(2e-7, 1e-4, 1e-6)}) {
      const Course here = engine(push, options);
      EXPECT_NEAR(here.end_depth, exact.end_depth, 1e-6 * exact.depth);
      EXPECT_NEAR(here.end_rate, exact.end_rate, 1e-6 * kSpeed);
    }
  }
}

// Thrown and left alone no contact is faster than it came: the two are one law.
TEST(PushedContact, In_a_free_impact_both_speeds_are_the_same) {
  const double ratio = contact_restitution(contact_damping(ContactLaw::lankarani_nikravesh, 0.9));
  for (const ApproachSpeed approach : {ApproachSpeed::begin, ApproachSpeed::greatest}) {
    Linkage linkage = pushed({-1e-5, 0.1, approach});
    linkage.loads.clear();
    const SimulationOutcome end = run(compile(linkage), steps_of(2e-7, 2e-3));
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    EXPECT_EQ(end.contacts, 1);
    EXPECT_NEAR(end.final_state.v[VelocityIndex(1)], -0.1 * ratio, 1e-6 * 0.1);
  }
}

}  // namespace linkstudy::testing::pushed_contact_test

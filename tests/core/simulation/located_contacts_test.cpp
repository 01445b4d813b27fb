// Runs that locate the begin and the end of contacts: impacts whose times and speeds are known in
// closed form, mechanisms against constant steps, and what the accuracy costs.
#include <gtest/gtest.h>

#include <cmath>

#include "core/laws/normal_contact.h"
#include "core/simulation/located_run.h"
#include "core/simulation/simulate.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::located_contacts_test {
namespace {

constexpr Integrator kAdaptive[] = {Integrator::adaptive, Integrator::stiff};
constexpr double kRadial = 1e-3, kStiffness = 1e10;  // of loose_bearing()

SimulationOptions by(Integrator integrator, double tolerance, SimulationOptions options) {
  options.integrator = integrator;
  options.relative_tolerance = options.absolute_tolerance = tolerance;
  return options;
}

// A journal of 1 kg that starts in the middle and flies along y.
Linkage flying_journal(double speed, double restitution) {
  JournalInBearing journal;
  journal.velocity = {0.0, speed, 0.0};
  Clearance clearance = loose_bearing();
  clearance.restitution = restitution;
  return journal_in_bearing(journal, clearance);
}

// Time of an elastic impact of a mass m on K delta^1.5, Hertz:
// 2 (delta_m / v) integral_0^1 dx / sqrt(1 - x^2.5), delta_m = (5 m v^2 / (4 K))^0.4.
double elastic_contact_time(double mass, double speed) {
  const double deepest = std::pow(1.25 * mass * speed * speed / kStiffness, 0.4);
  return 2 * deepest / speed * 0.4 * std::tgamma(0.4) * std::tgamma(0.5) / std::tgamma(0.9);
}

// Where an elastic journal is at time t when it is flying, and how many walls it has met.
struct Flight {
  double y;
  long contacts;
};
Flight elastic_flight(double speed, double t) {
  const double contact = elastic_contact_time(1.0, speed);
  const double cycle = contact + 2 * kRadial / speed;
  const double since = t - kRadial / speed;
  const long walls = static_cast<long>(since / cycle);
  const double left = since - static_cast<double>(walls) * cycle - contact;
  return {(walls % 2 == 0 ? 1.0 : -1.0) * (kRadial - speed * left), walls + 1};
}

// The RSUP linkage of physics.md section 8 with clearance in R, axes parallel or free to skew.
Linkage rsup_with_clearance(ClearanceKind kind, bool friction) {
  Linkage linkage = rsrrp_revolute();
  Closure& r = linkage.closures[0];
  r.model = ClosureModel::clearance;
  r.stabilization = Stabilization::baumgarte;
  r.clearance = loose_bearing();
  r.clearance.kind = kind;
  r.clearance.stiffness = 2.1446e10;
  if (friction) r.clearance.friction = table_1_friction();
  for (Load& load : linkage.loads)
    if (load.type == LoadType::drive) load.course.duration = 2.0;
  return linkage;
}

double largest(const Matrix& a, const Matrix& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace

TEST(LocatedContacts, Elastic_impacts_happen_at_the_times_of_the_closed_form) {
  // 0.85 of a cycle after the last begin of a contact: in flight.
  const double speed = 0.5;
  const double cycle = elastic_contact_time(1.0, speed) + 2 * kRadial / speed;
  const double end = kRadial / speed + 20.85 * cycle;
  const Flight exact = elastic_flight(speed, end);
  const Model model = compile(flying_journal(speed, 1.0));
  for (const Integrator integrator : kAdaptive) {
    for (const double tolerance : {1e-7, 1e-9}) {
      const SimulationOutcome run_end = run(model, by(integrator, tolerance, steps_of(1e-2, end)));
      ASSERT_EQ(run_end.cause, Cause::ok) << run_end.message;
      EXPECT_EQ(run_end.contacts, exact.contacts);
      EXPECT_NEAR(run_end.final_state.q[PositionIndex(1)], exact.y, 100 * tolerance);
    }
  }
}

TEST(LocatedContacts, Every_impact_leaves_the_speed_of_its_law) {
  for (const ContactLaw law :
       {ContactLaw::lankarani_nikravesh, ContactLaw::flores, ContactLaw::hunt_crossley}) {
    Linkage linkage = flying_journal(0.5, 0.7);
    linkage.closures[0].clearance.law = law;
    const Model model = compile(linkage);
    const double ratio = contact_restitution(contact_damping(law, 0.7));
    for (const Integrator integrator : kAdaptive) {
      const SimulationOutcome end = run(model, by(integrator, 1e-9, steps_of(1e-2, 0.1)));
      ASSERT_GE(end.contacts, 5);
      const double speed = 0.5 * std::pow(ratio, static_cast<double>(end.contacts));
      EXPECT_NEAR(std::fabs(end.final_state.v[VelocityIndex(1)]) / speed, 1.0, 2e-5);
      EXPECT_LT(end.energy_residual_max, 1e-6 * end.energy_scale);
    }
  }
}

TEST(LocatedContacts, A_twentieth_of_the_evaluations_of_constant_steps_is_more_accurate) {
  const double speed = 0.1;
  const double cycle = elastic_contact_time(1.0, speed) + 2 * kRadial / speed;
  const double end = kRadial / speed + 20.85 * cycle;
  const Model model = compile(flying_journal(speed, 1.0));
  const SimulationOutcome fixed = run(model, steps_of(5e-6, end));
  const SimulationOutcome located =
      run(model, by(Integrator::adaptive, 1e-10, steps_of(1e-2, end)));
  const double exact = elastic_flight(speed, end).y;
  EXPECT_LT(20 * located.evaluations, fixed.evaluations);
  EXPECT_LT(std::fabs(located.final_state.q[PositionIndex(1)] - exact),
            std::fabs(fixed.final_state.q[PositionIndex(1)] - exact));
}

TEST(LocatedContacts, A_contact_shorter_than_any_free_step_is_not_missed) {
  // Thrown up against gravity to a little past the wall: free flight is integrated exactly by any
  // step, and the contact lasts a tenth of a millisecond.
  Linkage linkage = flying_journal(0.0, 1.0);
  linkage.gravity = {0.0, -9.81, 0.0};
  const double speed = std::sqrt(2 * 9.81 * (kRadial + 1e-9));
  linkage.joints[0].velocity[1] = speed;
  const Model model = compile(linkage);
  for (const Integrator integrator : kAdaptive) {
    const SimulationOutcome end =
        run(model, by(integrator, 1e-10, steps_of(1e-2, 1.5 * speed / 9.81)));
    EXPECT_EQ(end.contacts, 1);
    const SimulationOutcome later =
        run(model, by(integrator, 1e-10, steps_of(1e-2, 2.9 * speed / 9.81)));
    EXPECT_EQ(later.contacts, 2);  // and the wall below
  }
}

TEST(LocatedContacts, Bounces_end_at_rest_on_the_static_depth) {
  Linkage linkage = flying_journal(0.0, 0.3);
  linkage.gravity = {0.0, -9.81, 0.0};
  const double depth = std::pow(9.81 / kStiffness, 2.0 / 3.0);
  const Model model = compile(linkage);
  const SimulationOutcome end =
      run(model, by(Integrator::adaptive, 1e-10, steps_of(1e-2, 0.4, 1e-2)));
  ASSERT_EQ(end.cause, Cause::ok) << end.message;
  EXPECT_GE(end.contacts, 3);
  EXPECT_LT(end.contacts, 100);
  EXPECT_NEAR(-end.final_state.q[PositionIndex(1)] - kRadial, depth, 0.05 * depth);
  EXPECT_LT(std::fabs(end.final_state.v[VelocityIndex(1)]), 1e-3);
  EXPECT_LT(end.energy_residual_max, 1e-6 * end.energy_scale);
}

TEST(LocatedContacts, A_run_that_starts_in_contact_has_that_contact) {
  Linkage linkage = flying_journal(0.0, 0.9);
  linkage.gravity = {0.0, -9.81, 0.0};
  const double depth = std::pow(9.81 / kStiffness, 2.0 / 3.0);
  linkage.joints[0].position[1] = -kRadial - depth;
  const Model model = compile(linkage);
  for (const Integrator integrator : kAdaptive) {
    const SimulationOutcome end = run(model, by(integrator, 1e-10, steps_of(1e-2, 0.05)));
    EXPECT_EQ(end.contacts, 1);
    EXPECT_NEAR(end.final_state.q[PositionIndex(1)], -kRadial - depth, 1e-9);
  }
}

TEST(LocatedContacts, A_bristle_is_zero_between_contacts_and_the_ledger_closes_with_friction) {
  JournalInBearing journal;
  journal.velocity = {0.02, 0.3, 0.0};
  journal.turning = {0.0, 0.0, 30.0};
  Clearance clearance = loose_bearing();
  clearance.friction = table_1_friction();
  const Model model = compile(journal_in_bearing(journal, clearance));
  const SimulationOptions options = by(Integrator::adaptive, 1e-9, steps_of(1e-5, 0.1, 1e-5));
  const Samples s = run(model, options, {"closure.B.penetration.0", "closure.B.bristle.0"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  long inside = 0;
  for (Eigen::Index k = 0; k < s.values.rows(); ++k) {
    if (s.values(k, 0) > 0.0) {
      ++inside;
    } else {
      EXPECT_EQ(s.values(k, 1), 0.0) << k;
    }
  }
  EXPECT_GT(inside, 100);
  EXPECT_GT(s.values.col(1).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT(s.outcome.energy_residual_max, 1e-6 * s.outcome.energy_scale);
}

TEST(LocatedContacts, Both_ends_of_a_skewing_journal_are_followed_as_by_fine_constant_steps) {
  JournalInBearing journal;
  journal.kind = ClearanceKind::spatial;
  journal.velocity = {0.01, 0.2, 0.0};
  journal.turning = {15.0, 3.0, 0.0};
  const Model model = compile(journal_in_bearing(journal, loose_bearing()));
  const SimulationOutcome fixed = run(model, steps_of(5e-7, 0.03));
  const SimulationOutcome located =
      run(model, by(Integrator::adaptive, 1e-10, steps_of(1e-3, 0.03)));
  ASSERT_EQ(located.cause, Cause::ok) << located.message;
  EXPECT_EQ(located.contacts, fixed.contacts);
  EXPECT_GE(located.contacts, 4);
  for (std::size_t i = 0; i < fixed.final_state.q.size(); ++i) {
    EXPECT_NEAR(located.final_state.q[PositionIndex(i)], fixed.final_state.q[PositionIndex(i)],
                1e-6)
        << i;
  }
  EXPECT_LT(20 * located.evaluations, fixed.evaluations);
}

TEST(LocatedContacts, Rsup_with_clearance_takes_a_tenth_of_the_evaluations_of_constant_steps) {
  const std::vector<std::string> signals = {"joint.A.v", "joint.P.q", "joint.P.v"};
  for (const bool friction : {false, true}) {
    const Model model = compile(rsup_with_clearance(ClearanceKind::planar, friction));
    const SimulationOptions grid = steps_of(1e-3, 0.3, 1e-3);
    const Samples exact = run(model, by(Integrator::adaptive, 1e-12, grid), signals);
    const Samples fixed = run(model, steps_of(5e-6, 0.3, 1e-3), signals);
    const Samples located = run(model, by(Integrator::adaptive, 1e-9, grid), signals);
    ASSERT_EQ(located.outcome.cause, Cause::ok) << located.outcome.message;
    EXPECT_EQ(located.outcome.contacts, fixed.outcome.contacts);
    EXPECT_LT(10 * located.outcome.evaluations, fixed.outcome.evaluations);
    EXPECT_LT(largest(located.values, exact.values), largest(fixed.values, exact.values));
    EXPECT_LT(located.outcome.energy_residual_max, fixed.outcome.energy_residual_max);
  }
}

TEST(LocatedContacts, The_stiff_integrator_agrees_with_the_explicit_one) {
  const std::vector<std::string> signals = {"joint.A.q", "joint.P.q", "joint.P.v"};
  const Model model = compile(rsup_with_clearance(ClearanceKind::spatial, false));
  const SimulationOptions grid = steps_of(1e-3, 0.1, 1e-3);
  const Samples a = run(model, by(Integrator::adaptive, 1e-10, grid), signals);
  const Samples b = run(model, by(Integrator::stiff, 1e-8, grid), signals);
  ASSERT_EQ(b.outcome.cause, Cause::ok) << b.outcome.message;
  EXPECT_EQ(a.outcome.contacts, b.outcome.contacts);
  EXPECT_GE(a.outcome.contacts, 2);
  EXPECT_LT(largest(a.values, b.values), 1e-4);
}

TEST(LocatedContacts, More_contacts_than_a_run_may_have_in_one_interval_end_it) {
  // A bearing so narrow and hard that the journal buzzes: 6e-8 s from wall to wall.
  Linkage linkage = flying_journal(0.5, 1.0);
  linkage.closures[0].clearance.radial = 1e-8;
  linkage.closures[0].clearance.stiffness = 1e20;
  const Model model = compile(linkage);
  const SimulationOutcome end = run(model, by(Integrator::adaptive, 1e-4, steps_of(0.1, 0.1)));
  EXPECT_EQ(end.cause, Cause::contact_budget);
  EXPECT_EQ(end.contacts, kMostContacts + 1);
  EXPECT_NE(end.message.find("contacts"), std::string::npos);
  EXPECT_GT(end.end_time, 0.0);
  EXPECT_LT(end.end_time, 0.1);
}

}  // namespace linkstudy::testing::located_contacts_test

// Contacts one by one: against closed forms of an impact, and against the histories of a run.
#include "core/simulation/contact_list.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/laws/normal_contact.h"
#include "core/simulation/simulate.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::contact_list_test {
namespace {

using Eigen::Vector3d;

constexpr double kMass = 2.0, kSpeed = 1.5;  // kg, m/s

// A mass on a rail between two stops, 1 m from the upper one, towards which it moves.
Linkage flying_mass(const JointStops& stops) {
  Linkage linkage;
  linkage.links = {{"body", kMass, Vector3d::Zero(), 0.5 * Eigen::Matrix3d::Identity(), {}}};
  linkage.joints = {joint_at("J", JointType::prismatic, kGround, "body", {})};
  linkage.joints[0].velocity = {kSpeed};
  linkage.joints[0].stop = stops;
  return linkage;
}

JointStops stops(double low, double high, double stiffness) {
  JointStops stop;
  stop.low = {low};
  stop.high = {high};
  stop.stiffness = {stiffness};
  return stop;
}

SimulationOptions adaptive(double end_time) {
  SimulationOptions options = steps_of(end_time, end_time);
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = 1e-11;
  options.absolute_tolerance = 1e-13;
  return options;
}

ContactList contacts_of(const Model& model, const SimulationOptions& options,
                        std::size_t most = 100) {
  Observers observers;
  observers.contacts.most = most;
  const SimulationOutcome end =
      simulate(model.mechanism, model.parameters, model.start, options, observers);
  EXPECT_EQ(end.cause, Cause::ok) << end.message;
  EXPECT_EQ(
      static_cast<std::size_t>(end.contacts),
      observers.contacts.records.size() + static_cast<std::size_t>(observers.contacts.unlisted));
  return observers.contacts;
}

void expect_near(const ContactRecord& a, const ContactRecord& b, double relative) {
  EXPECT_EQ(a.contact, b.contact);
  EXPECT_NEAR(a.begin, b.begin, relative * b.begin);
  EXPECT_NEAR(a.end, b.end, relative * b.end);
  EXPECT_NEAR(a.approach, b.approach, relative * b.approach);
  EXPECT_NEAR(a.separation, b.separation, relative * b.separation);
  EXPECT_NEAR(a.force, b.force, relative * b.force);
  EXPECT_NEAR(a.depth, b.depth, relative * b.depth);
}

}  // namespace

// f = K d without loss: half a swing of the mass on the stop.
TEST(ContactList, Of_a_linear_stop_is_half_a_swing) {
  const double k = 1e5;
  JointStops stop = stops(-9.0, 1.0, k);
  stop.exponent = 1.0;
  stop.restitution = 1.0;
  const Model model = compile(flying_mass(stop));
  const double half = std::numbers::pi * std::sqrt(kMass / k);  // 14 ms
  const ContactRecord expected{ContactIndex(1),
                               0,
                               1.0 / kSpeed,
                               1.0 / kSpeed + half,
                               kSpeed,
                               kSpeed,
                               kSpeed * std::sqrt(k * kMass),
                               kSpeed * std::sqrt(kMass / k)};
  const ContactList located = contacts_of(model, adaptive(1.0));
  ASSERT_EQ(located.records.size(), 1u);
  expect_near(located.records[0], expected, 1e-7);  // a cubic by quarters of its steps
  // 70 and 280 steps in the contact; RK4 meets it within a step, as a corner of the force: errors
  // fall by 4 to 16, and are below (1/70)^2 from the first.
  const ContactList coarse = contacts_of(model, steps_of(2e-4, 1.0));
  const ContactList fine = contacts_of(model, steps_of(5e-5, 1.0));
  ASSERT_EQ(coarse.records.size(), 1u);
  ASSERT_EQ(fine.records.size(), 1u);
  expect_near(coarse.records[0], expected, 2e-4);
  expect_near(fine.records[0], expected, 2e-5);
  const auto places = contact_places(model.mechanism);
  EXPECT_EQ(places[fine.records[0].contact].owner, "joint.J");
  EXPECT_EQ(places[fine.records[0].contact].side, "high");
}

// The equation of motion of an impact with loss separates (core/laws/normal_contact.h): the speed
// ratio follows from D, and with 1/D of the loss K d^(n+1) / (n+1) = m v^2 (D - ln(1 + D)) / D^2.
TEST(ContactList, Tells_the_restitution_and_the_depth_that_the_law_implies) {
  for (const ContactLaw law :
       {ContactLaw::lankarani_nikravesh, ContactLaw::flores, ContactLaw::hunt_crossley}) {
    JointStops stop = stops(-9.0, 1.0, 1e6);
    stop.law = law;
    stop.restitution = 0.7;
    stop.exponent = 1.5;
    const double d = contact_damping(law, 0.7);
    const double stored = kMass * kSpeed * kSpeed * (d - std::log1p(d)) / (d * d);
    const double depth = std::pow(2.5 * stored / 1e6, 0.4);
    const Model model = compile(flying_mass(stop));
    for (const SimulationOptions& options : {adaptive(1.0), steps_of(2e-5, 1.0)}) {
      const ContactList list = contacts_of(model, options);
      ASSERT_EQ(list.records.size(), 1u);
      const double tolerance = options.integrator == Integrator::rk4 ? 1e-4 : 1e-6;
      EXPECT_NEAR(list.records[0].separation / list.records[0].approach, contact_restitution(d),
                  tolerance);
      EXPECT_NEAR(list.records[0].depth, depth, tolerance * depth);
      // With loss the force is largest before the depth is, and more than K d^n there.
      EXPECT_GT(list.records[0].force, 1e6 * std::pow(depth, 1.5));
    }
  }
}

TEST(ContactList, Gives_no_number_for_what_is_not_within_the_run) {
  JointStops stop = stops(-9.0, 1.0, 1e5);
  stop.exponent = 1.0;
  stop.restitution = 1.0;
  Linkage linkage = flying_mass(stop);
  linkage.joints[0].position = {1.001};  // 1 mm inside
  const Model inside = compile(linkage);
  const double half = std::numbers::pi * std::sqrt(kMass / 1e5);
  for (const SimulationOptions& options : {adaptive(0.5), steps_of(1e-5, 0.5)}) {
    const ContactList list = contacts_of(inside, options);
    ASSERT_EQ(list.records.size(), 1u);
    EXPECT_TRUE(std::isnan(list.records[0].begin));
    EXPECT_TRUE(std::isnan(list.records[0].approach));
    EXPECT_LT(list.records[0].end, half);
    // It leaves with all it had: 1/2 m v^2 + 1/2 K (1 mm)^2.
    EXPECT_NEAR(list.records[0].separation, std::sqrt(kSpeed * kSpeed + 1e5 * 1e-6 / kMass), 1e-5);
  }
  const Model flying = compile(flying_mass(stop));
  for (SimulationOptions options : {adaptive(1.0), steps_of(1e-5, 1.0)}) {
    options.end_time = 1.0 / kSpeed + 0.25 * half;
    if (options.integrator == Integrator::adaptive) options.step = options.end_time;
    const ContactList list = contacts_of(flying, options);
    ASSERT_EQ(list.records.size(), 1u);
    EXPECT_NEAR(list.records[0].begin, 1.0 / kSpeed, 1e-6);
    EXPECT_TRUE(std::isnan(list.records[0].end));
    EXPECT_TRUE(std::isnan(list.records[0].separation));
    const double reached = std::sqrt(0.5) * kSpeed * std::sqrt(1e5 * kMass);  // sin 45 deg
    EXPECT_NEAR(list.records[0].force, reached, 1e-5 * reached);
  }
}

// Each rebound takes the same part of the speed: the first contact is the hardest, and a list that
// ends before the others counts them.
TEST(ContactList, Keeps_the_first_counts_the_rest_and_knows_the_hardest) {
  Linkage linkage = flying_mass(stops(0.0, 1.0, 1e6));
  linkage.gravity = {0.0, 0.0, 20.0};  // speeds it up on its way to the upper stop
  linkage.joints[0].stop->restitution = 0.9;
  const Model model = compile(linkage);
  const ContactList whole = contacts_of(model, adaptive(6.0));
  const ContactList cut = contacts_of(model, adaptive(6.0), 2);
  ASSERT_GT(whole.records.size(), 6u);
  ASSERT_EQ(cut.records.size(), 2u);
  EXPECT_EQ(cut.unlisted, static_cast<long>(whole.records.size()) - 2);
  for (std::size_t i = 0; i < 2; ++i) expect_near(cut.records[i], whole.records[i], 0.0);
  const auto harder = [](const ContactRecord& a, const ContactRecord& b) {
    return a.force < b.force;
  };
  const ContactRecord hardest =
      *std::max_element(whole.records.begin(), whole.records.end(), harder);
  ASSERT_TRUE(cut.hardest[0]);
  EXPECT_EQ(cut.hardest[0]->number, hardest.number);
  EXPECT_EQ(cut.hardest[0]->force, hardest.force);
  EXPECT_EQ(cut.hardest[0]->separation, hardest.separation);
  EXPECT_FALSE(cut.hardest[1]);
}

// A journal that rattles in its bearing, with friction: the histories of a run at every step.
TEST(ContactList, Of_a_journal_agrees_with_the_histories_of_the_run) {
  Clearance c = loose_bearing();
  c.friction = table_1_friction();
  JournalInBearing j;
  j.velocity = {0.5, 0.2, 0.0};
  j.turning = {0.0, 0.0, 30.0};
  const Model model = compile(journal_in_bearing(j, c));
  const SimulationOptions options = steps_of(5e-7, 0.03, 5e-7);
  const Samples s = run(model, options, {"closure.B.penetration.0", "closure.B.normal_force.0"});
  const ContactList list = contacts_of(model, options);
  ASSERT_GT(list.records.size(), 4u);
  Eigen::Index row = 0;
  for (const ContactRecord& one : list.records) {
    while (row < s.values.rows() && s.values(row, 0) == 0.0) ++row;
    ASSERT_LT(row, s.values.rows());
    const double first = 5e-7 * static_cast<double>(row);
    EXPECT_LE(one.begin, first * (1.0 + 1e-12));
    EXPECT_GE(one.begin, first - 5e-7 * (1.0 + 1e-9));
    double force = 0.0, depth = 0.0;
    for (; row < s.values.rows() && s.values(row, 0) > 0.0; ++row) {
      depth = std::max(depth, s.values(row, 0));
      force = std::max(force, s.values(row, 1));
    }
    EXPECT_NEAR(one.end, 5e-7 * (static_cast<double>(row) - 0.5), 2.6e-7);
    // A sample is at most half a step from the peak: (pi / 2 / n)^2 / 2 of it at n steps a contact.
    const double steps = (one.end - one.begin) / 5e-7;
    const double missed = 2.0 * std::pow(std::numbers::pi / 2.0 / steps, 2);
    EXPECT_GE(one.depth, depth);
    EXPECT_LE(one.depth, depth * (1.0 + missed));
    EXPECT_GE(one.force, force);
    EXPECT_LE(one.force, force * (1.0 + missed));
  }
  SimulationOptions located = adaptive(0.03);
  const ContactList other = contacts_of(model, located);
  ASSERT_EQ(other.records.size(), list.records.size());
  for (std::size_t i = 0; i < 3; ++i) expect_near(list.records[i], other.records[i], 1e-3);
}

// What contacts take is what the speeds lose in them; the rest is the damper's.
TEST(ContactLoss, Is_told_apart_from_that_of_dampers) {
  Linkage linkage = flying_mass(stops(-0.2, 1.0, 1e6));
  linkage.joints[0].stop->restitution = 0.6;
  const std::vector<std::string> signals = {"energy.dissipated_in_contacts", "energy.dissipated",
                                            "joint.J.v"};
  for (SimulationOptions options : {adaptive(3.0), steps_of(1e-5, 3.0)}) {
    const Model model = compile(linkage);
    const ContactList list = contacts_of(model, options);
    ASSERT_GE(list.records.size(), 2u);
    double lost = 0.0;
    for (const ContactRecord& one : list.records) {
      lost += 0.5 * kMass * (one.approach * one.approach - one.separation * one.separation);
    }
    const Samples s = run(model, options, signals);
    const double told = s.values(s.values.rows() - 1, 0);
    EXPECT_NEAR(told, lost, 1e-3 * lost);
    EXPECT_NEAR(told, s.values(s.values.rows() - 1, 1), 1e-14);
  }
  linkage.joints[0].damping = {0.4};
  const Samples s = run(compile(linkage), steps_of(1e-5, 3.0, 1e-5), signals);
  const auto last = s.values.rows() - 1;
  const Vector speed = s.values.col(2);
  const double taken =
      0.4 * 1e-5 * (speed.squaredNorm() - 0.5 * (speed[0] * speed[0] + speed[last] * speed[last]));
  EXPECT_GT(s.values(last, 0), 0.1);
  EXPECT_NEAR(s.values(last, 1) - s.values(last, 0), taken, 1e-6 * taken);  // trapezoidal rule
}

}  // namespace linkstudy::testing::contact_list_test

// The oracle's clearance and springs of joints against numbers by hand, virtual power and energy.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing::oracle_contact_test {
namespace {

using Eigen::Vector3d;

// A free body of 2 kg whose journal lies 1.1 mm beside the centre of a bearing on ground, axis
// along z, turned by 0.7 rad.
Linkage free_journal() {
  Linkage linkage;
  linkage.gravity = {0, 0, -9.81};
  linkage.links.push_back(
      {"body", 2.0, Vector3d::Zero(), Vector3d(4e-3, 4e-3, 5e-3).asDiagonal(), {}});
  Joint joint;
  joint.name = "F";
  joint.type = JointType::free;
  joint.parent = kGround;
  joint.child = "body";
  joint.position = {1.1e-3, 0, 0, 0.7, 0, 0};
  joint.velocity = {0.3, 0.2, 0, 10, 0, 0};
  linkage.joints.push_back(joint);
  Closure closure;
  closure.name = "B";
  closure.type = JointType::revolute;
  closure.model = ClosureModel::clearance;
  closure.first = {"body", {x_along_z(), Vector3d::Zero()}};
  closure.second = {kGround, {x_along_z(), Vector3d::Zero()}};
  Clearance& c = closure.clearance;
  c.radial = 1e-3;
  c.bearing_radius = 5e-3;
  c.stiffness = 1e9;
  c.friction = Friction{0.2, 0.1, 0.0175, 600.0, 0.5, 0.1, 0.0};
  linkage.closures.push_back(closure);
  return linkage;
}

// RSRRP with a loose pin at R, moved off its centre by the slider.
Linkage loose_pin(bool bearing_is_first, double slider) {
  Linkage linkage = rsrrp_revolute();
  Closure& closure = linkage.closures[0];
  closure.model = ClosureModel::clearance;
  closure.clearance.bearing_is_first = bearing_is_first;
  closure.clearance.radial = 2e-4;
  closure.clearance.bearing_radius = 5e-3;
  closure.clearance.stiffness = 1e8;
  closure.clearance.friction = Friction{0.2, 0.1, 0.0175, 600.0, 0.5, 0.1, 0.0};
  for (Joint& joint : linkage.joints) {
    if (joint.name == "P") joint.position[0] += slider;
    joint.velocity.assign(joint.position.size(), 0.2);
  }
  return linkage;
}

}  // namespace

// delta = 0.1 mm, K delta^1.5 = 1000 N, D = 0.1425, rate / approach = 0.6: f_n = 1085.5 N. At K
// the journal slides with 0.2 + 10 (5 - 1.1) 1e-3 = 0.239 m/s, far above v_s: g = 0.1,
// z_dot = 0.239 (1 - 0.06 / 0.1), mu = 0.06 + 0.5 z_dot + 0.0239 = 0.1317.
TEST(OracleContact, A_journal_beside_its_bearing_feels_the_forces_found_by_hand) {
  const TraceModel model = make_trace_model(free_journal());
  const OracleResult r = oracle_acceleration(model, 0.0, model.q0, model.v0, {{0.5, 1e-4}});
  const ContactResult& c = r.contacts[0];
  EXPECT_NEAR(c.depth, 1e-4, 1e-17);
  EXPECT_NEAR(c.rate, 0.3, 1e-15);
  EXPECT_NEAR(c.normal, 1085.5, 1e-9);
  EXPECT_NEAR(c.sliding, 0.239, 1e-15);
  EXPECT_NEAR(c.bristle_rate, 0.0956, 1e-14);
  EXPECT_NEAR(c.friction, 1085.5 * 0.1317, 1e-9);
  EXPECT_NEAR(c.stored, 1000.0 * 1e-4 / 2.5, 1e-13);
  EXPECT_NEAR(c.dissipated_power, 85.5 * 0.3 + 1085.5 * 0.1317 * 0.239, 1e-9);
  EXPECT_NEAR((c.force - Vector3d(-1085.5, -1085.5 * 0.1317, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((c.point - Vector3d(5e-3, 0, 0)).norm(), 0.0, 1e-17);
  EXPECT_NEAR(r.qdd[0], -1085.5 / 2.0, 1e-9);
  EXPECT_NEAR(r.qdd[1], -1085.5 * 0.1317 / 2.0, 1e-9);
  EXPECT_NEAR(r.qdd[3], -1085.5 * 0.1317 * 3.9e-3 / 5e-3, 1e-9);
  for (const int held : {2, 4, 5}) EXPECT_NEAR(r.qdd[held], 0.0, 1e-10);
  EXPECT_NEAR(r.closures[0].force.z(), 2.0 * 9.81, 1e-11);  // the one force that still holds
}

// Faster than it came, 0.3 m/s after 0.1 m/s: 1000 (1 + 3 D) as printed, 1000 (1 + D) by the
// greatest speed; away from the wall nothing pulls.
TEST(OracleContact, A_journal_driven_faster_than_it_came_tells_the_two_approach_speeds_apart) {
  Linkage linkage = free_journal();
  const auto normal = [&](double approach) {
    const TraceModel model = make_trace_model(linkage);
    return oracle_acceleration(model, 0.0, model.q0, model.v0, {{approach, 0.0}})
        .contacts[0]
        .normal;
  };
  EXPECT_NEAR(normal(0.1), 1427.5, 1e-9);
  linkage.closures[0].clearance.approach = ApproachSpeed::greatest;
  EXPECT_NEAR(normal(0.1), 1142.5, 1e-9);
  linkage.joints[0].velocity[0] = -0.3;
  EXPECT_NEAR(normal(0.1), 857.5, 1e-9);
  linkage.closures[0].clearance.approach = ApproachSpeed::begin;
  EXPECT_NEAR(normal(0.1), 572.5, 1e-9);
  EXPECT_EQ(normal(0.03), 0.0);
}

// By eq. (17) the journal is met at 5.1 mm, its own surface: it slides with 0.2 + 10 * 4e-3 m/s and
// is braked at its own radius.
TEST(OracleContact, With_two_points_friction_acts_on_the_journal_at_its_own_surface) {
  Linkage linkage = free_journal();
  linkage.closures[0].clearance.points = ContactPoints::two;
  const TraceModel model = make_trace_model(linkage);
  const OracleResult r = oracle_acceleration(model, 0.0, model.q0, model.v0, {{0.5, 1e-4}});
  EXPECT_NEAR(r.contacts[0].sliding, 0.24, 1e-15);
  EXPECT_NEAR(r.qdd[3], -r.contacts[0].friction * 4e-3 / 5e-3, 1e-9);
}

TEST(OracleContact, Apart_it_leaves_only_what_a_planar_joint_holds) {
  for (const bool bearing_is_first : {false, true}) {
    Linkage loose = loose_pin(bearing_is_first, 1e-5);
    const TraceModel model = make_trace_model(loose);
    const OracleState s = closed_state(model, start_state(model));
    loose.closures[0].model = ClosureModel::cut;
    loose.closures[0].type = JointType::planar;
    const OracleResult a = oracle_acceleration(model, 0.1, s.q, s.v);
    const OracleResult b = oracle_acceleration(loose, 0.1, s.q, s.v);
    EXPECT_FALSE(a.contacts[0].touches);
    EXPECT_LT(a.contacts[0].depth, 0.0);
    EXPECT_LT((a.qdd - b.qdd).norm(), 1e-12 * b.qdd.norm());
  }
}

TEST(OracleContact, Generalised_forces_of_a_contact_do_the_work_of_its_two_forces) {
  for (const bool bearing_is_first : {false, true}) {
    const TraceModel model = make_trace_model(loose_pin(bearing_is_first, 8e-4));
    const OracleState s = closed_state(model, start_state(model));
    const ContactResult c = oracle_acceleration(model, 0.1, s.q, s.v, {{0.1, 2e-5}}).contacts[0];
    ASSERT_TRUE(c.touches);
    const double power = -(c.normal * c.rate + c.friction * c.sliding);
    EXPECT_GT(std::fabs(c.rate), 1e-3);
    EXPECT_GT(std::fabs(c.sliding), 1e-3);
    EXPECT_NEAR(c.generalised.dot(s.v), power, 1e-9 * std::fabs(power));
  }
}

TEST(OracleContact, Energy_stays_through_impacts_without_loss) {
  Linkage linkage = loose_pin(true, 1e-5);
  linkage.loads.clear();
  linkage.closures[0].clearance.restitution = 1.0;
  linkage.closures[0].clearance.friction.reset();
  const TraceModel model = make_trace_model(linkage);
  OracleState s = closed_state(model, start_state(model));
  const double energy = total_energy(model, s), moving = kinetic_energy(model, s.q, s.v);
  double stored = 0.0;
  for (int k = 0; k < 4000; ++k) {
    rk4_step(model, 2e-6, s);
    stored = std::max(stored, oracle_acceleration(model, s.t, s.q, s.v).contacts[0].stored);
  }
  EXPECT_GT(stored, 1e-3 * moving);  // it did touch
  EXPECT_NEAR(total_energy(model, s), energy, 1e-6 * moving);
}

TEST(OracleContact, Springs_and_dampers_of_joints_pull_towards_their_rest) {
  Linkage linkage = free_journal();
  linkage.closures.clear();
  linkage.gravity.setZero();
  Joint& joint = linkage.joints[0];
  joint.position = {0.5, 0, 0, 0, 0, 0};
  joint.velocity = {0.1, 0, 0, 2, 0, 0};
  joint.stiffness = {100, 0, 0, 0.3, 0, 0};
  joint.damping = {3, 0, 0, 0.02, 0, 0};
  joint.rest = {0.2, 0, 0, -0.5, 0, 0};
  const TraceModel model = make_trace_model(linkage);
  const Vector qdd = oracle_acceleration(model, 0.0, model.q0, model.v0).qdd;
  EXPECT_NEAR(qdd[0], -(100 * 0.3 + 3 * 0.1) / 2.0, 1e-13);
  EXPECT_NEAR(qdd[3], -(0.3 * 0.5 + 0.02 * 2) / 5e-3, 1e-12);
  EXPECT_NEAR(total_energy(model, start_state(model)) - kinetic_energy(model, model.q0, model.v0),
              0.5 * 100 * 0.09 + 0.5 * 0.3 * 0.25, 1e-13);
}

}  // namespace linkstudy::testing::oracle_contact_test

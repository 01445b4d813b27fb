// Journals in bearings: impacts against closed forms, forces against the gradient of their energy,
// momentum of what is left alone, and the four states of contact.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/laws/normal_contact.h"
#include "tests/mechanisms/frames.h"
#include "tests/mechanisms/journal_in_bearing.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/random.h"

namespace linkstudy::testing::clearance_test {
namespace {

using Eigen::Vector3d;

// Largest penetration of mass m at speed v without damping: 1/2 m v^2 = K delta^(n+1) / (n+1).
double deepest(double mass, double speed, double stiffness) {
  return std::pow(1.25 * mass * speed * speed / stiffness, 0.4);
}

double speed_after(double t, const JournalInBearing& j, const Clearance& c, double step) {
  const SimulationOutcome end = run(compile(journal_in_bearing(j, c)), steps_of(step, t));
  EXPECT_EQ(end.cause, Cause::ok) << end.message;
  return std::hypot(end.final_state.v[VelocityIndex(0)], end.final_state.v[VelocityIndex(1)]);
}

struct Impact {
  ContactLaw law;
  double restitution, mass, speed, stiffness;
};

// Ratio of the speeds after and before the journal meets the wall of its bearing, along x.
double rebound(const Impact& i, ClearanceKind kind) {
  Clearance c = loose_bearing();
  c.law = i.law;
  c.restitution = i.restitution;
  c.stiffness = i.stiffness;
  JournalInBearing j;
  j.kind = kind;
  j.mass = i.mass;
  j.velocity.x() = i.speed;
  // A contact lasts 2.94 delta / v without damping, longer with it; then 2 c_r to the other wall.
  const double contact = deepest(i.mass, i.speed, i.stiffness) / i.speed;
  const double t = 1e-3 / i.speed + 30.0 * contact;
  return speed_after(t, j, c, contact / 400.0) / i.speed;
}

}  // namespace

TEST(Impact, Rebounds_with_the_restitution_that_its_law_implies_whatever_mass_speed_and_stiffness) {
  for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9, 0.95}) {
    for (const Impact& i : {Impact{ContactLaw::lankarani_nikravesh, e, 1.0, 0.1, 1e10},
                            Impact{ContactLaw::lankarani_nikravesh, e, 0.02, 0.3, 1e9},
                            Impact{ContactLaw::hunt_crossley, e, 1.0, 0.1, 1e10},
                            Impact{ContactLaw::flores, e, 1.0, 0.1, 1e10}}) {
      const double expected = contact_restitution(contact_damping(i.law, e));
      EXPECT_NEAR(rebound(i, ClearanceKind::planar), expected, 1e-6) << e;
    }
  }
}

TEST(Impact, Penetrates_as_deep_as_its_energy_asks) {
  Clearance c = loose_bearing();
  c.restitution = 1.0;
  JournalInBearing j;
  j.velocity = {0.06, 0.08, 0.0};
  const Samples samples = run(compile(journal_in_bearing(j, c)), steps_of(1e-6, 0.012, 1e-6),
                              {"closure.B.penetration.0", "closure.B.normal_force.0"});
  const double delta = deepest(1.0, 0.1, 1e10);
  EXPECT_NEAR(samples.values.col(0).maxCoeff(), delta, 1e-5 * delta);
  EXPECT_NEAR(samples.values.col(1).maxCoeff(), 1e10 * std::pow(delta, 1.5),
              1e-4 * 1e10 * std::pow(delta, 1.5));
  EXPECT_EQ(samples.values.col(1).minCoeff(), 0.0);
}

TEST(Impact, The_energy_ledger_closes_through_many_impacts_with_friction) {
  for (const ClearanceKind kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    Clearance c = loose_bearing();
    c.friction = table_1_friction();
    JournalInBearing j;
    j.kind = kind;
    j.velocity = {0.5, 0.2, 0.0};
    j.turning = {0.0, 0.0, 30.0};
    if (kind == ClearanceKind::spatial) j.turning.x() = 5.0;
    const SimulationOutcome end = run(compile(journal_in_bearing(j, c)), steps_of(5e-7, 0.1, 1e-4));
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    EXPECT_GT(end.contacts, 10);
    EXPECT_GT(end.least_contact_steps, 20);
    EXPECT_LT(end.energy_residual_max, 2e-5 * end.energy_scale);
  }
}

TEST(Impact, Counts_contacts_and_the_steps_of_the_shortest) {
  Clearance c = loose_bearing();
  c.restitution = 1.0;
  JournalInBearing j;
  j.velocity.x() = 0.1;
  const double delta = deepest(1.0, 0.1, 1e10);
  const double lasts = 2.9432 * delta / 0.1;  // Hertz
  // walls at 0.01 s, then every 0.02 s and one contact later
  const SimulationOutcome end =
      run(compile(journal_in_bearing(j, c)), steps_of(lasts / 50.0, 0.06));
  EXPECT_EQ(end.contacts, 3);
  EXPECT_NEAR(static_cast<double>(end.least_contact_steps), 50.0, 1.0);
}

TEST(Clearance, The_spatial_model_with_parallel_axes_is_the_planar_one) {
  Clearance c = loose_bearing();
  c.friction = table_1_friction();
  std::array<Samples, 2> samples;
  for (const ClearanceKind kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    JournalInBearing j;
    j.kind = kind;
    j.velocity = {0.3, 0.1, 0.0};
    j.turning.z() = 20.0;
    samples[kind == ClearanceKind::spatial] =
        run(compile(journal_in_bearing(j, c)), steps_of(1e-6, 0.03, 1e-5),
            {"joint.F.q.0", "joint.F.q.1", "joint.F.v.5", "closure.B.force",
             "closure.B.contact_state"});
  }
  EXPECT_GT(samples[0].outcome.contacts, 3);
  const Matrix error = samples[0].values - samples[1].values;
  EXPECT_LT(error.leftCols(2).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(error.col(2).cwiseAbs().maxCoeff(), 1e-9);
  const double force = samples[0].values.middleCols(3, 3).cwiseAbs().maxCoeff();
  EXPECT_GT(force, 100.0);
  EXPECT_LT(error.middleCols(3, 3).cwiseAbs().maxCoeff(), 1e-8 * force);
  EXPECT_EQ(error.col(6).cwiseAbs().maxCoeff(), 0.0);
}

TEST(Clearance, Every_state_of_contact_is_seen_and_named) {
  JournalInBearing j;
  j.kind = ClearanceKind::spatial;
  const auto state_at = [&](const Vector3d& position, const Vector3d& rotation) {
    j.position = position;
    j.rotation = rotation;
    return EngineProbe(journal_in_bearing(j, loose_bearing())).at("closure.B.contact_state");
  };
  EXPECT_EQ(state_at({0.5e-3, 0, 0}, {0, 0, 0}), 0.0);
  EXPECT_EQ(state_at({1.01e-3, 0, 0}, {0, 0, 0}), 3.0);
  EXPECT_EQ(state_at({0.9e-3, 0, 0}, {0, 0.02, 0}), 1.0);  // ends off by 0.2 mm
  EXPECT_EQ(state_at({0, 0, 0}, {0, 0.11, 0}), 2.0);       // 1.1 mm, opposite sides
  EXPECT_EQ(state_at({1.3e-3, 0, 0}, {0, 0.02, 0}), 3.0);
}

TEST(Clearance, Its_channels_tell_where_the_journal_is) {
  JournalInBearing j;
  j.kind = ClearanceKind::spatial;
  j.position = {0.9e-3, 0.2e-3, 0.0};
  j.rotation = {0, 0.03, 0};  // the axis leans towards +x at the +z end
  EngineProbe probe(journal_in_bearing(j, loose_bearing()));
  const double lean = 0.01 * std::tan(0.03);
  const double far_end = std::hypot(0.9e-3 + lean, 0.2e-3) - 1e-3;
  EXPECT_NEAR(probe.at("closure.B.penetration.1"), far_end, 1e-15);
  EXPECT_EQ(probe.at("closure.B.penetration.0"), 0.0);
  EXPECT_NEAR(probe.at("closure.B.normal_force.1"), 0.5e10 * std::pow(far_end, 1.5), 1e-6);
  // Bearing less journal, along y and z of the bearing's frame, whose x runs along ground z.
  const Eigen::Matrix3d frame = x_along_z();
  const Vector3d e = frame.transpose() * Vector3d(-0.9e-3, -0.2e-3, 0.0);
  EXPECT_NEAR(probe.at("closure.B.eccentricity.x"), e.y(), 1e-15);
  EXPECT_NEAR(probe.at("closure.B.eccentricity.y"), e.z(), 1e-15);
}

TEST(Clearance, A_journal_that_is_given_within_its_bearing_starts_there) {
  JournalInBearing j;
  j.position = {-0.4e-3, 0.3e-3, 0.0};
  j.velocity = {0.1, 0.0, 0.0};
  Clearance c = loose_bearing();
  c.friction = table_1_friction();
  const Preparation inside = prepare(journal_in_bearing(j, c), steps_of(1e-5, 0.1));
  ASSERT_EQ(inside.cause, Cause::ok) << inside.message;
  EXPECT_EQ(inside.model.start.q[PositionIndex(0)], -0.4e-3);
  EXPECT_EQ(inside.model.start.v[VelocityIndex(0)], 0.1);
  j.position = {-0.4e-3, 3e-3, 0.0};  // outside: closed as an ideal joint
  const Preparation outside = prepare(journal_in_bearing(j, c), steps_of(1e-5, 0.1));
  ASSERT_EQ(outside.cause, Cause::ok) << outside.message;
  EXPECT_NEAR(outside.model.start.q[PositionIndex(1)], 0.0, 1e-9);
}

TEST(Clearance, Equilibrium_is_that_of_the_ideal_joint) {
  Clearance c = loose_bearing();
  c.friction = table_1_friction();
  Linkage linkage = journal_in_bearing({}, c);
  linkage.gravity = {0.0, -9.81, 0.0};
  SimulationOptions options = steps_of(1e-5, 0.01);
  options.start = Start::equilibrium;
  const Preparation p = prepare(linkage, options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  EXPECT_EQ(p.model.start.z.size(), 1u);
  EXPECT_EQ(run(p.model, options).cause, Cause::ok);
}

// Without a past a contact is elastic: its generalised forces are the gradient of its energy.
TEST(Clearance, Forces_of_skewed_contacts_are_the_gradient_of_their_energy) {
  Random random(7);
  int touching = 0;
  for (int trial = 0; trial < 40; ++trial) {
    JournalInBearing j;
    j.kind = trial % 2 == 0 ? ClearanceKind::spatial : ClearanceKind::planar;
    j.position = Vector3d(random.within(1.2e-3), random.within(1.2e-3), random.within(1e-3));
    j.rotation = Vector3d(random.within(0.1), random.within(0.1), random.within(1.0));
    Linkage linkage = journal_in_bearing(j, loose_bearing());
    linkage.joints[0].coordinates = RotationCoordinates::zyx;
    const auto& h = linkage.joints[0].position;
    const Vector3d angles =
        zyx_angles(Eigen::Quaterniond(h[3], h[4], h[5], h[6]).toRotationMatrix());
    linkage.joints[0].position = {h[0], h[1], h[2], angles[0], angles[1], angles[2]};
    linkage.closures[0].clearance.bearing_is_first = trial % 3 == 0;
    EngineProbe probe(linkage);
    const Vector tau = probe.tau();
    if (probe.at("closure.B.contact_state") > 0.0) ++touching;
    const State<double> start = probe.state();
    for (std::size_t k = 0; k < 6; ++k) {
      const auto energy = [&](double step) {
        State<double> s = start;
        s.q[PositionIndex(k)] += step;
        probe.evaluate_at(s);
        return probe.at("energy.potential");
      };
      const double h_k = k < 3 ? 1e-9 : 1e-7;
      const double gradient = (energy(h_k) - energy(-h_k)) / (2.0 * h_k);
      const double scale = k < 3 ? 1.0 : 0.01;
      EXPECT_NEAR(tau[static_cast<Eigen::Index>(k)], -gradient,
                  scale * (1e-3 + 1e-5 * tau.head(3).norm()))
          << trial << " " << k;
    }
  }
  EXPECT_GT(touching, 15);
}

// Two free bodies, one with the journal and one with the bearing, far from parallel and spinning.
// With friction at two points, as printed, the two forces are a couple that nothing answers.
TEST(Clearance, Contacts_with_friction_at_one_point_keep_the_momentum_of_two_free_bodies) {
  for (const auto& [bearing_is_first, points] :
       {std::pair(false, ContactPoints::one), std::pair(true, ContactPoints::one),
        std::pair(false, ContactPoints::two), std::pair(true, ContactPoints::two)}) {
    JournalInBearing j;
    j.kind = ClearanceKind::spatial;
    j.velocity = {0.4, 0.3, 0.0};
    j.turning = {4.0, -3.0, 25.0};
    Clearance c = loose_bearing();
    c.friction = table_1_friction();
    c.bearing_is_first = bearing_is_first;
    c.points = points;
    Linkage linkage = journal_in_bearing(j, c);
    linkage.links.push_back(
        {"housing", 2.0, Vector3d::Zero(), Vector3d(4e-3, 3e-3, 5e-3).asDiagonal(), {}});
    Joint joint = linkage.joints[0];
    joint.name = "G";
    joint.child = "housing";
    joint.position = {0, 0, 0, 1, 0, 0, 0};
    joint.velocity = {-0.1, 0.05, 0.0, 1.0, 2.0, -10.0};
    linkage.joints.push_back(joint);
    linkage.closures[0].second.link = "housing";
    if (bearing_is_first) std::swap(linkage.closures[0].first, linkage.closures[0].second);
    linkage.closures[0].stabilization = Stabilization::projection;
    const Model model = compile(linkage);
    const auto momentum = [&](const State<double>& s) {
      Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
      for (std::size_t b = 0; b < 2; ++b) {
        const Vector3d p(&s.q[PositionIndex(7 * b)]), v(&s.v[VelocityIndex(6 * b)]),
            w(&s.v[VelocityIndex(6 * b + 3)]);
        const double* h = &s.q[PositionIndex(7 * b + 3)];
        const Eigen::Matrix3d r = Eigen::Quaterniond(h[0], h[1], h[2], h[3]).toRotationMatrix();
        const Link& link = linkage.links[b];
        sum.head<3>() += link.mass * v;
        sum.tail<3>() += p.cross(link.mass * v) + r * (link.inertia * w);
      }
      return sum;
    };
    const State<double>& start = model.start;
    const SimulationOutcome end = run(model, steps_of(1e-6, 0.03));
    ASSERT_EQ(end.cause, Cause::ok) << end.message;
    EXPECT_GT(end.contacts, 3);
    const auto change = (momentum(end.final_state) - momentum(start)).eval();
    EXPECT_LT(change.head<3>().norm(), 1e-10);
    EXPECT_LT(end.energy_residual_max, 1e-4 * end.energy_scale);
    if (points == ContactPoints::one) {
      EXPECT_LT(change.tail<3>().norm(), 1e-10) << "what the contacts turn, they turn in pairs";
    } else {
      EXPECT_GT(change.tail<3>().norm(), 1e-6);
    }
  }
}

// A heavy journal turns in its bearing: it rests where the wall is inclined by the angle of
// friction, and its spin is braked by mu N r. It swings about that place, by A = 0.14 or 0.25 as
// its contact settles, which lifts the mean of N by A^2 / 4: m v^2 / r is A^2 / 2, cosines lose A^2
// / 4.
TEST(Clearance, Friction_brakes_a_journal_that_turns_under_its_weight) {
  for (const ApproachSpeed approach : {ApproachSpeed::begin, ApproachSpeed::greatest}) {
    Clearance c = loose_bearing();
    c.friction = table_1_friction();
    c.restitution = 0.3;
    c.approach = approach;
    JournalInBearing j;
    j.moments = {2e-3, 2e-3, 1e-3};
    const double phi = std::atan(0.1);
    j.position = {-1e-3 * std::sin(phi), -1e-3 * std::cos(phi), 0.0};
    j.turning.z() = 200.0;
    Linkage linkage = journal_in_bearing(j, c);
    linkage.gravity = {0.0, -9.81, 0.0};
    const Samples samples = run(compile(linkage), steps_of(5e-6, 0.8, 1e-3),
                                {"joint.F.v.5", "joint.F.q.0", "joint.F.q.1"});
    ASSERT_EQ(samples.outcome.cause, Cause::ok) << samples.outcome.message;
    // Reaction through the weight at the angle of friction, N = m g cos(phi), at the radius of the
    // journal, 4 mm.
    const double braking = 0.1 * 9.81 * std::cos(phi) * 4e-3 / 1e-3;  // rad/s^2
    const double found = (samples.values(200, 0) - samples.values(800, 0)) / 0.6;
    const Vector angle =
        (samples.values.col(1).array() / samples.values.col(2).array()).atan().tail(600);
    const double swing = 0.5 * (angle.maxCoeff() - angle.minCoeff());
    EXPECT_NEAR(found / braking, 1.0 + 0.25 * swing * swing, 3e-3);
    if (approach == ApproachSpeed::begin) continue;
    EXPECT_NEAR(found, braking, 1e-2 * braking);
    const Vector mean = samples.values.bottomRows(600).colwise().mean();
    EXPECT_NEAR(mean[1] / mean[2], std::tan(phi), 0.05 * std::tan(phi));
  }
}

}  // namespace linkstudy::testing::clearance_test

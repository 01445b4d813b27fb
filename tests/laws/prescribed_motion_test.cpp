// Motions that are laws of time, by two routes: where the law has the acceleration that a torque
// gives, its effort is that torque; and runs against solutions that know nothing of the engine.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/kinematics/drive_cycle.h"
#include "core/simulation/motion_start.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/joint_at.h"
#include "tests/mechanisms/loose_slider_crank.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/rsup.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::prescribed_motion_test {
namespace {

constexpr double kGravity = 9.81;

Motion motion_of(const std::string& joint, MotionLaw law, int coordinate = 0) {
  Motion motion;
  motion.name = "m";
  motion.joint = joint;
  motion.coordinate = coordinate;
  motion.law = law;
  return motion;
}

// A sine that has this position, rate and acceleration at t = 0.
Motion sine_through(const std::string& joint, int coordinate, double q, double v, double a) {
  Motion motion = motion_of(joint, MotionLaw::sine, coordinate);
  motion.frequency = 0.5 / std::numbers::pi;  // 1 rad/s
  motion.amplitude = std::hypot(v, a);
  motion.phase = std::atan2(-a, v);
  motion.from = q + a;
  return motion;
}

Load effort_on(const std::string& joint, int coordinate, double value) {
  Load load;
  load.name = "effort";
  load.type = LoadType::drive;
  load.joint = joint;
  load.coordinate = coordinate;
  load.course.shape = CourseShape::constant;
  load.course.value = value;
  return load;
}

// A coordinate of every joint whose coordinates are no quaternion.
struct Place {
  std::string joint;
  int coordinate;
  PositionIndex q;
  VelocityIndex v;
};
std::vector<Place> places_of(const Mechanism& m) {
  std::vector<Place> places;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    const Body& body = m.bodies[BodyIndex(b)];
    if (body.v_count == 0 || body.q_count != body.v_count) continue;
    const int i = static_cast<int>(b) % body.v_count;
    places.push_back({m.joint_names[BodyIndex(b)], i, body.q_begin + i, body.v_begin + i});
  }
  return places;
}

// All channels of the driven linkage beside those of the forced one.
void expect_same_as_forced(EngineProbe& forced, EngineProbe& driven, double scale) {
  for (const Channel& c : list_channels(forced.model().mechanism)) {
    if (c.name == "energy.residual") continue;
    EXPECT_NEAR(driven.at(c.name), forced.at(c.name),
                1e-9 * std::max(scale, std::abs(forced.at(c.name))))
        << c.name;
  }
}

double largest_channel(EngineProbe& probe) {
  double largest = 0.0;
  for (const Channel& c : list_channels(probe.model().mechanism)) {
    largest = std::max(largest, std::abs(probe.at(c.name)));
  }
  return largest;
}

// At every coordinate that the closures leave free to move; how many these are.
int expect_effort_is_torque(const Linkage& linkage) {
  constexpr double kTorque = 2.5;
  const Model bare = compile(linkage);
  int count = 0;
  for (const Place& place : places_of(bare.mechanism)) {
    SCOPED_TRACE(linkage.name + " " + place.joint + " " + std::to_string(place.coordinate));
    Linkage with_torque = linkage;
    with_torque.loads.push_back(effort_on(place.joint, place.coordinate, kTorque));
    EngineProbe forced(with_torque);
    Linkage with_motion = linkage;
    with_motion.motions = {sine_through(place.joint, place.coordinate, bare.start.q[place.q],
                                        bare.start.v[place.v], forced.qdd()[place.v.value()])};
    if (!overdriven_text(compile(with_motion)).empty()) continue;
    ++count;
    EngineProbe driven(with_motion);
    const double scale = largest_channel(forced);
    EXPECT_NEAR(driven.at("motion.m.effort"), kTorque, 1e-9 * std::max(1.0, scale));
    expect_same_as_forced(forced, driven, scale);
  }
  return count;
}

}  // namespace

TEST(PrescribedMotion, Takes_the_torque_that_gives_its_acceleration_in_trees) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    count += expect_effort_is_torque(random_tree(seed));
  EXPECT_GT(count, 50);
}

TEST(PrescribedMotion, Takes_it_in_linkages_closed_by_cut_and_replacement_joints) {
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    for (const JointType type : {JointType::spherical, JointType::revolute, JointType::universal}) {
      for (const ClosureModel model : {ClosureModel::cut, ClosureModel::sde}) {
        count += expect_effort_is_torque(random_closed_linkage(seed, type, model));
      }
    }
  }
  EXPECT_GT(count, 80);
  EXPECT_GT(expect_effort_is_torque(rsrrp_revolute()), 0);
  EXPECT_GT(expect_effort_is_torque(spatial_slider_crank_cut_at_universal()), 0);
}

TEST(PrescribedMotion, Takes_it_beside_contacts_and_friction) {
  EXPECT_EQ(expect_effort_is_torque(loose_slider_crank(ClearanceKind::spatial, 5.0)), 3);
  Linkage rubbing = rsrrp();
  const RsrrpPose pose = rsrrp_pose(0.7);  // away from the dead position of the slider
  const double positions[] = {pose.psi, pose.d, pose.psi22, pose.psi23};
  for (std::size_t i = 0; i < 4; ++i) {
    Joint& joint = rubbing.joints[i];
    joint.position = {positions[i]};
    joint.velocity = {0.04};
    JointFriction friction;
    friction.law = {.mu_s = 0.2, .mu_k = 0.1, .v_s = 0.01, .sigma0 = 200.0, .sigma1 = 1.0};
    friction.radius = 0.01;
    joint.friction = friction;
  }
  EXPECT_EQ(expect_effort_is_torque(rubbing), 4);
}

// Rows that depend on each other have the same multipliers, and a beam of rigid finite elements is
// a tree like others.
TEST(PrescribedMotion, Takes_it_beside_redundant_rows_and_flexible_links) {
  EXPECT_EQ(expect_effort_is_torque(bennett()), 3);
  EXPECT_EQ(expect_effort_is_torque(four_bar()), 3);
  Rsup options;
  options.segments = 3;
  options.clearance = ClearanceKind::planar;
  EXPECT_GT(expect_effort_is_torque(rsup(options)), 5);
}

// Two of three coordinates driven: each effort is the torque there.
TEST(PrescribedMotion, Takes_the_torques_of_several_at_once) {
  Linkage linkage = random_tree(5, {.links = 4, .types = {JointType::revolute}});
  Linkage with_torques = linkage;
  const Model bare = compile(linkage);
  const std::vector<Place> places = places_of(bare.mechanism);
  with_torques.loads.push_back(effort_on(places[0].joint, 0, 2.0));
  with_torques.loads.push_back(effort_on(places[2].joint, 0, -3.0));
  with_torques.loads.back().name = "other";
  EngineProbe forced(with_torques);
  for (const std::size_t i : {0u, 2u}) {
    const Place& p = places[i];
    linkage.motions.push_back(
        sine_through(p.joint, 0, bare.start.q[p.q], bare.start.v[p.v], forced.qdd()[p.v.value()]));
    linkage.motions.back().name = "m" + std::to_string(i);
  }
  EngineProbe driven(linkage);
  const double scale = largest_channel(forced);
  EXPECT_NEAR(driven.at("motion.m0.effort"), 2.0, 1e-9 * scale);
  EXPECT_NEAR(driven.at("motion.m2.effort"), -3.0, 1e-9 * scale);
  expect_same_as_forced(forced, driven, scale);
}

// m L^2 q'' + m g L cos q, q = 0 horizontal.
TEST(PrescribedMotion, Of_a_pendulum_takes_the_torque_of_the_textbook) {
  Linkage linkage = pendulum(2.0, 0.5);
  linkage.motions = {motion_of("A", MotionLaw::sine)};
  linkage.motions[0].amplitude = 0.8;
  linkage.motions[0].frequency = 1.5;
  linkage.motions[0].phase = 0.3;
  linkage.motions[0].from = -0.2;
  const Samples s = run(compile(linkage), steps_of(1e-3, 2.0, 0.01),
                        {"time", "joint.A.q", "joint.A.v", "joint.A.a", "motion.m.effort",
                         "motion.m.power", "joint.A.torque_local.z", "energy.residual"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const double w = 2.0 * std::numbers::pi * 1.5;
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double phase = w * s.values(i, 0) + 0.3;
    const double q = -0.2 + 0.8 * std::sin(phase), a = -0.8 * w * w * std::sin(phase);
    EXPECT_NEAR(s.values(i, 1), q, 1e-14);
    EXPECT_NEAR(s.values(i, 2), 0.8 * w * std::cos(phase), 1e-13);
    EXPECT_NEAR(s.values(i, 3), a, 1e-12);
    const double torque = 2.0 * 0.25 * a + 2.0 * kGravity * 0.5 * std::cos(q);
    EXPECT_NEAR(s.values(i, 4), torque, 1e-12 * 60.0);
    EXPECT_NEAR(s.values(i, 5), s.values(i, 4) * s.values(i, 2), 1e-12 * 400.0);
    EXPECT_NEAR(s.values(i, 6), s.values(i, 4), 1e-11);
    // The work of the motor is the energy of the pendulum, at fourth order of the step.
    EXPECT_NEAR(s.values(i, 7), 0.0, 1e-7);
  }
}

// Every freedom driven: the coordinates are those of the exact pose, the torque is what changes the
// energy: u psi' = d(T + V)/dt.
TEST(PrescribedMotion, Of_all_freedoms_is_an_inverse_dynamics) {
  Linkage linkage = rsrrp();
  linkage.loads.clear();
  linkage.closures[0].stabilization = Stabilization::projection;
  linkage.motions = {motion_of("A", MotionLaw::speed)};
  linkage.motions[0].speed = 5.0;
  SimulationOptions options = steps_of(1e-4, 2.0, 1e-3);
  const Preparation p = prepare(linkage, options);
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  ASSERT_EQ(p.warnings.size(), 1u);
  EXPECT_NE(p.warnings[0].find("inverse dynamics"), std::string::npos);
  const Samples s =
      run(p.model, options,
          {"time", "joint.A.q", "joint.P.q", "joint.Q.q", "joint.R.q", "motion.m.power",
           "energy.kinetic", "energy.potential", "energy.supplied"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const auto energy = [&](Eigen::Index i) { return s.values(i, 6) + s.values(i, 7); };
  for (Eigen::Index i = 3; i + 3 < s.values.rows(); ++i) {
    const RsrrpPose pose = rsrrp_pose(5.0 * s.values(i, 0));
    EXPECT_NEAR(s.values(i, 2), pose.d, 1e-9);
    EXPECT_NEAR(std::remainder(s.values(i, 3) - pose.psi22, 2 * std::numbers::pi), 0.0, 1e-9);
    EXPECT_NEAR(s.values(i, 4), pose.psi23, 1e-9);
    const double rate = (45 * (energy(i + 1) - energy(i - 1)) -
                         9 * (energy(i + 2) - energy(i - 2)) + (energy(i + 3) - energy(i - 3))) /
                        (60 * 1e-3);
    EXPECT_NEAR(s.values(i, 5), rate, 1e-7 * 20.0);  // W; powers reach 20 W
    EXPECT_NEAR(s.values(i, 8), energy(i) - energy(0), 1e-9);
  }
}

// A pendulum whose support moves up and down by A sin(w t): with the angle p from the upright,
// l p'' = (g - A w^2 sin(w t)) sin p. It stands upright where (A w)^2 > 2 g l (P. L. Kapitza,
// 1951), for small A / l.
class Kapitza {
 public:
  Kapitza(double amplitude, double speed) : amplitude_(amplitude), speed_(speed) {
    linkage_ = pendulum(1.0, kLength);
    // The carrier moves along y, massless in effect: its motion is prescribed.
    linkage_.links.push_back(
        {"support", 1.0, Eigen::Vector3d::Zero(), 1e-3 * Eigen::Matrix3d::Identity(), {}});
    Joint guide = joint_at("G", JointType::prismatic, kGround, "support", {});
    guide.frame.rotation << 1, 0, 0, 0, 0, 1, 0, -1, 0;  // z along the ground's y
    guide.child_frame.rotation = guide.frame.rotation;
    linkage_.joints[0].parent = "support";
    linkage_.joints[0].position = {std::numbers::pi / 2 + kTilt};
    linkage_.joints.push_back(guide);
    linkage_.motions = {motion_of("G", MotionLaw::sine)};
    linkage_.motions[0].amplitude = amplitude;
    linkage_.motions[0].frequency = speed / (2.0 * std::numbers::pi);
    linkage_.motions[0].from = 0.0;
  }

  Samples run_for(double end, double step) const {
    return run(compile(linkage_), steps_of(step, end, 0.01), {"joint.A.q"});
  }

  // Angles from the upright every 0.01 s, by the equation above and steps of Runge-Kutta.
  std::vector<double> by_hand(double end, double step) const {
    std::vector<double> found;
    double p = kTilt, v = 0.0;
    const long steps = std::lround(end / step), stride = std::lround(0.01 / step);
    const auto bend = [&](double t, double x) {
      return (kGravity - amplitude_ * speed_ * speed_ * std::sin(speed_ * t)) * std::sin(x) /
             kLength;
    };
    for (long i = 0; i <= steps; ++i) {
      if (i % stride == 0) found.push_back(p);
      const double t = static_cast<double>(i) * step, h = step;
      const double k1 = bend(t, p), v2 = v + h / 2 * k1, k2 = bend(t + h / 2, p + h / 2 * v);
      const double v3 = v + h / 2 * k2, k3 = bend(t + h / 2, p + h / 2 * v2);
      const double v4 = v + h * k3, k4 = bend(t + h, p + h * v3);
      p += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
      v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return found;
  }

  static constexpr double kLength = 0.2, kTilt = 0.1;

 private:
  double amplitude_, speed_;
  Linkage linkage_;
};

TEST(PrescribedMotion, Of_its_support_holds_a_pendulum_upright) {
  const double speed = 400.0, border = std::sqrt(2.0 * kGravity * Kapitza::kLength) / speed;
  for (const double part : {0.85, 1.15}) {
    SCOPED_TRACE(part);
    const Kapitza kapitza(part * border, speed);
    const Samples s = kapitza.run_for(3.0, 1e-4);
    ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
    const Eigen::VectorXd tilt = s.values.col(0).array() - std::numbers::pi / 2;
    EXPECT_EQ(tilt.cwiseAbs().maxCoeff() < 0.6, part > 1.0);
  }
}

TEST(PrescribedMotion, Of_its_support_moves_a_pendulum_as_its_equation_says) {
  const Kapitza kapitza(0.01, 400.0);
  const Samples s = kapitza.run_for(1.0, 1e-5);
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const std::vector<double> by_hand = kapitza.by_hand(1.0, 1e-5);
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    EXPECT_NEAR(s.values(i, 0) - std::numbers::pi / 2, by_hand[static_cast<std::size_t>(i)], 1e-9);
  }
}

TEST(PrescribedMotion, Is_the_same_by_all_integrators) {
  Linkage linkage = rsrrp();
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.stiffness = {1e5, 1e5, 1e5, 0, 0, 0};
  linkage.motions = {motion_of("A", MotionLaw::speed)};
  linkage.motions[0].speed = 6.0;
  linkage.motions[0].rise = 0.5;
  linkage.loads.clear();
  SimulationOptions options = steps_of(2e-5, 1.0, 0.05);
  const std::vector<std::string> signals = {"joint.A.q", "joint.P.q", "closure.S.force",
                                            "motion.m.effort", "energy.supplied"};
  const Samples rk4 = run(compile(linkage), options, signals);
  for (const Integrator integrator : {Integrator::adaptive, Integrator::stiff}) {
    options.integrator = integrator;
    options.relative_tolerance = 1e-10;
    options.absolute_tolerance = 1e-12;
    const Samples other = run(compile(linkage), options, signals);
    ASSERT_EQ(other.outcome.cause, Cause::ok) << other.outcome.message;
    EXPECT_TRUE(near_absolute(other.values, rk4.values, 2e-5)) << name_of(integrator);
    EXPECT_TRUE(near_absolute(other.values.leftCols(2), rk4.values.leftCols(2), 1e-10));
  }
}

// The closures leave one freedom.
TEST(PrescribedMotion, Of_more_than_the_freedoms_is_refused) {
  Linkage linkage = rsrrp();
  linkage.motions = {motion_of("A", MotionLaw::speed), motion_of("P", MotionLaw::speed)};
  linkage.motions[1].name = "other";
  const Preparation p = prepare(linkage, {});
  EXPECT_EQ(p.cause, Cause::assembly_failed);
  EXPECT_NE(p.message.find("m, other"), std::string::npos) << p.message;
}

// With a replacement joint there is something to give.
TEST(PrescribedMotion, Of_both_ends_of_a_spring_deflects_it) {
  Linkage linkage = rsrrp();
  linkage.loads.clear();
  linkage.gravity.setZero();
  linkage.closures[0].model = ClosureModel::sde;
  linkage.closures[0].sde.start = SdeStart::given;
  linkage.closures[0].sde.stiffness = {1e4, 1e4, 1e4, 0, 0, 0};
  linkage.closures[0].sde.damping = {};
  for (const char* joint : {"A", "P", "Q", "R"}) {
    linkage.motions.push_back(motion_of(joint, MotionLaw::speed));
    linkage.motions.back().name = joint;
  }
  linkage.motions[1].speed = 0.02;  // the slider leaves alone
  const Preparation p = prepare(linkage, steps_of(1e-3, 1.0));
  ASSERT_EQ(p.cause, Cause::ok) << p.message;
  const Samples s = run(p.model, steps_of(1e-3, 1.0), {"closure.S.force", "motion.P.effort"});
  // The gap grows along z by 0.02 m: 200 N on the crank, and on the slider against its motion.
  EXPECT_NEAR(s.values(1, 2), 200.0, 1e-9 * 200.0);
  EXPECT_NEAR(s.values(1, 3), 200.0, 1e-9 * 200.0);
}

}  // namespace linkstudy::testing::prescribed_motion_test

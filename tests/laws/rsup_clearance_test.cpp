// Clearance in a whole linkage: the RSUP of [AugUrb18] beside the same linkage with an ideal joint,
// and its journal beside the geometry of the links that carry it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/laws/normal_contact.h"
#include "tests/mechanisms/loose_slider_crank.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"
#include "tests/support/free_bodies.h"

namespace linkstudy::testing::rsup_clearance_test {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kRadial = 1e-3;   // m
constexpr double kBearing = 5e-3;  // m
constexpr double kHalf = 10e-3;    // half of the bearing's length, m

SimulationOptions located(double tolerance, double end_time, double interval) {
  return adaptive_steps_of(interval, end_time, tolerance);
}

double steel_stiffness() {
  return hertz_stiffness({207e9, 0.3, kBearing}, {207e9, 0.3, kBearing - kRadial});
}

// Where the axis of the journal pierces the plane across the bearing's axis, `offset` along that
// axis from the bearing's middle: distance from the axis, m. From the poses of coupler and yoke.
double distance_off_axis(const Linkage& linkage, const std::vector<LinkMotion>& motions,
                         double offset) {
  const Closure& pin = linkage.closures[0];
  const auto& coupler = motion_of(motions, pin.first.link);
  const auto& yoke = motion_of(motions, pin.second.link);
  const Vector3d a = yoke.R * pin.second.frame.rotation.col(0);
  const Vector3d b = coupler.R * pin.first.frame.rotation.col(0);
  const Vector3d centre = yoke.p + yoke.R * pin.second.frame.position + offset * a;
  const Vector3d g = coupler.p + coupler.R * pin.first.frame.position - centre;
  return (g - (g.dot(a) / b.dot(a)) * b).norm();
}

// Samples of a loose pin: positions, then what the engine says of the contacts.
struct PinSamples {
  Linkage linkage;
  Samples samples;
  int contacts;

  Index rows() const { return samples.values.rows(); }
  double off_axis(Index row, double offset) const {
    const Vector q = samples.values.row(row).head(6), none = Vector::Zero(6);
    return distance_off_axis(linkage, link_motions(linkage, q, none, none), offset);
  }
  // Over all samples and contacts.
  double deepest() const { return samples.values.middleCols(6, contacts).maxCoeff(); }
  double penetration(Index row, int contact) const { return samples.values(row, 6 + contact); }
  double normal(Index row, int contact) const {
    return samples.values(row, 6 + contacts + contact);
  }
  int state(Index row) const { return static_cast<int>(samples.values(row, 6 + 2 * contacts)); }
};

PinSamples run_pin(const Rsup& options, const SimulationOptions& simulation) {
  const Linkage linkage = rsup(options);
  const Model model = compile(linkage);
  return {linkage,
          run(model, simulation,
              {"joint.A.q", "joint.S.q", "joint.P.q", "joint.Q.q", "closure.R.penetration",
               "closure.R.normal_force", "closure.R.contact_state"}),
          *options.clearance == ClearanceKind::planar ? 1 : 2};
}

// The journal is where the links have it, and nothing pushes it that it does not touch.
void expect_journal_inside(const PinSamples& pin, ApproachSpeed approach) {
  const double k = steel_stiffness() / pin.contacts;
  const double damping = contact_damping(ContactLaw::lankarani_nikravesh, 0.9);
  for (Index row = 0; row < pin.rows(); ++row) {
    double out = 0.0;
    for (int c = 0; c < pin.contacts; ++c) {
      const double offset = pin.contacts == 1 ? 0.0 : (c == 0 ? -kHalf : kHalf);
      const double distance = pin.off_axis(row, offset);
      const double depth = pin.penetration(row, c);
      ASSERT_NEAR(depth, std::max(distance - kRadial, 0.0), 1e-13) << row;
      const double elastic = k * std::pow(depth, 1.5);
      // A contact that is no faster than the speed its law divides by loses so much at most.
      const bool bounded = approach == ApproachSpeed::greatest;
      ASSERT_GE(pin.normal(row, c), bounded ? (1.0 - damping) * elastic * (1.0 - 1e-9) : 0.0)
          << row;
      if (bounded || depth == 0.0) {
        ASSERT_LE(pin.normal(row, c), (1.0 + damping) * elastic * (1.0 + 1e-9)) << row;
      }
      out = std::max(out, depth);
    }
    ASSERT_LE(pin.off_axis(row, 0.0), kRadial + out + 1e-15) << row;
  }
}

}  // namespace

// The same mechanism, its loop cut at another joint.
TEST(Rsup, Its_ideal_joints_move_it_as_the_RSRRP_linkage) {
  Linkage other = rsrrp();
  for (Load& load : other.loads) load.course.duration = 2.0;
  const SimulationOptions options = steps_of(1e-4, 2.0, 0.01);
  const std::vector<std::string> signals = {"joint.A.q", "joint.P.q", "joint.A.v", "joint.P.v"};
  const Samples here = run(compile(rsup()), options, signals);
  const Samples there = run(compile(other), options, signals);
  ASSERT_EQ(here.outcome.cause, Cause::ok) << here.outcome.message;
  EXPECT_LT((here.values - there.values).leftCols(2).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT((here.values - there.values).cwiseAbs().maxCoeff(), 1e-7);
  for (Index row = 0; row < here.values.rows(); ++row) {
    const RsrrpPose pose = rsrrp_pose(here.values(row, 0));
    ASSERT_NEAR(here.values(row, 1), pose.d, 1e-9);
  }
  EXPECT_GT(here.values(200, 0), 6.0) << "the crank has turned once";
}

// While crank and coupler keep still, a journal anywhere in its bearing moves the slider by up to
// c_r L / d, 2 c_r at the start. It falls there with the acceleration that the links have without
// each other, so that speeds differ by a root of c_r.
TEST(Rsup, With_clearance_going_to_zero_its_motion_goes_to_that_of_the_ideal_joint) {
  const std::vector<std::string> signals = {"joint.P.q", "joint.P.v"};
  const Samples ideal = run(compile(rsup()), steps_of(1e-4, 1.0, 1e-3), signals);
  const std::array radial = {1e-3, 3e-4, 1e-4, 3e-5, 1e-5};
  std::array<double, 5> way{}, speed{};
  for (std::size_t i = 0; i < radial.size(); ++i) {
    const Rsup options{.clearance = ClearanceKind::planar, .radial = radial[i], .friction = false};
    const Samples loose = run(compile(rsup(options)), located(1e-8, 1.0, 1e-3), signals);
    ASSERT_EQ(loose.outcome.cause, Cause::ok) << loose.outcome.message;
    EXPECT_GT(loose.outcome.contacts, 10);
    const Matrix error = (loose.values - ideal.values).cwiseAbs();
    way[i] = error.col(0).maxCoeff();
    speed[i] = error.col(1).maxCoeff();
    EXPECT_GT(way[i], 1.95 * radial[i]) << radial[i];
    EXPECT_LT(way[i], 2.15 * radial[i]) << radial[i];
    if (i == 0) continue;
    const double step = std::log(radial[i] / radial[i - 1]);
    EXPECT_NEAR(std::log(way[i] / way[i - 1]) / step, 1.0, 0.05) << radial[i];
    EXPECT_NEAR(std::log(speed[i] / speed[i - 1]) / step, 0.5, 0.05) << radial[i];
  }
}

TEST(Rsup, Its_journal_never_leaves_the_bearing_beyond_its_penetration) {
  for (const ClearanceKind kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    for (const double at_speed : {9.0, kFast}) {
      for (const ApproachSpeed approach : {ApproachSpeed::begin, ApproachSpeed::greatest}) {
        const PinSamples pin =
            run_pin({.clearance = kind, .at_speed = at_speed, .approach = approach},
                    located(1e-7, 2.0, 1e-4));
        ASSERT_EQ(pin.samples.outcome.cause, Cause::ok) << pin.samples.outcome.message;
        expect_journal_inside(pin, approach);
        EXPECT_GT(pin.deepest(), 1e-3 * kRadial);
        EXPECT_LT(pin.deepest(), (at_speed == kFast ? 0.1 : 0.05) * kRadial);
      }
    }
  }
}

// Seen from further away: the sphere's centre and the pin are as far apart as the coupler is long,
// give or take the clearance.
TEST(Rsup, A_planar_clearance_lengthens_and_shortens_the_coupler_by_no_more_than_itself) {
  const RsrrpGeometry g;
  const PinSamples pin =
      run_pin({.clearance = ClearanceKind::planar, .at_speed = kFast}, located(1e-7, 2.0, 1e-4));
  double longest = 0.0, shortest = 1.0;
  for (Index row = 0; row < pin.rows(); ++row) {
    const double psi = pin.samples.values(row, 0), d = pin.samples.values(row, 4);
    const Vector3d from_sphere(g.crank * std::sin(psi), -g.pin_drop() - g.crank * std::cos(psi), d);
    const double length = from_sphere.norm() - g.coupler;
    ASSERT_LE(std::abs(length), kRadial + pin.penetration(row, 0) + 1e-9) << row;
    longest = std::max(longest, length);
    shortest = std::min(shortest, length);
  }
  EXPECT_GT(longest, 0.99 * kRadial) << "it uses all of its clearance";
  EXPECT_LT(shortest, -0.99 * kRadial);
}

// Without friction the axes skew freely; when they first touch on both sides is a matter of chance,
// after 1.1 to 2.5 s. A contact that begins or ends between two samples is no
// deeper than the way made in between, and its force no larger than that depth allows.
TEST(Rsup, A_run_passes_through_all_four_states_of_contact_and_forces_are_continuous_there) {
  constexpr double kInterval = 1e-5;  // s
  const PinSamples pin =
      run_pin({.clearance = ClearanceKind::spatial, .friction = false, .at_speed = kFast},
              located(1e-7, 3.0, kInterval));
  ASSERT_EQ(pin.samples.outcome.cause, Cause::ok) << pin.samples.outcome.message;
  std::array<int, 4> seen{};
  int changes = 0;
  double largest = 0.0;
  for (Index row = 1; row < pin.rows(); ++row) {
    ++seen[static_cast<std::size_t>(pin.state(row))];
    if (pin.state(row) == pin.state(row - 1)) continue;
    ++changes;
    for (int c = 0; c < 2; ++c) {
      const bool touches = pin.penetration(row, c) > 0.0, touched = pin.penetration(row - 1, c) > 0;
      if (touches == touched) continue;
      const double offset = c == 0 ? -kHalf : kHalf;
      const double way = std::abs(pin.off_axis(row, offset) - pin.off_axis(row - 1, offset));
      const double jump = std::abs(pin.normal(row, c) - pin.normal(row - 1, c));
      ASSERT_LE(jump, 1.2 * 0.5 * steel_stiffness() * std::pow(way, 1.5)) << row;
      largest = std::max(largest, jump);
    }
  }
  for (int s = 0; s < 4; ++s) EXPECT_GT(seen[static_cast<std::size_t>(s)], 5) << s;
  EXPECT_GT(changes, 100);
  const double most = pin.samples.values.middleCols(8, 2).maxCoeff();
  EXPECT_LT(largest, 0.2 * most) << "jumps are those of sampling, not of the law";
}

// All loads in the plane: the axes stay parallel, whether they must or not. Nothing but its bearing
// keeps the rod in the plane, and impacts multiply what rounding tilts it: later it leaves it.
TEST(LooseSliderCrank, Its_spatial_clearance_moves_it_as_the_planar_one) {
  std::array<Samples, 2> samples;
  for (const ClearanceKind kind : {ClearanceKind::planar, ClearanceKind::spatial}) {
    samples[kind == ClearanceKind::spatial] =
        run(compile(loose_slider_crank(kind, 60.0)), steps_of(2e-6, 0.05, 1e-4),
            {"joint.A.q.0", "joint.P.q", "joint.P.v", "closure.R.force", "closure.R.eccentricity",
             "joint.A.q.1", "joint.B.q.1", "joint.B.q.2"});
  }
  for (const Samples& s : samples) ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  const Matrix& planar = samples[0].values;
  const Matrix error = (planar - samples[1].values).cwiseAbs();
  EXPECT_GT(samples[0].outcome.contacts, 5);
  EXPECT_EQ(samples[1].outcome.contacts, 2 * samples[0].outcome.contacts) << "both ends together";
  EXPECT_GT(planar(500, 0), 1.5) << "a quarter of a turn";
  EXPECT_LT(error.leftCols(2).maxCoeff(), 1e-9);
  EXPECT_LT(error.col(2).maxCoeff(), 1e-6);
  EXPECT_LT(error.middleCols(3, 3).maxCoeff(), 1e-5 * planar.middleCols(3, 3).maxCoeff());
  EXPECT_LT(error.middleCols(6, 2).maxCoeff(), 1e-9);
  for (const Samples& s : samples) EXPECT_LT(s.values.rightCols(3).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace linkstudy::testing::rsup_clearance_test

// Clearance, friction and springs of joints in the engine against the plain transcription of
// [AugUrb18] eqs. (10)-(18) over the trace formulas.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/random.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing::clearance_oracle_test {
namespace {

using Eigen::Vector3d;

constexpr double kNoApproach = std::numeric_limits<double>::infinity();

// RSRRP with a loose pin, its slider moved so that the journal lies off the bearing's centre, its
// axes parallel and everything moving.
Linkage loose_pin(Random& random, bool bearing_is_first, double slider) {
  Linkage linkage = rsrrp_revolute();
  Closure& closure = linkage.closures[0];
  closure.model = ClosureModel::clearance;
  Clearance& c = closure.clearance;
  c.bearing_is_first = bearing_is_first;
  c.radial = 2e-4;
  c.bearing_radius = 5e-3;
  c.restitution = 0.5;
  if (random.below(2) == 0) c.stiffness = 1e8;
  if (random.below(2) == 0) c.exponent = 1.3;
  if (random.below(2) == 0) c.points = ContactPoints::two;
  c.friction = Friction{0.2, 0.1, 0.0175, 600.0, 0.5, 0.1, random.below(2) == 0 ? 0.0 : 0.3};
  for (Joint& joint : linkage.joints) {
    const std::size_t n = joint.position.size();
    if (joint.name == "P") joint.position[0] += slider;
    const auto draw = [&](double size) {
      std::vector<double> x(n);
      for (double& value : x) value = random.within(size);
      return x;
    };
    joint.velocity = draw(1.0);
    joint.stiffness = draw(20.0);
    joint.damping = draw(2.0);
    joint.rest = draw(0.3);
  }
  return linkage;
}

// Start of the linkage := state
void begin_at(Linkage& linkage, const TraceModel& trace, const OracleState& state) {
  for (Joint& joint : linkage.joints) {
    const int first = coordinate_index(trace, joint.name);
    for (std::size_t k = 0; k < joint.position.size(); ++k) {
      joint.position[k] = state.q[first + static_cast<int>(k)];
      joint.velocity[k] = state.v[first + static_cast<int>(k)];
    }
  }
}

}  // namespace

// Outside a run the engine knows no approach speed and takes an infinite one: contacts are elastic
// there. Their loss in a run is held by clearance_test.cpp.
TEST(ClearanceOracle, Forces_and_accelerations_are_those_of_the_transcription) {
  Random random(31);
  int touching = 0;
  for (int k = 0; k < 24; ++k) {
    Linkage linkage = loose_pin(random, k % 2 == 0, k < 2 ? 1e-5 : random.within(1e-3));
    const TraceModel trace = make_trace_model(linkage);
    const OracleState s = closed_state(trace, start_state(trace));
    begin_at(linkage, trace, s);
    const double z = random.within(1e-4);
    const OracleResult oracle = oracle_acceleration(trace, 0.3, s.q, s.v, {{kNoApproach, z}});
    const ContactResult& c = oracle.contacts[0];
    touching += c.touches ? 1 : 0;

    EngineProbe engine(linkage, 0.3);
    State<double> state = engine.state();
    state.z.assign(state.z.size(), z);
    engine.evaluate_at(state);
    const auto map = oracle_coordinates(engine.model().mechanism, trace);
    EXPECT_TRUE(near_relative(engine.qdd(), reordered(oracle.qdd, map), 1e-9));
    if (!c.touches) continue;
    EXPECT_NEAR(engine.at("closure.R.penetration.0"), c.depth, 1e-15);
    EXPECT_NEAR(engine.at("closure.R.normal_force.0") / c.normal, 1.0, 1e-9);
    const Vector3d force = oracle.closures[0].force + c.force;
    EXPECT_TRUE(near_absolute(engine.vector("closure.R.force"), force, 1e-9 * force.norm()));
  }
  EXPECT_GT(touching, 10);
  EXPECT_LT(touching, 23);  // and some are apart
}

}  // namespace linkstudy::testing::clearance_oracle_test

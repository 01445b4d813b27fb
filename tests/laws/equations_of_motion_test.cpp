// The recursive equations of motion against the trace formulas of [Urbas16] on random linkages:
// trees of all joint types in angles and quaternions, closed loops of all closure types.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/mechanisms/random_linkages.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/random.h"
#include "tests/support/trace_formulas.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::equations_of_motion_test {
namespace {

using Eigen::Vector3d;

constexpr double kTime = 0.3;  // within the ramps and tables of the random loads
const std::vector<JointType> kClosureTypes = {
    JointType::spherical,   JointType::revolute, JointType::universal, JointType::prismatic,
    JointType::cylindrical, JointType::planar,   JointType::fixed};

// Closures between the oracle and the engine: forces, torques about the first point, gaps.
void expect_same_closures(const OracleResult& oracle, EngineProbe& engine, double tolerance) {
  for (const ClosureResult& c : oracle.closures) {
    const std::string name = "closure." + c.name;
    const Vector3d p1 = c.point_second - c.gap;
    const Vector3d torque = c.torque + (c.point_first - p1).cross(c.force);
    const double size = 1.0 + c.force.norm() + torque.norm();
    EXPECT_TRUE(near_absolute(engine.vector(name + ".force"), c.force, tolerance * size));
    EXPECT_TRUE(near_absolute(engine.vector(name + ".torque"), torque, tolerance * size));
    EXPECT_TRUE(near_absolute(engine.vector(name + ".gap"), c.gap, 1e-13));
  }
}

void expect_same_motion(const Linkage& linkage, double tolerance) {
  const TraceModel trace = make_trace_model(linkage);
  const OracleResult oracle = oracle_acceleration(trace, kTime, trace.q0, trace.v0);
  EngineProbe engine(linkage, kTime);
  const auto map = oracle_coordinates(engine.model().mechanism, trace);
  EXPECT_TRUE(near_relative(engine.qdd(), reordered(oracle.qdd, map), tolerance));
  expect_same_closures(oracle, engine, tolerance);
}

// Every form, both axes, both tilts; element directions askew.
std::vector<Sde> all_sdes() {
  std::vector<Sde> all;
  for (const SdeForm form :
       {SdeForm::directional, SdeForm::line_of_centres, SdeForm::three_springs}) {
    for (const SdeAxes axes : {SdeAxes::ground, SdeAxes::first}) {
      for (const TiltMeasure tilt : {TiltMeasure::axis, TiltMeasure::linearized}) {
        Sde sde;
        sde.form = form;
        sde.axes = axes;
        sde.tilt = tilt;
        sde.stiffness = {3000, 5000, 7000, 200, 300, 400};
        sde.damping = {30, 50, 70, 2, 3, 4};
        if (form == SdeForm::line_of_centres) {
          for (int d : {kY, kZ}) sde.stiffness[d] = sde.damping[d] = 0.0;
        }
        sde.directions << 1, 0, 0, 0.6, 0.8, 0, 0, 0.6, 0.8;
        all.push_back(sde);
      }
    }
  }
  return all;
}

}  // namespace

// A dozen roundings along paths of seven joints: 1e-12 of the largest entry leaves a decade.
TEST(EquationsOfMotion, Mass_matrix_and_bias_of_random_trees_are_those_of_the_trace_formulas) {
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    RandomTree options;
    options.links = 3 + static_cast<int>(seed % 7);
    const Linkage linkage = random_tree(seed, options);
    const TraceModel trace = make_trace_model(linkage);
    if (trace.dof == 0) continue;
    const auto transforms = link_transforms(trace, trace.q0);
    const TreeEquations tree = tree_equations(trace, transforms, trace.v0);
    const Vector loads = generalised_loads(trace, transforms, kTime, trace.v0);
    const EngineProbe engine(linkage, kTime);
    const auto map = oracle_coordinates(engine.model().mechanism, trace);
    ASSERT_TRUE(near_relative(engine.mass_matrix(), reordered(tree.mass_matrix, map), 1e-12))
        << "seed " << seed;
    ASSERT_TRUE(near_relative(engine.tau(),
                              reordered(Vector(loads - tree.velocity - tree.gravity), map), 1e-12))
        << "seed " << seed;
  }
}

TEST(EquationsOfMotion, Trees_of_a_single_joint_type_match_the_trace_formulas_too) {
  for (int type = 0; type <= static_cast<int>(JointType::screw); ++type) {
    if (static_cast<JointType>(type) == JointType::fixed) continue;
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      RandomTree options;
      options.links = 3;
      options.types = {static_cast<JointType>(type)};
      const Linkage linkage = random_tree(seed, options);
      const TraceModel trace = make_trace_model(linkage);
      const EngineProbe engine(linkage, kTime);
      const auto map = oracle_coordinates(engine.model().mechanism, trace);
      const auto transforms = link_transforms(trace, trace.q0);
      const TreeEquations tree = tree_equations(trace, transforms, trace.v0);
      ASSERT_TRUE(near_relative(engine.mass_matrix(), reordered(tree.mass_matrix, map), 1e-12))
          << "type " << type;
      expect_same_motion(linkage, 1e-9);  // condition of the mass matrix up to 1e3
    }
  }
}

TEST(EquationsOfMotion, A_resistance_has_no_course) {
  Linkage linkage = random_tree(2);
  linkage.loads.clear();
  Load load;
  load.type = LoadType::resistance;
  load.joint = linkage.joints[0].name;
  load.law = {ResistanceShape::linear, 2.0, 1.5};
  linkage.loads = {load};
  const Vector plain = EngineProbe(linkage).tau();
  linkage.loads[0].course = {CourseShape::table, 0.0, 0.0, {0.0, 1.0}, {4.0, 8.0}};
  EXPECT_EQ(EngineProbe(linkage).tau(), plain);
}

// Structure flags skip zeros, ones and quarter turns: linkages whose frames have them.
TEST(EquationsOfMotion, Aligned_and_centred_bodies_lose_no_term) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    Linkage linkage = random_tree(seed);
    Random random(seed);
    const auto quarter = [&] {
      Eigen::Matrix3d R;
      R << 0, 0, 1, 1, 0, 0, 0, 1, 0;
      const int turns = random.below(3);
      return turns == 0   ? Eigen::Matrix3d(Eigen::Matrix3d::Identity())
             : turns == 1 ? R
                          : Eigen::Matrix3d(Eigen::Vector3d(-1, -1, 1).asDiagonal());
    };
    for (Joint& joint : linkage.joints) {
      joint.frame.rotation = quarter();
      joint.frame.position = 0.3 * random.below(2) * Vector3d::Unit(random.below(3));
      joint.child_frame = {};
      if (random.below(3) == 0) joint.child_frame.rotation = quarter();
    }
    for (Link& link : linkage.links) {
      link.center_of_mass = 0.2 * random.below(2) * Vector3d::Unit(random.below(3));
      link.inertia = Vector3d(0.1, random.below(2) ? 0.1 : 0.02, 0.1).asDiagonal();
    }
    SCOPED_TRACE(seed);
    expect_same_motion(linkage, 1e-9);
  }
}

TEST(EquationsOfMotion, Quaternion_joints_move_as_their_angles_do) {
  RandomTree options;
  options.types = {JointType::spherical, JointType::free, JointType::revolute, JointType::prismatic,
                   JointType::fixed};
  options.loads = false;  // a drive on an angle is no drive on an angular velocity
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Linkage angles = random_tree(seed, options);
    const TraceModel trace = make_trace_model(angles);
    if (trace.dof == 0) continue;
    const Linkage linkage = with_quaternions(angles);
    const OracleResult oracle = oracle_acceleration(trace, kTime, trace.q0, trace.v0);
    const QuaternionMotion moved = quaternion_motion(linkage, trace.q0, trace.v0, oracle.qdd);
    const EngineProbe engine(linkage, kTime);
    const auto map = oracle_coordinates(engine.model().mechanism, trace);
    const auto transforms = link_transforms(trace, trace.q0);
    const Matrix M = tree_equations(trace, transforms, trace.v0).mass_matrix;
    const Matrix W = reordered(moved.W, map);
    ASSERT_TRUE(near_relative(engine.qdd(), reordered(moved.a, map), 1e-9)) << "seed " << seed;
    ASSERT_TRUE(near_relative(W.transpose() * engine.mass_matrix() * W, reordered(M, map), 1e-12))
        << "seed " << seed;
  }
}

TEST(EquationsOfMotion, Cut_loops_of_every_type_accelerate_as_the_oracle_says) {
  for (const JointType type : kClosureTypes) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
      SCOPED_TRACE(::testing::Message() << "type " << static_cast<int>(type) << " seed " << seed);
      Linkage linkage = random_closed_linkage(seed, type, ClosureModel::cut);
      expect_same_motion(linkage, 1e-9);  // condition of the bordered system up to 1e4
      shake(linkage, seed, 0.05, 0.5);    // open, sliding apart: no term may vanish
      expect_same_motion(linkage, 1e-9);
      linkage.closures[0].stabilization = Stabilization::baumgarte;
      linkage.closures[0].alpha = 7.0;
      linkage.closures[0].beta = 11.0;
      expect_same_motion(linkage, 1e-9);
    }
  }
}

TEST(EquationsOfMotion, Replaced_loops_of_every_type_and_form_accelerate_as_the_oracle_says) {
  for (const JointType type : kClosureTypes) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      for (const Sde& sde : all_sdes()) {
        SCOPED_TRACE(::testing::Message()
                     << "type " << static_cast<int>(type) << " seed " << seed << " form "
                     << static_cast<int>(sde.form) << " axes " << static_cast<int>(sde.axes));
        Linkage linkage = random_closed_linkage(seed, type, ClosureModel::sde);
        linkage.closures[0].sde = sde;
        shake(linkage, seed, 0.1, 0.5);
        expect_same_motion(linkage, 1e-10);
      }
    }
  }
}

TEST(EquationsOfMotion, A_damping_ratio_becomes_the_same_damping_in_both_routes) {
  for (const JointType type : {JointType::spherical, JointType::revolute, JointType::fixed}) {
    for (Sde sde : all_sdes()) {
      if (sde.form == SdeForm::line_of_centres) continue;  // its mass is that of any direction
      sde.damping = {};
      sde.damping_ratio = 0.7;
      SCOPED_TRACE(static_cast<int>(sde.form));
      expect_same_motion(sde_pair(3, type, sde, 0.0), 1e-10);  // closed, as a prepared start is
    }
  }
}

TEST(EquationsOfMotion, Two_closures_of_different_models_share_a_linkage) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Linkage linkage = random_closed_linkage(seed, JointType::spherical, ClosureModel::cut);
    Closure spring = linkage.closures[0];
    spring.name = "spring";
    spring.model = ClosureModel::sde;
    spring.first.link = kGround;
    linkage.closures.push_back(spring);
    SCOPED_TRACE(seed);
    expect_same_motion(linkage, 1e-9);
    std::swap(linkage.closures[0], linkage.closures[1]);
    expect_same_motion(linkage, 1e-9);
  }
}

}  // namespace linkstudy::testing::equations_of_motion_test

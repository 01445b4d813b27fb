// Channels: names, units, groups, signs and axes; and that no scalar depends on the ground frame.
#include "core/simulation/channels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>

#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"
#include "tests/support/free_bodies.h"
#include "tests/support/near.h"

namespace linkstudy::testing::channels_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::map<std::string, std::string> units_of(const Linkage& linkage) {
  std::map<std::string, std::string> units;
  for (const Channel& c : list_channels(compile(linkage).mechanism)) units[c.name] = c.unit;
  return units;
}

Linkage one_joint(JointType type, RotationCoordinates coordinates = RotationCoordinates::zyx) {
  Linkage linkage;
  linkage.links = {{"body", 1.0, Vector3d::Zero(), Matrix3d::Identity()}};
  Joint joint;
  joint.name = "J";
  joint.type = type;
  joint.coordinates = coordinates;
  joint.parent = kGround;
  joint.child = "body";
  linkage.joints = {joint};
  return linkage;
}

struct Displacement {
  Matrix3d R;
  Vector3d p;
};

void move(Frame& frame, const Displacement& X) {
  frame = {X.R * frame.rotation, X.R * frame.position + X.p};
}

// The whole linkage moved, its weight and ground-fixed loads with it.
Linkage moved(Linkage linkage, const Displacement& X) {
  linkage.gravity = X.R * linkage.gravity;
  for (Joint& joint : linkage.joints)
    if (joint.parent == kGround) move(joint.frame, X);
  for (Closure& c : linkage.closures) {
    if (c.first.link == kGround) move(c.first.frame, X);
    if (c.second.link == kGround) move(c.second.frame, X);
  }
  for (Load& load : linkage.loads)
    if (!load.follows_link) load.direction = X.R * load.direction;
  return linkage;
}

// Any rotation, and a shift square to gravity, so that no weight is lifted.
Displacement displacement(const Linkage& linkage) {
  const Matrix3d R =
      Eigen::AngleAxisd(2.1, Vector3d(0.3, -0.5, 0.8).normalized()).toRotationMatrix();
  const Vector3d g = R * linkage.gravity;
  return {R, 3.0 * g.cross(Vector3d(0.2, 0.9, -0.4)).normalized()};
}

bool in_ground_axes(const std::string& group) {
  for (const char* end : {".force", ".torque", ".gap"}) {
    const std::string suffix = end;
    if (group.size() > suffix.size() &&
        group.compare(group.size() - suffix.size(), suffix.size(), suffix) == 0) {
      return true;
    }
  }
  return false;
}

void expect_frame_invariance(const Linkage& linkage) {
  SCOPED_TRACE(linkage.name);
  const Displacement X = displacement(linkage);
  EngineProbe here(linkage, 0.3), there(moved(linkage, X), 0.3);
  const std::vector<Channel> all = list_channels(here.model().mechanism);
  for (const std::string& group : signal_names(all)) {
    if (in_ground_axes(group)) {
      const Vector3d expected = X.R * here.vector(group);
      EXPECT_TRUE(near_absolute(there.vector(group), expected, 1e-9 * (1 + expected.norm())))
          << group;
      continue;
    }
    for (const Channel& c : find_channels(all, group)) {
      const double expected = here.at(c.name);
      EXPECT_NEAR(there.at(c.name), expected, 1e-9 * (1 + std::abs(expected))) << c.name;
    }
  }
}

}  // namespace

TEST(Channels, Names_and_units_of_a_linkage_with_a_closure) {
  const auto units = units_of(rsrrp());
  const std::map<std::string, std::string> some = {{"time", "s"},
                                                   {"joint.A.q", "rad"},
                                                   {"joint.A.v", "rad/s"},
                                                   {"joint.A.a", "rad/s^2"},
                                                   {"joint.P.q", "m"},
                                                   {"joint.P.v", "m/s"},
                                                   {"joint.P.a", "m/s^2"},
                                                   {"joint.R.force.x", "N"},
                                                   {"joint.R.torque.z", "N m"},
                                                   {"joint.R.force_local.y", "N"},
                                                   {"joint.R.torque_local.x", "N m"},
                                                   {"closure.S.force.x", "N"},
                                                   {"closure.S.torque.y", "N m"},
                                                   {"closure.S.gap.z", "m"},
                                                   {"energy.kinetic", "J"},
                                                   {"energy.potential", "J"},
                                                   {"energy.supplied", "J"},
                                                   {"energy.dissipated", "J"},
                                                   {"energy.residual", "J"}};
  for (const auto& [name, unit] : some) {
    ASSERT_TRUE(units.contains(name)) << name;
    EXPECT_EQ(units.at(name), unit) << name;
  }
  EXPECT_EQ(units.size(), 1u + 4 * (3 + 12) + 9 + 5);
  EXPECT_EQ(list_channels(compile(rsrrp()).mechanism).front().name, "time");
}

TEST(Channels, Joints_with_several_coordinates_number_them) {
  const auto cylindrical = units_of(one_joint(JointType::cylindrical));
  EXPECT_EQ(cylindrical.at("joint.J.q.0"), "rad");
  EXPECT_EQ(cylindrical.at("joint.J.q.1"), "m");
  EXPECT_EQ(cylindrical.at("joint.J.v.1"), "m/s");
  EXPECT_FALSE(cylindrical.contains("joint.J.q"));
  const auto planar = units_of(one_joint(JointType::planar));
  EXPECT_EQ(planar.at("joint.J.q.0"), "m");
  EXPECT_EQ(planar.at("joint.J.q.2"), "rad");
  EXPECT_EQ(units_of(one_joint(JointType::screw)).at("joint.J.q"), "rad");
  EXPECT_FALSE(units_of(one_joint(JointType::fixed)).contains("joint.J.q"));
}

TEST(Channels, Quaternions_have_four_pure_numbers_and_three_angular_velocities) {
  const auto ball = units_of(one_joint(JointType::spherical, RotationCoordinates::quaternion));
  EXPECT_EQ(ball.at("joint.J.q.0"), "");
  EXPECT_EQ(ball.at("joint.J.q.3"), "");
  EXPECT_EQ(ball.at("joint.J.v.2"), "rad/s");
  EXPECT_FALSE(ball.contains("joint.J.v.3"));
  const auto free = units_of(one_joint(JointType::free, RotationCoordinates::quaternion));
  EXPECT_EQ(free.at("joint.J.q.2"), "m");
  EXPECT_EQ(free.at("joint.J.q.6"), "");
  EXPECT_EQ(free.at("joint.J.v.2"), "m/s");
  EXPECT_EQ(free.at("joint.J.a.5"), "rad/s^2");
}

TEST(Channels, A_group_is_its_members_and_an_unknown_name_is_nothing) {
  const auto all = list_channels(compile(rsrrp()).mechanism);
  const auto force = find_channels(all, "closure.S.force");
  ASSERT_EQ(force.size(), 3u);
  EXPECT_EQ(force[0].name, "closure.S.force.x");
  EXPECT_EQ(force[2].name, "closure.S.force.z");
  EXPECT_EQ(find_channels(all, "joint.R.force_local").size(), 3u);
  EXPECT_EQ(find_channels(all, "joint.A.q").size(), 1u);
  EXPECT_TRUE(find_channels(all, "closure.T.force").empty());
  EXPECT_TRUE(find_channels(all, "closure.S").empty());
  EXPECT_TRUE(find_channels(all, "").empty());
  EXPECT_THAT(signal_names(all), ::testing::Contains("closure.S.force"));
}

TEST(Channels, The_closure_force_acts_on_the_first_chain_and_swaps_with_the_ends) {
  Linkage swapped = rsrrp();
  std::swap(swapped.closures[0].first, swapped.closures[0].second);
  EngineProbe one(rsrrp()), other(swapped);
  const Vector3d f = one.vector("closure.S.force");
  EXPECT_GT(f.norm(), 1.0);
  EXPECT_TRUE(near_absolute(other.vector("closure.S.force"), -f, 1e-11 * f.norm()));
  // The crank hangs on A and S only: f balances what A does not carry.
  const Vector3d a_C(-0.05 * one.at("joint.A.a"), 0, 0);
  const Vector3d expected = 1.0 * (a_C - Vector3d(0, -9.81, 0)) - one.vector("joint.A.force");
  EXPECT_TRUE(near_absolute(f, expected, 1e-11 * f.norm()));
}

TEST(Channels, Local_reactions_are_those_of_the_ground_in_the_childs_joint_frame) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomTree options;
    options.types = {JointType::revolute, JointType::universal, JointType::planar};
    options.shuffled = false;  // joints in tree order, as link_motions wants them
    const Linkage linkage = random_tree(seed, options);
    EngineProbe engine(linkage);
    const State<double>& s = engine.state();
    const auto n = static_cast<Eigen::Index>(s.q.size());
    const auto motions = link_motions(linkage, Eigen::Map<const Vector>(s.q.data(), n),
                                      Vector::Zero(n), Vector::Zero(n));
    for (const Joint& joint : linkage.joints) {
      const Matrix3d R = motion_of(motions, joint.child).R * joint.child_frame.rotation;
      const std::string name = "joint." + joint.name;
      for (const char* part : {".force", ".torque"}) {
        const Vector3d ground = engine.vector(name + part);
        EXPECT_TRUE(near_absolute(engine.vector(name + part + "_local"), R.transpose() * ground,
                                  1e-11 * (1 + ground.norm())))
            << name;
      }
    }
  }
}

TEST(Channels, A_linkage_moved_as_a_whole_changes_no_scalar_and_turns_its_vectors) {
  for (std::uint64_t seed = 0; seed < 15; ++seed) {
    expect_frame_invariance(random_tree(seed));
    expect_frame_invariance(random_closed_linkage(seed, JointType::spherical, ClosureModel::cut));
    expect_frame_invariance(random_closed_linkage(seed, JointType::cylindrical, ClosureModel::cut));
    Linkage sde = random_closed_linkage(seed, JointType::revolute, ClosureModel::sde);
    sde.closures[0].sde.axes = SdeAxes::first;  // ground axes would not turn with the linkage
    shake(sde, seed, 0.1, 0.5);
    expect_frame_invariance(sde);
  }
  expect_frame_invariance(rsrrp());
}

}  // namespace linkstudy::testing::channels_test

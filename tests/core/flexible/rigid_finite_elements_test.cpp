// Flexible links as chains of elements: who is joined to whom, and that at zero angles nothing is
// changed: poses, mass matrix and forces of random trees against those with rigid links.
#include "core/flexible/rigid_finite_elements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/topology/check_linkage.h"
#include "tests/mechanisms/cantilever.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"
#include "tests/support/random.h"
#include "tests/support/trace_kinematics.h"

namespace linkstudy::testing::rigid_finite_elements_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using ::testing::ElementsAre;

std::vector<std::string> connections(const Linkage& linkage) {
  std::vector<std::string> result;
  for (const Joint& joint : linkage.joints) {
    result.push_back(joint.name + ": " + joint.parent + " " + joint.child);
  }
  return result;
}

const Joint& joint_named(const Linkage& linkage, const std::string& name) {
  return *std::find_if(linkage.joints.begin(), linkage.joints.end(),
                       [&](const Joint& joint) { return joint.name == name; });
}

// Element of the expanded beam of length 1 at whose span a load and a chosen point at x end up.
std::string element_at(int segments, double x) {
  BeamData data;
  data.length = 1.0;
  Linkage linkage = cantilever(data, segments);
  Load load;
  load.name = "load";
  load.type = LoadType::link_force;
  load.link = "beam";
  load.point = Vector3d(x, 0.3, -2.0);  // off the axis: its projection counts
  linkage.loads = {load};
  linkage.points = {{"point", "beam", load.point}, {"still", kGround, load.point}};
  const Linkage expanded = expand_flexible_links(linkage);
  EXPECT_EQ(expanded.points[0].link, expanded.loads[0].link);
  EXPECT_EQ(expanded.points[1].link, kGround);
  return expanded.loads[0].link;
}

// Every link of a random tree a flexible beam somewhere in it, with inertia of its section as a
// uniform beam has it: about the axis the sum of those across beyond a thin rod.
Linkage tree_of_beams(std::uint64_t seed) {
  Linkage linkage = random_tree(seed);
  Random random(seed + 100);
  for (Link& link : linkage.links) {
    BeamData data;
    data.length = 0.6 + random.within(0.4);
    data.mass = 1.0 + random.within(0.5);
    const BeamPlace place{random.vector(3, 0.5), random.vector(3, 1.0), random.vector(3, 1.0)};
    Link beam = beam_link(link.name, data, 1 + random.below(6), place);
    const Vector3d across = (place.along.cross(place.across)).normalized();
    const Vector3d along = place.along.normalized();
    beam.inertia += 0.02 * (across * across.transpose() + along * along.transpose()) +
                    0.5 * data.axial * (Matrix3d::Identity() - along * along.transpose());
    link = beam;
  }
  return linkage;
}

Linkage rigid(Linkage linkage) {
  for (Link& link : linkage.links) link.flexible.reset();
  return linkage;
}

// Velocities of the joints of `model` in the order of those of `of`, which are among them.
std::vector<int> velocities_of(const Mechanism& of, const Mechanism& model) {
  std::vector<int> map;
  for (std::size_t b = 1; b < of.bodies.size(); ++b) {
    const auto at =
        std::find(model.joint_names.begin(), model.joint_names.end(), of.joint_names[BodyIndex(b)]);
    const BodyIndex body(at - model.joint_names.begin());
    for (int k = 0; k < of.bodies[BodyIndex(b)].v_count; ++k)
      map.push_back(model.bodies[body].v_begin.value() + k);
  }
  return map;
}

}  // namespace

TEST(Expansion, A_beam_held_at_its_begin_grows_towards_its_end) {
  const Linkage linkage = expand_flexible_links(cantilever({}, 3));
  EXPECT_THAT(connections(linkage),
              ElementsAre("wall: ground beam_rfe0", "beam_sde1: beam_rfe0 beam_rfe1",
                          "beam_sde2: beam_rfe1 beam_rfe2", "beam_sde3: beam_rfe2 beam_rfe3"));
  ASSERT_EQ(linkage.links.size(), 4u);
  EXPECT_EQ(linkage.links[3].name, "beam_rfe3");
}

TEST(Expansion, A_beam_held_elsewhere_grows_both_ways) {
  EXPECT_THAT(connections(expand_flexible_links(cantilever({}, 2, 0.8))),
              ElementsAre("wall: ground beam_rfe2", "beam_sde2: beam_rfe2 beam_rfe1",
                          "beam_sde1: beam_rfe1 beam_rfe0"));
  EXPECT_THAT(connections(expand_flexible_links(cantilever({}, 4, 0.4))),
              ElementsAre("wall: ground beam_rfe2", "beam_sde3: beam_rfe2 beam_rfe3",
                          "beam_sde4: beam_rfe3 beam_rfe4", "beam_sde2: beam_rfe2 beam_rfe1",
                          "beam_sde1: beam_rfe1 beam_rfe0"));
}

TEST(Expansion, Springs_stand_in_the_middles_of_equal_segments_with_the_document_s_numbers) {
  BeamData data;
  data.retardation = 3e-4;
  for (const double wall : {0.0, 0.8}) {  // the same whichever way the tree grows
    const Linkage linkage = expand_flexible_links(cantilever(data, 4, wall));
    for (int k = 1; k <= 4; ++k) {
      const Joint& sde = joint_named(linkage, "beam_sde" + std::to_string(k));
      EXPECT_EQ(sde.type, JointType::spherical);
      EXPECT_EQ(sde.coordinates, RotationCoordinates::zyx);
      EXPECT_NEAR(sde.frame.position.x(), (k - 0.5) * 0.2, 1e-15);
      EXPECT_TRUE(near_absolute(sde.frame.rotation, Matrix3d::Identity(), 0.0));
      const Vector3d c(data.bending_z() / 0.2, data.bending_y() / 0.2, data.torsion() / 0.2);
      EXPECT_TRUE(near_relative(Vector3d(sde.stiffness.data()), c, 1e-14));
      EXPECT_TRUE(near_relative(Vector3d(sde.damping.data()), 3e-4 * c, 1e-14));
      EXPECT_THAT(sde.rest, ElementsAre(0.0, 0.0, 0.0));
    }
  }
}

TEST(Expansion, The_first_and_the_last_element_have_half_length_and_half_mass) {
  BeamData data;
  const Linkage linkage = expand_flexible_links(cantilever(data, 4));
  for (std::size_t k = 0; k <= 4; ++k) {
    const bool outer = k == 0 || k == 4;
    EXPECT_NEAR(linkage.links[k].mass, data.mass / (outer ? 8 : 4), 1e-15);
    const double middle = k == 0 ? 0.05 : k == 4 ? 0.75 : 0.2 * static_cast<double>(k);
    EXPECT_NEAR(linkage.links[k].center_of_mass.x(), middle, 1e-15);
  }
}

TEST(Expansion, What_is_attached_goes_to_the_element_of_its_span) {
  EXPECT_EQ(element_at(4, 0.0), "beam_rfe0");
  EXPECT_EQ(element_at(4, 0.124), "beam_rfe0");
  EXPECT_EQ(element_at(4, 0.126), "beam_rfe1");
  EXPECT_EQ(element_at(4, 0.5), "beam_rfe2");
  EXPECT_EQ(element_at(4, 0.874), "beam_rfe3");
  EXPECT_EQ(element_at(4, 0.876), "beam_rfe4");
  EXPECT_EQ(element_at(4, 1.0), "beam_rfe4");
  EXPECT_EQ(element_at(4, -7.0), "beam_rfe0");
  EXPECT_EQ(element_at(4, 9.0), "beam_rfe4");
}

TEST(Expansion, The_shape_of_a_link_is_with_the_element_of_its_own_joint) {
  Linkage described = cantilever({}, 4, 0.4);
  described.links[0].shape.push_back({.diameter = 0.02, .frame = {}});
  for (const Link& link : expand_flexible_links(described).links) {
    EXPECT_EQ(link.shape == described.links[0].shape, link.name == "beam_rfe2") << link.name;
    EXPECT_EQ(link.shape.empty(), link.name != "beam_rfe2") << link.name;
  }
}

TEST(Expansion, Where_two_spans_meet_rounding_does_not_choose) {
  for (int n = 1; n <= 60; ++n) {
    for (int k = 1; k <= n; ++k) {
      const double meeting = (k - 0.5) / n;
      for (const double x : {meeting, std::nextafter(meeting, 0.0), std::nextafter(meeting, 1.0)}) {
        ASSERT_EQ(element_at(n, x), "beam_rfe" + std::to_string(k)) << n;
      }
    }
  }
}

TEST(Expansion, Joints_closures_and_loads_find_their_elements_and_keep_their_frames) {
  Linkage linkage = cantilever({}, 2);
  linkage.links.push_back(rigid(linkage).links[0]);
  linkage.links[1].name = "arm";
  Joint hinge = linkage.joints[0];
  hinge.name = "hinge";
  hinge.type = JointType::revolute;
  hinge.parent = "beam";
  hinge.child = "arm";
  hinge.frame.position = Vector3d(0.41, 0, 0);
  linkage.joints.insert(linkage.joints.begin(), hinge);
  Closure closure;
  closure.name = "end";
  closure.first = {kGround, {Matrix3d::Identity(), Vector3d(0.9, 0, 0)}};
  closure.second = {"beam", {Matrix3d::Identity(), Vector3d(0.8, 0.1, 0)}};
  linkage.closures = {closure};
  Load torque;
  torque.name = "torque";
  torque.type = LoadType::link_torque;
  torque.course.shape = CourseShape::constant;
  torque.link = "beam";
  torque.point = Vector3d(0.7, 0, 0);
  Load other = torque;
  other.name = "other";
  other.link = "arm";
  linkage.loads = {torque, other};
  const Linkage expanded = expand_flexible_links(linkage);
  EXPECT_TRUE(check(expanded).empty());
  EXPECT_EQ(joint_named(expanded, "hinge").parent, "beam_rfe1");
  EXPECT_EQ(joint_named(expanded, "hinge").child, "arm");
  EXPECT_EQ(joint_named(expanded, "hinge").frame.position, hinge.frame.position);
  EXPECT_EQ(expanded.closures[0].first.link, kGround);
  EXPECT_EQ(expanded.closures[0].second.link, "beam_rfe2");
  EXPECT_EQ(expanded.closures[0].second.frame.position, closure.second.frame.position);
  EXPECT_EQ(expanded.loads[0].link, "beam_rfe2");
  EXPECT_EQ(expanded.loads[1].link, "arm");
}

TEST(Expansion, Rigid_links_stay_as_they_are) {
  const Linkage linkage = rigid(tree_of_beams(1));
  const Linkage expanded = expand_flexible_links(linkage);
  EXPECT_EQ(connections(expanded), connections(linkage));
  EXPECT_EQ(expanded.links.size(), linkage.links.size());
}

TEST(Expansion, A_tree_of_beams_is_a_tree_again) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Linkage linkage = tree_of_beams(seed);
    ASSERT_TRUE(check(linkage).empty()) << check(linkage)[0].message;
    const Linkage expanded = expand_flexible_links(linkage);
    EXPECT_TRUE(check(expanded).empty()) << check(expanded)[0].message;
    EXPECT_GT(expanded.links.size(), linkage.links.size() + 7);
  }
}

TEST(Expansion, At_zero_angles_every_element_stands_where_its_rigid_link_does) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Linkage linkage = tree_of_beams(seed);
    const TraceModel whole = make_trace_model(rigid(linkage));
    const TraceModel divided = make_trace_model(expand_flexible_links(linkage));
    const auto poses = link_transforms(whole, whole.q0);
    const auto elements = link_transforms(divided, divided.q0);
    for (std::size_t i = 0; i < divided.links.size(); ++i) {
      const std::string& name = divided.links[i].name;
      const int link = link_index(whole, name.substr(0, name.find("_rfe")));
      EXPECT_TRUE(near_absolute(elements[i].T, poses[static_cast<std::size_t>(link)].T, 1e-13))
          << name;
    }
  }
}

TEST(Expansion, Mass_centre_and_inertia_of_the_link_are_kept) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    for (const Link& link : tree_of_beams(seed).links) {
      Linkage alone = cantilever({}, 1);
      alone.links = {link};
      alone.joints[0].child = link.name;
      double mass = 0.0;
      Vector3d moment = Vector3d::Zero();
      Matrix3d inertia = Matrix3d::Zero();  // about the link's centre
      for (const Link& element : expand_flexible_links(alone).links) {
        const Vector3d r = element.center_of_mass - link.center_of_mass;
        mass += element.mass;
        moment += element.mass * r;
        inertia += element.inertia +
                   element.mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
      }
      EXPECT_NEAR(mass, link.mass, 1e-14);
      EXPECT_LT(moment.norm(), 1e-15);
      EXPECT_TRUE(near_relative(inertia, link.inertia, 1e-14));
    }
  }
}

TEST(Expansion, Mass_matrix_and_forces_on_the_joints_of_rigid_links_are_kept) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Linkage linkage = tree_of_beams(seed);
    EngineProbe whole(rigid(linkage), 0.7);
    EngineProbe divided(expand_flexible_links(linkage), 0.7);
    const std::vector<int> map = velocities_of(whole.model().mechanism, divided.model().mechanism);
    EXPECT_GT(divided.mass_matrix().rows(), whole.mass_matrix().rows());
    EXPECT_TRUE(near_relative(reordered(divided.mass_matrix(), map), whole.mass_matrix(), 1e-12));
    EXPECT_TRUE(near_relative(reordered(divided.tau(), map), whole.tau(), 1e-11));
  }
}

TEST(RigidFiniteElements, Begin_bent_and_moving_as_they_are_told) {
  Linkage linkage = cantilever({}, 2);
  FlexibleBeam& beam = *linkage.links[0].flexible;
  beam.position = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
  beam.velocity = {1, 2, 3, 4, 5, 6};
  ASSERT_TRUE(check(linkage).empty());
  const Linkage expanded = expand_flexible_links(linkage);
  EXPECT_THAT(joint_named(expanded, "beam_sde1").position, ElementsAre(0.1, 0.2, 0.3));
  EXPECT_THAT(joint_named(expanded, "beam_sde2").position, ElementsAre(0.4, 0.5, 0.6));
  EXPECT_THAT(joint_named(expanded, "beam_sde1").velocity, ElementsAre(1, 2, 3));
  EXPECT_THAT(joint_named(expanded, "beam_sde2").velocity, ElementsAre(4, 5, 6));
  beam.segments = 3;
  ASSERT_EQ(check(linkage).size(), 2u);
  EXPECT_EQ(check(linkage)[0].path, "link.beam.flexible.initial.position");
  EXPECT_EQ(check(linkage)[1].path, "link.beam.flexible.initial.velocity");
}

}  // namespace linkstudy::testing::rigid_finite_elements_test

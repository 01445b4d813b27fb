// Reactions in the tree joints: recursive Newton-Euler against one dense system of free bodies, and
// the principle of virtual power.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/random_linkages.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"
#include "tests/support/engine_probe.h"
#include "tests/support/free_bodies.h"
#include "tests/support/near.h"
#include "tests/support/trace_formulas.h"
#include "tests/support/zyx_equivalent.h"

namespace linkstudy::testing::reactions_test {
namespace {

using Eigen::Vector3d;

constexpr double kTime = 0.3;

// State and accelerations of the engine in the order of tree_order, as free_bodies wants them.
struct FreeBodyInput {
  Vector q, v, a;
};
FreeBodyInput tree_ordered(const Linkage& linkage, const EngineProbe& engine) {
  const Mechanism& m = engine.model().mechanism;
  const State<double>& s = engine.state();
  const Vector qdd = engine.qdd();
  FreeBodyInput in{Vector(m.nq), Vector(m.nv), Vector(m.nv)};
  int q = 0, v = 0;
  for (const int j : tree_order(linkage)) {
    const std::string& name = linkage.joints[static_cast<std::size_t>(j)].name;
    const auto at = std::find(m.joint_names.begin(), m.joint_names.end(), name);
    const Body& b = m.bodies[BodyIndex(at - m.joint_names.begin())];
    for (int k = 0; k < b.q_count; ++k) in.q[q++] = s.q[b.q_begin + k];
    for (int k = 0; k < b.v_count; ++k, ++v) {
      in.v[v] = s.v[b.v_begin + k];
      in.a[v] = qdd[b.v_begin.value() + k];
    }
  }
  return in;
}

// Position of a closure's end in ground axes.
Vector3d closure_point(const std::vector<LinkMotion>& motions, const ClosureEnd& end) {
  if (end.link == kGround) return end.frame.position;
  return point_motion(motion_of(motions, end.link), end.frame.position).p;
}

// Loads and closure wrenches on the links, the latter from the engine's channels: force and torque
// at the first point. Their opposite acts on the second link: at the second point where the element
// stands in ground axes (the ground takes the couple of a stretched one), else at the first.
std::vector<ExternalWrench> all_wrenches(const Linkage& linkage,
                                         const std::vector<LinkMotion>& motions,
                                         EngineProbe& engine) {
  std::vector<ExternalWrench> wrenches = load_wrenches(linkage, motions, kTime);
  for (const Closure& c : linkage.closures) {
    const bool in_ground = c.model == ClosureModel::sde && c.sde.axes == SdeAxes::ground;
    const Vector3d p = closure_point(motions, c.first);
    const Vector3d p_second = in_ground ? closure_point(motions, c.second) : p;
    const Vector3d f = engine.vector("closure." + c.name + ".force");
    const Vector3d n = engine.vector("closure." + c.name + ".torque");
    if (c.first.link != kGround) wrenches.push_back({c.first.link, p, f, n});
    if (c.second.link != kGround) wrenches.push_back({c.second.link, p_second, -f, -n});
  }
  return wrenches;
}

void expect_reactions_of_free_bodies(const Linkage& linkage) {
  SCOPED_TRACE(linkage.name);
  EngineProbe engine(linkage, kTime);
  const FreeBodyInput in = tree_ordered(linkage, engine);
  const auto motions = link_motions(linkage, in.q, in.v, in.a);
  const Reactions reactions =
      joint_reactions(linkage, motions, all_wrenches(linkage, motions, engine));
  double size = 1.0;
  for (const JointReaction& r : reactions.joints) {
    size = std::max({size, r.force.norm(), r.torque.norm()});
  }
  for (const JointReaction& r : reactions.joints) {
    const std::string name = "joint." + r.joint;
    // Both routes carry each wrench over a handful of links.
    EXPECT_TRUE(near_absolute(engine.vector(name + ".force"), r.force, 1e-11 * size)) << name;
    EXPECT_TRUE(near_absolute(engine.vector(name + ".torque"), r.torque, 1e-11 * size)) << name;
  }
}

// Power of a joint's reaction at a velocity field: child less parent.
double reaction_power(const Joint& joint, EngineProbe& engine,
                      const std::vector<LinkMotion>& field) {
  const Vector3d f = engine.vector("joint." + joint.name + ".force");
  const Vector3d n = engine.vector("joint." + joint.name + ".torque");
  const LinkMotion& child = motion_of(field, joint.child);
  const PointMotion origin = point_motion(child, joint.child_frame.position);
  double power = f.dot(origin.v) + n.dot(child.omega);
  if (joint.parent == kGround) return power;
  const LinkMotion& parent = motion_of(field, joint.parent);
  return power - f.dot(parent.v + parent.omega.cross(origin.p - parent.p)) - n.dot(parent.omega);
}

// Drives less resistances at every coordinate of the tree.
Vector joint_loads(const Linkage& linkage) {
  TraceModel trace = make_trace_model(linkage);
  std::erase_if(trace.loads, [](const TraceLoad& load) {
    return load.load.type == LoadType::link_force || load.load.type == LoadType::link_torque;
  });
  return generalised_loads(trace, link_transforms(trace, trace.q0), kTime, trace.v0);
}

void expect_no_work_beyond_loads(const Linkage& linkage) {
  EngineProbe engine(linkage, kTime);
  const TraceModel trace = make_trace_model(linkage);
  const Vector expected = joint_loads(linkage);
  for (const Joint& joint : linkage.joints) {
    const int first = coordinate_index(trace, joint.name);
    const double size = 1.0 + engine.vector("joint." + joint.name + ".force").norm() +
                        engine.vector("joint." + joint.name + ".torque").norm();
    for (int k = 0; k < velocity_count(joint.type); ++k) {
      const Vector e = Vector::Unit(trace.dof, first + k);
      const auto field = link_motions(linkage, trace.q0, e, 0.0 * e);
      EXPECT_NEAR(reaction_power(joint, engine, field), expected[first + k], 1e-10 * size)
          << linkage.name << " " << joint.name;
    }
  }
}

const std::vector<JointType> kClosureTypes = {
    JointType::spherical,   JointType::revolute, JointType::universal, JointType::prismatic,
    JointType::cylindrical, JointType::planar,   JointType::fixed};

}  // namespace

TEST(Reactions, Trees_react_as_free_bodies_demand) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    expect_reactions_of_free_bodies(random_tree(seed));
  }
}

TEST(Reactions, Trees_with_quaternions_react_as_free_bodies_demand) {
  RandomTree options;
  options.loads = false;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    expect_reactions_of_free_bodies(with_quaternions(random_tree(seed, options)));
  }
}

TEST(Reactions, Closed_linkages_react_as_free_bodies_demand) {
  for (const JointType type : kClosureTypes) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      Linkage cut = random_closed_linkage(seed, type, ClosureModel::cut);
      Linkage sde = random_closed_linkage(seed, type, ClosureModel::sde);
      shake(sde, seed, 0.1, 0.5);  // stretched
      sde.closures[0].sde.axes = seed % 2 == 0 ? SdeAxes::first : SdeAxes::ground;
      expect_reactions_of_free_bodies(cut);
      expect_reactions_of_free_bodies(sde);
    }
  }
}

TEST(Reactions, Named_mechanisms_react_as_free_bodies_demand) {
  for (const Linkage& linkage : {rsrrp(), rsrrp_revolute(), four_bar(), spatial_slider_crank(),
                                 spatial_slider_crank_cut_at_universal()}) {
    expect_reactions_of_free_bodies(linkage);
  }
}

TEST(Reactions, Reactions_do_no_work_beyond_drives_and_resistances) {
  for (std::uint64_t seed = 0; seed < 30; ++seed) expect_no_work_beyond_loads(random_tree(seed));
  for (const JointType type : kClosureTypes) {
    for (const ClosureModel model : {ClosureModel::cut, ClosureModel::sde}) {
      expect_no_work_beyond_loads(random_closed_linkage(3, type, model));
    }
  }
}

// A pendulum at rest in the horizontal, by hand: alpha = g / L, all weight but m (g - alpha L) = 0
// carried by the rod's fall; hanging at speed w: m (g + w^2 L).
TEST(Reactions, A_pendulum_pulls_with_weight_and_centrifugal_force) {
  Linkage linkage;
  linkage.gravity = Vector3d(0, -9.81, 0);
  linkage.links = {{"bob", 2.0, Vector3d(0.5, 0, 0), Eigen::Matrix3d::Zero()}};
  Joint joint;
  joint.name = "A";
  joint.parent = kGround;
  joint.child = "bob";
  joint.position = {-M_PI / 2};
  joint.velocity = {3.0};
  linkage.joints = {joint};
  EngineProbe engine(linkage);
  EXPECT_TRUE(near_absolute(engine.vector("joint.A.force"),
                            Vector3d(0, 2.0 * (9.81 + 9.0 * 0.5), 0), 1e-13));
  EXPECT_TRUE(near_absolute(engine.vector("joint.A.torque"), Vector3d::Zero(), 1e-13));
  // Local x points down the rod: the pull is towards the pivot.
  EXPECT_TRUE(near_absolute(engine.vector("joint.A.force_local"),
                            Vector3d(-2.0 * (9.81 + 9.0 * 0.5), 0, 0), 1e-13));
}

}  // namespace linkstudy::testing::reactions_test

// Which joints can bear against each other: blocks of the graph of links and joints.
#include "core/model/loop_joints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/flexible/rigid_finite_elements.h"
#include "core/model/compile.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/placed_linkage.h"

namespace linkstudy::testing::loop_joints_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

Mechanism with_loop_joints(const Linkage& linkage) {
  Mechanism m = compile(linkage).mechanism;
  add_loop_joints(linkage, m);
  return m;
}

std::string name_of(const Mechanism& m, const LoopJoint& joint) {
  return joint.body.exists() ? m.joint_names[joint.body] : m.closure_names[joint.closure];
}

// Names by group, sorted by the first.
std::vector<std::vector<std::string>> groups_of(const Linkage& linkage) {
  const Mechanism m = with_loop_joints(linkage);
  std::map<int, std::vector<std::string>> groups;
  for (const LoopJoint& joint : m.loop_joints) groups[joint.group].push_back(name_of(m, joint));
  std::vector<std::vector<std::string>> names;
  for (auto& [group, joints] : groups) names.push_back(std::move(joints));
  return names;
}

Linkage two_bars_and_a_pendulum() {
  const JointPlace o{{0, 0, 0}}, b{{0, 1, 0}}, c{{1, 1, 0}}, d{{1, 0, 0}};
  using enum JointType;
  return PlacedLinkage("two")
      .add("A", revolute, kGround, "a", o)
      .add("B", revolute, "a", "b", b)
      .add("D", revolute, kGround, "d", d)
      .close("C", revolute, "b", "d", c)
      .add("P", revolute, "d", "p", c)
      .add("E", revolute, kGround, "e", d)
      .add("F", revolute, "e", "f", c)
      .close("G", revolute, "f", kGround, c)
      .linkage();
}

}  // namespace

TEST(LoopJoints, Loops_that_share_only_a_link_are_apart_and_a_pendulum_is_on_none) {
  EXPECT_THAT(groups_of(two_bars_and_a_pendulum()),
              UnorderedElementsAre(UnorderedElementsAre("A", "B", "C", "D"),
                                   UnorderedElementsAre("E", "F", "G")));
}

TEST(LoopJoints, Loops_that_share_a_joint_are_one_group) {
  Linkage linkage = two_bars_and_a_pendulum();
  linkage.closures[1].second.link = "a";  // from f to the first crank, beside A
  EXPECT_THAT(groups_of(linkage),
              ElementsAre(UnorderedElementsAre("A", "B", "C", "D", "E", "F", "G")));
}

TEST(LoopJoints, A_replacement_joint_and_a_free_joint_make_no_loop) {
  Linkage soft = four_bar();
  soft.closures[0].model = ClosureModel::sde;
  EXPECT_THAT(groups_of(soft), IsEmpty());
  EXPECT_THAT(with_loop_joints(soft).loop_rows, IsEmpty());
  Linkage loose = four_bar();
  loose.joints[2].type = JointType::free;
  loose.joints[2].position.clear();
  loose.joints[2].velocity.clear();
  EXPECT_THAT(groups_of(loose), IsEmpty());
}

TEST(LoopJoints, Joints_inside_a_flexible_link_are_on_the_loop_and_do_not_count) {
  Linkage linkage = planar_4r();
  FlexibleBeam beam;
  beam.segments = 3;
  beam.begin = {0.1, 0.05, 0};
  beam.end = {0.35, 0.3, 0};
  beam.across = {0, 0, 1};
  beam.young = 2e11;
  beam.shear = 8e10;
  beam.second_moment_y = beam.second_moment_z = 1e-9;
  beam.torsion_constant = 2e-9;
  linkage.links[1].flexible = beam;
  const Linkage chain = expand_flexible_links(linkage);
  const Mechanism m = with_loop_joints(chain);
  std::vector<std::string> counted;
  for (const LoopJoint& joint : m.loop_joints) {
    if (joint.counts) counted.push_back(name_of(m, joint));
  }
  EXPECT_THAT(counted, UnorderedElementsAre("A", "B", "C", "D"));
  EXPECT_EQ(m.loop_joints.size(), 7u);
  EXPECT_TRUE(m.loop_joints.front().counts);
  EXPECT_FALSE(m.loop_joints.back().counts);
}

TEST(LoopJoints, Idle_rows_are_there_again) {
  const Linkage linkage = planar_4r();
  const std::vector<unsigned> idle = {1u << kX | 1u << kTheta | 1u << kPsi};
  Mechanism m = compile(linkage, idle).mechanism;
  EXPECT_LT(m.cut_rows.size(), 5u);
  add_loop_joints(linkage, m);
  EXPECT_EQ(m.loop_rows.size(), 5u);
}

TEST(LoopJoints, Runs_that_share_otherwise_do_not_share_a_step_loop) {
  const Linkage linkage = planar_4r();
  EXPECT_FALSE(same_structure(compile(linkage).mechanism, with_loop_joints(linkage)));
  EXPECT_TRUE(same_structure(with_loop_joints(linkage), with_loop_joints(linkage)));
}

}  // namespace linkstudy::testing::loop_joints_test

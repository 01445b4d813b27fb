// Mobility: known linkages, and the poses where they change it.
#include "core/kinematics/mobility.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/placed_linkage.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/spatial_slider_crank.h"

namespace linkstudy::testing::mobility_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

MobilityReport mobility_at_start(const Linkage& linkage) {
  const Model closed = compile_closed(linkage);
  State<double> start = closed.start;
  assemble_start(closed, start);
  return analyse_mobility(closed, start);
}

struct Known {
  const char* name;
  Linkage linkage;
  int kutzbach, mobility, redundant;
  SingularState state;
};

// Textbook numbers; Bricard's, Bennett's and Sarrus' linkages move against Kutzbach's count.
std::vector<Known> known_linkages() {
  using enum SingularState;
  return {{"planar 4R", planar_4r(), -2, 1, 3, permanent},
          {"crank-rocker", four_bar(), -2, 1, 3, permanent},
          {"spherical 4R", spherical_4r(), -2, 1, 3, permanent},
          {"Bennett", bennett(), -2, 1, 3, permanent},
          {"Sarrus", sarrus(), 0, 1, 1, permanent},
          {"Bricard", bricard(), 0, 1, 1, permanent},
          {"RCCC", rccc(), 1, 1, 0, none},
          {"RSSR", rssr(), 2, 2, 0, none},
          {"RSRRP", rsrrp(), 1, 1, 0, none},
          {"RSRRP cut at R", rsrrp_revolute(), 1, 1, 0, none},
          {"slider-crank", spatial_slider_crank(), 1, 1, 0, none},
          {"Stewart platform", stewart_platform(), 6, 6, 0, none},
          {"triangle", triangle(), -3, 0, 3, permanent}};
}

TEST(Mobility, Of_known_linkages_is_the_known_one) {
  for (const Known& k : known_linkages()) {
    SCOPED_TRACE(k.name);
    const MobilityReport r = mobility_at_start(k.linkage);
    EXPECT_EQ(r.kutzbach, k.kutzbach);
    EXPECT_EQ(r.mobility, k.mobility);
    EXPECT_EQ(r.instantaneous_mobility, k.mobility);
    EXPECT_EQ(r.redundant, k.redundant);
    EXPECT_EQ(r.state, k.state);
    EXPECT_LT(r.rank.largest_dropped, 1e-12);
    EXPECT_GT(r.rank.smallest_kept, 1e-3);
  }
}

TEST(Mobility, Does_not_depend_on_the_unit_of_length) {
  for (const double size : {1e-4, 1e3}) {
    for (Linkage linkage : {spatial_slider_crank(), rccc(), bennett()}) {
      const MobilityReport as_given = mobility_at_start(linkage);
      for (Joint& joint : linkage.joints) {
        joint.frame.position *= size;
        joint.child_frame.position *= size;
        if (joint.type == JointType::prismatic) joint.position[0] *= size;
      }
      for (Link& link : linkage.links) link.center_of_mass *= size;
      for (Closure& closure : linkage.closures) {
        closure.first.frame.position *= size;
        closure.second.frame.position *= size;
      }
      const MobilityReport scaled = mobility_at_start(linkage);
      EXPECT_EQ(scaled.mobility, as_given.mobility);
      EXPECT_NEAR(scaled.rank.smallest_kept, as_given.rank.smallest_kept, 1e-6);
    }
  }
}

TEST(Mobility, Of_a_bennett_linkage_is_lost_with_a_wrong_length) {
  Linkage wrong = bennett();
  wrong.joints[1].frame.position.x() *= 1.001;  // length of the crank
  const Model closed = compile_closed(wrong);
  State<double> start = closed.start;
  const AssemblyReport assembly = assemble_start(closed, start);
  EXPECT_EQ(analyse_mobility(closed, start).mobility, 0);
  EXPECT_FALSE(assembly.closed);
  EXPECT_GT(assembly.residual, 1e-6);
}

TEST(Mobility, Counts_links_joints_loops_and_coordinates) {
  const MobilityReport stewart = mobility_at_start(stewart_platform());
  EXPECT_EQ(stewart.links, 14);
  EXPECT_EQ(stewart.joints, 18);
  EXPECT_EQ(stewart.loops, 5);
  EXPECT_EQ(stewart.coordinates, 36);
  EXPECT_EQ(stewart.coordinates - 6 * stewart.loops, stewart.kutzbach);
}

TEST(Mobility, Of_flat_rods_jumps_for_an_instant) {
  Linkage linkage = n_four_bar(2);
  const auto at_angle = [&](double angle) {
    for (Joint& joint : linkage.joints) joint.position = {joint.name[0] == 'A' ? angle : -angle};
    return mobility_at_start(linkage);
  };
  for (const double angle : {0.3, -0.3}) {
    const MobilityReport tilted = at_angle(angle);
    EXPECT_EQ(tilted.instantaneous_mobility, 1);
    EXPECT_EQ(tilted.state, SingularState::permanent);
  }
  const MobilityReport flat = at_angle(0.0);
  EXPECT_EQ(flat.instantaneous_mobility, 3);
  EXPECT_EQ(flat.mobility, 1);
  EXPECT_EQ(flat.redundant, 6);
  EXPECT_EQ(flat.state, SingularState::instantaneous);
}

TEST(Mobility, Of_a_parallelogram_at_its_change_point_is_two_for_an_instant) {
  const MobilityReport r = mobility_at_start(flat_parallelogram());
  EXPECT_EQ(r.instantaneous_mobility, 2);
  EXPECT_EQ(r.mobility, 1);
  EXPECT_EQ(r.state, SingularState::instantaneous);
}

TEST(Mobility, Of_a_flat_triangle_is_shaky_but_zero) {
  const Linkage flat = PlacedLinkage("flat_triangle")
                           .add("A", JointType::revolute, kGround, "left", {{0, 0, 0}})
                           .add("B", JointType::revolute, kGround, "right", {{1, 0, 0}})
                           .close("C", JointType::revolute, "left", "right", {{0.4, 0, 0}})
                           .linkage();
  const MobilityReport r = mobility_at_start(flat);
  EXPECT_EQ(r.instantaneous_mobility, 1);
  EXPECT_EQ(r.mobility, 0);
  EXPECT_EQ(r.state, SingularState::instantaneous);
}

std::vector<std::string> names_of(const std::vector<CarriedRedundancy>& all) {
  std::vector<std::string> names;
  for (const CarriedRedundancy& one : all) names.push_back(one.joint);
  return names;
}

TEST(Mobility, Names_the_joints_that_hold_a_motion_twice) {
  const MobilityReport bar = mobility_at_start(four_bar());
  EXPECT_THAT(names_of(bar.redundant_joints),
              ElementsAre("joint.A", "joint.B", "joint.D", "closure.C"));
  for (const CarriedRedundancy& one : bar.redundant_joints) EXPECT_EQ(one.count, 3) << one.joint;
  EXPECT_THAT(mobility_at_start(rsrrp()).redundant_joints, IsEmpty());
}

// A planar four-bar behind a spatial loop: only the joints of the planar loop are redundant.
TEST(Mobility, Leaves_the_joints_of_a_sound_loop_out) {
  Linkage linkage = rssr();
  const Linkage bars = planar_4r();
  for (Link link : bars.links) {
    link.name += "_2";
    linkage.links.push_back(link);
  }
  for (Joint joint : bars.joints) {
    joint.name += "2";
    if (joint.parent != kGround) joint.parent += "_2";
    joint.child += "_2";
    linkage.joints.push_back(joint);
  }
  Closure closure = bars.closures.front();
  closure.name = "C2";
  closure.first.link += "_2";
  closure.second.link += "_2";
  linkage.closures.push_back(closure);
  const MobilityReport r = mobility_at_start(linkage);
  EXPECT_EQ(r.mobility, 3);
  EXPECT_THAT(names_of(r.redundant_joints),
              ElementsAre("joint.A2", "joint.B2", "joint.D2", "closure.C2"));
}

TEST(Mobility, Finds_the_idle_spin_of_a_coupler_between_two_balls) {
  const MobilityReport r = mobility_at_start(rssr());
  ASSERT_EQ(r.idle.size(), 1u);
  EXPECT_THAT(r.idle[0].links, ElementsAre("coupler"));
  EXPECT_THAT(r.idle[0].joints, ElementsAre("joint.B", "closure.C"));
  EXPECT_EQ(r.idle[0].count, 1);
}

// S-P-S: each leg of two links spins about the line through its balls, one of them on ground.
TEST(Mobility, Finds_the_idle_spins_of_legs_between_ground_and_platform) {
  Linkage linkage = stewart_platform();
  for (Joint& joint : linkage.joints) {
    if (joint.type != JointType::universal) continue;
    joint.type = JointType::spherical;
    joint.position.resize(3, 0.0);
    joint.velocity.resize(3, 0.0);
  }
  const MobilityReport r = mobility_at_start(linkage);
  EXPECT_EQ(r.mobility, 12);
  ASSERT_EQ(r.idle.size(), 6u);
  for (const IdleFreedom& idle : r.idle) {
    EXPECT_EQ(idle.count, 1);
    EXPECT_EQ(idle.links.size(), 2u);
    EXPECT_EQ(idle.joints.size(), 2u);
  }
}

TEST(Mobility, Calls_nothing_idle_that_a_linkage_needs) {
  for (const Linkage& linkage : {four_bar(), rsrrp(), rccc(), stewart_platform(), sarrus()}) {
    EXPECT_THAT(mobility_at_start(linkage).idle, IsEmpty()) << linkage.name;
  }
}

TEST(Mobility, Finds_the_idle_spin_of_a_strut_of_two_links) {
  const Linkage strut =
      PlacedLinkage("strut")
          .add("A", JointType::revolute, kGround, "crank", {{0, 0, 0}, {0, 0, 1}})
          .add("S", JointType::spherical, "crank", "barrel", {{0.3, 0, 0}})
          .add("P", JointType::prismatic, "barrel", "rod", {{0.3, 0.2, 0.1}, {0, 0.4, 0.2}})
          .add("D", JointType::revolute, kGround, "rocker", {{0, 0.4, 0.2}, {0, 0, 1}})
          .close("T", JointType::spherical, "rod", "rocker", {{0.3, 0.4, 0.2}})
          .linkage();
  const MobilityReport r = mobility_at_start(strut);
  EXPECT_EQ(r.mobility, 3);
  ASSERT_EQ(r.idle.size(), 1u);
  EXPECT_THAT(r.idle[0].links, ElementsAre("barrel", "rod"));
}

}  // namespace
}  // namespace linkstudy::testing::mobility_test

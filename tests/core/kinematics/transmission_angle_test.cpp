// Transmission angles against the triangles of planar and spatial loops, and where there is none.
#include "core/kinematics/transmission_angle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/loose_slider_crank.h"
#include "tests/mechanisms/n_four_bar.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/rsup.h"
#include "tests/mechanisms/spatial_slider_crank.h"

namespace linkstudy::testing::transmission_angle_test {
namespace {

// A linkage that is closed as it is given.
struct Given {
  explicit Given(const Linkage& linkage) : closed(compile_closed(linkage)) {}

  std::vector<TransmissionLoop> loops(const std::string& drive) const {
    std::vector<TransmissionLoop> all;
    for (const Drive& one : list_drives(closed.mechanism)) {
      if (one.name != drive) continue;
      for (const BasicLoop& loop : find_basic_loops(closed.mechanism)) {
        const auto found = TransmissionLoop::find(closed, loop, one, closed.start);
        if (found) all.push_back(*found);
      }
    }
    return all;
  }

  Model closed;
};

// What is left of an angle where its supplement counts as it does.
double folded(double angle) {
  return std::asin(std::abs(std::sin(angle)));
}

}  // namespace

TEST(TransmissionAngle, Of_a_four_bar_is_that_between_coupler_and_rocker) {
  const Given given(four_bar());
  const auto loops = given.loops("joint.A");
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].output(), "joint.D");
  const FourBarGeometry g;
  State<double> s = given.closed.start;
  for (double crank = 0.0; crank < 6.3; crank += 0.1) {
    const FourBarPose pose = four_bar_pose(crank, 1.0);
    s.q = {pose.crank, pose.coupler - pose.crank, pose.rocker};
    EXPECT_NEAR(loops[0].angle(s), folded(pose.coupler - pose.rocker), 1e-12) << crank;
    // The law of cosines over the diagonal.
    const double diagonal =
        g.crank * g.crank + g.ground * g.ground - 2.0 * g.crank * g.ground * std::cos(crank);
    const double cosine =
        (g.coupler * g.coupler + g.rocker * g.rocker - diagonal) / (2.0 * g.coupler * g.rocker);
    EXPECT_NEAR(loops[0].angle(s), folded(std::acos(cosine)), 1e-12) << crank;
  }
}

// Driven at the rocker the crank is the output.
TEST(TransmissionAngle, Depends_on_which_link_is_driven) {
  const Given given(four_bar());
  const auto loops = given.loops("joint.D");
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].output(), "joint.A");
  const FourBarPose pose = four_bar_pose(1.0, 5.0);
  EXPECT_NEAR(loops[0].angle(given.closed.start), folded(pose.coupler - pose.crank), 1e-12);
  EXPECT_TRUE(given.loops("joint.B").empty()) << "a drive that is not on ground";
}

// Along the rail the rod's direction is x / l.
TEST(TransmissionAngle, Of_a_spatial_slider_crank_is_that_of_the_rod_against_the_rail) {
  const SpatialSliderCrankPose pose = spatial_slider_crank_pose(0.0, 6.0);
  for (const Linkage& linkage : {spatial_slider_crank(), spatial_slider_crank_cut_at_universal()}) {
    const Given given(linkage);
    const auto loops = given.loops("joint.A");
    ASSERT_EQ(loops.size(), 1u);
    EXPECT_EQ(loops[0].output(), "joint.P");
    EXPECT_NEAR(loops[0].angle(given.closed.start), std::asin(pose.x / 0.3), 1e-12);
  }
}

TEST(TransmissionAngle, Is_not_told_of_loops_whose_line_of_force_is_another) {
  EXPECT_TRUE(Given(bennett()).loops("joint.A").empty()) << "hinges that are not parallel";
  EXPECT_TRUE(Given(rsrrp()).loops("joint.A").empty()) << "five links";
  const auto several = Given(n_four_bar()).loops("joint.A");
  EXPECT_LE(several.size(), 1u) << "a loop without the drive";
}

}  // namespace linkstudy::testing::transmission_angle_test

#include "core/kinematics/idle_rows.h"

#include <gtest/gtest.h>

#include "core/model/compile.h"
#include "tests/mechanisms/bennett.h"
#include "tests/mechanisms/four_bar.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/engine_probe.h"

namespace linkstudy::testing::idle_rows_test {

TEST(IdleRows, A_planar_loop_needs_neither_the_tilts_of_its_pin_nor_the_motion_along_it) {
  const std::vector<unsigned> idle = find_idle_directions(four_bar());
  ASSERT_EQ(idle.size(), 1u);
  EXPECT_EQ(idle[0], 1u << kZ | 1u << kTheta | 1u << kPsi);
  EXPECT_EQ(compile(four_bar(), idle).mechanism.cut_row_count(), 2);
}

TEST(IdleRows, Spatial_loops_need_every_row_even_if_some_depend_on_others) {
  for (const Linkage& linkage : {rsrrp(), rsrrp_revolute(), bennett()}) {
    for (const unsigned idle : find_idle_directions(linkage)) EXPECT_EQ(idle, 0u);
  }
}

TEST(IdleRows, A_row_that_nothing_moves_but_that_is_open_stays) {
  Linkage linkage = four_bar();
  linkage.closures[0].second.frame.position.z() += 0.01;  // can never be closed
  EXPECT_EQ(find_idle_directions(linkage)[0], 1u << kTheta | 1u << kPsi);
}

TEST(IdleRows, Without_them_motion_and_reactions_stay_what_they_are) {
  const Linkage linkage = four_bar();
  const std::vector<std::string> signals = {
      "time", "closure." + linkage.closures[0].name + ".force",
      "closure." + linkage.closures[0].name + ".torque", "energy.kinetic",
      "joint." + linkage.joints[0].name + ".torque"};
  const SimulationOptions options = steps_of(1e-3, 1.0, 0.1);
  const Samples all = run(compile(linkage), options, signals);
  const Samples few = run(compile(linkage, find_idle_directions(linkage)), options, signals);
  EXPECT_TRUE(all.outcome.redundant);
  EXPECT_FALSE(few.outcome.redundant);
  EXPECT_GT(all.values.cwiseAbs().maxCoeff(), 1.0);
  EXPECT_LT((all.values - few.values).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace linkstudy::testing::idle_rows_test

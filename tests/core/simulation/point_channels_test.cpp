// Channels of chosen points: names, closed forms and differences along runs, points of flexible
// links; and that watching changes no bit of what is watched.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/flexible/rigid_finite_elements.h"
#include "core/simulation/channels.h"
#include "tests/mechanisms/pendulum.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/engine_probe.h"
#include "tests/support/near.h"

namespace linkstudy::testing::point_channels_test {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;

Linkage watched_rsrrp() {
  Linkage linkage = rsrrp();
  linkage.points = {{"middle", "coupler", Vector3d(0.02, 0.25, -0.01)}};
  return linkage;
}

// The flexible linkage with the two points that its closure holds together.
Linkage watched_rsup(int segments) {
  Linkage linkage = rsup();
  for (Link& link : linkage.links) {
    if (link.name != "coupler") continue;
    link.flexible = steel_rod(segments);
    link.flexible->young /= 100.0;  // bends visibly
  }
  const Closure& pin = linkage.closures[0];
  linkage.points = {{"end", pin.first.link, pin.first.frame.position},
                    {"pin", pin.second.link, pin.second.frame.position}};
  return expand_flexible_links(linkage);
}

// Derivative of a column at row i from its neighbours, of fourth order.
Vector3d slope(const Matrix& values, Eigen::Index i, Eigen::Index column, double h) {
  const auto at = [&](Eigen::Index k) { return values.row(i + k).segment<3>(column).transpose(); };
  return (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * h);
}

}  // namespace

TEST(PointChannels, Are_nine_with_units_behind_the_closures_and_group_by_three) {
  const auto all = list_channels(compile(watched_rsrrp()).mechanism);
  const auto without = list_channels(compile(rsrrp()).mechanism);
  EXPECT_EQ(all.size(), without.size() + 9);
  const std::pair<const char*, const char*> units[] = {
      {"position", "m"}, {"velocity", "m/s"}, {"acceleration", "m/s^2"}};
  for (const auto& [quantity, unit] : units) {
    const auto found = find_channels(all, std::string("point.middle.") + quantity);
    ASSERT_EQ(found.size(), 3u) << quantity;
    EXPECT_EQ(found[1].name, std::string("point.middle.") + quantity + ".y");
    EXPECT_EQ(found[1].unit, unit);
  }
  EXPECT_THAT(signal_names(all), ::testing::Contains("point.middle.velocity"));
}

TEST(PointChannels, A_pendulum_s_tip_follows_the_closed_form) {
  const double length = 0.6;
  Linkage linkage = pendulum(1.3, length);
  linkage.points = {{"tip", "rod", Vector3d(length, 0, 0)}};
  const Samples s =
      run(compile(linkage), steps_of(1e-4, 1.0, 0.01),
          {"joint.A.q", "point.tip.position", "point.tip.velocity", "point.tip.acceleration"});
  ASSERT_EQ(s.outcome.cause, Cause::ok);
  for (Eigen::Index i = 0; i < s.values.rows(); ++i) {
    const double q = s.values(i, 0);  // from rest at q = 0, horizontal
    const Vector3d outward(std::cos(q), std::sin(q), 0), along(-std::sin(q), std::cos(q), 0);
    const double square = -2.0 * kGravity * length * std::sin(q);  // of the speed
    const Vector3d v = s.values.row(i).segment<3>(4), a = s.values.row(i).segment<3>(7);
    EXPECT_TRUE(near_absolute(s.values.row(i).segment<3>(1).transpose(), length * outward, 1e-14));
    EXPECT_NEAR(v.squaredNorm(), square, 1e-9);
    EXPECT_NEAR(v.dot(outward), 0.0, 1e-12);
    const Vector3d expected = -kGravity * std::cos(q) * along - square / length * outward;
    EXPECT_TRUE(near_absolute(a, expected, 1e-8));
  }
}

TEST(PointChannels, On_a_spatial_linkage_they_are_derivatives_of_each_other) {
  const double h = 1e-4;
  const Samples s =
      run(compile(watched_rsrrp()), steps_of(h, 1.0, h),
          {"point.middle.position", "point.middle.velocity", "point.middle.acceleration"});
  ASSERT_EQ(s.outcome.cause, Cause::ok);
  EXPECT_GT(s.values.col(8).cwiseAbs().maxCoeff(), 0.1);  // it moves, out of the plane too
  for (Eigen::Index i = 2; i + 2 < s.values.rows(); i += 10) {
    const Vector3d v = s.values.row(i).segment<3>(3), a = s.values.row(i).segment<3>(6);
    ASSERT_TRUE(near_absolute(slope(s.values, i, 0, h), v, 1e-6)) << i;
    ASSERT_TRUE(near_absolute(slope(s.values, i, 3, h), a, 1e-6)) << i;
  }
}

// An expanded coupler ends in its last element, which the closure holds at the rigid yoke.
TEST(PointChannels, The_end_of_a_flexible_link_is_where_its_closure_holds_it) {
  const Linkage linkage = watched_rsup(3);
  const Preparation ready = prepare(linkage, steps_of(1e-5, 0.2));
  ASSERT_EQ(ready.cause, Cause::ok) << ready.message;
  const Samples s = run(
      ready.model, steps_of(1e-5, 0.2, 5e-3),
      {"point.end.position", "point.end.velocity", "point.end.acceleration", "point.pin.position",
       "point.pin.velocity", "point.pin.acceleration", "closure.R.gap", "joint.coupler_sde2.q"});
  ASSERT_EQ(s.outcome.cause, Cause::ok) << s.outcome.message;
  EXPECT_GT(s.values.rightCols(3).cwiseAbs().maxCoeff(), 1e-4);  // rad: bent
  const Matrix gap = s.values.middleCols(18, 3);
  EXPECT_LT(gap.cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_TRUE(near_absolute(s.values.middleCols(9, 3) - s.values.leftCols(3), gap, 1e-13));
  EXPECT_TRUE(near_absolute(s.values.middleCols(12, 3), s.values.middleCols(3, 3), 1e-6));
  EXPECT_TRUE(near_absolute(s.values.middleCols(15, 3), s.values.middleCols(6, 3), 1e-3));
}

TEST(PointChannels, Watching_changes_no_bit_of_the_motion_and_not_the_structure) {
  const Model watched = compile(watched_rsrrp()), plain = compile(rsrrp());
  EXPECT_TRUE(same_structure(watched.mechanism, plain.mechanism));
  const SimulationOptions options = steps_of(1e-4, 0.3, 1e-3);
  const Samples a = run(watched, options, {"point.middle.acceleration", "joint.R.q"});
  const Samples b = run(plain, options, {"joint.R.q"});
  ASSERT_EQ(a.outcome.cause, Cause::ok);
  EXPECT_TRUE(near_absolute(a.values.col(3), b.values.col(0), 0.0));
  EXPECT_EQ(a.outcome.final_state.q, b.outcome.final_state.q);
  EXPECT_EQ(a.outcome.final_state.v, b.outcome.final_state.v);
  EXPECT_EQ(a.outcome.energy_residual_max, b.outcome.energy_residual_max);
}

// Reactions leave the accelerations of bodies behind; points compute them: both orders agree.
TEST(PointChannels, Accelerations_are_the_same_before_and_after_reactions) {
  EngineProbe first(watched_rsrrp()), second(watched_rsrrp());
  const Vector3d early = first.vector("point.middle.acceleration");
  second.vector("joint.R.force");
  EXPECT_TRUE(near_absolute(second.vector("point.middle.acceleration"), early, 0.0));
  const Vector3d force = second.vector("joint.R.force");
  EXPECT_TRUE(near_absolute(first.vector("joint.R.force"), force, 0.0));
}

}  // namespace linkstudy::testing::point_channels_test

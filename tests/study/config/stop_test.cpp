// joint.*.stop and the table of joint.*.spring: members, units and damaged ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "config_text.h"
#include "study/config/toml_writer.h"
#include "wrong_text.h"

namespace linkstudy::stop_test {
namespace {

using test::expect_one_error;
using test::kRsrrp;
using test::read_good;
using test::replaced;
using test::Wrong;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

const char* const kStart = "initial = { position = [\"0 deg\"], velocity = [0.0] }";

const std::string kStopped =
    std::string(kStart) +
    "\nstop = { low = [\"-90 deg\"], high = [2.0], stiffness = [1e5], restitution = 0.6, law = "
    "\"flores\" }\nspring = { damping = [0.1], table = { positions = [\"-180 deg\", 0.0, 1.0], "
    "efforts = [-2.0, 0.0, \"3 N m\"] } }\n";

std::string text() {
  return replaced(kRsrrp, kStart, kStopped);
}

}  // namespace

TEST(Stops, Are_read_key_by_key) {
  const Joint joint = read_good(text()).linkage.joints[0];
  ASSERT_TRUE(joint.stop);
  EXPECT_THAT(joint.stop->low, ElementsAre(-std::numbers::pi / 2.0));
  EXPECT_THAT(joint.stop->high, ElementsAre(2.0));
  EXPECT_THAT(joint.stop->stiffness, ElementsAre(1e5));
  EXPECT_EQ(joint.stop->restitution, 0.6);
  EXPECT_EQ(joint.stop->law, ContactLaw::flores);
  EXPECT_EQ(joint.stop->exponent, 1.5);
  EXPECT_THAT(joint.stop->damping, IsEmpty());
  ASSERT_TRUE(joint.spring_curve);
  EXPECT_EQ(joint.spring_curve->coordinate, 0);
  EXPECT_THAT(joint.spring_curve->curve.at, ElementsAre(-std::numbers::pi, 0.0, 1.0));
  EXPECT_THAT(joint.spring_curve->curve.force, ElementsAre(-2.0, 0.0, 3.0));
}

TEST(Stops, Have_paths_and_take_a_damping_in_place_of_the_restitution) {
  const Joint joint = read_good(text(), {"joint.A.stop.damping=[5.0]", "joint.A.stop.high.0=1.5",
                                         "joint.A.spring.table.efforts.2=4"})
                          .linkage.joints[0];
  EXPECT_THAT(joint.stop->damping, ElementsAre(5.0));
  EXPECT_THAT(joint.stop->high, ElementsAre(1.5));
  EXPECT_EQ(joint.spring_curve->curve.force[2], 4.0);
}

TEST(Stops, Are_the_same_when_what_was_resolved_is_read_again) {
  const ModelInput input = read_good(text());
  EXPECT_EQ(read_good(write_toml(input.resolved)).linkage, input.linkage);
}

namespace {

class WrongStop : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongStop, Gives_one_error_at_the_marked_place) {
  expect_one_error(text(), GetParam());
}

const Wrong kWrong[] = {
    {"dimension", "low = [\"-90 deg\"]", "low = [@\"-90 mm\"]", "rad"},
    {"two_entries", "high = [2.0]", "high = @[2.0, 3.0]",
     "joint 'A': stop.high must have 1 entry for this joint, got 2"},
    {"crossed", "low = [\"-90 deg\"]", "low = [@2.5]",
     "joint 'A': stop.low must lie below stop.high, got 2.5 and 2"},
    {"restitution", "restitution = 0.6", "restitution = @0.0", "restitution"},
    {"both_losses", "restitution = 0.6", "restitution = 0.6, @damping = [1.0]",
     "exclude each other"},
    {"no_ends", "{ low = [\"-90 deg\"], high = [2.0], stiffness", "@{ stiffness",
     "neither low nor high"},
    {"falling_positions", "positions = [\"-180 deg\", 0.0, 1.0]",
     "positions = [\"-180 deg\", 0.0, @-1.0]", "spring.table.positions must increase"},
    {"effort_dimension", "\"3 N m\"", "@\"3 N\"", "N m"},
    {"coordinate", "table = { positions", "table = { coordinate = @1, positions",
     "this joint has 1 coordinates, counted from 0, got 1"},
};

INSTANTIATE_TEST_SUITE_P(Stop, WrongStop, ::testing::ValuesIn(kWrong),
                         [](const auto& tested) { return tested.param.what; });

}  // namespace

}  // namespace linkstudy::stop_test

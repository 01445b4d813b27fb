// Prescribed motions as they are written and read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "config_text.h"
#include "wrong_text.h"

namespace linkstudy::motion_test {
namespace {

using test::kRsrrp;
using test::read_good;
using test::Wrong;
using ::testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

const char* const kMotions = R"(
[[motion]]
name = "crank"
joint = "A"
law = { shape = "speed", speed = "60 rpm", rise = "0.5 s" }
[[motion]]
name = "slide"
joint = "P"
coordinate = 0
law = { shape = "table", times = [0, "500 ms", 2], positions = [0.25, "26 cm", 0.3] }
[[motion]]
name = "swing"
joint = "Q"
law = { shape = "sine", amplitude = "10 deg", frequency = "2 Hz", phase = "90 deg" }
[[motion]]
name = "turn"
joint = "R"
law = { shape = "polynomial_345", from = "-60 deg", to = "30 deg", duration = "1 s" }
)";

TEST(Motion, Is_read_key_by_key) {
  const std::vector<Motion> motions = read_good(kRsrrp + kMotions).linkage.motions;
  ASSERT_EQ(motions.size(), 4u);
  EXPECT_EQ(motions[0].name, "crank");
  EXPECT_EQ(motions[0].joint, "A");
  EXPECT_EQ(motions[0].law, MotionLaw::speed);
  EXPECT_DOUBLE_EQ(motions[0].speed, 2 * kPi);
  EXPECT_EQ(motions[0].rise, 0.5);
  EXPECT_FALSE(motions[0].from);
  EXPECT_THAT(motions[1].times, ElementsAre(0, 0.5, 2));
  EXPECT_THAT(motions[1].positions, ElementsAre(0.25, 0.26, 0.3));
  EXPECT_DOUBLE_EQ(motions[2].amplitude, kPi / 18);
  EXPECT_EQ(motions[2].frequency, 2.0);
  EXPECT_DOUBLE_EQ(motions[2].phase, kPi / 2);
  EXPECT_DOUBLE_EQ(motions[3].from.value(), -kPi / 3);
  EXPECT_DOUBLE_EQ(motions[3].to, kPi / 6);
  EXPECT_EQ(motions[3].duration, 1.0);
}

TEST(Motion, Is_set_by_its_name) {
  const ModelInput input = read_good(
      kRsrrp + kMotions, {"motion.crank.law.speed=\"90 rpm\"", "motion.turn.law.duration=2.5"});
  EXPECT_DOUBLE_EQ(input.linkage.motions[0].speed, 3 * kPi);
  EXPECT_EQ(input.linkage.motions[3].duration, 2.5);
}

class WrongMotion : public ::testing::TestWithParam<Wrong> {};

const Wrong kWrong[] = {
    {"unknown_joint", "joint = \"P\"\ncoordinate = 0", "joint = @\"PP\"",
     "motion 'slide': joint does not exist, got 'PP'", "did you mean 'P'?"},
    {"closure", "joint = \"P\"\ncoordinate = 0", "joint = @\"S\"",
     "motion 'slide': joint does not exist, got 'S'"},
    {"coordinate_beyond", "coordinate = 0", "coordinate = @1",
     "motion 'slide': joint 'P' has 1 coordinates, counted from 0, got 1", "from 0 to 0"},
    {"same_coordinate", "joint = \"Q\"", "joint = @\"A\"",
     "motion 'swing': motion 'crank' moves the same coordinate"},
    {"same_name", "name = \"turn\"", "name = @\"swing\"", "the name 'swing' is used twice"},
    {"metres_of_a_turn", "\"-60 deg\", to", "@\"10 cm\", to",
     "from must be in rad here, got a value in m"},
    {"speed_of_a_turn", "\"60 rpm\"", "@\"2 m/s\"",
     "speed must be in rad/s here, got a value in m/s"},
    {"no_law",
     "[[motion]]\nname = \"swing\"\njoint = \"Q\"\nlaw = { shape = \"sine\", amplitude = \"10 "
     "deg\", "
     "frequency = \"2 Hz\", phase = \"90 deg\" }\n",
     "@[[motion]]\nname = \"swing\"\njoint = \"Q\"\n", "motion 'swing': law is missing"},
    {"unknown_shape", "shape = \"sine\"", "shape = @\"cosine\"",
     "law.shape must be one of linear, smooth, polynomial_345, table, speed, sine, got 'cosine'"},
    {"speed_of_a_sine", "shape = \"sine\",", "shape = \"sine\", @speed = 1,",
     "law.speed does not go with shape = 'sine'"},
    {"no_speed", "{ shape = \"speed\", speed = \"60 rpm\", rise", "@{ shape = \"speed\", rise",
     "law.speed is missing"},
    {"no_frequency", "\"2 Hz\"", "@0.0", "law.frequency must be positive"},
    {"negative_rise", "\"0.5 s\"", "@-0.5", "law.rise must not be negative"},
    {"two_times", "times = [0, \"500 ms\", 2], positions = [0.25, \"26 cm\", 0.3]",
     "times = [0, 2], positions = @[0.25, 0.3]",
     "law.times and law.positions must have the same length, 3 or more, got 2 and 2"},
    {"late_begin", "times = [0, ", "times = [@0.1, ", "law.times must begin with 0, got 0.1"},
    {"not_rising", "\"500 ms\", 2], positions = [0.25, \"26 cm\", 0.3]",
     "1, @1, 2], positions = [0.25, 0.26, 0.28, 0.3]", "law.times must increase, got 1 after 1"},
};

TEST_P(WrongMotion, Gives_one_error_at_the_marked_place) {
  test::expect_one_error(kRsrrp + kMotions, GetParam());
}

std::string name_of_case(const ::testing::TestParamInfo<Wrong>& info) {
  return info.param.what;
}

INSTANTIATE_TEST_SUITE_P(Motions, WrongMotion, ::testing::ValuesIn(kWrong), name_of_case);

// A quaternion has no coordinates of its own.
TEST(Motion, Of_a_quaternion_is_refused) {
  const std::string ball =
      test::replaced(kRsrrp, "name = \"R\"\ntype = \"revolute\"",
                     "name = \"R\"\ntype = \"spherical\"\ncoordinates = \"quaternion\"");
  Diagnostics diagnostics;
  test::read_text(test::replaced(ball, "initial.position = [\"-60 deg\"]", "") +
                      "[[motion]]\nname = \"m\"\njoint = \"R\"\ncoordinate = 2\n"
                      "law = { shape = \"speed\", speed = 1.0 }\n",
                  diagnostics);
  EXPECT_THAT(to_string(diagnostics),
              ::testing::HasSubstr("coordinate 2 of joint 'R' is of a quaternion"));
}

}  // namespace
}  // namespace linkstudy::motion_test

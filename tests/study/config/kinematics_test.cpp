// Chosen points and the courses of drives as they are written and read.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "config_text.h"
#include "study/config/toml_reader.h"
#include "study/config/toml_writer.h"
#include "study/config/validate.h"
#include "wrong_text.h"

namespace linkstudy::kinematics_test {
namespace {

using test::kRsrrp;
using test::read_good;
using test::read_text;
using test::replaced;
using test::Wrong;
using ::testing::ElementsAre;

constexpr double kPi = std::numbers::pi;

const char* const kCourse = R"(
[kinematics]
positions = 11
duration = "2 s"
[[kinematics.drive]]
joint = "A"
from = "10 deg"
to = "370 deg"
law = "polynomial_345"
[[kinematics.drive]]
joint = "P"
law = "table"
times = [0, "500 ms", 2]
positions = [0.25, "26 cm", 0.3]
)";

const char* const kPoint = R"(
[[point]]
name = "tip"
link = "coupler"
position = ["1 cm", 0.5, 0]
[[point]]
name = "post"
link = "ground"
)";

// The reference linkage with a ball joint in quaternions at R: nothing else of it changes.
std::string with_ball(const std::string& text) {
  return replaced(replaced(text, "name = \"R\"\ntype = \"revolute\"",
                           "name = \"R\"\ntype = \"spherical\"\ncoordinates = \"quaternion\""),
                  "initial.position = [\"-60 deg\"]", "");
}

class WrongCourse : public ::testing::TestWithParam<Wrong> {};

const Wrong kWrong[] = {
    {"unknown_joint", "[[kinematics.drive]]\njoint = \"P\"",
     "[[kinematics.drive]]\njoint = @\"PP\"", "drive 1: joint does not exist, got 'PP'",
     "did you mean 'P'?"},
    {"closure", "[[kinematics.drive]]\njoint = \"P\"", "[[kinematics.drive]]\njoint = @\"S\"",
     "drive 1: joint does not exist, got 'S'", "a closure cannot be driven"},
    {"no_joint", "[[kinematics.drive]]\njoint = \"P\"\n", "@[[kinematics.drive]]\n",
     "drive 1: joint is missing"},
    {"coordinate_beyond", "from = \"10 deg\"", "coordinate = @1\nfrom = \"10 deg\"",
     "drive 0: joint 'A' has 1 coordinates, counted from 0, got 1", "from 0 to 0"},
    {"coordinate_below", "from = \"10 deg\"", "coordinate = @-1\nfrom = \"10 deg\"",
     "drive 0: coordinate must lie in [0, 5], got -1"},
    {"metres_of_a_turn", "from = \"10 deg\"", "from = @\"10 cm\"",
     "drive 0: from must be in rad here, got a value in m"},
    {"degrees_of_a_slide", "\"26 cm\"", "@\"26 deg\"",
     "drive 1: positions.1 must be in m here, got a value in rad"},
    {"nowhere", "to = \"370 deg\"", "to = @\"10 deg\"", "drive 0: to must differ from from",
     "rests where `to` is left out"},
    {"driven_twice", "[[kinematics.drive]]\njoint = \"P\"",
     "[[kinematics.drive]]\njoint = @\"A\"\nlaw = \"smooth\"\n[[kinematics.drive]]\njoint = \"P\"",
     "drive 1: coordinate 0 of joint 'A' is driven twice"},
    {"unknown_law", "\"polynomial_345\"", "@\"polynomial_5\"",
     "drive 0: law must be one of linear, smooth, polynomial_345, table, got 'polynomial_5'",
     "did you mean 'polynomial_345'?"},
    {"to_in_a_table", "times = [0", "@to = 0.3\ntimes = [0",
     "drive 1: to does not go with law = 'table'"},
    {"times_without_a_table", "from = \"10 deg\"", "@times = [0, 1, 2]\nfrom = \"10 deg\"",
     "drive 0: times does not go with law = 'polynomial_345'"},
    {"table_without_positions",
     "[[kinematics.drive]]\njoint = \"P\"\nlaw = \"table\"\ntimes = [0, \"500 ms\", 2]\npositions "
     "= "
     "[0.25, \"26 cm\", 0.3]\n",
     "@[[kinematics.drive]]\njoint = \"P\"\nlaw = \"table\"\ntimes = [0, 1, 2]\n",
     "drive 1: positions is missing"},
    {"two_times", "times = [0, \"500 ms\", 2]\npositions = [0.25, \"26 cm\", 0.3]",
     "times = @[0, 2]\npositions = [0.25, 0.3]",
     "drive 1: times must have at least 3 entries, got 2"},
    {"late_begin", "times = [0, ", "times = [@0.1, ", "drive 1: times must begin with 0, got 0.1"},
    {"not_rising", "\"500 ms\", 2]\npositions = [0.25, \"26 cm\", 0.3]",
     "1, @1, 2]\npositions = [0.25, 0.26, 0.28, 0.3]",
     "drive 1: times must increase, got 1 after 1"},
    {"other_length", "positions = [0.25, \"26 cm\", 0.3]", "positions = @[0.25, 0.26, 0.28, 0.3]",
     "drive 1: times and positions must have the same length, got 3 and 4"},
    {"two_tables", "from = \"10 deg\"\nto = \"370 deg\"\nlaw = \"polynomial_345\"",
     "law = \"table\"\ntimes = [0, 1, 2]\npositions = [0, 1, 0]\n[[kinematics.drive]]\njoint = "
     "\"Q\"\nlaw = \"table\"\ntimes = [0, 1, @3]\npositions = [0, 1, 0]",
     "drive 1: times must end at 2 s like those of drive 0, got 3 s"},
    {"other_duration", "duration = \"2 s\"", "duration = @\"3 s\"",
     "kinematics.duration must be the last of the times of drive 1, 2 s, got 3 s"},
    {"no_duration", "duration = \"2 s\"", "duration = @0", "kinematics.duration must be positive"},
    {"one_position", "positions = 11", "positions = @1", "kinematics.positions must lie in [2, 1"},
    {"half_a_position", "positions = 11", "positions = @11.5",
     "kinematics.positions must be an integer"},
    {"unknown_key", "positions = 11", "@position = 11", "kinematics.position is not a known key",
     "did you mean 'positions'?"},
};

std::string name_of_case(const ::testing::TestParamInfo<Wrong>& info) {
  return info.param.what;
}

TEST_P(WrongCourse, Gives_one_error_at_the_marked_place) {
  test::expect_one_error(kRsrrp + kCourse, GetParam());
}

INSTANTIATE_TEST_SUITE_P(Courses, WrongCourse, ::testing::ValuesIn(kWrong), name_of_case);

TEST(Course, Is_read_key_by_key) {
  const KinematicsOptions course = read_good(kRsrrp + kCourse).kinematics;
  EXPECT_EQ(course.positions, 11);
  EXPECT_EQ(course.duration, 2.0);
  ASSERT_EQ(course.drives.size(), 2u);
  const DriveCourse& turn = course.drives[0];
  EXPECT_EQ(turn.joint, "A");
  EXPECT_EQ(turn.coordinate, 0);
  EXPECT_EQ(turn.law, MotionLaw::polynomial_345);
  ASSERT_TRUE(turn.from && turn.to);
  EXPECT_DOUBLE_EQ(*turn.from, kPi / 18.0);
  EXPECT_DOUBLE_EQ(*turn.to, 37.0 * kPi / 18.0);
  const DriveCourse& slide = course.drives[1];
  EXPECT_EQ(slide.law, MotionLaw::table);
  EXPECT_FALSE(slide.from || slide.to);
  EXPECT_THAT(slide.times, ElementsAre(0.0, 0.5, 2.0));
  EXPECT_THAT(slide.positions, ElementsAre(0.25, 0.26, 0.3));
}

TEST(Course, Has_a_linear_drive_and_73_positions_where_nothing_else_is_said) {
  const ModelInput input = read_good(kRsrrp + "[[kinematics.drive]]\njoint = \"Q\"\n");
  EXPECT_EQ(input.kinematics.positions, 73);
  EXPECT_FALSE(input.kinematics.duration);
  ASSERT_EQ(input.kinematics.drives.size(), 1u);
  const DriveCourse& drive = input.kinematics.drives[0];
  EXPECT_EQ(drive.law, MotionLaw::linear);
  EXPECT_EQ(drive.coordinate, 0);
  EXPECT_FALSE(drive.from || drive.to);
}

TEST(Course, Several_coordinates_of_one_joint_are_driven_but_none_of_a_quaternion) {
  const std::string ball = replaced(
      replaced(kRsrrp, "name = \"R\"\ntype = \"revolute\"", "name = \"R\"\ntype = \"spherical\""),
      "initial.position = [\"-60 deg\"]", "");
  const auto drive = [](int i) {
    return "[[kinematics.drive]]\njoint = \"R\"\ncoordinate = " + std::to_string(i) + "\n";
  };
  EXPECT_EQ(read_good(ball + drive(0) + drive(2)).kinematics.drives[1].coordinate, 2);
  for (const int i : {0, 3}) {
    Diagnostics diagnostics;
    EXPECT_FALSE(read_text(with_ball(kRsrrp) + drive(i), diagnostics));
    EXPECT_EQ(diagnostics.size(), 1u) << to_string(diagnostics);
    EXPECT_THAT(to_string(diagnostics), ::testing::HasSubstr("is of a quaternion"));
  }
}

TEST(Course, All_its_errors_come_in_one_pass) {
  std::string text = replaced(kRsrrp + kCourse, "joint = \"P\"", "joint = \"X\"");
  text = replaced(text, "from = \"10 deg\"", "from = \"10 mm\"");
  text = replaced(text, "[0, \"500 ms\", 2]", "[0, 2, 1]");
  text = replaced(text, "\"26 cm\", 0.3]", "\"26 cm\"]");
  Diagnostics diagnostics;
  EXPECT_FALSE(read_text(text, diagnostics));
  // from, joint, times, positions; the duration is not that of the table either.
  EXPECT_EQ(diagnostics.size(), 5u) << to_string(diagnostics);
}

TEST(Course, A_joint_that_was_reported_is_not_reported_by_its_drive) {
  const std::string text =
      replaced(kRsrrp + kCourse, "name = \"P\"\ntype = \"prismatic\"", "name = \"P\"\ntype = 1");
  Diagnostics diagnostics;
  EXPECT_FALSE(read_text(text, diagnostics));
  EXPECT_EQ(diagnostics.size(), 1u) << to_string(diagnostics);
}

TEST(Course, Its_numbers_are_set_by_their_paths) {
  const ModelInput input =
      read_good(kRsrrp + kCourse, {"kinematics.positions=5", "kinematics.drive.0.to=90 deg",
                                   "kinematics.drive.1.positions.1=0.27"});
  EXPECT_EQ(input.kinematics.positions, 5);
  EXPECT_DOUBLE_EQ(*input.kinematics.drives[0].to, kPi / 2.0);
  EXPECT_EQ(input.kinematics.drives[1].positions[1], 0.27);
  EXPECT_EQ(read_good(kRsrrp, {"kinematics.positions=5"}).kinematics.positions, 5);
  Diagnostics diagnostics;
  const auto model = ModelDocument::parse(kRsrrp + kCourse, "model.toml", diagnostics);
  EXPECT_EQ(parameter_for(*model, "kinematics.drive.0.to")->unit, "rad");
  EXPECT_EQ(parameter_for(*model, "kinematics.drive.1.positions.2")->unit, "m");
  EXPECT_EQ(parameter_for(*model, "kinematics.duration")->unit, "s");
}

TEST(Points, Are_read_and_their_numbers_set_by_their_paths) {
  const ModelInput input = read_good(kRsrrp + kPoint, {"point.tip.position.2=-2 mm"});
  const std::vector<ChosenPoint>& points = input.linkage.points;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].name, "tip");
  EXPECT_EQ(points[0].link, "coupler");
  EXPECT_TRUE(points[0].position.isApprox(Eigen::Vector3d(0.01, 0.5, -0.002)));
  EXPECT_EQ(points[1].link, "ground");
  EXPECT_EQ(points[1].position, Eigen::Vector3d::Zero());
  const ModelInput moved =
      read_good(kRsrrp + kPoint, {"point.tip.position=[1, 2, 3]", "point.tip.link=yoke"});
  EXPECT_EQ(moved.linkage.points[0].position, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(moved.linkage.points[0].link, "yoke");
  Diagnostics diagnostics;
  const auto model = ModelDocument::parse(kRsrrp + kPoint, "model.toml", diagnostics);
  EXPECT_EQ(parameter_for(*model, "point.tip.position.0")->unit, "m");
}

TEST(Points, Of_a_flexible_link_stay_with_it_on_the_rigid_linkage) {
  const ModelInput input = read_good(test::real_joints_text() + kPoint);
  EXPECT_EQ(input.linkage.points[0].link, "coupler_rfe4");
  EXPECT_EQ(input.rigid.points[0].link, "coupler");
}

TEST(Resolved, A_model_without_points_and_courses_is_resolved_without_them) {
  const ModelInput input = read_good(kRsrrp);
  EXPECT_EQ(input.resolved.find("point"), nullptr);
  EXPECT_EQ(input.resolved.find("kinematics"), nullptr);
}

TEST(Resolved, Points_and_courses_read_back_to_themselves) {
  Tree resolved = read_good(kRsrrp + kCourse + kPoint).resolved;
  Diagnostics diagnostics;
  std::optional<Tree> again = parse_toml(write_toml(resolved), "resolved.toml", diagnostics);
  ASSERT_TRUE(again) << to_string(diagnostics);
  validate(*again, model_schema(), diagnostics);
  EXPECT_TRUE(diagnostics.empty()) << to_string(diagnostics);
  EXPECT_TRUE(equal_content(resolved, *again)) << write_toml(resolved);
}

}  // namespace
}  // namespace linkstudy::kinematics_test

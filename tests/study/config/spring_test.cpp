// [[spring]]: members field by field, paths of its values, and damaged ones.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config_text.h"
#include "study/config/toml_writer.h"
#include "wrong_text.h"

namespace linkstudy::spring_test {
namespace {

using test::expect_one_error;
using test::kRsrrp;
using test::read_good;
using test::Wrong;
using ::testing::ElementsAre;

const std::string kSprings = R"(
[[spring]]
name = "strut"
first = { link = "ground", position = ["100 mm", 0.2, 0.0] }
second = { link = "yoke", position = [0.0, 0.03, 0.0] }
stiffness = "20 N/mm"
damping = 300.0
free_length = "250 mm"
acts = "compression"

[[spring]]
name = "cylinder"
first = { link = "crank" }
second = { link = "coupler", position = [0.0, 0.25, 0.0] }
force = { lengths = [0.1, 0.2, 0.4], forces = ["-1 kN", 0.0, 500.0] }
course = { shape = "table", times = [0.0, 1.0], values = [0.0, "2 kN"] }
)";

std::string with_springs() {
  return kRsrrp + kSprings;
}

}  // namespace

TEST(Springs, Are_read_key_by_key) {
  const Linkage linkage = read_good(with_springs()).linkage;
  ASSERT_EQ(linkage.springs.size(), 2u);
  const PointSpring& strut = linkage.springs[0];
  EXPECT_EQ(strut.name, "strut");
  EXPECT_EQ(strut.first, (SpringEnd{"ground", {0.1, 0.2, 0.0}}));
  EXPECT_EQ(strut.second, (SpringEnd{"yoke", {0.0, 0.03, 0.0}}));
  EXPECT_EQ(strut.stiffness, 2e4);
  EXPECT_EQ(strut.damping, 300.0);
  EXPECT_EQ(strut.free_length, 0.25);
  EXPECT_EQ(strut.acts, SpringActs::compression);
  EXPECT_FALSE(strut.force || strut.course);
  const PointSpring& cylinder = linkage.springs[1];
  EXPECT_EQ(cylinder.first.position, Eigen::Vector3d::Zero());
  EXPECT_EQ(cylinder.acts, SpringActs::both);
  ASSERT_TRUE(cylinder.force && cylinder.course);
  EXPECT_THAT(cylinder.force->at, ElementsAre(0.1, 0.2, 0.4));
  EXPECT_THAT(cylinder.force->force, ElementsAre(-1000.0, 0.0, 500.0));
  EXPECT_EQ(cylinder.course->shape, CourseShape::table);
  EXPECT_THAT(cylinder.course->values, ElementsAre(0.0, 2000.0));
}

TEST(Springs, Have_paths_to_all_their_numbers) {
  const Linkage linkage =
      read_good(with_springs(),
                {"spring.strut.stiffness=5 kN/m", "spring.*.damping=7",
                 "spring.cylinder.force.forces.2=600", "spring.strut.second.position.1=0.04"})
          .linkage;
  EXPECT_EQ(linkage.springs[0].stiffness, 5e3);
  EXPECT_EQ(linkage.springs[0].damping, 7.0);
  EXPECT_EQ(linkage.springs[1].damping, 7.0);
  EXPECT_EQ(linkage.springs[1].force->force[2], 600.0);
  EXPECT_EQ(linkage.springs[0].second.position.y(), 0.04);
}

// As damping and damping_ratio of an sde do.
TEST(Springs, Take_a_stiffness_that_is_set_in_place_of_their_table) {
  const Linkage linkage = read_good(with_springs(), {"spring.cylinder.stiffness=100",
                                                     "spring.cylinder.free_length=0.2"})
                              .linkage;
  EXPECT_FALSE(linkage.springs[1].force);
  EXPECT_EQ(linkage.springs[1].stiffness, 100.0);
}

TEST(Springs, Are_the_same_when_what_was_resolved_is_read_again) {
  const ModelInput input = read_good(with_springs());
  EXPECT_EQ(read_good(write_toml(input.resolved)).linkage, input.linkage);
}

namespace {

class WrongSpring : public ::testing::TestWithParam<Wrong> {};

TEST_P(WrongSpring, Gives_one_error_at_the_marked_place) {
  expect_one_error(with_springs(), GetParam());
}

const char* const kStrut = R"([[spring]]
name = "strut"
first = { link = "ground", position = ["100 mm", 0.2, 0.0] }
second = { link = "yoke", position = [0.0, 0.03, 0.0] }
stiffness = "20 N/mm"
damping = 300.0
free_length = "250 mm"
)";
const char* const kStrutWithoutLength = R"(@[[spring]]
name = "strut"
first = { link = "ground", position = ["100 mm", 0.2, 0.0] }
second = { link = "yoke", position = [0.0, 0.03, 0.0] }
stiffness = "20 N/mm"
damping = 300.0
)";

const Wrong kWrong[] = {
    {"negative_stiffness", "stiffness = \"20 N/mm\"", "stiffness = @-5.0",
     "spring 'strut': stiffness must not be negative, got -5 N/m"},
    {"wrong_dimension", "damping = 300.0", "damping = @\"300 N/m\"", "N s/m"},
    {"unknown_side", "acts = \"compression\"", "acts = @\"pull\"", "acts"},
    {"no_free_length", kStrut, kStrutWithoutLength,
     "spring 'strut': free_length is missing, the length without force"},
    {"unknown_link", "second = { link = \"yoke\"", "second = { link = @\"yok\"",
     "spring 'strut': second.link is not a link, got 'yok'", "yoke"},
    {"one_link", "first = { link = \"crank\" }\nsecond = { link = \"coupler\"",
     "first = { link = \"coupler\" }\nsecond = { link = @\"coupler\"",
     "both ends are on the same link 'coupler'"},
    {"falling_lengths", "lengths = [0.1, 0.2, 0.4]", "lengths = [0.1, 0.2, @0.2]",
     "force.lengths must increase, got 0.2 after 0.2"},
    {"short_table", "forces = [\"-1 kN\", 0.0, 500.0]", "forces = @[\"-1 kN\", 0.0]",
     "must have the same length, got 3 and 2"},
    {"table_and_stiffness", "force = { lengths", "stiffness = 10.0\n@force = { lengths",
     "stiffness"},
    {"same_name", "name = \"cylinder\"", "name = @\"strut\"", "the name 'strut' is used twice"},
};

INSTANTIATE_TEST_SUITE_P(Spring, WrongSpring, ::testing::ValuesIn(kWrong),
                         [](const auto& tested) { return tested.param.what; });

}  // namespace

}  // namespace linkstudy::spring_test

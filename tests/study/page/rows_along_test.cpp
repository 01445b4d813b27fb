// Evaluations along one parameter, and what histories are drawn together.
#include "study/page/rows_along.h"

#include <gmock/gmock.h>

#include "study/page/history_panels.h"

namespace linkstudy::testing::rows_along_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::vector<Evaluation> evaluations(const std::vector<std::vector<Value>>& points) {
  std::vector<Evaluation> rows;
  for (const std::vector<Value>& values : points) {
    rows.emplace_back();
    rows.back().point = {rows.size() - 1, values};
  }
  return rows;
}

TEST(RowsAlong, Take_the_usual_value_of_every_other_parameter) {
  // A cross: three steps at the usual stiffness 5, three stiffnesses at the usual step 0.2.
  const auto rows =
      evaluations({{0.3, 5.0}, {0.2, 9.0}, {0.2, 5.0}, {0.1, 5.0}, {0.2, 1.0}, {0.2, 7.0}});
  EXPECT_THAT(rows_along(rows, 0), ElementsAre(3, 2, 0));
  EXPECT_THAT(rows_along(rows, 1), ElementsAre(4, 2, 5, 1));
}

TEST(RowsAlong, Are_there_where_usual_values_never_meet) {
  // 5 is usual and 0.2 is usual, but no row has both: of those with 5 the usual value counts.
  const auto rows = evaluations({{1.0, 5.0, 0.1},
                                 {2.0, 5.0, 0.3},
                                 {3.0, 5.0, 0.3},
                                 {4.0, 7.0, 0.2},
                                 {5.0, 8.0, 0.2},
                                 {6.0, 9.0, 0.2}});
  EXPECT_THAT(rows_along(rows, 0), ElementsAre(1, 2));
}

TEST(RowsAlong, Words_are_no_axis_and_choose_nothing) {
  const auto rows = evaluations({{2.0, "cut"}, {1.0, "sde"}});
  EXPECT_THAT(rows_along(rows, 1), IsEmpty());
  EXPECT_THAT(rows_along(rows, 0), ElementsAre(1, 0));
  EXPECT_THAT(rows_along({}, 0), IsEmpty());
}

TEST(UsualRows, Leave_two_parameters_free) {
  const auto rows = evaluations({{1.0, 5.0, "sde", 0.2},
                                 {2.0, 5.0, "cut", 0.2},
                                 {2.0, 9.0, "sde", 0.1},
                                 {3.0, 7.0, "sde", 0.2},
                                 {4.0, 7.0, "cut", 0.1}});
  // Three of five are "sde", of those two have 0.2.
  EXPECT_THAT(usual_rows(rows, {0, 1}), ElementsAre(0, 3));
  // Two have 2.0, each with a word of its own: of equals the first.
  EXPECT_THAT(usual_rows(rows, {1, 3}), ElementsAre(1));
  EXPECT_THAT(usual_rows({}, {0, 1}), IsEmpty());
}

TEST(ChannelGroup, Is_what_components_and_coordinates_have_in_common) {
  EXPECT_EQ(channel_group("closure.S.force.x"), "closure.S.force");
  EXPECT_EQ(channel_group("joint.U.q.1"), "joint.U.q");
  EXPECT_EQ(channel_group("joint.A.q"), "joint.A.q");
  EXPECT_EQ(channel_group("quality"), "quality");
  EXPECT_EQ(channel_group("energy.residual"), "energy.residual");
}

TEST(Coordinate, Is_one_of_a_joint_of_the_tree) {
  EXPECT_TRUE(is_coordinate("joint.A.q"));
  EXPECT_TRUE(is_coordinate("joint.U.q.1"));
  EXPECT_FALSE(is_coordinate("joint.A.v"));
  EXPECT_FALSE(is_coordinate("closure.S.q.0"));
  EXPECT_FALSE(is_coordinate("time"));
}

}  // namespace
}  // namespace linkstudy::testing::rows_along_test

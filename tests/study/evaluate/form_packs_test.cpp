#include "study/evaluate/form_packs.h"

#include <gmock/gmock.h>

#include <algorithm>

namespace linkstudy::form_packs_test {
namespace {

using ::testing::ElementsAre;
using Packs = std::vector<std::vector<Point>>;

const std::vector<Parameter> kStiffness = {{"closure.S.sde.stiffness", "N/m", ""}};

std::vector<Point> stiffnesses(std::size_t count) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({i, {1e4 * static_cast<double>(i + 1)}});
  return points;
}

std::vector<std::size_t> sizes_of(const Packs& packs) {
  std::vector<std::size_t> sizes;
  for (const auto& pack : packs) sizes.push_back(pack.size());
  return sizes;
}

std::vector<std::uint64_t> ids_of(const Packs& packs) {
  std::vector<std::uint64_t> ids;
  for (const auto& pack : packs)
    for (const Point& point : pack) ids.push_back(point.id);
  return ids;
}

TEST(Packs, Fill_the_lanes_of_one_rank_in_order) {
  const Packs packs = form_packs(stiffnesses(20), kStiffness, 8, 1);
  EXPECT_THAT(sizes_of(packs), ElementsAre(8, 8, 4));
  EXPECT_TRUE(std::ranges::is_sorted(ids_of(packs)));
}

TEST(Packs, Are_smaller_where_ranks_would_stay_idle) {
  EXPECT_THAT(sizes_of(form_packs(stiffnesses(20), kStiffness, 8, 3)), ElementsAre(7, 7, 6));
  EXPECT_EQ(form_packs(stiffnesses(20), kStiffness, 8, 40).size(), 20u);
  EXPECT_EQ(form_packs(stiffnesses(5), kStiffness, 1, 2).size(), 5u);
  EXPECT_TRUE(form_packs({}, kStiffness, 8, 2).empty());
}

// A grid whose innermost entry is the step: neighbours never share a step loop.
TEST(Packs, Hold_what_shares_steps_and_words_and_every_point_once) {
  const std::vector<Parameter> parameters = {
      kStiffness[0], {"closure.S.model", "", ""}, {"simulation.step", "s", ""}};
  std::vector<Point> points;
  for (int i = 0; i < 24; ++i) {
    points.push_back({static_cast<std::uint64_t>(i),
                      {1e4 * (i + 1), std::string(i % 4 < 2 ? "cut" : "sde"), 1e-4 * (i % 2 + 1)}});
  }
  const Packs packs = form_packs(points, parameters, 4, 1);
  EXPECT_THAT(sizes_of(packs), ElementsAre(4, 2, 4, 2, 4, 2, 4, 2));
  for (const auto& pack : packs) {
    for (const Point& point : pack) {
      EXPECT_EQ(point.values[1], pack[0].values[1]);
      EXPECT_EQ(point.values[2], pack[0].values[2]);
    }
  }
  std::vector<std::uint64_t> ids = ids_of(packs);
  std::ranges::sort(ids);
  for (std::uint64_t i = 0; i < 24; ++i) EXPECT_EQ(ids.at(i), i);
}

}  // namespace
}  // namespace linkstudy::form_packs_test

// Ranges of indices against the loops that they stand for.
#include "core/base/indices.h"

#include <gmock/gmock.h>

namespace linkstudy::testing::indices_test {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <class Range>
std::vector<int> listed(const Range& range) {
  std::vector<int> all;
  for (const int i : range) all.push_back(i);
  return all;
}

// Two branches: 2 on 1 on 0, and 4 on 3 on 0.
struct Tree {
  int nv = 5;
  std::vector<int> v_parent{-1, 0, 1, 0, 3};
};

}  // namespace

TEST(Indices, Go_up_to_their_end_and_down_to_their_begin) {
  EXPECT_THAT(listed(indices(3)), ElementsAre(0, 1, 2));
  EXPECT_THAT(listed(indices(2, 5)), ElementsAre(2, 3, 4));
  EXPECT_THAT(listed(indices_down(3)), ElementsAre(2, 1, 0));
  EXPECT_THAT(listed(indices_down(2, 5)), ElementsAre(4, 3, 2));
  EXPECT_THAT(listed(indices_of(std::vector{7.0, 8.0})), ElementsAre(0, 1));
}

TEST(Indices, Are_none_where_the_end_is_not_beyond_the_begin) {
  for (const int end : {2, 1, -1}) {
    EXPECT_THAT(listed(indices(2, end)), IsEmpty());
    EXPECT_THAT(listed(indices_down(2, end)), IsEmpty());
  }
}

TEST(Indices, Of_a_path_end_at_the_root) {
  const Tree tree;
  EXPECT_THAT(listed(path(tree, 4)), ElementsAre(4, 3, 0));
  EXPECT_THAT(listed(ancestors(tree, 2)), ElementsAre(1, 0));
  EXPECT_THAT(listed(ancestors(tree, 0)), IsEmpty());
  EXPECT_THAT(listed(path(tree, -1)), IsEmpty());
  EXPECT_THAT(listed(velocities_down(tree)), ElementsAre(4, 3, 2, 1, 0));
}

}  // namespace linkstudy::testing::indices_test

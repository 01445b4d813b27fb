#include "core/topology/nearest_name.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace linkstudy::nearest_name_test {
namespace {

TEST(NearestName, Distances_are_those_of_the_textbook_words) {
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);
  EXPECT_EQ(edit_distance("saturday", "sunday"), 3);
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("ab", "ba"), 1);   // neighbours swapped
  EXPECT_EQ(edit_distance("CA", "ABC"), 3);  // optimal string alignment, not 2
  EXPECT_EQ(edit_distance("Crank", "cRANK"), 0);
}

TEST(NearestName, A_typing_error_is_recognised_and_another_word_is_not) {
  const std::vector<std::string> names = {"ground", "crank", "coupler"};
  EXPECT_EQ(nearest_name("crnak", names), "crank");
  EXPECT_EQ(nearest_name("Ground", names), "ground");
  EXPECT_EQ(nearest_name("slider", names), "");
  EXPECT_EQ(nearest_name("x", {}), "");
  EXPECT_EQ(suggest_name("couplr", names), "did you mean 'coupler'?");
  EXPECT_EQ(suggest_name("slider", names), "known: ground, crank, coupler");
  EXPECT_THAT(nearest_names("crank2", names, 2), ::testing::ElementsAre("crank", "ground"));
}

TEST(NearestName, Names_start_with_a_letter) {
  for (const char* name : {"a", "Z9", "link_2"}) EXPECT_TRUE(is_legal_name(name)) << name;
  for (const char* name : {"", "9a", "_a", "a b", "a.b", "a-b", "\u00E9"})
    EXPECT_FALSE(is_legal_name(name)) << name;
}

}  // namespace
}  // namespace linkstudy::nearest_name_test

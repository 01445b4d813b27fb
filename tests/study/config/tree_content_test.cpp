// What a tree says, apart from how it is written, and where two trees say something else.
#include "study/config/tree_content.h"

#include <gtest/gtest.h>

#include "study/config/toml_reader.h"

namespace linkstudy::testing::tree_content_test {
namespace {

Tree tree_of(const std::string& text) {
  Diagnostics diagnostics;
  const std::optional<Tree> tree = parse_toml(text, "text", diagnostics);
  EXPECT_TRUE(tree) << text;
  return tree.value_or(Tree());
}

std::string bytes_of(const std::string& text) {
  ByteWriter out;
  put_content(out, tree_of(text));
  return out.take();
}

TEST(TreeContent, Is_the_same_however_it_is_written) {
  const std::string own = bytes_of("a = 1.0\nb = [2, 3]\n[c]\nd = \"x\"\ne = true\n");
  EXPECT_EQ(bytes_of("c = { e = true, d = \"x\" }\nb = [2.0, 3.0]\na = 1\n"), own);
  for (const char* other : {"a = 1.0\nb = [3, 2]\n[c]\nd = \"x\"\ne = true\n",
                            "a = 1.0000000000000002\nb = [2, 3]\n[c]\nd = \"x\"\ne = true\n",
                            "a = 1.0\nb = [2, 3]\n[c]\nd = \"x\"\ne = false\n",
                            "a = \"1.0\"\nb = [2, 3]\n[c]\nd = \"x\"\ne = true\n",
                            "a = 1.0\nb = [2, 3]\n[c]\nd = \"x\"\ne = true\nf = 1\n"}) {
    EXPECT_NE(bytes_of(other), own) << other;
  }
  EXPECT_NE(bytes_of("a = 0.0"), bytes_of("a = -0.0"));
  EXPECT_NE(bytes_of("a = 9007199254740992"), bytes_of("a = 9007199254740993"));
}

TEST(TreeContent, The_first_difference_is_named_as_a_path) {
  const Tree own = tree_of("[[link]]\nname = \"crank\"\nmass = 1.0\n[simulation]\nstep = 1e-3\n");
  EXPECT_FALSE(find_difference(own, own));
  const auto heavier = find_difference(
      own, tree_of("[[link]]\nname = \"crank\"\nmass = 2\n[simulation]\nstep = 1e-3\n"));
  ASSERT_TRUE(heavier);
  EXPECT_EQ(heavier->path, "link.crank.mass");
  EXPECT_EQ(heavier->first, "1");
  EXPECT_EQ(heavier->second, "2");
  const auto alone = find_difference(own, tree_of("[simulation]\nstep = 1e-3\n"));
  ASSERT_TRUE(alone);
  EXPECT_EQ(alone->path, "link");
  EXPECT_EQ(alone->second, "nothing");
  EXPECT_EQ(find_difference(tree_of("a = [1, 2]"), tree_of("a = [1, 3]"))->second, "[1, 3]");
}

}  // namespace
}  // namespace linkstudy::testing::tree_content_test

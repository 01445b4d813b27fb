#include "study/record/lines.h"

#include <gmock/gmock.h>

#include "study/record/findings.h"

namespace linkstudy::testing::lines_test {

using ::testing::ElementsAre;

TEST(Lines, Words_are_broken_at_spaces_and_nothing_is_lost) {
  EXPECT_THAT(words_in_lines("joint.A, joint.B, closure.C", 18),
              ElementsAre("joint.A, joint.B,", "closure.C"));
  EXPECT_THAT(words_in_lines("joint.A, joint.B,", 17), ElementsAre("joint.A, joint.B,"));
  EXPECT_THAT(words_in_lines("a longer_than_it b", 6), ElementsAre("a", "longer_than_it", "b"));
  EXPECT_THAT(words_in_lines("two  spaces stay  inside", 18),
              ElementsAre("two  spaces stay", "inside"));
  EXPECT_THAT(words_in_lines("", 10), ElementsAre(""));
}

TEST(Lines, Characters_count_not_bytes) {
  EXPECT_EQ(text_width("Kr\u00e4fte"), 6u);
  EXPECT_THAT(words_in_lines("\u00e4\u00e4\u00e4 b", 5), ElementsAre("\u00e4\u00e4\u00e4 b"));
}

TEST(Lines, A_finding_that_is_too_long_goes_on_below_its_text) {
  const std::string text =
      summary_line("loop",
                   "joint.bucket_foot, joint.bucket_cylinder, closure.bucket_eye, joint.B; "
                   "cut at closure.bucket_eye; proper equations a11 a31");
  EXPECT_EQ(
      text,
      "loop         joint.bucket_foot, joint.bucket_cylinder, closure.bucket_eye, joint.B; cut "
      "at\n             closure.bucket_eye; proper equations a11 a31\n");
  EXPECT_EQ(summary_line("mobility", "1"), "mobility     1\n");
}

}  // namespace linkstudy::testing::lines_test

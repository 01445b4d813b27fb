// What only our own code can break is an error of its own, in Release, too.
#include "core/base/ensure.h"

#include <gmock/gmock.h>

namespace linkstudy::testing::ensure_test {

TEST(Ensure, What_holds_passes_and_what_does_not_is_said_with_the_function) {
  EXPECT_NO_THROW(ensure(true, "anything"));
  try {
    ensure(1 > 2, "one is more than two");
    FAIL();
  } catch (const std::logic_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("TestBody"));
    EXPECT_THAT(error.what(), ::testing::HasSubstr("one is more than two"));
  }
}

}  // namespace linkstudy::testing::ensure_test

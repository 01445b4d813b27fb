// What a run says of the steps that it has written.
#include "study/record/version.h"

#include <gtest/gtest.h>

#include "core/simulation/written_steps.h"

namespace linkstudy::version_test {

TEST(WrittenText, Says_how_many_steps_were_written_in_which_time) {
  EXPECT_EQ(written_text(WrittenReport{}), "");
  EXPECT_EQ(written_text({1, 0.00312, 0, 0, ""}), "1 step kernel written in 3.1 ms");
  EXPECT_EQ(written_text({3, 0.0451, 0, 0, ""}), "3 step kernels written in 45.1 ms");
}

TEST(WrittenText, Names_what_was_not_trusted_and_what_could_not_be_written) {
  EXPECT_EQ(written_text({3, 0.0451, 1, 0, ""}),
            "3 step kernels written in 45.1 ms, 1 served by AVX2: AVX-512 gave other bits");
  EXPECT_EQ(written_text({0, 0.0, 0, 1, "why"}), "1 structure by the general loop alone (why)");
  EXPECT_EQ(written_text({1, 0.002, 1, 2, "why"}),
            "1 step kernel written in 2.0 ms, 1 served by AVX2: AVX-512 gave other bits, "
            "2 structures by the general loop alone (why)");
}

}  // namespace linkstudy::version_test

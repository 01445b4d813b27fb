#include "study/schedule/manager_load.h"

#include <gtest/gtest.h>

namespace linkstudy::manager_load_test {
namespace {

using std::chrono::milliseconds;

TEST(ManagerLoad, Leaves_time_until_a_fifth_and_again_below_a_twentieth) {
  ManagerLoad load;
  const ManagerLoad::Time begin{};
  EXPECT_TRUE(load.leaves_time());
  load.measure(begin, 5.0);  // nothing to compare with
  EXPECT_TRUE(load.leaves_time());
  load.measure(begin + milliseconds(100), 5.019);
  EXPECT_TRUE(load.leaves_time());
  load.measure(begin + milliseconds(200), 5.040);  // 21 %
  EXPECT_FALSE(load.leaves_time());
  load.measure(begin + milliseconds(300), 5.046);  // 6 %
  EXPECT_FALSE(load.leaves_time());
  load.measure(begin + milliseconds(400), 5.050);  // 4 %
  EXPECT_TRUE(load.leaves_time());
}

TEST(ManagerLoad, Counts_what_this_thread_computes) {
  ManagerLoad load;
  const auto begin = ManagerLoad::Time::clock::now();
  load.measure(begin);
  double sum = 0.0;
  auto now = begin;
  while (now - begin < milliseconds(50)) {
    for (int i = 0; i < 1000; ++i) sum += static_cast<double>(i);
    now = ManagerLoad::Time::clock::now();
  }
  load.measure(begin + (now - begin) / 100);  // as if it had taken a hundredth of the time
  EXPECT_FALSE(load.leaves_time()) << sum;
}

}  // namespace
}  // namespace linkstudy::manager_load_test

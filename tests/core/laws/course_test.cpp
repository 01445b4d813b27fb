// Courses and resistances against their closed forms.
#include "core/laws/course.h"

#include <gtest/gtest.h>

namespace linkstudy::testing::course_test {

TEST(Course, A_ramp_grows_in_proportion_to_time_and_then_stays) {
  EXPECT_DOUBLE_EQ(ramp_course(1.25, 1.0 / 5.0), 0.25);
  EXPECT_EQ(ramp_course(0.0, 0.2), 0.0);
  EXPECT_EQ(ramp_course(5.0, 0.2), 1.0);
  EXPECT_EQ(ramp_course(1e6, 0.2), 1.0);
}

TEST(Course, A_smooth_course_is_the_cubic_of_its_book_with_flat_ends) {
  for (const double s : {0.0, 0.125, 0.25, 0.5, 0.8, 1.0}) {
    EXPECT_NEAR(smooth_course(4.0 * s, 0.25), 3 * s * s - 2 * s * s * s, 1e-15);
  }
  EXPECT_EQ(smooth_course(1e3, 0.25), 1.0);
  const double e = 1e-6;  // slopes vanish at both ends: the values there are 3 e^2 away
  EXPECT_NEAR(smooth_course(e, 1.0), 3 * e * e, 1e-17);
  EXPECT_NEAR(1.0 - smooth_course(1.0 - e, 1.0), 3 * e * e, 1e-15);
}

TEST(Course, Nothing_acts_before_time_zero) {
  for (const double t : {-1e-9, -0.3, -1.0, -40.0}) {
    EXPECT_EQ(ramp_course(t, 0.25), 0.0) << t;
    EXPECT_EQ(smooth_course(t, 0.25), 0.0) << t;
  }
}

TEST(Course, A_segment_climbs_between_its_ends_and_is_flat_outside) {
  EXPECT_EQ(linear_segment(0.5, 1.0, 2.0, 3.0), 0.0);
  EXPECT_DOUBLE_EQ(linear_segment(1.5, 1.0, 2.0, 3.0), 1.5);
  EXPECT_DOUBLE_EQ(linear_segment(9.0, 1.0, 2.0, 3.0), 6.0);
  EXPECT_DOUBLE_EQ(linear_segment(2.0, 1.0, 2.0, -3.0), -3.0);
}

TEST(Course, Resistances_have_the_sign_of_the_speed_and_their_value_at_the_named_speed) {
  const double value = 10.0, speed = 9.0;
  for (const double v : {-18.0, -9.0, -4.5, 0.0, 4.5, 9.0}) {
    EXPECT_DOUBLE_EQ(linear_resistance(v, value / speed), value * v / speed);
    EXPECT_NEAR(quadratic_resistance(v, value / (speed * speed)),
                value * (v / speed) * std::fabs(v / speed), 1e-14);
  }
}

}  // namespace linkstudy::testing::course_test

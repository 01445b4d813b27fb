// Begin and end of contacts on courses whose zeros are known.
#include "core/simulation/contact_events.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace linkstudy::testing::contact_events_test {
namespace {

using Course = std::function<Nearness(double)>;

// First event of contacts that follow the courses.
std::optional<ContactEvent> find(const std::vector<Course>& courses, double t0, double t1,
                                 const std::vector<ContactPhase>& phases, int* looks = nullptr) {
  const auto all = [&](double t, Nearness* out) {
    if (looks) ++*looks;
    for (const Course& c : courses) *out++ = c(t);
  };
  ContactEvents events(all, static_cast<int>(courses.size()));
  std::vector<Nearness> begin(courses.size()), end(courses.size());
  all(t0, begin.data());
  all(t1, end.data());
  if (looks) *looks = 0;
  return events.find(t0, t1, begin, end, phases);
}

// depth = height - g (t - top)^2 / 2
Course toss(double top, double height, double g = 9.81) {
  return [=](double t) {
    return Nearness{height - 0.5 * g * (t - top) * (t - top), -g * (t - top)};
  };
}

constexpr ContactPhase kOpen{false, false}, kTouching{true, false};
constexpr ContactPhase kJustOpened{false, true}, kJustTouching{true, true};

}  // namespace

TEST(ContactEvents, A_contact_begins_and_ends_at_the_zeros_of_its_depth) {
  const double half = std::sqrt(2 * 0.3 / 9.81);
  const auto begin = find({toss(1.0, 0.3)}, 0.5, 1.1, {kOpen});
  ASSERT_TRUE(begin);
  EXPECT_NEAR(begin->t, 1.0 - half, 1e-15);
  const auto end = find({toss(1.0, 0.3)}, 0.9, 2.0, {kTouching});
  ASSERT_TRUE(end);
  EXPECT_NEAR(end->t, 1.0 + half, 1e-15);
}

TEST(ContactEvents, A_contact_that_comes_and_goes_within_a_step_is_found) {
  for (const double height : {1e-2, 1e-5, 1e-9}) {
    for (const double top : {0.52, 0.71, 1.3}) {
      const auto e = find({toss(top, height)}, 0.0, 2.0, {kOpen});
      ASSERT_TRUE(e) << height << " " << top;
      EXPECT_NEAR(e->t, top - std::sqrt(2 * height / 9.81), 1e-10);
      EXPECT_FALSE(find({toss(top, -height)}, 0.0, 2.0, {kOpen})) << height << " " << top;
    }
  }
}

TEST(ContactEvents, The_first_of_several_crossings_is_found) {
  // |x| - 1 for a mass that is thrown up just past one wall and then falls through the other.
  const Course between = [](double t) {
    const double x = 1.001 - 5.0 * (t - 0.4) * (t - 0.4), v = -10.0 * (t - 0.4);
    return Nearness{std::fabs(x) - 1.0, x > 0 ? v : -v};
  };
  for (const double end : {0.5, 1.5, 4.0, 40.0}) {
    const auto e = find({between}, 0.0, end, {kOpen});
    ASSERT_TRUE(e) << end;
    EXPECT_NEAR(e->t, 0.4 - std::sqrt(0.001 / 5.0), 1e-13) << end;
  }
  const Course waves = [](double t) {
    return Nearness{std::sin(40.0 * t) - 0.5, 40.0 * std::cos(40.0 * t)};
  };
  const auto e = find({waves}, -0.01, 1.0, {kOpen});
  ASSERT_TRUE(e);
  EXPECT_NEAR(e->t, std::asin(0.5) / 40.0, 1e-14);
}

TEST(ContactEvents, The_earlier_of_two_contacts_is_named) {
  const auto e = find({toss(1.0, 0.1), toss(0.9, 0.1)}, 0.0, 1.0, {kOpen, kOpen});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->contact, ContactIndex(1));
  EXPECT_NEAR(e->t, 0.9 - std::sqrt(0.2 / 9.81), 1e-15);
}

TEST(ContactEvents, A_contact_just_begun_ends_after_its_hump_and_not_at_its_begin) {
  const double half = std::sqrt(2 * 1e-5 / 9.81);
  for (const double begin : {-half, -half * (1 - 1e-15), -half * (1 + 1e-15)}) {
    const auto e = find({toss(0.0, 1e-5)}, begin, 10 * half, {kJustTouching});
    ASSERT_TRUE(e);
    EXPECT_NEAR(e->t, half, 1e-15);
    EXPECT_FALSE(find({toss(0.0, 1e-5)}, begin, 0.5 * half, {kJustTouching}));
    EXPECT_FALSE(find({toss(0.0, 1e-5)}, -begin, 10 * half, {kJustOpened}));
  }
}

TEST(ContactEvents, A_flight_just_begun_ends_where_it_comes_back) {
  // Away from the wall at 0.1 m/s, drawn back to it.
  const Course bounce = [](double t) { return Nearness{-0.1 * t + 5.0 * t * t, -0.1 + 10.0 * t}; };
  for (const double end : {0.021, 0.03, 1.0, 100.0}) {
    const auto e = find({bounce}, 0.0, end, {kJustOpened});
    ASSERT_TRUE(e) << end;
    EXPECT_NEAR(e->t, 0.02, 1e-15) << end;
  }
}

TEST(ContactEvents, A_flight_that_never_leaves_ends_at_once_and_a_touch_at_rest_goes_on) {
  const Course pressed = [](double t) { return Nearness{5.0 * t * t, 10.0 * t}; };
  const auto e = find({pressed}, 0.0, 0.1, {kJustOpened});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->t, 0.0);
  EXPECT_FALSE(find({pressed}, 0.0, 0.1, {kJustTouching}));
}

TEST(ContactEvents, Contacts_far_from_any_event_are_not_looked_at) {
  int looks = 0;
  EXPECT_FALSE(find({toss(0.0, -1.0, 0.1)}, 0.0, 0.5, {kOpen}, &looks));
  EXPECT_EQ(looks, 0);
  EXPECT_TRUE(find({toss(1.0, 0.3)}, 0.5, 1.1, {kOpen}, &looks));
  EXPECT_LT(looks, 25);
}

}  // namespace linkstudy::testing::contact_events_test

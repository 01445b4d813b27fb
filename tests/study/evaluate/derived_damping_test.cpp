#include "study/evaluate/derived_damping.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/simulation/prepare.h"
#include "tests/mechanisms/bushing.h"
#include "tests/mechanisms/mass_on_spring.h"

namespace linkstudy::derived_damping_test {
namespace {

constexpr double kRounding = 1e-12;  // relative; a root and an eigenvalue

std::vector<Trace> damping_of(Linkage linkage, double ratio, const std::string& prefix = "") {
  linkage.closures[0].sde.damping_ratio = ratio;
  SimulationOptions options;
  options.end_time = 0.1;
  options.step = 1e-4;
  const Preparation ready = prepare(linkage, options);
  EXPECT_EQ(ready.cause, Cause::ok) << ready.message;
  std::vector<Trace> derived;
  add_damping(linkage, ready.model, prefix, derived);
  return derived;
}

// A mass m on a spring c is damped by b = 2 zeta sqrt(c m).
TEST(DerivedDamping, Of_a_mass_on_a_spring_is_that_of_the_textbook) {
  const auto derived = damping_of(testing::mass_on_spring(2.0, 1e4), 0.7, "fast_");
  ASSERT_EQ(derived.size(), 2u);
  EXPECT_EQ(derived[0].name, "fast_closure.spring.sde.damping_ratio");
  EXPECT_EQ(derived[0].values[0], 0.7);
  EXPECT_EQ(derived[1].name, "fast_closure.spring.sde.damping");
  EXPECT_EQ(derived[1].unit, "N s/m");
  const double expected = 2.0 * 0.7 * std::sqrt(1e4 * 2.0);
  EXPECT_NEAR(derived[1].values[0], expected, kRounding * expected);
}

// Turns about principal axes: m_eff is the least moment of inertia, here 0.1 kg m^2.
TEST(DerivedDamping, Of_turns_has_their_unit_and_a_value_for_each_direction_that_differs) {
  testing::Bushing alike;
  const auto one = damping_of(testing::bushing(alike), 0.3);
  ASSERT_EQ(one.size(), 2u);
  EXPECT_EQ(one[1].name, "closure.B.sde.damping.turn");
  EXPECT_EQ(one[1].unit, "N m s/rad");
  EXPECT_NEAR(one[1].values[0], 2.0 * 0.3 * std::sqrt(5.0 * 0.1), kRounding);
  testing::Bushing unlike;
  unlike.stiffness = {5.0, 10.0, 20.0};
  const auto three = damping_of(testing::bushing(unlike), 0.3);
  ASSERT_EQ(three.size(), 4u);
  const char* names[] = {"phi", "theta", "psi"};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(three[1 + i].name, std::string("closure.B.sde.damping.") + names[i]);
    const double c = unlike.stiffness[static_cast<Eigen::Index>(i)];
    EXPECT_NEAR(three[1 + i].values[0], 2.0 * 0.3 * std::sqrt(c * 0.1), kRounding);
  }
}

TEST(DerivedDamping, Is_told_only_where_a_ratio_gives_it) {
  const Linkage linkage = testing::mass_on_spring(2.0, 1e4, 30.0);
  std::vector<Trace> derived;
  add_damping(linkage, prepare(linkage, {}).model, "", derived);
  EXPECT_TRUE(derived.empty());
}

}  // namespace
}  // namespace linkstudy::derived_damping_test

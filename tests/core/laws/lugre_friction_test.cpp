// The law of LuGre friction by itself: sliding speed given, bristle integrated.
#include "core/laws/lugre_friction.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "core/base/pack.h"
#include "tests/support/fixed_step.h"
#include "tests/support/random.h"

namespace linkstudy::testing::lugre_friction_test {
namespace {

using Parameters = LugreParameters<double>;
using Plane = std::array<double, 2>;

// Table 1 of [AugUrb18].
const Parameters kRsup{0.2, 0.1, 0.0175, 600.0, std::sqrt(600.0), 0.0, 0.0};
// Another one with a viscous part and weighted damping.
const Parameters kWeighted{0.35, 0.22, 0.004, 2e4, 40.0, 0.3, 0.01};

double sliding(const Parameters& p, double v) {
  return p.mu_k + (p.mu_s - p.mu_k) * std::exp(-v * v / (p.v_s * p.v_s));
}

// Bristle after sliding at v for a time, from z.
double bend(const Parameters& p, double z, double v, double time) {
  const double rate = p.sigma0 * std::fabs(v) / sliding(p, v);
  const int steps = 20 + static_cast<int>(20.0 * rate * time);
  std::array<double, 1> y{z};
  for (int k = 0; k < steps; ++k) {
    fixed_step(0.0, time / steps, y,
               [&](double, const double* s, double* ds) { *ds = lugre_friction(p, *s, v).z_rate; });
  }
  return y[0];
}

Plane rotated(double along, double angle) {
  return {along * std::cos(angle), along * std::sin(angle)};
}

// A speed of either sign between 1e-6 and 1 m/s, every size as likely.
double any_speed(Random& random) {
  const double size = std::pow(10.0, -3.0 + random.within(3.0));
  return random.below(2) == 0 ? size : -size;
}

}  // namespace

TEST(LugreFriction, Steady_sliding_follows_the_curve_of_stribeck_with_its_viscous_part) {
  for (const Parameters& p : {kRsup, kWeighted}) {
    for (const double v : {1e-4, 1e-3, 0.004, 0.01, 0.0175, 0.05, 0.3}) {
      for (const double way : {v, -v}) {
        const double z = bend(p, 0.0, way, 40.0 * p.mu_s / (p.sigma0 * v));
        const double expected = std::copysign(sliding(p, v), way) + p.sigma2 * way;
        EXPECT_NEAR(lugre_friction(p, z, way).mu, expected, 1e-9) << way;
        EXPECT_NEAR(lugre_friction(p, z, way).z_rate / v, 0.0, 1e-8) << way;
      }
    }
  }
}

TEST(LugreFriction, The_curve_starts_at_the_static_and_ends_at_the_kinetic_coefficient) {
  EXPECT_DOUBLE_EQ(lugre_sliding(kRsup, 0.0), 0.2);
  EXPECT_DOUBLE_EQ(lugre_sliding(kRsup, 1.0), 0.1);
  EXPECT_NEAR(lugre_sliding(kRsup, 0.0175), 0.1 + 0.1 * 0.367879441, 1e-10);
}

// At constant speed z = g / sigma0 (1 - exp(-sigma0 v t / g)).
TEST(LugreFriction, A_fresh_bristle_bends_exponentially_with_the_way_slid) {
  for (const double v : {2e-4, 0.0175, 0.4}) {
    const double g = sliding(kRsup, v), end = g / kRsup.sigma0;
    for (const double way : {0.1 * end, end, 3.0 * end}) {
      EXPECT_NEAR(bend(kRsup, 0.0, v, way / v) / end, 1.0 - std::exp(-way / end), 1e-8);
    }
  }
}

TEST(LugreFriction, No_history_of_sliding_bends_the_bristle_further_than_static_friction) {
  Random random(21);
  for (const Parameters& p : {kRsup, kWeighted}) {
    const double bound = p.mu_s / p.sigma0;
    double z = 0.0, most = 0.0;
    for (int k = 0; k < 4000; ++k) {
      const double v = any_speed(random);
      z = bend(p, z, v, (1.0 + random.within(1.0)) * bound / std::fabs(v));
      most = std::max(most, std::fabs(z));
    }
    EXPECT_LE(most, bound * (1.0 + 1e-12));
    EXPECT_GT(most, 0.8 * bound);  // the bound is approached, not only kept
  }
}

TEST(LugreFriction, At_the_bound_the_bristle_cannot_grow_whatever_the_speed) {
  Random random(22);
  for (int k = 0; k < 20000; ++k) {
    const double v = any_speed(random), z = kRsup.mu_s / kRsup.sigma0;
    EXPECT_LE(lugre_friction(kRsup, z, v).z_rate, 1e-15) << v;
    EXPECT_GE(lugre_friction(kRsup, -z, v).z_rate, -1e-15) << v;
  }
}

TEST(LugreFriction, Friction_at_rest_is_the_spring_of_the_bent_bristle) {
  for (const double z : {-2e-4, 0.0, 1e-4, 3e-4}) {
    const LugreState<double> s = lugre_friction(kRsup, z, 0.0);
    EXPECT_EQ(s.z_rate, 0.0);
    EXPECT_DOUBLE_EQ(s.mu, 600.0 * z);
  }
}

// sigma1 = sqrt(600) s/m: mu of a fresh contact is 24.5 s/m v; with the weight nothing of it is
// left at some multiples of v_d, and all of it at rest.
TEST(LugreFriction, A_damping_speed_takes_the_blow_out_of_a_fresh_contact) {
  EXPECT_NEAR(lugre_friction(kRsup, 0.0, 1.0).mu, 24.4949, 1e-4);
  Parameters p = kRsup;
  p.v_d = 0.1;
  EXPECT_NEAR(lugre_friction(p, 0.0, 0.1).mu, 2.44949 * std::exp(-1.0), 1e-5);
  EXPECT_LT(lugre_friction(p, 0.0, 1.0).mu, 1e-40);
  EXPECT_NEAR(lugre_friction(p, 0.0, 1e-6).mu / lugre_friction(kRsup, 0.0, 1e-6).mu, 1.0, 1e-9);
  double most = 0.0;  // v exp(-(v / v_d)^2) is greatest at v_d / sqrt(2)
  for (double v = 1e-4; v < 2.0; v *= 1.01) most = std::max(most, lugre_friction(p, 0.0, v).mu);
  EXPECT_NEAR(most, 24.4949 * 0.1 / std::sqrt(2.0) * std::exp(-0.5), 1e-4);
}

TEST(LugreFriction, The_weight_changes_no_steady_state) {
  Parameters p = kRsup;
  p.v_d = 0.01;
  for (const double v : {1e-3, 0.02, 0.3}) {
    const double time = 40.0 * p.mu_s / (p.sigma0 * v);
    const double plain = lugre_friction(kRsup, bend(kRsup, 0.0, v, time), v).mu;
    EXPECT_NEAR(lugre_friction(p, bend(p, 0.0, v, time), v).mu, plain, 1e-9);
  }
}

TEST(LugreFriction, Reversed_sliding_of_the_mirrored_bristle_is_mirrored) {
  Random random(23);
  for (int k = 0; k < 1000; ++k) {
    const double v = any_speed(random), z = random.within(1e-5);
    const LugreState<double> a = lugre_friction(kWeighted, z, v);
    const LugreState<double> b = lugre_friction(kWeighted, -z, -v);
    EXPECT_EQ(a.mu, -b.mu);
    EXPECT_EQ(a.z_rate, -b.z_rate);
  }
}

TEST(LugreFriction, In_a_plane_sliding_along_any_line_is_that_of_the_line) {
  Random random(24);
  for (int k = 0; k < 1000; ++k) {
    const double v = any_speed(random), z = random.within(1e-5), angle = random.within(3.0);
    const LugreState<double> line = lugre_friction(kWeighted, z, v);
    const auto plane = lugre_friction(kWeighted, rotated(z, angle), rotated(v, angle));
    const Plane mu = rotated(line.mu, angle), rate = rotated(line.z_rate, angle);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(plane.mu[i], mu[i], 1e-13 * (1.0 + std::fabs(line.mu)));
      EXPECT_NEAR(plane.z_rate[i], rate[i], 1e-14 * (1.0 + std::fabs(line.z_rate)));
    }
  }
}

TEST(LugreFriction, In_a_plane_friction_turns_against_the_new_way_and_keeps_its_size) {
  const double v = 0.05, g = sliding(kRsup, v), bound = kRsup.mu_s / kRsup.sigma0;
  std::array<double, 2> z{g / kRsup.sigma0, 0.0};  // after long sliding along x
  const double angle = 2.0;
  double longest = 0.0;
  for (int k = 0; k < 4000; ++k) {
    fixed_step(0.0, 1e-5, z, [&](double, const double* s, double* ds) {
      const auto rate = lugre_friction(kRsup, Plane{s[0], s[1]}, rotated(v, angle)).z_rate;
      ds[0] = rate[0], ds[1] = rate[1];
    });
    longest = std::max(longest, std::hypot(z[0], z[1]));
  }
  const auto end = lugre_friction(kRsup, z, rotated(v, angle));
  EXPECT_NEAR(end.mu[0], g * std::cos(angle), 1e-4);
  EXPECT_NEAR(end.mu[1], g * std::sin(angle), 1e-4);
  EXPECT_LE(longest, bound);
}

TEST(LugreFriction, In_a_plane_no_history_bends_the_bristle_further_than_static_friction) {
  Random random(25);
  const double bound = kRsup.mu_s / kRsup.sigma0;
  for (int k = 0; k < 20000; ++k) {
    const Plane z = rotated(bound, random.within(3.15)), v = rotated(any_speed(random), 0.3);
    const auto rate = lugre_friction(kRsup, z, v).z_rate;
    EXPECT_LE((z[0] * rate[0] + z[1] * rate[1]) / bound, 1e-15);
  }
}

TEST(LugreFriction, Lanes_of_a_pack_are_bristles_of_their_own) {
  using Lanes = Pack<2, Baseline>;
  const auto both = [](double a, double b) {
    Lanes x(a);
    set_lane(x, 1, b);
    return x;
  };
  const Parameters &a = kRsup, &b = kWeighted;  // without and with the weight, side by side
  const LugreParameters<Lanes> p{both(a.mu_s, b.mu_s),     both(a.mu_k, b.mu_k),
                                 both(a.v_s, b.v_s),       both(a.sigma0, b.sigma0),
                                 both(a.sigma1, b.sigma1), both(a.sigma2, b.sigma2),
                                 both(a.v_d, b.v_d)};
  Random random(26);
  for (int k = 0; k < 1000; ++k) {
    const double v0 = any_speed(random), v1 = any_speed(random), z0 = random.within(3e-4),
                 z1 = random.within(1e-5);
    const LugreState<Lanes> s = lugre_friction(p, both(z0, z1), both(v0, v1));
    const LugreState<double> s0 = lugre_friction(a, z0, v0), s1 = lugre_friction(b, z1, v1);
    EXPECT_DOUBLE_EQ(lane(s.mu, 0), s0.mu);
    EXPECT_DOUBLE_EQ(lane(s.mu, 1), s1.mu);
    EXPECT_DOUBLE_EQ(lane(s.z_rate, 0), s0.z_rate);
    EXPECT_DOUBLE_EQ(lane(s.z_rate, 1), s1.z_rate);
  }
}

}  // namespace linkstudy::testing::lugre_friction_test

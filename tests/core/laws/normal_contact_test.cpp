// A mass thrown at a wall through the laws of normal contact, against the closed relation of its
// rebound and the published properties of the three laws.
#include "core/laws/normal_contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/pack.h"
#include "tests/support/fixed_step.h"
#include "tests/support/random.h"

namespace linkstudy::testing::normal_contact_test {
namespace {

constexpr ContactLaw kLaws[] = {ContactLaw::lankarani_nikravesh, ContactLaw::flores,
                                ContactLaw::hunt_crossley};

struct Throw {
  double mass, speed, stiffness;  // kg, m/s, N/m^n
};

// Three powers of ten and more in mass, speed and stiffness.
constexpr Throw kThrows[] = {{1e-2, 20.0, 1e6}, {1.0, 1.0, 2.1446e10}, {50.0, 0.02, 1e8}};

struct Rebound {
  double restitution;  // speed away / speed of approach
  double lost;         // work of the damping part of the force, J
  double gap;          // greatest |kinetic + stored + lost - kinetic at the start|, J
  double deepest;      // m
  double duration;     // s
};

Rebound rebound(const NormalContact<double>& c, bool hertz, const Throw& a, int steps) {
  const double energy = 0.5 * a.mass * a.speed * a.speed;
  const double depth = std::pow(energy * (c.exponent + 1.0) / c.stiffness, 1.0 / (c.exponent + 1));
  const double h = 3.0 * depth / a.speed / steps;  // an elastic impact lasts about 3 depth / speed
  const auto motion = [&](double, const double* y, double* dy) {
    const ContactForce<double> f = normal_contact_force(c, hertz, y[0], y[1], a.speed);
    dy[0] = y[1];
    dy[1] = -f.normal / a.mass;
    dy[2] = (f.normal - f.elastic) * y[1];
  };
  std::array<double, 3> y{0.0, a.speed, 0.0};
  Rebound r{};
  int taken = 0;
  do {
    fixed_step(0.0, h, y, motion);
    ++taken;
    const double elastic = normal_contact_force(c, hertz, y[0], y[1], a.speed).elastic;
    const double stored = contact_energy(c, std::max(y[0], 0.0), elastic);
    const double all = 0.5 * a.mass * y[1] * y[1] + stored + y[2];
    r.gap = std::max(r.gap, std::fabs(all - energy));
    r.deepest = std::max(r.deepest, y[0]);
  } while (y[0] > 0.0);
  r.restitution = -y[1] / a.speed;
  r.lost = y[2];
  r.duration = taken * h - y[0] / y[1];
  return r;
}

NormalContact<double> contact(double stiffness, double exponent, double damping) {
  return {stiffness, exponent, damping, 1e-9};
}

// Error of e* as a root of D - ln(1 + D) = -D e* - ln(1 - D e*): what the equation is off by over
// its slope D^2 e / (1 - D e).
long double error_of_root(long double d, long double e) {
  const long double off = -d * e - std::log1p(-d * e) - (d - std::log1p(d));
  return off * (1.0L - d * e) / (d * d * e);
}

double obtained(ContactLaw law, double e) {
  return contact_restitution(contact_damping(law, e));
}

}  // namespace

TEST(NormalContact, Damping_factors_are_those_of_their_papers) {
  EXPECT_DOUBLE_EQ(contact_damping(ContactLaw::lankarani_nikravesh, 0.9), 0.1425);
  EXPECT_DOUBLE_EQ(contact_damping(ContactLaw::lankarani_nikravesh, 0.0), 0.75);
  EXPECT_DOUBLE_EQ(contact_damping(ContactLaw::flores, 0.5), 1.6);
  EXPECT_DOUBLE_EQ(contact_damping(ContactLaw::flores, 0.8), 0.4);
  EXPECT_TRUE(std::isinf(contact_damping(ContactLaw::flores, 0.0)));
  EXPECT_DOUBLE_EQ(contact_damping(ContactLaw::hunt_crossley, 0.5), 0.75);
  for (const ContactLaw law : kLaws) EXPECT_EQ(contact_damping(law, 1.0), 0.0);
}

TEST(NormalContact, The_rebound_of_a_damping_factor_solves_the_closed_relation) {
  for (double d = 1e-6; d < 30.0; d *= 1.13) {
    EXPECT_LT(std::fabs(error_of_root(d, contact_restitution(d))), 1e-11L) << d;
  }
  EXPECT_EQ(contact_restitution(0.0), 1.0);
  EXPECT_EQ(contact_restitution(std::numeric_limits<double>::infinity()), 0.0);
}

TEST(NormalContact, The_rebound_has_no_step_where_its_series_begins) {
  const double step = 1e-9;  // slope -2/3; the series and the root each err below 1e-12
  const double left = contact_restitution(1e-4 - step), right = contact_restitution(1e-4 + step);
  EXPECT_NEAR(left - right, 2.0 * step * 2.0 / 3.0, 3e-12);
}

TEST(NormalContact, A_mass_rebounds_with_the_exact_ratio_whatever_it_weighs_and_meets) {
  for (const ContactLaw law : kLaws) {
    for (const double e : {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95}) {
      const double d = contact_damping(law, e);
      const double exact = contact_restitution(d);
      for (const Throw& a : kThrows) {
        for (const double n : {1.0, 1.5, 2.2}) {
          const Rebound r = rebound(contact(a.stiffness, n, d), n == 1.5, a, 4000);
          EXPECT_NEAR(r.restitution, exact, 1e-6) << "e " << e << ", n " << n;
        }
      }
    }
  }
}

TEST(NormalContact, An_impact_loses_the_kinetic_energy_that_does_not_come_back) {
  for (const ContactLaw law : kLaws) {
    for (const double e : {0.1, 0.5, 0.9}) {
      const double d = contact_damping(law, e), ratio = contact_restitution(d);
      for (const Throw& a : kThrows) {
        const double energy = 0.5 * a.mass * a.speed * a.speed;
        const Rebound r = rebound(contact(a.stiffness, 1.5, d), true, a, 4000);
        EXPECT_NEAR(r.lost / energy, 1.0 - ratio * ratio, 2e-6) << e;
        EXPECT_LT(r.gap / energy, 1e-7) << e;  // at every step of the impact
      }
    }
  }
}

TEST(NormalContact, Without_loss_the_depth_is_that_of_energy_and_the_duration_that_of_hertz) {
  const Throw a{1.0, 1.0, 2.1446e10};
  const Rebound r = rebound(contact(a.stiffness, 1.5, 0.0), true, a, 20000);
  const double depth = std::pow(2.5 * 0.5 * a.mass * a.speed * a.speed / a.stiffness, 0.4);
  EXPECT_NEAR(r.deepest / depth, 1.0, 1e-7);
  EXPECT_NEAR(r.restitution, 1.0, 1e-10);
  EXPECT_NEAR(r.duration * a.speed / depth, 2.943275, 1e-5);  // 2 integral of (1 - x^2.5)^-1/2
}

TEST(NormalContact, The_rebound_converges_as_steps_get_smaller) {
  const double d = contact_damping(ContactLaw::lankarani_nikravesh, 0.5);
  const double exact = contact_restitution(d);
  double last = 1.0;
  for (const int steps : {20, 80, 320, 1280}) {
    const Rebound r = rebound(contact(1e8, 1.5, d), true, kThrows[1], steps);
    const double error = std::fabs(r.restitution - exact);
    EXPECT_LT(error, 0.25 * last) << steps;
    last = error;
  }
  EXPECT_LT(last, 1e-6);
}

// Hunt and Crossley 1975: their law is exact to first order in 1 - e. Expanding the closed
// relation, e* = 1 - 2/3 D + 4/9 D^2 - ..., the next term is (1 - e)^2, and 3/2 (1 - e)^2 for
// Lankarani and Nikravesh.
TEST(NormalContact, Hunt_Crossley_and_Lankarani_Nikravesh_are_right_for_nearly_elastic_impacts) {
  for (const double x : {1e-2, 1e-3}) {
    const double e = 1.0 - x;
    EXPECT_NEAR((obtained(ContactLaw::hunt_crossley, e) - e) / (x * x), 1.0, 2.0 * x);
    EXPECT_NEAR((obtained(ContactLaw::lankarani_nikravesh, e) - e) / (x * x), 1.5, 4.0 * x);
  }
}

// Flores, Machado, Silva, Martins 2011 offer their law for the whole range, from soft to hard; the
// two others cannot reach low restitutions at all.
TEST(NormalContact, Flores_stays_near_the_restitution_asked_for_over_the_whole_range) {
  double worst = 0.0;
  for (int k = 1; k < 100; ++k) {
    const double e = 0.01 * k;
    worst = std::max(worst, std::fabs(obtained(ContactLaw::flores, e) - e));
    if (e > 0.7) continue;
    const double own = std::fabs(obtained(ContactLaw::flores, e) - e);
    EXPECT_LT(own, std::fabs(obtained(ContactLaw::hunt_crossley, e) - e)) << e;
    EXPECT_LT(own, std::fabs(obtained(ContactLaw::lankarani_nikravesh, e) - e)) << e;
  }
  EXPECT_LT(worst, 0.05);  // 0.045 below, at e = 0.24
  EXPECT_GT(worst, 0.04);
  EXPECT_NEAR(obtained(ContactLaw::flores, 1e-3), 0.625e-3, 1e-5);  // 1 / D = 5 e / 8
  EXPECT_GT(obtained(ContactLaw::hunt_crossley, 0.0), 0.45);
  EXPECT_GT(obtained(ContactLaw::lankarani_nikravesh, 0.0), 0.6);
}

TEST(NormalContact, A_contact_never_pulls_and_apart_there_is_no_force) {
  Random random(5);
  for (int k = 0; k < 20000; ++k) {
    const double d = 10.0 + random.within(10.0);
    const NormalContact<double> c = contact(1e9, 1.0 + random.below(3) * 0.5, d);
    const double depth = random.within(1e-4), rate = random.within(3.0);
    const double approach = std::max(0.0, random.within(1.0));
    const bool hertz = c.exponent == 1.5;
    const ContactForce<double> f =
        normal_contact_force(c, hertz, depth, rate, approach, ApproachSpeed::greatest);
    const ContactForce<double> printed = normal_contact_force(c, hertz, depth, rate, approach);
    ASSERT_GE(f.normal, 0.0);
    ASSERT_GE(printed.normal, 0.0);
    ASSERT_EQ(printed.elastic, f.elastic);
    // Slower than it came both are the same; faster, the printed law loses more both ways.
    if (std::fabs(rate) <= std::max(approach, c.least_speed)) {
      ASSERT_EQ(printed.normal, f.normal);
    } else {
      ASSERT_GE((printed.normal - f.normal) * rate, 0.0);
    }
    if (depth <= 0.0) {
      ASSERT_EQ(f.normal, 0.0);
    }
    if (rate > 0.0 && depth > 0.0) {
      ASSERT_GE(f.normal, f.elastic);
    }
    ASSERT_LE(f.normal, (1.0 + d) * f.elastic * (1.0 + 1e-15));
  }
}

TEST(NormalContact, A_body_laid_down_without_speed_feels_a_finite_force) {
  const NormalContact<double> c{1e9, 1.5, 0.75, 1e-3};
  EXPECT_DOUBLE_EQ(normal_contact_force(c, true, 1e-6, 0.0, 0.0).normal, 1e9 * 1e-9);
  EXPECT_DOUBLE_EQ(normal_contact_force(c, true, 1e-6, 5e-4, 0.0).normal, 1.375);
  EXPECT_DOUBLE_EQ(normal_contact_force(c, true, 1e-6, -5e-4, 0.0).normal, 0.625);
  const auto greatest = ApproachSpeed::greatest;
  EXPECT_DOUBLE_EQ(normal_contact_force(c, true, 1e-6, 2.0, 0.0, greatest).normal, 1.75);
  EXPECT_DOUBLE_EQ(normal_contact_force(c, true, 1e-6, 2.0, 0.0).normal, 1501.0);
  EXPECT_DOUBLE_EQ(normal_contact_force(c, true, 1e-6, -2.0, 0.0).normal, 0.0);
}

TEST(NormalContact, The_root_of_hertz_and_the_general_power_give_the_same_force) {
  for (double depth = 1e-12; depth < 1e-2; depth *= 1.7) {
    const NormalContact<double> c = contact(2.1446e10, 1.5, 0.3);
    const double fast = normal_contact_force(c, true, depth, 0.2, 0.5).normal;
    EXPECT_NEAR(normal_contact_force(c, false, depth, 0.2, 0.5).normal / fast, 1.0, 2e-14);
  }
}

// Steel, bearing 5 mm, journal 4 mm: 207 GPa and 0.3 give 2.1446e10 by hand.
TEST(NormalContact, The_stiffness_of_steel_in_steel_is_that_of_hertz) {
  const ContactBody bearing{207e9, 0.3, 5e-3}, journal{207e9, 0.3, 4e-3};
  EXPECT_NEAR(hertz_stiffness(bearing, journal), 2.1446e10, 1e6);
  // Two bodies of one material in a gap of 1 m: 2 E / (3 (1 - nu^2)) sqrt(r_b r_j).
  EXPECT_DOUBLE_EQ(hertz_stiffness({3.0, 0.5, 5.0}, {3.0, 0.5, 4.0}), std::sqrt(20.0) * 8.0 / 3.0);
  // A rigid journal leaves the compliance of the bearing alone.
  EXPECT_NEAR(hertz_stiffness(bearing, {1e30, 0.3, 4e-3}) / hertz_stiffness(bearing, journal), 2.0,
              1e-12);
}

TEST(NormalContact, The_speed_at_the_crossing_is_exact_under_constant_acceleration) {
  Random random(6);
  for (int k = 0; k < 2000; ++k) {
    const double v0 = 1.0 + random.within(0.9), a = random.within(9.81);
    const double h = 0.01 * (1.5 + random.within(1.0));
    const double depth = v0 * h + 0.5 * a * h * h;              // travelled in the step
    const double begin = -depth * (0.5 + random.within(0.49));  // depth before it
    const double exact = std::sqrt(v0 * v0 - 2.0 * a * begin);
    EXPECT_NEAR(crossing_speed(begin, v0, begin + depth, v0 + a * h), exact, 1e-12);
  }
}

TEST(NormalContact, The_speed_at_the_crossing_is_a_number_whatever_the_states) {
  EXPECT_EQ(crossing_speed(0.0, 0.7, 0.0, 0.9), 0.7);     // on the wall already
  EXPECT_EQ(crossing_speed(1e-3, -0.7, 2e-3, 0.9), 0.7);  // inside already
  EXPECT_EQ(crossing_speed(-1e-3, 0.7, -1e-3, 0.9), 0.7);
  EXPECT_NEAR(crossing_speed(-1.0, 0.3, -0.2, 0.6), 0.6, 1e-15);  // not there yet
  EXPECT_EQ(crossing_speed(-1.0, 0.0, 1e-9, 2.0), crossing_speed(-1.0, 0.0, 1e-9, -2.0));
  EXPECT_GE(crossing_speed(-1e-9, 1.0, 1e-3, 0.0), 0.0);
  EXPECT_GE(crossing_speed(-1e-300, 0.0, 1e-300, 0.0), 0.0);
}

TEST(NormalContact, Lanes_of_a_pack_are_contacts_of_their_own) {
  using Lanes = Pack<2, Baseline>;
  Random random(7);
  const auto both = [](double a, double b) {
    Lanes x(a);
    set_lane(x, 1, b);
    return x;
  };
  for (int k = 0; k < 2000; ++k) {
    double depth[2], rate[2], n[2];
    for (int i = 0; i < 2; ++i) {
      depth[i] = random.within(1e-4), rate[i] = random.within(2.0), n[i] = 1.7 + random.within(0.6);
    }
    const NormalContact<Lanes> c{both(1e9, 2e8), both(n[0], n[1]), both(0.1, 1.6), Lanes(1e-3)};
    const Lanes force = normal_contact_force(c, false, both(depth[0], depth[1]),
                                             both(rate[0], rate[1]), both(0.4, 0.0))
                            .normal;
    const NormalContact<double> c0{1e9, n[0], 0.1, 1e-3}, c1{2e8, n[1], 1.6, 1e-3};
    EXPECT_DOUBLE_EQ(lane(force, 0),
                     normal_contact_force(c0, false, depth[0], rate[0], 0.4).normal);
    EXPECT_DOUBLE_EQ(lane(force, 1),
                     normal_contact_force(c1, false, depth[1], rate[1], 0.0).normal);
  }
}

}  // namespace linkstudy::testing::normal_contact_test

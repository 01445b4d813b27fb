// Packs against double: every operation, every lane, on every instruction set of this machine.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

#include "core/base/elementary.h"
#include "core/base/isa.h"
#include "tests/pack/pack_probe_impl.h"
#include "tests/support/random.h"

namespace linkstudy::testing::pack_test {
namespace {

struct Probe {
  InstructionSet isa;
  int lanes;
  ApplyPack apply;
  ApplyLaws laws;
};

std::vector<Probe> probes() {
  std::vector<Probe> found;
  for (const Probe& p : {Probe{InstructionSet::baseline, 1, apply_baseline_one, laws_baseline_one},
                         Probe{InstructionSet::baseline, 2, apply_baseline_all, laws_baseline_all},
                         Probe{InstructionSet::avx2, 1, apply_avx2_one, laws_avx2_one},
                         Probe{InstructionSet::avx2, 4, apply_avx2_all, laws_avx2_all},
                         Probe{InstructionSet::avx512, 1, apply_avx512_one, laws_avx512_one},
                         Probe{InstructionSet::avx512, 8, apply_avx512_all, laws_avx512_all}}) {
    if (machine_has(p.isa)) found.push_back(p);
  }
  return found;
}

// Ordinary numbers, and those that break things.
double draw(Random& random) {
  constexpr double strange[] = {0.0,
                                -0.0,
                                1.0,
                                -1.0,
                                1e300,
                                -1e300,
                                1e-300,
                                std::numeric_limits<double>::infinity(),
                                std::numeric_limits<double>::quiet_NaN()};
  const int i = random.below(40);
  return i < 9 ? strange[i] : random.within(10.0);
}

// Anything from the smallest normal number to the largest.
double positive(Random& random) {
  return std::ldexp(1.5 + random.within(0.5), random.below(2046) - 1022);
}

::testing::AssertionResult same(double x, double y) {
  if (std::isnan(x) && std::isnan(y)) return ::testing::AssertionSuccess();
  if (std::memcmp(&x, &y, sizeof x) == 0) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << x << " is not " << y;
}

void expect_same_as_double(const PackOperands& o, const PackResults& r, bool fused) {
  const auto [a, b, c] = o;
  EXPECT_TRUE(same(r.sum, a + b));
  EXPECT_TRUE(same(r.difference, a - b));
  EXPECT_TRUE(same(r.product, a * b));
  EXPECT_TRUE(same(r.quotient, a / b));
  EXPECT_TRUE(same(r.negated, -a));
  EXPECT_TRUE(same(r.root, std::sqrt(std::fabs(a))));
  EXPECT_TRUE(same(r.absolute, std::fabs(a)));
  EXPECT_TRUE(same(r.least, a < b ? a : b));
  EXPECT_TRUE(same(r.greatest, a > b ? a : b));
  EXPECT_TRUE(same(r.madd, fused ? std::fma(a, b, c) : a * b + c));
  EXPECT_TRUE(same(r.msub, fused ? std::fma(a, b, -c) : a * b - c));
  EXPECT_TRUE(same(r.nmadd, fused ? std::fma(-a, b, c) : c - a * b));
  EXPECT_TRUE(same(r.chosen, a < b ? a : c));
  EXPECT_TRUE(same(r.broadcast, 0.1));
  if (a >= std::numeric_limits<double>::min() && std::isfinite(a)) {
    EXPECT_EQ(r.exponent, std::logb(a));
    EXPECT_EQ(r.fraction, std::scalbn(a, -std::ilogb(a)));
  }
  EXPECT_EQ(r.below, a < b);
  EXPECT_EQ(r.equal, a == b);
  EXPECT_EQ(r.finite, std::isfinite(a));
}

}  // namespace

TEST(Pack, Every_lane_computes_what_a_double_does) {
  for (const Probe& p : probes()) {
    SCOPED_TRACE(std::string(name_of(p.isa)) + ", lanes " + std::to_string(p.lanes));
    Random random(7);
    for (int n = 0; n < 500; ++n) {
      std::vector<PackOperands> in(static_cast<std::size_t>(p.lanes));
      std::vector<PackResults> out(in.size());
      for (PackOperands& o : in) o = {draw(random), draw(random), draw(random)};
      unsigned bits = 0;
      p.apply(in.data(), out.data(), &bits);
      for (std::size_t i = 0; i < in.size(); ++i) {
        expect_same_as_double(in[i], out[i], p.isa != InstructionSet::baseline);
        EXPECT_EQ((bits >> i & 1u) != 0, in[i].a < in[i].b);
      }
      EXPECT_EQ(bits >> p.lanes, 0u);
      if (HasFailure()) return;
    }
  }
}

TEST(Pack, Elementary_functions_are_within_two_units_in_the_last_place_in_every_lane) {
  for (const Probe& p : probes()) {
    Random random(11);
    for (int n = 0; n < 5000; ++n) {
      std::vector<PackOperands> in(static_cast<std::size_t>(p.lanes));
      std::vector<PackResults> out(in.size());
      for (PackOperands& o : in) o = {0.0, 0.0, random.within(1000.0)};
      unsigned bits = 0;
      p.apply(in.data(), out.data(), &bits);
      for (std::size_t i = 0; i < in.size(); ++i) {
        const long double sine = std::sin(static_cast<long double>(in[i].c));
        const long double cosine = std::cos(static_cast<long double>(in[i].c));
        const auto ulp = [](long double x) {
          return std::nextafter(std::fabs(static_cast<double>(x)), 2.0) -
                 std::fabs(static_cast<double>(x));
        };
        ASSERT_LE(std::fabs(out[i].sine - sine), 2.0L * ulp(sine)) << in[i].c;
        ASSERT_LE(std::fabs(out[i].cosine - cosine), 2.0L * ulp(cosine)) << in[i].c;
        const long double exact = std::exp(static_cast<long double>(in[i].c));
        if (in[i].c < -708.0) {
          ASSERT_EQ(out[i].exponential, 0.0);
        } else if (in[i].c > 709.7827) {
          ASSERT_EQ(out[i].exponential, std::numeric_limits<double>::infinity());
        } else {
          const double size = static_cast<double>(exact);
          ASSERT_LE(std::fabs(out[i].exponential - exact),
                    2.0L * (std::nextafter(size, HUGE_VAL) - size));
        }
      }
    }
  }
}

TEST(Pack, Logarithms_and_powers_are_as_exact_in_every_lane_as_they_say) {
  for (const Probe& p : probes()) {
    Random random(17);
    for (int n = 0; n < 5000; ++n) {
      std::vector<PackOperands> in(static_cast<std::size_t>(p.lanes));
      std::vector<PackResults> out(in.size());
      for (PackOperands& o : in) {
        o = {n % 2 == 0 ? positive(random) : 1.0 + random.within(0.9), 0.0, random.within(0.99)};
      }
      unsigned bits = 0;
      p.apply(in.data(), out.data(), &bits);
      for (std::size_t i = 0; i < in.size(); ++i) {
        const long double exact = std::log(static_cast<long double>(in[i].a));
        const double size = std::fabs(static_cast<double>(exact));
        ASSERT_LE(std::fabs(out[i].logarithm - exact), std::nextafter(size, HUGE_VAL) - size);
        const long double power = std::pow(static_cast<long double>(in[i].a), in[i].c);
        ASSERT_LE(std::fabs(out[i].power / power - 1.0L),
                  (1.0L + std::fabs(in[i].c * exact)) * 0x1p-52L);
      }
    }
  }
}

TEST(Pack, Logarithms_and_powers_of_no_positive_number_end_alike_in_every_lane) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Probe& p : probes()) {
    for (const double a : {0.0, -0.0, -2.0, -infinity, infinity, nan, 1e-310}) {
      std::vector<PackOperands> in(static_cast<std::size_t>(p.lanes), {a, 0.0, 1.5});
      std::vector<PackResults> out(in.size());
      unsigned bits = 0;
      p.apply(in.data(), out.data(), &bits);
      for (const PackResults& r : out) {
        EXPECT_TRUE(same(r.logarithm, linkstudy::log(a))) << a;
        EXPECT_TRUE(same(r.power, a > 1.0 ? infinity : 0.0)) << a;
      }
    }
  }
}

TEST(Pack, Sets_with_fused_instructions_agree_on_every_bit_of_elementary_functions) {
  if (!machine_has(InstructionSet::avx512)) GTEST_SKIP() << "no AVX-512 here";
  Random random(13);
  for (int n = 0; n < 2000; ++n) {
    PackOperands in[8];
    PackResults wide[8], narrow[8];
    unsigned bits = 0;
    for (PackOperands& o : in) o = {positive(random), 0.0, random.within(1000.0)};
    apply_avx512_all(in, wide, &bits);
    apply_avx2_all(in, narrow, &bits);
    apply_avx2_all(in + 4, narrow + 4, &bits);
    for (int i = 0; i < 8; ++i) {
      ASSERT_TRUE(same(wide[i].sine, narrow[i].sine));
      ASSERT_TRUE(same(wide[i].cosine, narrow[i].cosine));
      ASSERT_TRUE(same(wide[i].exponential, narrow[i].exponential));
      ASSERT_TRUE(same(wide[i].logarithm, narrow[i].logarithm));
      ASSERT_TRUE(same(wide[i].power, narrow[i].power));
      PackResults one;
      apply_avx512_one(in + i, &one, &bits);
      ASSERT_TRUE(same(wide[i].sine, one.sine));
      ASSERT_TRUE(same(wide[i].exponential, one.exponential));
      ASSERT_TRUE(same(wide[i].logarithm, one.logarithm));
    }
  }
}

TEST(Pack, Laws_of_contact_and_friction_give_in_every_lane_what_they_give_a_double) {
  for (const Probe& p : probes()) {
    SCOPED_TRACE(std::string(name_of(p.isa)) + ", lanes " + std::to_string(p.lanes));
    Random random(19);
    for (int n = 0; n < 2000; ++n) {
      std::vector<PackOperands> in(static_cast<std::size_t>(p.lanes));
      std::vector<LawResults> out(in.size());
      for (PackOperands& o : in) o = {random.within(1e-2), random.within(1.0), random.within(1.0)};
      p.laws(in.data(), out.data());
      for (std::size_t i = 0; i < in.size(); ++i) {
        const LawValues<double> x = law_values(in[i].a, in[i].b, in[i].c);
        EXPECT_NEAR(out[i].normal, x.normal, 1e-13 * x.normal);
        EXPECT_NEAR(out[i].mu, x.mu, 1e-12);  // of terms of size 24
        EXPECT_NEAR(out[i].z_rate, x.z_rate, 1e-13);
        EXPECT_NEAR(out[i].crossing, x.crossing, 1e-13);
      }
      if (HasFailure()) return;
    }
  }
}

TEST(SimdLevel, The_environment_chooses_set_and_lanes_or_is_refused) {
  EXPECT_EQ(choose_simd_level("baseline", nullptr).lanes, 2);
  EXPECT_EQ(choose_simd_level("baseline", "1").lanes, 1);
  EXPECT_EQ(choose_simd_level("baseline", "1").isa, InstructionSet::baseline);
  EXPECT_THROW(choose_simd_level("baseline", "3"), SimdError);
  EXPECT_THROW(choose_simd_level("sse9", nullptr), SimdError);
  const SimdLevel level = choose_simd_level(nullptr, nullptr);
  EXPECT_TRUE(machine_has(level.isa));
  if (!machine_has(InstructionSet::avx512)) {
    EXPECT_THROW(choose_simd_level("avx512", nullptr), SimdError);
  } else {
    EXPECT_EQ(level.isa, InstructionSet::avx512);
    EXPECT_EQ(level.lanes, 8);
  }
}

}  // namespace linkstudy::testing::pack_test

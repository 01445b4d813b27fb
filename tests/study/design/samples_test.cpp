// Sampled designs: strata counted, the published first points of a Sobol sequence, the rules of
// trajectories and blocks, points that stay when a design is extended.
#include "study/design/samples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "study/design/design.h"
#include "study/design/random_stream.h"

namespace linkstudy::testing::samples_test {
namespace {

using ::testing::HasSubstr;
using Unit = std::vector<double>;

DesignOptions samples(Design type, std::uint64_t n, std::uint64_t seed = 1) {
  return {.type = type, .samples = n, .seed = seed};
}

DesignOptions morris(std::uint64_t trajectories, std::uint64_t levels) {
  return {.type = Design::morris, .trajectories = trajectories, .levels = levels, .seed = 5};
}

std::vector<Axis> unit_axes(std::size_t k) {
  std::vector<Axis> axes(k);
  for (std::size_t i = 0; i < k; ++i) {
    axes[i].parameter.path = "x" + std::to_string(i);
    axes[i].distribution = Distribution{Law::lin, 0.0, 1.0};
  }
  return axes;
}

TEST(Samples, Every_stratum_of_every_parameter_of_a_latin_hypercube_has_one_sample) {
  for (const std::uint64_t n : {1u, 2u, 7u, 8u, 12u, 100u, 101u, 1024u, 3000u}) {
    for (const std::uint64_t seed : {1u, 2u, 99u}) {
      std::vector<std::set<std::uint64_t>> strata(4);
      for (std::uint64_t id = 0; id < n; ++id) {
        const Unit u = latin_hypercube_point(samples(Design::latin_hypercube, n, seed), 4, id);
        for (std::size_t i = 0; i < 4; ++i) {
          ASSERT_TRUE(u[i] > 0.0 && u[i] < 1.0);
          strata[i].insert(static_cast<std::uint64_t>(u[i] * static_cast<double>(n)));
        }
      }
      for (const auto& own : strata) EXPECT_EQ(own.size(), n) << "of " << n;
    }
  }
}

TEST(Samples, Twice_as_many_of_a_latin_hypercube_keep_the_earlier_ones) {
  for (const std::uint64_t n : {5u, 12u, 64u}) {
    for (std::uint64_t id = 0; id < n; ++id) {
      const Unit u = latin_hypercube_point(samples(Design::latin_hypercube, n), 3, id);
      for (const std::uint64_t more : {2 * n, 4 * n, 16 * n}) {
        EXPECT_EQ(latin_hypercube_point(samples(Design::latin_hypercube, more), 3, id), u);
      }
    }
  }
}

// Pairs of parameters are independent: correlations of n samples scatter by 1/sqrt(n).
TEST(Samples, Parameters_of_a_latin_hypercube_are_paired_at_random) {
  for (const std::uint64_t n : {999u, 1024u}) {
    double greatest = 0.0;
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      double sum = 0.0;
      for (std::uint64_t id = 0; id < n; ++id) {
        const Unit u = latin_hypercube_point(samples(Design::latin_hypercube, n, seed), 2, id);
        sum += 12.0 * (u[0] - 0.5) * (u[1] - 0.5);
      }
      greatest = std::max(greatest, std::abs(sum / static_cast<double>(n)));
    }
    EXPECT_LT(greatest, 4.0 / std::sqrt(static_cast<double>(n)));
    EXPECT_GT(greatest, 0.1 / std::sqrt(static_cast<double>(n)));
  }
}

TEST(Samples, A_shuffle_reaches_every_place_once) {
  for (std::uint64_t n = 1; n < 70; ++n) {
    std::set<std::uint64_t> places;
    for (std::uint64_t i = 0; i < n; ++i) places.insert(permuted(RandomStream(3, {n}), n, i));
    EXPECT_EQ(places.size(), n);
    EXPECT_EQ(*places.rbegin(), n - 1);
  }
}

// Pearson's statistic over the 24 orders of four, 23 degrees of freedom: above 60 once in 30 000.
TEST(Samples, A_shuffle_has_all_orders_alike) {
  std::map<std::vector<std::uint64_t>, double> counts;
  constexpr int kEach = 500;
  for (std::uint64_t seed = 0; seed < 24u * kEach; ++seed) {
    std::vector<std::uint64_t> order;
    for (std::uint64_t i = 0; i < 4; ++i) order.push_back(permuted(RandomStream(seed, {}), 4, i));
    ++counts[order];
  }
  ASSERT_EQ(counts.size(), 24u);
  double statistic = 0.0;
  for (const auto& [order, count] : counts) statistic += std::pow(count - kEach, 2) / kEach;
  EXPECT_LT(statistic, 60.0);
}

std::uint64_t bits_of(double u) {
  return static_cast<std::uint64_t>(u * 0x1p52);
}

// First points in ten dimensions that S. Joe and F. Kuo print beside their direction numbers
// new-joe-kuo-6.21201 (2008). The zero point of ours is the digital shift.
TEST(Samples, A_sobol_sequence_is_that_of_joe_and_kuo_under_a_shift) {
  const std::vector<Unit> printed = {
      {0, 0, 0, 0, 0, 0, 0, 0, 0, 0},
      {0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5},
      {0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.25, 0.75, 0.75, 0.75},
      {0.25, 0.75, 0.75, 0.75, 0.25, 0.25, 0.75, 0.25, 0.25, 0.25},
      {0.375, 0.375, 0.625, 0.875, 0.375, 0.125, 0.375, 0.875, 0.875, 0.625},
      {0.875, 0.875, 0.125, 0.375, 0.875, 0.625, 0.875, 0.375, 0.375, 0.125},
      {0.625, 0.125, 0.875, 0.625, 0.625, 0.875, 0.125, 0.125, 0.125, 0.375},
      {0.125, 0.625, 0.375, 0.125, 0.125, 0.375, 0.625, 0.625, 0.625, 0.875},
      {0.1875, 0.3125, 0.9375, 0.4375, 0.5625, 0.3125, 0.4375, 0.9375, 0.9375, 0.3125},
      {0.6875, 0.8125, 0.4375, 0.9375, 0.0625, 0.8125, 0.9375, 0.4375, 0.4375, 0.8125}};
  for (const std::uint64_t seed : {1u, 8u}) {
    const DesignOptions design = samples(Design::sobol, 10, seed);
    const Unit shift = sobol_point(design, 10, 0);
    for (std::uint64_t id = 0; id < printed.size(); ++id) {
      const Unit u = sobol_point(design, 10, id);
      for (std::size_t i = 0; i < 10; ++i) {
        EXPECT_EQ(bits_of(u[i]) ^ bits_of(shift[i]), bits_of(printed[id][i])) << id << " " << i;
      }
    }
  }
}

// A digital shift leaves nets nets: of the first 2^m points each elementary interval of 2^-m in one
// dimension has one.
TEST(Samples, The_first_powers_of_two_of_a_sobol_sequence_fill_the_strata) {
  const DesignOptions design = samples(Design::sobol, 256, 17);
  std::vector<std::set<std::uint64_t>> strata(12);
  for (std::uint64_t id = 0; id < 256; ++id) {
    const Unit u = sobol_point(design, 12, id);
    for (std::size_t i = 0; i < 12; ++i) strata[i].insert(bits_of(u[i]) >> 44);
  }
  for (const auto& own : strata) EXPECT_EQ(own.size(), 256u);
}

// The mean of prod (|4 u_i - 2| + i) / (1 + i) is 1: n random samples of it scatter by 0.8 /
// sqrt(n).
TEST(Samples, A_sobol_sequence_integrates_far_better_than_chance) {
  constexpr std::uint64_t n = 4096;
  double sum = 0.0;
  for (std::uint64_t id = 0; id < n; ++id) {
    const Unit u = sobol_point(samples(Design::sobol, n, 2), 5, id);
    double product = 1.0;
    for (std::size_t i = 0; i < 5; ++i) {
      const auto a = static_cast<double>(i);
      product *= (std::abs(4.0 * u[i] - 2.0) + a) / (1.0 + a);
    }
    sum += product;
  }
  EXPECT_NEAR(sum / n, 1.0, 0.1 * 0.8 / std::sqrt(static_cast<double>(n)));
}

TEST(Samples, A_trajectory_moves_every_parameter_once_by_the_same_step_on_the_grid) {
  constexpr std::size_t k = 5;
  for (const std::uint64_t levels : {2u, 4u, 6u}) {
    const double p = static_cast<double>(levels);
    const double delta = p / (2.0 * (p - 1.0));
    std::map<double, int> visits;
    std::set<std::vector<std::size_t>> orders;
    for (std::uint64_t t = 0; t < 400; ++t) {
      std::vector<std::size_t> order;
      for (std::uint64_t s = 0; s <= k; ++s) {
        const Unit u = morris_point(morris(400, levels), k, t * (k + 1) + s);
        for (const double one : u) {
          EXPECT_NEAR(one * (p - 1.0), std::round(one * (p - 1.0)), 1e-12);
          ++visits[one];
        }
        if (s == 0) continue;
        const Unit before = morris_point(morris(400, levels), k, t * (k + 1) + s - 1);
        for (std::size_t i = 0; i < k; ++i) {
          if (u[i] == before[i]) continue;
          EXPECT_NEAR(std::abs(u[i] - before[i]), delta, 1e-12);
          order.push_back(i);
        }
      }
      EXPECT_EQ(std::set(order.begin(), order.end()).size(), k);
      EXPECT_EQ(order.size(), k);
      orders.insert(order);
    }
    EXPECT_GT(orders.size(), 100u);  // of 120
    // Every level is as likely: 12000 numbers, of which 1/levels with a deviation below 3 %.
    ASSERT_EQ(visits.size(), levels);
    for (const auto& [level, count] : visits) EXPECT_NEAR(count * p / 12000.0, 1.0, 0.15);
  }
}

TEST(Samples, A_block_has_both_points_and_each_with_one_number_of_the_other) {
  constexpr std::size_t k = 3;
  const DesignOptions design = samples(Design::saltelli, 8);
  std::set<double> numbers;
  for (std::uint64_t block = 0; block < 8; ++block) {
    const auto point = [&](std::uint64_t member) {
      return saltelli_point(design, k, block * (k + 2) + member);
    };
    const Unit a = point(0), b = point(k + 1);
    for (std::size_t i = 0; i < k; ++i) {
      Unit mixed = a;
      mixed[i] = b[i];
      EXPECT_EQ(point(1 + i), mixed);
      EXPECT_NE(a[i], b[i]);
    }
    Unit both = a;
    both.insert(both.end(), b.begin(), b.end());
    EXPECT_EQ(both, sobol_point(design, 2 * k, block));
  }
}

TEST(Samples, Points_are_functions_of_seed_and_id_and_stay_when_a_design_is_extended) {
  const std::vector<Axis> axes = unit_axes(4);
  const std::vector<std::pair<DesignOptions, DesignOptions>> pairs = {
      {samples(Design::sobol, 37), samples(Design::sobol, 90)},
      {samples(Design::saltelli, 7), samples(Design::saltelli, 20)},
      {samples(Design::latin_hypercube, 25), samples(Design::latin_hypercube, 50)},
      {morris(6, 4), morris(11, 4)}};
  for (const auto& [few, many] : pairs) {
    const std::vector<Point> short_list = make_points(few, axes);
    const std::vector<Point> long_list = make_points(many, axes);
    ASSERT_LT(short_list.size(), long_list.size());
    for (std::size_t i = short_list.size(); i-- > 0;) {
      EXPECT_EQ(short_list[i].id, i);
      EXPECT_EQ(short_list[i].values, long_list[i].values);
      EXPECT_EQ(make_point(few, axes, i).values, short_list[i].values);
    }
    DesignOptions other = few;
    other.seed = 77;
    EXPECT_NE(make_points(other, axes).front().values, short_list.front().values);
  }
}

TEST(Samples, Follow_the_distributions_of_their_axes) {
  std::vector<Axis> axes = unit_axes(2);
  axes[0].distribution = Distribution{Law::log, 1.0e2, 1.0e6};
  axes[1].distribution = Distribution{.law = Law::normal, .mean = 3.0, .deviation = 0.5};
  const DesignOptions design = samples(Design::latin_hypercube, 500);
  double decades = 0.0, mean = 0.0, squares = 0.0;
  for (const Point& point : make_points(design, axes)) {
    decades += std::log10(std::get<double>(point.values[0])) / 500.0;
    mean += std::get<double>(point.values[1]) / 500.0;
    squares += std::pow(std::get<double>(point.values[1]) - 3.0, 2) / 500.0;
  }
  // One sample a stratum: what is left is the place within it.
  EXPECT_NEAR(decades, 4.0, 4.0 / 500.0);
  EXPECT_NEAR(mean, 3.0, 0.5 / 100.0);
  EXPECT_NEAR(std::sqrt(squares), 0.5, 0.5 / 50.0);
}

TEST(Samples, Refuse_what_cannot_be_sampled) {
  const auto message_of = [](const DesignOptions& design, const std::vector<Axis>& axes) {
    try {
      count_points(design, axes);
    } catch (const std::invalid_argument& reason) {
      return std::string(reason.what());
    }
    return std::string("nothing");
  };
  EXPECT_THAT(message_of(samples(Design::sobol, 4), {}), HasSubstr("nothing to sample"));
  EXPECT_THAT(message_of(samples(Design::sobol, 4), {make_axis({"k", "", ""}, {1.0, 2.0})}),
              HasSubstr("'k' has no values"));
  EXPECT_THAT(message_of(samples(Design::saltelli, 90'000'000), unit_axes(3)),
              HasSubstr("90000000 x 5 points are more than"));
  EXPECT_THAT(message_of(samples(Design::saltelli, 2), unit_axes(2000)),
              HasSubstr("points of 4000 numbers are longer"));
  EXPECT_EQ(count_points(samples(Design::sobol, 2), unit_axes(2000)), 2u);
}

}  // namespace
}  // namespace linkstudy::testing::samples_test

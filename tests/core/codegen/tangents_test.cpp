// Derivatives of graphs against those worked out by hand, and against differences.
#include "core/codegen/tangents.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "core/base/elementary.h"
#include "core/codegen/traced.h"
#include "tests/support/derivatives.h"

namespace linkstudy::testing::tangents_test {
namespace {

using codegen::Graph;
using codegen::Tangents;

Traced input(int slot) {
  return Traced::from(codegen::traced_graph->input(slot));
}

// f'(x) by the graph that f leaves.
double traced_slope(const std::function<Traced(Traced)>& f, double x) {
  Graph graph;
  const codegen::Trace tracing(graph);
  graph.write(f(input(0)).value, 0);
  Tangents tangents(graph, {0});
  EXPECT_TRUE(tangents.update({x}));
  return tangents.derivative(0, 0);
}

}  // namespace

TEST(Tangents, Elementary_functions_have_their_derivatives) {
  for (const double x : {-11.3, -2.0, -0.4, 1e-3, 0.7, 1.4, 3.0, 25.0}) {
    const auto sin = [](Traced a) { return sincos(a).sin; };
    const auto cos = [](Traced a) { return sincos(a).cos; };
    EXPECT_NEAR(traced_slope(sin, x), std::cos(x), 4e-15);
    EXPECT_NEAR(traced_slope(cos, x), -std::sin(x), 4e-15);
    const auto grow = [](Traced a) { return exp(a); };
    EXPECT_NEAR(traced_slope(grow, x) / std::exp(x), 1.0, 4e-15);
    const auto size = [](Traced a) { return abs(a); };
    EXPECT_EQ(traced_slope(size, x), x > 0.0 ? 1.0 : -1.0);
    if (x < 0.0) continue;
    const auto logarithm = [](Traced a) { return log(a); };
    EXPECT_NEAR(traced_slope(logarithm, x) * x, 1.0, 4e-15);
    const auto root = [](Traced a) { return sqrt(a); };
    EXPECT_NEAR(traced_slope(root, x) * 2.0 * std::sqrt(x), 1.0, 4e-15);
    const auto cubed_root = [](Traced a) { return power(a, Traced(1.5)); };
    EXPECT_NEAR(traced_slope(cubed_root, x) / (1.5 * std::sqrt(x)), 1.0, 2e-14);
    const auto angle = [](Traced a) { return quadrant_angle(a, Traced(2.0)); };
    EXPECT_NEAR(traced_slope(angle, x) * (4.0 + x * x) / 2.0, 1.0, 1e-14);
  }
}

TEST(Tangents, Arithmetic_and_choices_follow_the_branch_taken) {
  for (const double x : {-3.0, -0.5, 0.25, 1.5, 4.0}) {
    const double slopes[] = {
        traced_slope([](Traced a) { return (a - Traced(7.0)) / (a * a + Traced(1.0)); }, x),
        traced_slope([](Traced a) { return madd(a, a, -a) + msub(a, Traced(3.0), a * a); }, x),
        traced_slope([](Traced a) { return nmadd(a, a, Traced(2.0)) - max(a, Traced(1.0)); }, x),
        traced_slope([](Traced a) { return min(a * a, Traced(1.0)); }, x),
        traced_slope([](Traced a) { return select(a < Traced(1.0), a * a, sqrt(a - a)); }, x)};
    const double one = x * x + 1.0;
    EXPECT_NEAR(slopes[0], (one - 2.0 * x * (x - 7.0)) / (one * one), 1e-14);
    EXPECT_NEAR(slopes[1], 2.0 * x - 1.0 + 3.0 - 2.0 * x, 1e-14);
    EXPECT_NEAR(slopes[2], -2.0 * x - (x > 1.0 ? 1.0 : 0.0), 1e-14);
    EXPECT_NEAR(slopes[3], x * x < 1.0 ? 2.0 * x : 0.0, 1e-14);
    EXPECT_NEAR(slopes[4], x < 1.0 ? 2.0 * x : 0.0, 1e-14);
  }
}

TEST(Tangents, A_branch_that_is_no_number_leaves_nothing_where_it_is_not_taken) {
  const auto guarded = [](Traced a) { return select(a > Traced(0.0), a, (a - a) / (a - a) * a); };
  EXPECT_EQ(traced_slope(guarded, 2.0), 1.0);
  EXPECT_TRUE(std::isnan(traced_slope(guarded, -2.0)));
}

TEST(Tangents, Corners_have_the_middle_of_both_sides) {
  EXPECT_EQ(traced_slope([](Traced a) { return abs(a); }, 0.0), 0.0);
  EXPECT_EQ(traced_slope([](Traced a) { return sqrt(a * a); }, 0.0), 0.0);
}

TEST(Tangents, Rounding_to_whole_numbers_does_not_vary) {
  const auto whole = [](Traced a) { return (a + Traced(detail::kRound)) - Traced(detail::kRound); };
  EXPECT_EQ(traced_slope(whole, 2.3), 0.0);
  EXPECT_EQ(traced_slope([](Traced a) { return power_of_two(a); }, 3.0), 0.0);
}

TEST(Tangents, Where_the_graph_does_not_hold_nothing_is_known) {
  Graph graph;
  const codegen::Trace tracing(graph);
  const Traced x = input(0);
  graph.require((x > Traced(1.0)).value);
  graph.write((x * x).value, 0);
  Tangents tangents(graph, {0});
  EXPECT_FALSE(tangents.update({0.5}));
  ASSERT_TRUE(tangents.update({3.0}));
  EXPECT_EQ(tangents.derivative(0, 0), 6.0);
  EXPECT_EQ(tangents.value(0), 9.0);
}

// 21 inputs, of which 19 are differentiated: more than are carried along at once.
TEST(Tangents, Many_outputs_of_many_inputs_have_the_slopes_of_differences) {
  constexpr int kInputs = 21, kOutputs = 13;
  Graph graph;
  const codegen::Trace tracing(graph);
  std::mt19937_64 random(7);
  std::vector<Traced> x;
  for (int i = 0; i < kInputs; ++i) x.push_back(input(i));
  const auto any = [&] { return x[random() % x.size()]; };
  for (int i = 0; i < 200; ++i) {
    const Traced a = any(), b = any();
    switch (random() % 4) {
      case 0:
        x.push_back(sincos(a).sin * b);
        break;
      case 1:
        x.push_back(sincos(a + b).cos);
        break;
      case 2:
        x.push_back(a / sqrt(Traced(1.0) + b * b));
        break;
      default:
        x.push_back(madd(sincos(a).cos, sincos(b).sin, Traced(0.5) * any()));
    }
  }
  for (int i = 0; i < kOutputs; ++i) graph.write(any().value, i);
  std::vector<int> varied;
  for (int i = 1; i < kInputs - 1; ++i) varied.push_back(i);
  std::vector<double> at(kInputs);
  for (double& one : at) one = static_cast<double>(random() % 1000) / 500.0 - 1.0;
  Tangents tangents(graph, varied);
  ASSERT_TRUE(tangents.update(at));
  int unlike_zero = 0;
  for (std::size_t k = 0; k < varied.size(); ++k) {
    for (int r = 0; r < kOutputs; ++r) {
      const auto along = [&](double value) {
        std::vector<double> slots = at;
        slots[static_cast<std::size_t>(varied[k])] = value;
        interpret(graph, slots);
        return slots[static_cast<std::size_t>(r)];
      };
      const double expected = slope(along, at[static_cast<std::size_t>(varied[k])], 1e-2);
      const double got = tangents.derivative(r, static_cast<int>(k));
      EXPECT_NEAR(got, expected, 1e-8 * (1.0 + std::fabs(expected)));
      if (got != 0.0) ++unlike_zero;
    }
  }
  EXPECT_GT(unlike_zero, 50);
}

}  // namespace linkstudy::testing::tangents_test

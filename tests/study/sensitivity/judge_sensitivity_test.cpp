// From evaluations to sensitivities: which blocks count for which quantity, and what is said of
// effects that are none, small or told. Values are of functions whose indices are known.
#include "study/sensitivity/judge_sensitivity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "study/config/case_selection.h"
#include "study/design/design.h"
#include "study/sensitivity/sensitivity_tables.h"

namespace linkstudy::testing::judge_sensitivity_test {
namespace {

using namespace linkstudy::sensitivity;
using Function = std::function<double(double x, double y)>;

// Two ranges of width 1 and 10, and two responses; with what every run keeps behind them.
StudyInput input_of(Design type, std::uint64_t blocks) {
  StudyInput input;
  input.name = "test";
  input.design = {.type = type, .samples = blocks, .trajectories = blocks, .seed = 4};
  for (const double width : {1.0, 10.0}) {
    VaryInput& one = input.vary.emplace_back();
    one.parameter.path = width == 1.0 ? "x" : "y";
    one.distribution = Distribution{Law::lin, 0.0, width};
  }
  return input;
}

const std::vector<Response> kResponses = {
    {"first", "N", "max of x"},
    {"second", "1", "max of y"},
    {"gap_max", "m", "largest distance between the two points of a closure"}};

std::map<std::uint64_t, Evaluation> evaluate(const StudyInput& input, const Function& first,
                                             const Function& second) {
  std::map<std::uint64_t, Evaluation> evaluations;
  for (const Point& point : make_points(input.design, axes_of(input))) {
    const double x = std::get<double>(point.values[0]), y = std::get<double>(point.values[1]);
    Evaluation& one = evaluations[point.id];
    one.point = point;
    one.responses = {first(x, y), second(x, y), 0.0};
  }
  return evaluations;
}

// The noise is what another order of operations leaves.
double linear(double x, double y) {
  return 3.0 * x + 7.0 + 1e-15 * std::sin(1e6 * y);
}
double product(double x, double y) {
  return x * y;
}

TEST(JudgeSensitivity, Tells_the_indices_of_each_quantity) {
  const StudyInput input = input_of(Design::saltelli, 1024);
  const Sensitivity found = judge_sensitivity(input, kResponses, evaluate(input, linear, product));
  ASSERT_EQ(found.quantities.size(), 2u);  // what every run keeps is none
  const QuantitySensitivity& first = found.quantities[0];
  EXPECT_EQ(first.name, "first");
  EXPECT_EQ(first.unit, "N");
  EXPECT_EQ(first.blocks, 1024u);
  EXPECT_EQ(first.left_out, 0u);
  EXPECT_NEAR(first.mean, 8.5, 0.01);
  EXPECT_NEAR(first.deviation, 3.0 / std::sqrt(12.0), 0.01);
  EXPECT_NEAR(first.parameters[0].main.value, 1.0, 0.01);
  EXPECT_EQ(first.parameters[0].main.finding, Finding::acts);
  // Rounding is no effect.
  EXPECT_EQ(first.parameters[1].total.value, 0.0);
  EXPECT_EQ(first.parameters[1].total.finding, Finding::none);
  // Of x y: V_x = V_y = 1/48 and V = 7/144 in units of the ranges.
  const QuantitySensitivity& second = found.quantities[1];
  EXPECT_EQ(second.unit, "");
  for (const ParameterSensitivity& own : second.parameters) {
    EXPECT_NEAR(own.main.value, 3.0 / 7.0, 0.02);
    EXPECT_NEAR(own.total.value, 4.0 / 7.0, 0.02);
    EXPECT_TRUE(own.main.interval.contains(own.main.value));
  }
}

TEST(JudgeSensitivity, Tells_the_effects_of_each_quantity) {
  const StudyInput input = input_of(Design::morris, 40);
  const Sensitivity found = judge_sensitivity(input, kResponses, evaluate(input, linear, product));
  const std::vector<ParameterSensitivity>& first = found.quantities[0].parameters;
  EXPECT_NEAR(first[0].main.value, 3.0, 1e-12);
  EXPECT_NEAR(first[0].sigma, 0.0, 1e-12);
  EXPECT_EQ(first[1].total.finding, Finding::none);
  // Effects of x on x y are y: 0, 10/3, 20/3, 10, all as likely.
  const ParameterSensitivity& of_x = found.quantities[1].parameters[0];
  EXPECT_NEAR(of_x.main.value, 5.0, 3.0 * 3.73 / std::sqrt(40.0));
  EXPECT_EQ(of_x.main.value, of_x.total.value);
  EXPECT_NEAR(of_x.sigma, 3.73, 0.8);  // sqrt(5/36) 10
  EXPECT_TRUE(std::isnan(found.quantities[1].mean));
}

TEST(JudgeSensitivity, Counts_complete_blocks_alone_for_each_quantity) {
  for (const Design type : {Design::saltelli, Design::morris}) {
    const StudyInput input = input_of(type, 16);
    const std::uint64_t size = type == Design::morris ? 3 : 4;
    auto evaluations = evaluate(input, linear, product);
    evaluations[3 * size + 1].status = Cause::diverged;
    evaluations[3 * size + 1].responses = {NAN, NAN, NAN};
    evaluations[5 * size].responses[0] = NAN;  // ok, and without this number
    evaluations.erase(15 * size + 2);
    const Sensitivity found = judge_sensitivity(input, kResponses, evaluations);
    EXPECT_EQ(found.quantities[0].blocks, 13u);
    EXPECT_EQ(found.quantities[0].left_out, 3u);
    EXPECT_EQ(found.quantities[1].blocks, 14u);
    EXPECT_EQ(found.quantities[1].left_out, 2u);
    EXPECT_EQ(found.failed, 1u);
    ASSERT_EQ(found.failures.size(), 2u);
    EXPECT_EQ(row_count(make_failure_table(found)), 2u);
    // What is left is as good as the values of the blocks that are complete.
    auto others = evaluations;
    others[3 * size].responses = {1e9, 1e9, 0.0};
    const Sensitivity again = judge_sensitivity(input, kResponses, others);
    EXPECT_EQ(again.quantities[1].parameters[0].main.value,
              found.quantities[1].parameters[0].main.value);
  }
}

TEST(JudgeSensitivity, Says_nothing_of_what_does_not_vary_or_has_too_few_blocks) {
  const StudyInput input = input_of(Design::saltelli, 8);
  auto evaluations = evaluate(
      input, [](double, double) { return 2.0; }, product);
  for (std::uint64_t id = 4; id < 32; ++id) evaluations[id].responses[1] = NAN;
  const Sensitivity found = judge_sensitivity(input, kResponses, evaluations);
  for (const QuantitySensitivity& quantity : found.quantities) {
    for (const ParameterSensitivity& own : quantity.parameters) {
      EXPECT_EQ(own.main.finding, Finding::untold);
      EXPECT_TRUE(std::isnan(own.total.value));
    }
  }
  EXPECT_EQ(found.quantities[1].blocks, 1u);
}

// y adds a thousandth of the variance: 16 blocks do not tell it from 0.
TEST(JudgeSensitivity, What_cannot_be_told_from_zero_has_the_blocks_that_would_tell) {
  const StudyInput input = input_of(Design::saltelli, 16);
  const auto faint = [](double x, double y) { return x * x + 0.003 * y * (1.0 + x); };
  const Sensitivity found = judge_sensitivity(input, kResponses, evaluate(input, faint, product));
  const Estimate& first = found.quantities[0].parameters[1].main;
  ASSERT_EQ(first.finding, Finding::indistinct);
  EXPECT_TRUE(first.interval.contains(0.0));
  EXPECT_GT(first.needed, 0.0);
  EXPECT_TRUE(std::isnan(found.quantities[0].parameters[0].main.needed));
}

}  // namespace
}  // namespace linkstudy::testing::judge_sensitivity_test

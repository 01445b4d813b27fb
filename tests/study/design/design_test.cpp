// Truth: combinations written out by hand, and the row-major formula read backwards.
#include "study/design/design.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "study/record/sequence.h"

namespace linkstudy::design_test {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

Axis words(const std::string& path, std::vector<std::string> values) {
  return {{path, "", ""}, std::vector<Value>(values.begin(), values.end())};
}

Axis numbers(const std::string& path, std::vector<double> values) {
  return make_axis({path, "N/m", ""}, values);
}

TEST(Grid, Runs_its_last_axis_fastest) {
  const auto points =
      make_points({Design::grid}, {words("model", {"cut", "sde"}), numbers("k", {1.0, 2.0, 3.0})});
  const std::vector<std::vector<Value>> expected = {{"cut", 1.0}, {"cut", 2.0}, {"cut", 3.0},
                                                    {"sde", 1.0}, {"sde", 2.0}, {"sde", 3.0}};
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].id, i);
    EXPECT_EQ(points[i].values, expected[i]);
  }
}

TEST(Grid, Holds_every_combination_once_where_the_formula_says) {
  const std::vector<Axis> axes = {numbers("a", linspace(0, 3, 4)), numbers("b", linspace(0, 2, 3)),
                                  numbers("c", linspace(0, 4, 5))};
  std::set<std::vector<Value>> seen;
  for (const Point& point : make_points({Design::grid}, axes)) {
    const double a = std::get<double>(point.values[0]), b = std::get<double>(point.values[1]),
                 c = std::get<double>(point.values[2]);
    EXPECT_EQ(static_cast<double>(point.id), (a * 3 + b) * 5 + c);
    seen.insert(point.values);
  }
  EXPECT_EQ(seen.size(), 60u);
}

TEST(Grid, Of_a_billion_points_is_refused_before_memory_is_asked_for) {
  const std::vector<double> thousand = linspace(1, 1000, 1000);
  const std::vector<Axis> axes = {numbers("a", thousand), numbers("b", thousand),
                                  numbers("closure.S.sde.stiffness", thousand)};
  EXPECT_THAT([&] { make_points({Design::grid}, axes); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("closure.S.sde.stiffness")));
}

TEST(Grid, Whose_size_overflows_64_bits_is_refused) {
  std::vector<Axis> axes;
  for (int i = 0; i < 22; ++i) axes.push_back(numbers(std::to_string(i), linspace(1, 8, 8)));
  EXPECT_THROW(count_points({Design::grid}, axes), std::invalid_argument);  // 8^22 = 2^66
}

TEST(Grid, Of_exactly_the_limit_is_counted) {
  const std::vector<double> ten_thousand = linspace(1, 10000, 10000);
  EXPECT_EQ(count_points({Design::grid}, {numbers("a", ten_thousand), numbers("b", ten_thousand)}),
            100'000'000u);
}

TEST(List, Takes_the_axes_side_by_side) {
  const auto points =
      make_points({Design::list}, {numbers("k", {1e4, 1e5}), words("model", {"sde", "cut"})});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].values, (std::vector<Value>{1e4, "sde"}));
  EXPECT_EQ(points[1].values, (std::vector<Value>{1e5, "cut"}));
  EXPECT_EQ(points[1].id, 1u);
}

TEST(List, Of_unequal_axes_names_both_and_their_lengths) {
  EXPECT_THAT(
      [] {
        make_points({Design::list}, {numbers("step", {1, 2, 3}), numbers("mass", {1, 2})});
      },
      ThrowsMessage<std::invalid_argument>(
          ::testing::AllOf(HasSubstr("'mass' has 2"), HasSubstr("'step' has 3"))));
}

TEST(Designs, Without_axes_are_the_base_model_alone) {
  for (const Design design : {Design::list, Design::grid}) {
    const auto points = make_points({design}, {});
    ASSERT_EQ(points.size(), 1u);
    EXPECT_TRUE(points[0].values.empty());
  }
}

TEST(Designs, Refuse_an_empty_axis_and_a_parameter_varied_twice) {
  for (const Design design : {Design::list, Design::grid}) {
    EXPECT_THROW(make_points({design}, {numbers("a", {})}), std::invalid_argument);
    EXPECT_THROW(make_points({design}, {numbers("a", {1}), numbers("a", {2})}),
                 std::invalid_argument);
  }
}

Axis around(const std::string& path, std::vector<double> values, std::size_t center) {
  Axis axis = numbers(path, std::move(values));
  axis.center = center;
  return axis;
}

TEST(Centered, Begins_at_the_centre_and_moves_one_parameter_at_a_time) {
  const auto points = make_points(
      {Design::centered}, {around("a", {1, 2, 3}, 1), around("b", {10, 20, 30, 40, 50}, 2)});
  const std::vector<std::vector<Value>> expected = {
      {2.0, 30.0}, {1.0, 30.0}, {3.0, 30.0}, {2.0, 10.0}, {2.0, 20.0}, {2.0, 40.0}, {2.0, 50.0}};
  ASSERT_EQ(points.size(), expected.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(points[i].id, i);
    EXPECT_EQ(points[i].values, expected[i]);
  }
}

TEST(Vector, Moves_all_parameters_together) {
  const auto points = make_points(
      {Design::vector}, {numbers("a", linspace(0, 1, 5)), numbers("b", logspace(1, 16, 5))});
  ASSERT_EQ(points.size(), 5u);
  EXPECT_EQ(points[3].values, (std::vector<Value>{0.75, 8.0}));
}

TEST(Designs, Are_found_by_the_name_they_print) {
  for (const Design design : {Design::list, Design::grid})
    EXPECT_EQ(find_word<Design>(name_of(design)), design);
  EXPECT_EQ(find_word<Design>("grdi"), std::nullopt);
}

}  // namespace
}  // namespace linkstudy::design_test

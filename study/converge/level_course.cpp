#include "study/converge/level_course.h"

#include <fmt/format.h>

#include <algorithm>

namespace linkstudy::convergence {
namespace {

double number_of(const Value& value) {
  return std::get<double>(value);
}

// Positions of the values of an axis, coarse to fine.
std::vector<std::size_t> by_fineness(const StudyInput& input, std::size_t axis) {
  const std::vector<Value>& values = input.vary[axis].values;
  std::vector<std::size_t> order(values.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t i) {
    return h_of_size(input.refine[axis].limit, number_of(values[i]));
  });
  return order;
}

std::string shown_value(const VaryInput& vary, std::size_t position) {
  return fmt::format("{} = {:g}{}{}", vary.parameter.path, number_of(vary.values[position]),
                     vary.parameter.unit.empty() ? "" : " ", vary.parameter.unit);
}

}  // namespace

double h_of_size(RefineLimit limit, double size) {
  return limit == RefineLimit::infinity ? 1.0 / size : size;
}

// Ids as design/grid.h counts them: the last axis runs fastest.
std::vector<LevelCourse> list_courses(const StudyInput& input) {
  const std::size_t axes = input.vary.size();
  const std::size_t width = axes > 1 ? input.vary[1].values.size() : 1;
  const auto make = [&](std::size_t axis, std::size_t other) {
    LevelCourse course;
    course.axis = axis;
    for (const std::size_t i : by_fineness(input, axis)) {
      const double size = number_of(input.vary[axis].values[i]);
      course.sizes.push_back(size);
      course.h.push_back(h_of_size(input.refine[axis].limit, size));
      course.ids.push_back(axis == 0 ? i * width + other : other * width + i);
    }
    if (axes > 1) course.at = shown_value(input.vary[1 - axis], other);
    return course;
  };
  std::vector<LevelCourse> courses;
  if (axes == 1) return {make(0, 0)};
  const std::vector<std::size_t> seconds = by_fineness(input, 1);
  for (const std::size_t second : seconds) {
    courses.push_back(make(0, second));
    courses.back().at_finest = second == seconds.back();
  }
  courses.push_back(make(1, by_fineness(input, 0).back()));
  return courses;
}

}  // namespace linkstudy::convergence

#include "core/topology/check_course.h"

#include <cmath>

namespace linkstudy {
namespace {

constexpr double kSameLength = 1.0e-12;  // relative: "360 deg" from -180 deg to 180 deg

// Two columns of one table, the first increasing.
void check_columns(const std::string& first, const std::vector<double>& at,
                   const std::string& second, const std::vector<double>& values,
                   RecordCheck& record) {
  if (at.empty() || at.size() != values.size()) {
    record.report(second,
                  first + " and " + second + " must have the same length, got " +
                      std::to_string(at.size()) + " and " + std::to_string(values.size()),
                  "give one value for each entry of " + first);
  }
  for (std::size_t i = 1; i < at.size(); ++i) {
    if (at[i] > at[i - 1]) continue;
    record.report(first + "." + std::to_string(i),
                  first + " must increase, got " + text_of(at[i]) + " after " + text_of(at[i - 1]),
                  "sort the table by its first column, each entry once");
    break;
  }
  record.require_finite(first, all_finite(at));
  record.require_finite(second, all_finite(values));
}

// Columns and what they go over must be of one kind.
void check_table(const Course& course, RecordCheck& record) {
  if (course.over && course.positions.empty()) {
    return record.report("course.times", "a course over a joint coordinate has no times",
                         "give positions in their place, or leave over out");
  }
  if (!course.over && !course.positions.empty()) {
    return record.report("course.positions",
                         "positions are those of a joint coordinate, and none is named",
                         "add over = { joint = \"...\" }, or give times");
  }
  const bool by_time = !course.over.has_value();
  check_columns(by_time ? "course.times" : "course.positions",
                by_time ? course.times : course.positions, "course.values", course.values, record);
}

// What repeats has room in its period.
void check_period(const Course& course, RecordCheck& record) {
  if (!(*course.period > 0.0)) return record.require_positive("course.period", *course.period);
  const bool is_table = course.shape == CourseShape::table;
  const std::vector<double>& at = course.over ? course.positions : course.times;
  if (is_table && at.size() == 1) {
    return record.report("course.period", "a table of one entry has nothing to repeat",
                         "leave period out");
  }
  const double length = !is_table ? course.duration : at.empty() ? 0.0 : at.back() - at.front();
  if (!(length > *course.period * (1.0 + kSameLength))) return;
  record.report(
      "course.period",
      std::string("period must be at least ") +
          (is_table ? "the length of the table, " : "duration, ") + text_of(length) + ", got " +
          text_of(*course.period),
      "after period the course begins again; it jumps where it does not end as it begins");
}

}  // namespace

void check_course(const Course& course, RecordCheck& record) {
  if (course.period) check_period(course, record);
  if (course.shape == CourseShape::table) return check_table(course, record);
  record.require_finite("course.value", std::isfinite(course.value));
  if (course.shape != CourseShape::constant) {
    record.require_positive("course.duration", course.duration);
  }
}

void check_curve(const ForceCurve& curve, const CurveKeys& keys, RecordCheck& record) {
  check_columns(keys.at, curve.at, keys.force, curve.force, record);
  if (curve.at.size() != 1) return;
  record.report(keys.at, keys.at + " needs two points or more, got 1",
                "give a second point; beyond the last the force stays what it is");
}

}  // namespace linkstudy

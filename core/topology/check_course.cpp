#include "core/topology/check_course.h"

#include <cmath>

namespace linkstudy {
namespace {

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

}  // namespace

void check_course(const Course& course, RecordCheck& record) {
  if (course.shape == CourseShape::table) {
    check_columns("course.times", course.times, "course.values", course.values, record);
    return;
  }
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

#include "core/topology/record_check.h"

#include <cmath>
#include <cstdio>

#include "core/topology/check_values.h"

namespace linkstudy {
namespace {

constexpr double kUnitTolerance = 1.0e-6;

}  // namespace

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

std::string text_of(const Eigen::Vector3d& value) {
  return "[" + text_of(value.x()) + ", " + text_of(value.y()) + ", " + text_of(value.z()) + "]";
}

bool all_finite(const std::vector<double>& values) {
  for (const double value : values)
    if (!std::isfinite(value)) return false;
  return true;
}

void RecordCheck::report(const std::string& key, const std::string& message,
                         const std::string& remedy) {
  problems.push_back({path + "." + key, title + ": " + message, remedy});
}

void RecordCheck::require_positive(const std::string& key, double value) {
  if (std::isfinite(value) && value > 0.0) return;
  report(key, key + " must be positive, got " + text_of(value), "give a number above 0");
}

void RecordCheck::require_not_negative(const std::string& key, double value) {
  if (std::isfinite(value) && value >= 0.0) return;
  report(key, key + " must not be negative, got " + text_of(value), "give 0 or more");
}

void RecordCheck::require_finite(const std::string& key, bool finite) {
  if (!finite) report(key, key + " must be finite", "replace NaN and infinity by numbers");
}

void RecordCheck::require_unit(const std::string& key, double norm) {
  if (std::abs(norm - 1.0) <= kUnitTolerance) return;
  report(key, key + " must have length 1, got length " + text_of(norm), "normalise it");
}

void RecordCheck::require_frame(const std::string& key, const Frame& frame) {
  require_finite(key + ".position", frame.position.allFinite());
  const std::string fault = rotation_fault(frame.rotation);
  if (fault.empty()) return;
  report(key + ".rotation", key + ".rotation " + fault,
         "columns are the axes of the frame: right-handed, of length 1, perpendicular");
}

}  // namespace linkstudy

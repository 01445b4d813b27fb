#include "core/topology/check_motion.h"

#include <cmath>

#include "core/topology/record_check.h"

namespace linkstudy {
namespace {

void check_spline(const Motion& motion, RecordCheck& record) {
  const std::vector<double>& t = motion.times;
  if (t.size() < 3 || t.size() != motion.positions.size()) {
    record.report("law.positions",
                  "law.times and law.positions must have the same length, 3 or more, got " +
                      std::to_string(t.size()) + " and " + std::to_string(motion.positions.size()),
                  "give one position for each time");
  }
  if (!t.empty() && t.front() != 0.0) {
    record.report("law.times.0", "law.times must begin with 0, got " + text_of(t.front()),
                  "the motion begins at 0 s");
  }
  for (std::size_t i = 1; i < t.size(); ++i) {
    if (t[i] > t[i - 1]) continue;
    record.report("law.times." + std::to_string(i),
                  "law.times must increase, got " + text_of(t[i]) + " after " + text_of(t[i - 1]),
                  "sort the table by time, each time once");
    break;
  }
  record.require_finite("law.times", all_finite(t));
  record.require_finite("law.positions", all_finite(motion.positions));
}

}  // namespace

void check_motion(const Motion& motion, const std::string& path, std::vector<Problem>& problems) {
  RecordCheck record{path, "motion '" + motion.name + "'", problems};
  if (motion.from) record.require_finite("law.from", std::isfinite(*motion.from));
  switch (motion.law) {
    case MotionLaw::table:
      return check_spline(motion, record);
    case MotionLaw::speed:
      record.require_finite("law.speed", std::isfinite(motion.speed));
      return record.require_not_negative("law.rise", motion.rise);
    case MotionLaw::sine:
      record.require_finite("law.amplitude", std::isfinite(motion.amplitude));
      record.require_finite("law.phase", std::isfinite(motion.phase));
      return record.require_positive("law.frequency", motion.frequency);
    default:
      record.require_finite("law.to", std::isfinite(motion.to));
      return record.require_positive("law.duration", motion.duration);
  }
}

}  // namespace linkstudy

#include "core/kinematics/drive_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/ensure.h"

namespace linkstudy {
namespace {

using Eigen::VectorXd;

MotionNumbers law_of(const DriveCourse& course, double duration) {
  const bool is_table = course.law == MotionLaw::table;
  ensure(course.motion ? course.from.has_value() : is_table || (course.from && course.to),
         "both ends of the course are given");
  if (course.motion) return motion_numbers(*course.motion, *course.from);
  Motion motion;
  motion.law = course.law;
  motion.from = course.from;
  motion.to = course.to.value_or(0.0);
  motion.duration = duration;
  motion.times = course.times;
  motion.positions = course.positions;
  return motion_numbers(motion, 0.0);
}

}  // namespace

DrivePath::DrivePath(std::vector<DriveCourse> courses, double duration)
    : courses_(std::move(courses)), duration_(duration) {
  ensure(duration > 0.0, "the drives take some time");
  for (const DriveCourse& course : courses_) laws_.push_back(law_of(course, duration_));
}

DrivePath DrivePath::straight(const VectorXd& from, const VectorXd& to) {
  std::vector<DriveCourse> courses(static_cast<std::size_t>(from.size()));
  for (std::size_t i = 0; i < courses.size(); ++i) {
    courses[i].from = from[static_cast<Eigen::Index>(i)];
    courses[i].to = to[static_cast<Eigen::Index>(i)];
  }
  return {courses, 1.0};
}

double DrivePath::longest_step() const {
  double longest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < laws_.size(); ++k) {
    const MotionNumbers& law = laws_[k];
    const bool is_straight = law.law == MotionLaw::speed && !law.rises;
    if (is_straight || law.law == MotionLaw::linear) continue;
    longest = std::min(longest, duration_ / 64.0);
    for (std::size_t i = 1; i < law.knots.size(); ++i) {
      longest = std::min(longest, (law.knots[i].begin - law.knots[i - 1].begin) / 8.0);
    }
    // Of a sine every swing counts, of a rise or a way its own time.
    const double rate = law.parameters.rate;
    const bool has_rate = courses_[k].motion && law.law != MotionLaw::table;
    if (has_rate) longest = std::min(longest, (law.law == MotionLaw::sine ? 0.1 : 1.0 / 64) / rate);
  }
  return longest;
}

DriveMotion DrivePath::at(double t) const {
  const auto n = static_cast<Eigen::Index>(courses_.size());
  DriveMotion motion{VectorXd(n), VectorXd(n), VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const MotionNumbers& law = laws_[k];
    const bool goes_on = courses_[k].motion || law.law == MotionLaw::linear;
    const double end = law.knots.empty() ? duration_ : law.knots.back().begin;
    const bool rests = !goes_on && (t < 0.0 || t > end);
    const CoordinateMotion<double> x = law.at(rests ? std::clamp(t, 0.0, end) : t);
    // At the end of a smooth way it is still that of the way.
    const bool jumps = !goes_on && law.law == MotionLaw::smooth;
    const double inside = jumps ? std::min(t, std::nextafter(end, 0.0)) : t;
    motion.position[i] = x.q;
    motion.rate[i] = rests ? 0.0 : x.v;
    motion.second_rate[i] = rests ? 0.0 : law.at(inside).a;
  }
  return motion;
}

}  // namespace linkstudy

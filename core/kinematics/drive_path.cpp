#include "core/kinematics/drive_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <utility>

namespace linkstudy {
namespace {

using Eigen::VectorXd;

// A law, with its derivatives by s.
struct Law {
  double value, first, second;
};

Law evaluate(MotionLaw law, double s) {
  switch (law) {
    case MotionLaw::smooth:
      return {s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s), 6.0 - 12.0 * s};
    case MotionLaw::polynomial_345:
      return {s * s * s * (10.0 + s * (-15.0 + 6.0 * s)), 30.0 * s * s * (1.0 - s) * (1.0 - s),
              60.0 * s * (1.0 - s) * (1.0 - 2.0 * s)};
    default:
      return {s, 1.0, 0.0};
  }
}

}  // namespace

// Natural cubic spline: second derivatives m at the points, zero at both ends, from
//   h_i m_i + 2 (h_i + h_i+1) m_i+1 + h_i+1 m_i+2 = 6 (slope_i+1 - slope_i)
struct DrivePath::Spline {
  explicit Spline(const DriveCourse& course) : t(course.times), p(course.positions), m(t.size()) {
    // Forward elimination of the tridiagonal system, then backward.
    const std::size_t last = t.size() - 1;
    std::vector<double> above(t.size());
    for (std::size_t i = 1; i < last; ++i) {
      const double pivot = 2.0 * (width(i - 1) + width(i)) - width(i - 1) * above[i - 1];
      above[i] = width(i) / pivot;
      m[i] = (6.0 * (slope(i) - slope(i - 1)) - width(i - 1) * m[i - 1]) / pivot;
    }
    for (std::size_t i = last; i-- > 1;) m[i] -= above[i] * m[i + 1];
  }

  double width(std::size_t i) const { return t[i + 1] - t[i]; }
  double slope(std::size_t i) const { return (p[i + 1] - p[i]) / width(i); }

  Law at(double time) const {
    if (time < t.front()) return {p.front(), 0.0, 0.0};
    if (time > t.back()) return {p.back(), 0.0, 0.0};
    const auto above = std::upper_bound(t.begin() + 1, t.end() - 1, time);
    const auto i = static_cast<std::size_t>(above - t.begin()) - 1;
    const double h = width(i), x = time - t[i], jerk = (m[i + 1] - m[i]) / h;
    const double first = slope(i) - h * (2.0 * m[i] + m[i + 1]) / 6.0;
    return {p[i] + x * (first + x * (0.5 * m[i] + x * jerk / 6.0)),
            first + x * (m[i] + 0.5 * x * jerk), m[i] + x * jerk};
  }

  std::vector<double> t, p, m;
};

DrivePath::DrivePath(std::vector<DriveCourse> courses, double duration)
    : courses_(std::move(courses)), duration_(duration) {
  for (const DriveCourse& course : courses_) {
    splines_.push_back(course.law == MotionLaw::table ? std::make_shared<const Spline>(course)
                                                      : nullptr);
  }
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
  for (const DriveCourse& course : courses_) {
    if (course.law == MotionLaw::linear) continue;
    longest = std::min(longest, duration_ / 64.0);
    for (std::size_t i = 1; i < course.times.size(); ++i) {
      longest = std::min(longest, (course.times[i] - course.times[i - 1]) / 8.0);
    }
  }
  return longest;
}

DriveMotion DrivePath::at(double t) const {
  const auto n = static_cast<Eigen::Index>(courses_.size());
  DriveMotion motion{VectorXd(n), VectorXd(n), VectorXd(n)};
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    const DriveCourse& course = courses_[k];
    Law law;
    if (splines_[k]) {
      law = splines_[k]->at(t);
    } else {
      const bool goes_on = course.law == MotionLaw::linear;
      const double s = goes_on ? t / duration_ : std::clamp(t / duration_, 0.0, 1.0);
      const double reach = *course.to - *course.from;
      const Law unit = evaluate(course.law, s);
      const bool rests = !goes_on && (t < 0.0 || t > duration_);
      law = {*course.from + reach * unit.value, rests ? 0.0 : reach * unit.first / duration_,
             rests ? 0.0 : reach * unit.second / (duration_ * duration_)};
    }
    motion.position[i] = law.value;
    motion.rate[i] = law.first;
    motion.second_rate[i] = law.second;
  }
  return motion;
}

}  // namespace linkstudy

#include "core/kinematics/drive_path.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <unsupported/Eigen/Splines>
#include <utility>

namespace linkstudy {
namespace {

using Eigen::Index;
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

struct DrivePath::Spline {
  using Curve = Eigen::Spline<double, 1, Eigen::Dynamic>;

  explicit Spline(const DriveCourse& course) : end(course.times.back()) {
    const auto count = static_cast<Index>(course.times.size());
    Eigen::RowVectorXd values(count), knots(count);
    for (Index i = 0; i < count; ++i) {
      values[i] = course.positions[static_cast<std::size_t>(i)];
      knots[i] = course.times[static_cast<std::size_t>(i)] / end;
    }
    // Through two or three points there is no cubic.
    const auto degree = std::min<Index>(3, count - 1);
    curve = Eigen::SplineFitting<Curve>::Interpolate(values, degree, knots);
  }

  Law at(double t) const {
    const double x = std::clamp(t / end, 0.0, 1.0);
    const Eigen::Matrix<double, 1, Eigen::Dynamic> d = curve.derivatives(x, 2);
    const bool rests = t < 0.0 || t > end;
    return {d[0], rests ? 0.0 : d[1] / end, rests ? 0.0 : d[2] / (end * end)};
  }

  double end;
  Curve curve;
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
    courses[i].from = from[static_cast<Index>(i)];
    courses[i].to = to[static_cast<Index>(i)];
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
  const Index n = count();
  DriveMotion motion{VectorXd(n), VectorXd(n), VectorXd(n)};
  for (Index i = 0; i < n; ++i) {
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

#include "core/simulation/course_corners.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace linkstudy {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr double kSameTime = 1e-12;   // relative; more than what courses take for rounding
constexpr double kNearCorner = 1e-3;  // of the length of a table

VelocityIndex velocity_of(const Mechanism& m, PositionIndex q) {
  const auto stage =
      std::find_if(m.stages.begin(), m.stages.end(), [q](const Stage& s) { return s.q == q; });
  return stage->v;
}

}  // namespace

CourseCorners::CourseCorners(const Mechanism& m, const Parameters<double>& p) {
  for (const LoadIndex i : indices_of(m.loads)) {
    if (m.loads[i].type != LoadType::resistance) add(m, p, m.loads[i].course, p.loads[i].course);
  }
  for (const PointSpringIndex i : indices_of(m.point_springs)) {
    if (!m.point_springs[i].is_driven) continue;
    add(m, p, m.point_springs[i].course, p.point_springs[i].course);
  }
}

void CourseCorners::add(const Mechanism& m, const Parameters<double>& p, const CourseStructure& s,
                        const CourseParameters<double>& n) {
  if (s.shape != CourseShape::table && !s.repeats) return;
  Corners c{{n.origin},
            s.repeats ? n.period : 0.0,
            s.q,
            s.q.exists() ? velocity_of(m, s.q) : VelocityIndex()};
  for (const SegmentIndex i : indices(s.begin, s.end)) {
    const SegmentParameters<double>& segment = p.segments[i];
    c.at.push_back(segment.begin + segment.length);
  }
  if (n.rate > 0.0) c.at.push_back(1.0 / n.rate);
  if (s.shape == CourseShape::table && s.begin == s.end) return;
  (s.q.exists() ? over_coordinates_ : in_time_).push_back(std::move(c));
}

// To the next corner on one side that is farther away than `least`.
double CourseCorners::distance(const Corners& c, double x, int direction, double least) {
  double nearest = kNever;
  const double whole = c.period > 0.0 ? std::floor((x - c.at.front()) / c.period) : 0.0;
  for (const double turn : {whole - 1.0, whole, whole + 1.0, whole + 2.0}) {
    if (c.period == 0.0 && turn != 0.0) continue;
    for (const double at : c.at) {
      const double way = direction * (at + turn * c.period - x);
      if (way > least) nearest = std::min(nearest, way);
    }
  }
  return nearest;
}

double CourseCorners::next(double t) const {
  double nearest = kNever;
  for (const Corners& c : in_time_) {
    const double least = 2.0 * kSameTime * std::max({std::abs(t), c.at.back(), c.period});
    nearest = std::min(nearest, distance(c, t, 1, least));
  }
  return t + nearest;
}

double CourseCorners::before(double corner) {
  return std::isinf(corner) ? corner : corner - kSameTime * std::abs(corner);
}

double CourseCorners::way_ahead(Positions<const double> q, Velocities<const double> v,
                                Velocities<const double> a) const {
  double longest = kNever;
  for (const Corners& c : over_coordinates_) {
    const double least = kNearCorner * (c.at.back() - c.at.front());
    const double rate = v[c.v], x = q[c.q];
    double way = kNever;
    if (rate >= 0.0) way = std::min(way, distance(c, x, 1, least));
    if (rate <= 0.0) way = std::min(way, distance(c, x, -1, least));
    if (!std::isfinite(way)) continue;
    // |v| h + |a| h^2 / 2 = way
    const double speed = std::abs(rate), change = std::abs(a[c.v]);
    const double divisor = speed + std::sqrt(speed * speed + 2.0 * change * way);
    if (divisor > 0.0) longest = std::min(longest, 2.0 * way / divisor);
  }
  return longest;
}

}  // namespace linkstudy

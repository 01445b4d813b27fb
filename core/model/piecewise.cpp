#include "core/model/piecewise.h"

#include <algorithm>

#include "core/laws/spring_force.h"

namespace linkstudy {
namespace {

// One segment for each interval, from the first value on.
CurveStructure add_segments(const std::vector<double>& at, const std::vector<double>& values,
                            Mechanism& m, Parameters<double>& p) {
  const SegmentIndex begin(m.table_segments);
  CurveStructure s{begin, begin};
  for (std::size_t i = 1; i < at.size(); ++i) {
    const double length = at[i] - at[i - 1];
    p.segments.push_back({at[i - 1], length, (values[i] - values[i - 1]) / length});
    ++s.end;
  }
  m.table_segments = s.end.value();
  return s;
}

// With a point more where it changes sign, and zero on the side where the spring does not act.
ForceCurve acting_curve(const ForceCurve& curve, SpringActs acts) {
  if (acts == SpringActs::both) return curve;
  ForceCurve part;
  const auto add = [&](double at, double force) {
    part.at.push_back(at);
    part.force.push_back(force);
  };
  for (std::size_t i = 0; i < curve.at.size(); ++i) {
    if (i > 0 && curve.force[i - 1] * curve.force[i] < 0.0) {
      const double share = curve.force[i - 1] / (curve.force[i - 1] - curve.force[i]);
      const double zero = curve.at[i - 1] + share * (curve.at[i] - curve.at[i - 1]);
      if (curve.at[i - 1] < zero && zero < curve.at[i]) add(zero, 0.0);
    }
    add(curve.at[i], acting_part(acts, curve.force[i]));
  }
  return part;
}

// Integral of the force from the first point to where it is least: at a point, or where the force
// turns from pushing to pulling within a segment.
double least_energy(const ForceCurve& curve) {
  double least = 0.0, energy = 0.0;
  for (std::size_t i = 1; i < curve.at.size(); ++i) {
    const double length = curve.at[i] - curve.at[i - 1];
    const double from = curve.force[i - 1], to = curve.force[i];
    if (from < 0.0 && to > 0.0) {
      least = std::min(least, energy - 0.5 * from * from * length / (to - from));
    }
    energy += 0.5 * (from + to) * length;
    least = std::min(least, energy);
  }
  return least;
}

}  // namespace

CourseParameters<double> add_course(const Course& course, PositionIndex q, CourseStructure& s,
                                    Mechanism& m, Parameters<double>& p) {
  s.shape = course.shape;
  s.q = q;
  s.repeats = course.period.has_value();
  CourseParameters<double> n{course.value, 0.0, 0.0, course.period.value_or(0.0)};
  if (course.shape == CourseShape::table) {
    const std::vector<double>& at = q.exists() ? course.positions : course.times;
    const CurveStructure table = add_segments(at, course.values, m, p);
    s.begin = table.begin;
    s.end = table.end;
    if (q.exists() && !table.is_linear()) s.bend = BendIndex(m.bent_springs++);
    n.value = course.values.front();
    n.origin = at.front();
    return n;
  }
  const bool rises = course.shape == CourseShape::ramp || course.shape == CourseShape::smooth;
  if (rises && course.duration > 0.0) n.rate = 1.0 / course.duration;
  if (rises && !(course.duration > 0.0)) s.shape = CourseShape::constant;
  return n;
}

CurveParameters<double> add_curve(const ForceCurve& curve, SpringActs acts, CurveStructure& s,
                                  Mechanism& m, Parameters<double>& p) {
  const ForceCurve part = acting_curve(curve, acts);
  s = add_segments(part.at, part.force, m, p);
  return {part.at.front(), part.force.front(), -least_energy(part)};
}

}  // namespace linkstudy

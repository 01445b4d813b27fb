// A piecewise linear force over a length or a coordinate, its slope, and what is stored in it.
#pragma once

#include "core/laws/piecewise_linear.h"
#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

template <class Real>
inline Real curve_force(const CurveStructure& s, const CurveParameters<Real>& n,
                        const Segments<Real>& segments, Real x) {
  Real force = n.value;
  for (const SegmentIndex i : indices(s.begin, s.end)) {
    const SegmentParameters<Real>& g = segments[i];
    force = force + linear_segment(x, g.begin, g.length, g.slope);
  }
  return force;
}

template <class Real>
inline Real curve_slope(const CurveStructure& s, const Segments<Real>& segments, Real x) {
  Real slope(0.0);
  for (const SegmentIndex i : indices(s.begin, s.end)) {
    const SegmentParameters<Real>& g = segments[i];
    slope = slope + linear_segment_slope(x, g.begin, g.length, g.slope);
  }
  return slope;
}

// The integral of the force, exactly.
template <class Real>
inline Real curve_energy(const CurveStructure& s, const CurveParameters<Real>& n,
                         const Segments<Real>& segments, Real x) {
  Real energy = madd(n.value, x - n.begin, n.energy);
  for (const SegmentIndex i : indices(s.begin, s.end)) {
    const SegmentParameters<Real>& g = segments[i];
    energy = energy + linear_segment_integral(x, g.begin, g.length, g.slope);
  }
  return energy;
}

}  // namespace linkstudy

// Rows of cut joints that depend on each other, or nearly so: the way that update_schur_complement
// and solve_schur take where J M^-1 J^T is not definite by a margin (core/numerics/
// redundant_system.h). Here is what the mechanism adds: sizes of rows and velocities, and how much
// independence counts as drift.
//
// Row scale: 1 for a rotation, the closure's lever l for a translation, both the largest rate that
// such a row can have for a relative rate of 1 rad/s, whichever way it points. l^2 is the mean of
// the squared distances of the closure point from the axes that move it. So multipliers are least
// in (l N)^2 + (N m)^2: of one unit, the same in every system of units, however the linkage lies,
// whatever its masses.
#pragma once

#include <algorithm>

#include "core/kinematics/closure_jacobian.h"
#include "core/model/walk.h"

namespace linkstudy {

// Off the closed poses rows that depend on each other do not quite: their independent part grows
// with the gap, and so does what has to count as none. Stages of a Runge-Kutta step lie h^2 off
// even if its ends are closed. Independence below these is not looked at: `least` is that of
// kRankTolerance, by which a start is judged; beyond `most` a gap no longer excuses.
struct DriftTolerance {
  static constexpr double per_gap = 10.0;
  static constexpr double least = 1e-7;
  static constexpr double most = 1e-2;
};

// Levers below this part of the coordinates are rounding of the coordinates, and distances below
// this part of the lever count as that.
inline constexpr double kLeastLever = 1e-3;

// f(k) of the velocities that move the two ends of a closure against each other: on the path of one
// end to ground and not on that of the other.
template <class F>
inline void for_relative_velocities(const Mechanism& m, const ClosureStructure& c, F&& f) {
  VelocityIndex a = c.last_1, b = c.last_2;
  while (a != b) {
    VelocityIndex& last = a > b ? a : b;
    f(last);
    last = m.v_parent[last];
  }
}

template <class Real>
inline Real largest_component(const Vec3<Real>& a) {
  return max(abs(a.x), max(abs(a.y), abs(a.z)));
}

// Distance of a closure point from the axis of a velocity, or of a screw's motion along it if that
// is more; m.
template <class Real>
inline Real distance_from_axis(const Mechanism& m, const Parameters<Real>& p,
                               const Workspace<Real>& w, VelocityIndex k, const Vec3<Real>& point) {
  const Velocity& v = m.velocities[k];
  const Vec3<Real> turned = cross(w.axes[k], point - w.bodies[v.body].p_WB);
  const Real distance = sqrt(dot(turned, turned));
  return v.kind == VelocityKind::screw ? max(distance, abs(p.pitch[v.stage])) : distance;
}

// l of a closure; 0 where nothing turns its ends against each other.
template <class Real>
inline Real closure_lever(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                          ClosureIndex closure) {
  const Vec3<Real>& point = w.closures[closure].p_WS;
  Real square(0.0), extent(0.0);
  int count = 0;
  for_relative_velocities(m, m.closures[closure], [&](VelocityIndex k) {
    const Velocity& v = m.velocities[k];
    if (v.kind == VelocityKind::translation) return;
    const Real distance = distance_from_axis(m, p, w, k, point);
    square = madd(distance, distance, square);
    extent = max(extent, largest_component(w.bodies[v.body].p_WB));
    ++count;
  });
  if (count == 0) return Real(0.0);
  extent = max(extent, largest_component(point));
  return max(sqrt(square / Real(static_cast<double>(count))), Real(kLeastLever) * extent);
}

// Scales of all rows. A closure without a lever, and a coupling of shifts, takes the longest of the
// others, or 1 m.
template <class Real>
inline void update_row_scales(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  Real longest(0.0);
  for (const ClosureIndex c : indices_of(m.closures)) {
    if (storage_of(m.closures[c].model) != RowStorage::cut) continue;
    const Real lever = closure_lever(m, p, w, c);
    longest = max(longest, lever);
    for (const RowIndex r : rows_of(m.closures[c])) w.row_scale[r] = lever;
  }
  for (const CouplingStructure& c : m.couplings) w.row_scale[c.row] = Real(0.0);
  longest = select(longest > Real(0.0), longest, Real(1.0));
  for (const RowIndex r : indices_of(m.cut_rows)) {
    Real& s = w.row_scale[r];
    s = select(s > Real(0.0), s, longest);
    if (measures_turn(m.cut_rows[r].kind)) s = Real(1.0);
  }
}

// Largest part of a unit of row r's scaled rate that velocity k can have.
template <class Real>
inline Real scaled_bound(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w,
                         VelocityIndex k, RowIndex r) {
  const Row& row = m.cut_rows[r];
  const bool slides = m.velocities[k].kind == VelocityKind::translation;
  if (measures_turn(row.kind)) return Real(slides ? 0.0 : 1.0);
  const Real inverse = Real(1.0) / w.row_scale[r];
  if (slides) return inverse;
  const Vec3<Real>& point = w.closures[row.closure].p_WS;
  return max(distance_from_axis(m, p, w, k, point) * inverse, Real(kLeastLever));
}

// Scales of all velocities: with them no entry of the scaled Jacobian exceeds about 1.
template <class Real>
inline void update_velocity_scales(const Mechanism& m, const Parameters<Real>& p,
                                   Workspace<Real>& w) {
  for (const VelocityIndex k : velocities(m)) w.velocity_scale[k] = Real(0.0);
  for (const ClosureIndex c : indices_of(m.closures)) {
    if (storage_of(m.closures[c].model) != RowStorage::cut) continue;
    for_relative_velocities(m, m.closures[c], [&](VelocityIndex k) {
      Real& scale = w.velocity_scale[k];
      for (const RowIndex r : rows_of(m.closures[c])) {
        scale = max(scale, scaled_bound(m, p, w, k, r));
      }
    });
  }
  for (const CouplingStructure& c : m.couplings) {
    for (const TermIndex n : terms_of(c)) {
      Real& scale = w.velocity_scale[m.coupling_terms[n].v];
      scale = max(scale, abs(p.coupling_factors[n]) / w.row_scale[c.row]);
    }
  }
  for (const VelocityIndex k : velocities(m)) {
    Real& scale = w.velocity_scale[k];
    scale = select(scale > Real(0.0), scale, Real(1.0));
  }
}

// Largest gap of a row in its scale.
template <class Real>
inline Real largest_gap(const Mechanism& m, const Workspace<Real>& w) {
  Real gap(0.0);
  for (const RowIndex r : indices_of(m.cut_rows)) {
    gap = max(gap, abs(w.cut_rows[r].d) / w.row_scale[r]);
  }
  return gap;
}

// Factors for the lanes of Workspace::redundant, and the number of their independent rows.
// From Workspace::cut_jacobian.
template <class Real>
inline void factorize_redundant_rows(const Mechanism& m, const Parameters<Real>& p,
                                     Workspace<Real>& w) {
  update_row_scales(m, p, w);
  update_velocity_scales(m, p, w);
  const Real by_gap = Real(DriftTolerance::per_gap) * largest_gap(m, w);
  const Real tolerance = min(max(by_gap, Real(DriftTolerance::least)), Real(DriftTolerance::most));
  RedundantSystem<Real>& system = w.redundant_system;
  const auto copy = [](const auto& from, Real* to) { std::copy_n(from.data(), from.size(), to); };
  copy(w.row_scale, system.row_scale());
  copy(w.cut_jacobian, system.jacobian());
  copy(w.cut_y, system.factor());
  copy(w.velocity_scale, system.column_scale());
  copy(w.inverse_pivot, system.inverse_pivot());
  system.reduce(tolerance);
  system.factorize();
  w.kept_rows = select(w.redundant, system.rank(), w.kept_rows);
}

// Workspace::schur_rhs becomes the multipliers: in the lanes that factorize_redundant_rows did by
// their factors, in the others by solve_others().
template <class Real, class Solve>
inline void solve_beside_redundant_rows(Workspace<Real>& w, Solve&& solve_others) {
  RedundantSystem<Real>& system = w.redundant_system;
  std::copy(w.schur_rhs.begin(), w.schur_rhs.end(), system.right_hand_side());
  system.solve();
  if (!all(w.redundant)) solve_others();
  for (const RowIndex r : indices_of(w.schur_rhs)) {
    Real& lambda = w.schur_rhs[r];
    lambda = select(w.redundant, system.right_hand_side()[r.value()], lambda);
  }
}

}  // namespace linkstudy

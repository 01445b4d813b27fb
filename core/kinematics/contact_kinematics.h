// Where a journal lies in its bearing ([AugUrb18] eqs. (10)-(12), and sec. 4 for skewed axes).
//
// With a and b the axes of bearing and journal (x axes of their closure frames), c a point of the
// bearing's axis and p_j the journal's point, the journal's axis pierces the plane across a at
//   c + X,   X = (p_j - c) + s b,   s = -((p_j - c) . a) / (b . a);   e = -X is the eccentricity.
// Penetration delta = |X| - c_r. With u = X / |X| and w the velocity of the journal at c + X seen
// from the bearing,
//   delta_dot = n . w,   n = u - a (u . b) / (b . a),
// so that a normal force N works with N delta_dot exactly if it acts along n at c + X. Axes that
// are parallel give n = u. Friction acts at the bearing's surface, K = c + r_b u, along t = a x u:
//   v_t = t . w + (r_b - |X|) (omega_j - omega_b) . a
// By [AugUrb18] eq. (17) the journal feels friction at its own surface, K + delta u, and slides
// with delta omega_j . a more (ContactPoints::two). Friction then turns the two bodies together by
// the couple delta mu N, and depends on how fast the frame of reference turns: not the default.
#pragma once

#include "core/kinematics/closure_kinematics.h"

namespace linkstudy {

// The two ends of a clearance. Ground axes.
template <class Real>
struct JournalInBearing {
  Vec3<Real> a, b;              // axes of bearing and journal
  Vec3<Real> bearing, journal;  // closure points, m
  Vec3<Real> v_bearing, v_journal;
  Vec3<Real> omega_bearing, omega_journal;
};

template <class Real>
inline JournalInBearing<Real> journal_in_bearing(const ClearanceStructure& c,
                                                 const ClosureState<Real>& x,
                                                 const BodyState<Real>& first,
                                                 const BodyState<Real>& second) {
  if (c.bearing_first) {
    return {x.R_WF.x, x.R_WS.x, x.p_WF, x.p_WS, x.v_WF, x.v_WS, first.w_WB, second.w_WB};
  }
  return {x.R_WS.x, x.R_WF.x, x.p_WS, x.p_WF, x.v_WS, x.v_WF, second.w_WB, first.w_WB};
}

template <class Real>
struct ContactGeometry {
  Vec3<Real> x;      // X, m
  Vec3<Real> point;  // c + X, m
  Vec3<Real> n;      // delta_dot = n . w
  Vec3<Real> t;      // direction of sliding
  Real arm;          // r_b - |X|, m
  Real depth, rate;  // delta, m; delta_dot, m/s
  Real speed;        // v_t, m/s
};

template <class Real>
inline ContactGeometry<Real> contact_geometry(const JournalInBearing<Real>& j, Real offset,
                                              Real clearance, Real bearing_radius) {
  const Vec3<Real> along = offset * j.a;
  const Vec3<Real> c = j.bearing + along;
  const Vec3<Real> g = j.journal - c;
  // Axes across each other have no such point: far from any contact, but kept finite.
  const Real cosine = dot(j.b, j.a);
  const Real aligned = select(abs(cosine) < Real(1e-3), Real(1e-3), cosine);
  const Vec3<Real> reach = (-dot(g, j.a) / aligned) * j.b;
  ContactGeometry<Real> k;
  k.x = g + reach;
  k.point = c + k.x;
  const Vec3<Real> w = (j.v_journal + cross(j.omega_journal, reach)) -
                       (j.v_bearing + cross(j.omega_bearing, along + k.x));
  const Real length = sqrt(dot(k.x, k.x));
  const auto centred = length < Real(1e-150);
  const Real one(1.0), none(0.0);
  const Vec3<Real> u = select(centred, none, one / select(centred, one, length)) * k.x;
  k.n = u - (dot(u, j.b) / aligned) * j.a;
  k.t = cross(j.a, u);
  k.arm = bearing_radius - length;
  k.depth = length - clearance;
  k.rate = dot(k.n, w);
  k.speed = madd(k.arm, dot(j.omega_journal - j.omega_bearing, j.a), dot(k.t, w));
  return k;
}

// Of one contact of a journal.
template <class Real>
inline ContactGeometry<Real> contact_geometry(const JournalInBearing<Real>& j,
                                              const ContactStructure& contact,
                                              const ClearanceParameters<Real>& n) {
  return contact_geometry(j, Real(contact.side) * n.length, n.radial, n.bearing_radius);
}

// f(clearance, journal in its bearing) after update_kinematics; the pose of its closure is updated.
template <class Real, class F>
inline void for_journals(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w, F&& f) {
  const BodyStates<Real>& bodies = w.bodies;
  for (const ClearanceIndex c : indices_of(m.clearances)) {
    const ClearanceStructure& clearance = m.clearances[c];
    const ClosureStructure& closure = m.closures[clearance.closure];
    ClosureState<Real>& x = w.closures[clearance.closure];
    update_closure_pose(m, closure, p.closures[clearance.closure], bodies, x);
    f(c, journal_in_bearing(clearance, x, bodies[closure.first], bodies[closure.second]));
  }
}

}  // namespace linkstudy

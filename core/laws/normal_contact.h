// Normal force of a body that penetrates another, with the loss of an impact.
//   f = K delta^n (1 + D rate / v0),   never below 0: a contact does not pull
// delta: depth of penetration, m; rate = d delta / dt, m/s, positive while it deepens; v0: speed of
// approach at the start of this contact, m/s. A force that presses the bodies apart is positive.
//   D of a coefficient of restitution e asked for ([AugUrb18] eq. (13) is the first):
//     Lankarani-Nikravesh (1990)       3 (1 - e^2) / 4
//     Flores et al. (2011)             8 (1 - e) / (5 e), infinite at e = 0
//     Hunt-Crossley (1975)             3 (1 - e) / 2
//   The speed ratio e* that a mass really leaves with follows from D alone, for every K, n, mass
//   and speed: with x = rate / v0 the equation of motion separates into x dx / (1 + D x) = -dE / (m
//   v0^2) and elastic work is the same both ways, so
//     D - ln(1 + D) = -D e* - ln(1 - D e*).
// The factor divides by max(v0, least_speed), so that a body at rest laid on another feels a finite
// force. With ApproachSpeed::greatest it divides by max(v0, |rate|, least_speed): then f <= (1 + D)
// K delta^n, and no law pulls. In a free impact, where |rate| never exceeds v0, both are the same.
#pragma once

#include "core/base/elementary.h"
#include "core/laws/contact_law.h"

namespace linkstudy {

// D for the coefficient of restitution asked for, 0 <= restitution <= 1.
double contact_damping(ContactLaw law, double restitution);

// e* of D >= 0, with an error below 1e-11.
double contact_restitution(double damping);

struct ContactBody {
  double young = 0.0;    // E, Pa
  double poisson = 0.0;  // nu
  double radius = 0.0;   // of its cylinder or sphere, m
};

// K = 4 / (3 (h_b + h_j)) sqrt(r_b r_j / (r_b - r_j)), h = (1 - nu^2) / E; N/m^1.5. The radius of
// the bearing must be the larger one.
double hertz_stiffness(const ContactBody& bearing, const ContactBody& journal);

template <class Real>
struct NormalContact {
  Real stiffness;    // K, N/m^n
  Real exponent;     // n
  Real damping;      // D
  Real least_speed;  // m/s
};

template <class Real>
struct ContactForce {
  Real normal;   // f, N
  Real elastic;  // K delta^n, N
};

// v0 of a contact whose approach was `approach`.
template <class Real>
inline Real dividing_speed(ApproachSpeed which, Real approach, Real rate) {
  return which == ApproachSpeed::greatest ? max(approach, abs(rate)) : approach;
}

// hertz: the exponent is 3/2, by a root instead of logarithms. No force at depths below 0.
template <class Real>
inline ContactForce<Real> normal_contact_force(const NormalContact<Real>& c, bool hertz, Real depth,
                                               Real rate, Real approach,
                                               ApproachSpeed which = ApproachSpeed::begin) {
  const Real delta = max(depth, Real(0.0));
  const Real elastic = c.stiffness * (hertz ? delta * sqrt(delta) : power(delta, c.exponent));
  const Real speed = max(dividing_speed(which, approach, rate), c.least_speed);
  const Real factor = max(madd(c.damping, rate / speed, Real(1.0)), Real(0.0));
  return {elastic * factor, elastic};
}

// Energy stored in the contact, J: K delta^(n + 1) / (n + 1), depth >= 0.
template <class Real>
inline Real contact_energy(const NormalContact<Real>& c, Real depth, Real elastic) {
  return elastic * depth / (c.exponent + Real(1.0));
}

// Speed at depth 0 of a body seen at depth0 < 0 and then at depth > 0, under constant acceleration
// between: v_c^2 = rate0^2 + (rate^2 - rate0^2) w, w = -depth0 / (depth - depth0). A body that is
// inside at depth0 already has |rate0|.
template <class Real>
inline Real crossing_speed(Real depth0, Real rate0, Real depth, Real rate) {
  const Real zero(0.0), one(1.0);
  const Real way = depth - depth0;
  const auto outside = (depth0 < zero) && (way > zero);
  const Real part = select(outside, -depth0 / select(outside, way, one), zero);
  const Real square0 = rate0 * rate0;
  const Real square = madd(madd(rate, rate, -square0), min(part, one), square0);
  return sqrt(max(square, zero));
}

}  // namespace linkstudy

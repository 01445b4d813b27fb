// Spatial vectors and inertia in ground axes about the ground origin O, the common origin of the
// step loop: no transforms between links are needed.
//   Motion  (omega, v_O): a point at p moves with v_O + omega x p
//   Force   (n_O, f):     a force f at p has n_O = p x f
//   Inertia (m, h, I_O):  h = m p_C, I_O the rotational inertia about O
// [Featherstone, Rigid Body Dynamics Algorithms, ch. 2]
#pragma once

#include "core/spatial/vector3.h"

namespace linkstudy {

template <class Real>
struct Motion {
  Vec3<Real> angular;
  Vec3<Real> linear;
};

template <class Real>
struct Force {
  Vec3<Real> moment;
  Vec3<Real> force;
};

template <class Real>
struct Inertia {
  Real m;
  Vec3<Real> h;
  Sym3<Real> i;
};

template <class Real>
inline Motion<Real> operator+(const Motion<Real>& a, const Motion<Real>& b) {
  return {a.angular + b.angular, a.linear + b.linear};
}

template <class Real>
inline Motion<Real> operator-(const Motion<Real>& a, const Motion<Real>& b) {
  return {a.angular - b.angular, a.linear - b.linear};
}

template <class Real>
inline Motion<Real> operator*(Real s, const Motion<Real>& a) {
  return {s * a.angular, s * a.linear};
}

// s a + b
template <class Real>
inline Motion<Real> madd(Real s, const Motion<Real>& a, const Motion<Real>& b) {
  return {madd(s, a.angular, b.angular), madd(s, a.linear, b.linear)};
}

template <class Real>
inline Force<Real> operator+(const Force<Real>& a, const Force<Real>& b) {
  return {a.moment + b.moment, a.force + b.force};
}

template <class Real>
inline Force<Real> operator-(const Force<Real>& a, const Force<Real>& b) {
  return {a.moment - b.moment, a.force - b.force};
}

template <class Real>
inline Force<Real> madd(Real s, const Force<Real>& a, const Force<Real>& b) {
  return {madd(s, a.moment, b.moment), madd(s, a.force, b.force)};
}

// Power of a force on a motion.
template <class Real>
inline Real dot(const Motion<Real>& a, const Force<Real>& b) {
  return dot(a.angular, b.moment) + dot(a.linear, b.force);
}

// Rate of a motion vector b that moves with a: a x b.
template <class Real>
inline Motion<Real> cross(const Motion<Real>& a, const Motion<Real>& b) {
  return {cross(a.angular, b.angular), cross(a.angular, b.linear) + cross(a.linear, b.angular)};
}

// Rate of a force vector b that moves with a: a x* b.
template <class Real>
inline Force<Real> cross(const Motion<Real>& a, const Force<Real>& b) {
  return {cross(a.angular, b.moment) + cross(a.linear, b.force), cross(a.angular, b.force)};
}

template <class Real>
inline Force<Real> operator*(const Inertia<Real>& a, const Motion<Real>& b) {
  return {a.i * b.angular + cross(a.h, b.linear), madd(a.m, b.linear, cross(b.angular, a.h))};
}

template <class Real>
inline Inertia<Real> operator+(const Inertia<Real>& a, const Inertia<Real>& b) {
  return {a.m + b.m, a.h + b.h, a.i + b.i};
}

// Velocity of the point at p.
template <class Real>
inline Vec3<Real> velocity_at(const Motion<Real>& v, const Vec3<Real>& p) {
  return v.linear + cross(v.angular, p);
}

// Acceleration of the material point now at p, from the spatial acceleration a = dV/dt about O.
template <class Real>
inline Vec3<Real> acceleration_at(const Motion<Real>& a, const Motion<Real>& v,
                                  const Vec3<Real>& p) {
  return a.linear + cross(a.angular, p) + cross(v.angular, velocity_at(v, p));
}

// Inertia about O of a body with mass m, centre of mass at c, and inertia R i R^T about it.
// m (|c|^2 1 - c c^T) is the parallel-axis term.
template <class Real>
inline Inertia<Real> shift_to_origin(Real m, const Vec3<Real>& c, const Sym3<Real>& about_center) {
  const Vec3<Real> h = m * c;
  const Real hh = dot(h, c);
  const Sym3<Real>& s = about_center;
  return {m,
          h,
          {s.xx + madd(-h.x, c.x, hh), s.yy + madd(-h.y, c.y, hh), s.zz + madd(-h.z, c.z, hh),
           madd(-h.x, c.y, s.xy), madd(-h.x, c.z, s.xz), madd(-h.y, c.z, s.yz)}};
}

// R diag(d) R^T = d.z 1 + (d.x - d.z) r_x r_x^T + (d.y - d.z) r_y r_y^T
template <class Real>
inline Sym3<Real> rotate_diagonal(const Mat3<Real>& r, const Vec3<Real>& d) {
  const Real o(0.0);
  return add_square(add_square(Sym3<Real>{d.z, d.z, d.z, o, o, o}, d.x - d.z, r.x), d.y - d.z, r.y);
}

// R S R^T
template <class Real>
inline Sym3<Real> rotate(const Mat3<Real>& r, const Sym3<Real>& s) {
  const Vec3<Real> a = r * Vec3<Real>{s.xx, s.xy, s.xz};
  const Vec3<Real> b = r * Vec3<Real>{s.xy, s.yy, s.yz};
  const Vec3<Real> c = r * Vec3<Real>{s.xz, s.yz, s.zz};
  const auto entry = [&](Real ri, Real rj, Real rk, Real xa, Real xb, Real xc) {
    return madd(xa, ri, madd(xb, rj, xc * rk));
  };
  return {entry(r.x.x, r.y.x, r.z.x, a.x, b.x, c.x), entry(r.x.y, r.y.y, r.z.y, a.y, b.y, c.y),
          entry(r.x.z, r.y.z, r.z.z, a.z, b.z, c.z), entry(r.x.y, r.y.y, r.z.y, a.x, b.x, c.x),
          entry(r.x.z, r.y.z, r.z.z, a.x, b.x, c.x), entry(r.x.z, r.y.z, r.z.z, a.y, b.y, c.y)};
}

}  // namespace linkstudy

// Wrenches and inertias in ground axes about a point that belongs to the body they are kept for:
// its internal origin. No transform between frames is needed, only shifts of that point.
//   Wrench  (n, f)      moment about the point and force
//   Inertia (m, h, I)   h = m c with c the centre of mass from the point, I about the point
#pragma once

#include "core/spatial/vector3.h"

namespace linkstudy {

template <class Real>
struct Wrench {
  Vec3<Real> moment;
  Vec3<Real> force;
};

template <class Real>
struct Inertia {
  Real m;
  Vec3<Real> h;
  Sym3<Real> i;
};

// Force f at a point `arm` away from the wrench's point, added.
template <class Real>
inline void add_force(Wrench<Real>& w, const Vec3<Real>& arm, const Vec3<Real>& f) {
  w.force = w.force + f;
  w.moment = w.moment + cross(arm, f);
}

template <class Real>
inline void subtract_force(Wrench<Real>& w, const Vec3<Real>& arm, const Vec3<Real>& f) {
  w.force = w.force - f;
  w.moment = w.moment - cross(arm, f);
}

// The same inertia about a point that lies -r away (r from the new point to the old):
// h' = h + m r, I' = I + 2 (g.r) 1 - g r^T - r g^T with g = h + m r / 2.
template <class Real>
inline Inertia<Real> shift_inertia(const Inertia<Real>& a, const Vec3<Real>& r) {
  const Vec3<Real> g = madd(Real(0.5) * a.m, r, a.h);
  const Real xx = g.x * r.x, yy = g.y * r.y, zz = g.z * r.z;
  const Real two(2.0);
  return {a.m,
          madd(a.m, r, a.h),
          {madd(two, yy + zz, a.i.xx), madd(two, xx + zz, a.i.yy), madd(two, xx + yy, a.i.zz),
           nmadd(g.x, r.y, nmadd(g.y, r.x, a.i.xy)), nmadd(g.x, r.z, nmadd(g.z, r.x, a.i.xz)),
           nmadd(g.y, r.z, nmadd(g.z, r.y, a.i.yz))}};
}

template <class Real>
inline void add_inertia(Inertia<Real>& a, const Inertia<Real>& b) {
  a.m = a.m + b.m;
  a.h = a.h + b.h;
  a.i = a.i + b.i;
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

// a 1 + b e e^T for a unit vector e
template <class Real>
inline Sym3<Real> axisymmetric(Real a, Real b, const Vec3<Real>& e) {
  const Real o(0.0);
  return add_square(Sym3<Real>{a, a, a, o, o, o}, b, e);
}

}  // namespace linkstudy

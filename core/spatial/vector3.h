// Vectors and matrices of three-space for the step loop: plain structs of Real, no Eigen.
// A rotation R_AB is held by its columns, the axes of B seen in A.
#pragma once

#include "core/base/real.h"

namespace linkstudy {

template <class Real>
struct Vec3 {
  Real x, y, z;
};

template <class Real>
struct Mat3 {
  Vec3<Real> x, y, z;  // columns
};

// Symmetric matrix.
template <class Real>
struct Sym3 {
  Real xx, yy, zz, xy, xz, yz;
};

template <class Real>
inline Vec3<Real> zero3() {
  return {Real(0.0), Real(0.0), Real(0.0)};
}

template <class Real>
inline Mat3<Real> identity3() {
  const Real o(0.0), e(1.0);
  return {{e, o, o}, {o, e, o}, {o, o, e}};
}

template <class Real>
inline Vec3<Real> operator+(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
inline Vec3<Real> operator-(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real>
inline Vec3<Real> operator*(Real s, const Vec3<Real>& a) {
  return {s * a.x, s * a.y, s * a.z};
}

// s a + b
template <class Real>
inline Vec3<Real> madd(Real s, const Vec3<Real>& a, const Vec3<Real>& b) {
  return {madd(s, a.x, b.x), madd(s, a.y, b.y), madd(s, a.z, b.z)};
}

// s a - b
template <class Real>
inline Vec3<Real> msub(Real s, const Vec3<Real>& a, const Vec3<Real>& b) {
  return {msub(s, a.x, b.x), msub(s, a.y, b.y), msub(s, a.z, b.z)};
}

template <class Real>
inline Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
  return madd(a.x, b.x, madd(a.y, b.y, a.z * b.z));
}

template <class Real>
inline Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
  return {msub(a.y, b.z, a.z * b.y), msub(a.z, b.x, a.x * b.z), msub(a.x, b.y, a.y * b.x)};
}

template <class Real>
inline Vec3<Real> operator*(const Mat3<Real>& m, const Vec3<Real>& a) {
  return madd(a.x, m.x, madd(a.y, m.y, a.z * m.z));
}

template <class Real>
inline Mat3<Real> operator*(const Mat3<Real>& a, const Mat3<Real>& b) {
  return {a * b.x, a * b.y, a * b.z};
}

// m^T a
template <class Real>
inline Vec3<Real> transpose_times(const Mat3<Real>& m, const Vec3<Real>& a) {
  return {dot(m.x, a), dot(m.y, a), dot(m.z, a)};
}

template <class Real>
inline Vec3<Real> operator*(const Sym3<Real>& s, const Vec3<Real>& a) {
  return {madd(s.xx, a.x, madd(s.xy, a.y, s.xz * a.z)),
          madd(s.xy, a.x, madd(s.yy, a.y, s.yz * a.z)),
          madd(s.xz, a.x, madd(s.yz, a.y, s.zz * a.z))};
}

template <class Real>
inline Sym3<Real> operator+(const Sym3<Real>& a, const Sym3<Real>& b) {
  return {a.xx + b.xx, a.yy + b.yy, a.zz + b.zz, a.xy + b.xy, a.xz + b.xz, a.yz + b.yz};
}

// s + w a a^T
template <class Real>
inline Sym3<Real> add_square(const Sym3<Real>& s, Real w, const Vec3<Real>& a) {
  const Vec3<Real> b = w * a;
  return {madd(b.x, a.x, s.xx), madd(b.y, a.y, s.yy), madd(b.z, a.z, s.zz),
          madd(b.x, a.y, s.xy), madd(b.x, a.z, s.xz), madd(b.y, a.z, s.yz)};
}

}  // namespace linkstudy

// Numbers of a linkage in the frames of the Mechanism. With Real a pack of lanes, every lane is
// another case. Units: SI.
#pragma once

#include <vector>

#include "core/laws/lugre_friction.h"
#include "core/laws/normal_contact.h"
#include "core/laws/prescribed_motion.h"
#include "core/model/indices.h"
#include "core/spatial/vector3.h"

namespace linkstudy {

// P is the parent's internal frame, J the joint frame in it, before the joint moves.
template <class Real>
struct BodyParameters {
  Mat3<Real> R_PJ;
  Vec3<Real> p_PJ;     // m
  Real mass;           // kg
  Vec3<Real> moment;   // mass times centre of mass, internal frame, kg m
  Sym3<Real> inertia;  // about the internal origin, internal axes, kg m^2
};

// By stage, m/rad.
template <class Real>
using Pitches = std::type_identity_t<IndexedPointer<StageIndex, const Real>>;

template <class Real>
struct ClosureParameters {
  Mat3<Real> frame_1;  // {1,e} in the internal frame of the first body
  Vec3<Real> point_1;
  Mat3<Real> frame_2;  // {2,e} in the second
  Vec3<Real> point_2;
  Mat3<Real> springs;  // columns: directions of the form three_springs
  Real velocity_gain;  // Baumgarte: 2 alpha, 1/s
  Real position_gain;  // Baumgarte: beta^2, 1/s^2
  Real length;         // of a rod, m; else 0
};

template <class Real>
struct CourseParameters {
  Real value;   // amplitude, or the first of a table, N or N m
  Real rate;    // 1 / duration
  Real origin;  // where a period begins, s, rad or m
  Real period;  // where it repeats
};

template <class Real>
struct LoadParameters {
  CourseParameters<Real> course;
  Real resistance;   // value / v0 or value / v0^2
  Vec3<Real> point;  // internal frame
  Vec3<Real> direction;
};

template <class Real>
struct SegmentParameters {
  Real begin, length, slope;  // of a table course, or a force over a length or coordinate
};

template <class Real>
using Segments = IndexedVector<SegmentIndex, SegmentParameters<Real>>;

template <class Real>
struct SpringParameters {
  Real stiffness, damping;
};

// Where a piecewise linear force begins.
template <class Real>
struct CurveParameters {
  Real begin;   // first point, m or rad
  Real value;   // force there, N or N m
  Real energy;  // stored there, J: the least between the first point and the last is zero
};

template <class Real>
struct JointSpringParameters {
  Real stiffness, damping, rest;
  CurveParameters<Real> curve;  // beside stiffness and rest
};

template <class Real>
struct PointSpringParameters {
  Vec3<Real> point_1, point_2;    // internal frames, m
  Real stiffness, damping;        // N/m, N s/m
  Real free_length;               // m
  CurveParameters<Real> curve;    // in place of stiffness and free length
  CourseParameters<Real> course;  // of the actuator
};

template <class Real>
struct ClearanceParameters {
  Real radial;                  // c_r, m
  Real bearing_radius;          // m
  Real length;                  // of the bearing, m
  NormalContact<Real> contact;  // K of one contact: a half where there are two
  LugreParameters<Real> friction;
  Real relaxation;  // of a free bristle: sigma0 / sigma1, 1/s
};

template <class Real>
struct StopParameters {
  Real limit;                   // rad or m
  NormalContact<Real> contact;  // N/m^n or N m/rad^n, rad/s or m/s
  Real damping;                 // b, N s/m or N m s/rad
};

template <class Real>
struct JointFrictionParameters {
  LugreParameters<Real> law;
  Real radius;          // m
  Real inverse_length;  // 1/m; 0: moments are not felt
  Real inverse_radius;  // 1/m, of a prismatic joint; 0: twist is not felt
  Real preload;         // N
};

template <class Real>
struct ConstantFrictionParameters {
  LugreParameters<Real> law;
  std::array<Real, 3> arm;  // of each rate: m of a turn, 1 of a shift
  Real load;                // N
};

template <class Real>
struct Parameters {
  Vec3<Real> gravity;                                     // ground axes
  IndexedVector<BodyIndex, BodyParameters<Real>> bodies;  // [0] unused
  IndexedVector<StageIndex, Real> pitch;                  // m/rad
  IndexedVector<ClosureIndex, ClosureParameters<Real>> closures;
  IndexedVector<RowIndex, SpringParameters<Real>> springs;  // of sde rows
  IndexedVector<LoadIndex, LoadParameters<Real>> loads;
  IndexedVector<JointSpringIndex, JointSpringParameters<Real>> joint_springs;
  IndexedVector<PointSpringIndex, PointSpringParameters<Real>> point_springs;
  IndexedVector<ClearanceIndex, ClearanceParameters<Real>> clearances;
  IndexedVector<StopIndex, StopParameters<Real>> stops;
  IndexedVector<FrictionIndex, JointFrictionParameters<Real>> frictions;
  IndexedVector<ConstantFrictionIndex, ConstantFrictionParameters<Real>> constant_frictions;
  Segments<Real> segments;
  IndexedVector<MotionIndex, MotionParameters<Real>> motions;
  IndexedVector<KnotIndex, KnotParameters<Real>> knots;  // of the tables of motions
  IndexedVector<CouplingIndex, Real> coupling_offsets;   // rad or m
  IndexedVector<TermIndex, Real> coupling_factors;
  IndexedVector<PointIndex, Vec3<Real>> points;  // internal frames, m
};

}  // namespace linkstudy

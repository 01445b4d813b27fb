// Numbers of a linkage in the frames of the Mechanism. With Real a pack of lanes, every lane is
// another case. Units: SI.
#pragma once

#include <vector>

#include "core/laws/lugre_friction.h"
#include "core/laws/normal_contact.h"
#include "core/laws/prescribed_motion.h"
#include "core/spatial/vector3.h"

namespace linkstudy {

template <class Real>
struct BodyParameters {
  Mat3<Real> frame;    // R_PJ: joint frame in the parent's internal frame
  Vec3<Real> origin;   // p_PJ, m
  Real mass;           // kg
  Vec3<Real> moment;   // mass times centre of mass, internal frame, kg m
  Sym3<Real> inertia;  // about the internal origin, internal axes, kg m^2
};

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
  Vec3<Real> gravity;                        // ground axes
  std::vector<BodyParameters<Real>> bodies;  // (nb), [0] unused
  std::vector<Real> pitch;                   // by stage, m/rad
  std::vector<ClosureParameters<Real>> closures;
  std::vector<SpringParameters<Real>> springs;  // (ns)
  std::vector<LoadParameters<Real>> loads;
  std::vector<JointSpringParameters<Real>> joint_springs;
  std::vector<PointSpringParameters<Real>> point_springs;
  std::vector<ClearanceParameters<Real>> clearances;
  std::vector<StopParameters<Real>> stops;
  std::vector<JointFrictionParameters<Real>> frictions;
  std::vector<ConstantFrictionParameters<Real>> constant_frictions;
  std::vector<SegmentParameters<Real>> segments;
  std::vector<MotionParameters<Real>> motions;
  std::vector<KnotParameters<Real>> knots;  // of the tables of motions
  std::vector<Real> coupling_offsets;       // by coupling, rad or m
  std::vector<Real> coupling_factors;       // by term
  std::vector<Vec3<Real>> points;           // chosen points, internal frames, m
};

}  // namespace linkstudy

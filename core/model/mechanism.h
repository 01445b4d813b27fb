// Structure of a linkage, compiled for the step loop: what is connected to what, by index, and
// which entries are trivial. Holds no dimensions; cases of one structure differ in Parameters only
// and may share a Mechanism.
//
// Bodies are numbered 0 (ground), 1 .. nb-1 with parents before children. Each body's internal
// frame is the child frame of its tree joint; frames and inertias of the description are
// re-expressed in it once, so the step loop knows no child frames. Joints are products of the basic
// motions Z1 .. Z6 of [Palcak] (translations and rotations along and about x, y, z), a screw about
// z, or a ball (unit quaternion).
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "core/model/indices.h"
#include "core/topology/linkage.h"

namespace linkstudy {

enum class BasicMotion : std::uint8_t { tx, ty, tz, rx, ry, rz, screw, ball };

struct Stage {
  BasicMotion motion;
  PositionIndex q;  // first; a ball has 4 (w x y z)
  VelocityIndex v;  // first; a ball has 3 (angular velocity in the joint's child frame)
  bool operator==(const Stage&) const = default;
};

// What one velocity (degree of freedom) does to its body.
enum class VelocityKind : std::uint8_t { translation, rotation, screw };

struct Velocity {
  BodyIndex body;
  VelocityKind kind;
  StageIndex stage;      // for the pitch of a screw
  MotionIndex motion{};  // that prescribes it, or none
  bool operator==(const Velocity&) const = default;
};

// How much of a constant vector or rotation is not trivial: what the step loop may skip.
enum class VectorShape : std::uint8_t { zero, along_x, along_y, along_z, general };
// quarter: a signed permutation of the axes (turns by multiples of 90 deg).
enum class RotationShape : std::uint8_t { identity, quarter, general };
// Inertia about the internal origin: a 1, a 1 + b e e^T with e an internal axis, or any.
enum class InertiaShape : std::uint8_t { isotropic, about_x, about_y, about_z, general };

// A signed permutation: column i of the result is sign[i] times column axis[i].
struct QuarterTurn {
  std::array<std::int8_t, 3> axis{0, 1, 2};
  std::array<std::int8_t, 3> sign{1, 1, 1};
  bool operator==(const QuarterTurn&) const = default;
};

struct Body {
  BodyIndex parent = kGroundBody;
  StageIndex stage_begin{0}, stage_end{0};
  PositionIndex q_begin{0};
  int q_count = 0;
  VelocityIndex v_begin{0};
  int v_count = 0;
  RotationShape frame = RotationShape::general;  // joint frame in the parent
  QuarterTurn quarter;
  VectorShape offset = VectorShape::general;  // origin of the joint frame in the parent
  VectorShape center = VectorShape::general;  // centre of mass
  InertiaShape inertia = InertiaShape::general;
  bool carries = false;  // has bodies outboard
  bool shifted = true;   // the internal origin is not the parent's
  bool rotates = true;   // angular velocity may differ from zero
  bool gyrates = true;   // angular acceleration for qdd = 0 may differ from zero
  bool operator==(const Body&) const = default;
};

// A scalar direction of a closure: its displacement d, rate, and the wrench that works on it.
//   translation_ground  d = e . (p_WS - p_WF), e a ground axis
//   translation_first   d = e . (p_WS - p_WF), e an axis of {1,e}
//   spring_ground/_first  the same with e a given unit direction
//   line_of_centres     d = |p_WS - p_WF| - length
//   rotation            d = sign * a . b, a an axis of {1,e}, b an axis of {2,e}
//   rotation_vector     d = e . phi, e an axis of {1,e}, phi the rotation vector from it to {2,e}
// or of a coupling of joint coordinates, without a closure and without a wrench:
//   coupling_turn, _shift  d = sum of factor * coordinate - offset, rad or m
enum class RowKind : std::uint8_t {
  translation_ground,
  translation_first,
  spring_ground,
  spring_first,
  line_of_centres,
  rotation,
  rotation_vector,
  coupling_turn,
  coupling_shift
};

// d is an angle or a sine of one, the wrench a couple.
constexpr bool measures_turn(RowKind kind) {
  return kind == RowKind::rotation || kind == RowKind::rotation_vector ||
         kind == RowKind::coupling_turn;
}
constexpr bool is_of_coupling(RowKind kind) {
  return kind == RowKind::coupling_turn || kind == RowKind::coupling_shift;
}

struct Row {
  RowKind kind;
  ClosureIndex closure;      // or none
  int axis;                  // e, or a
  int other = 0;             // b
  double sign = 1;           // of a rotation
  int direction;             // Direction that it stands for (three_springs: number of the spring)
  CouplingIndex coupling{};  // where it is one
  bool operator==(const Row&) const = default;
};

struct ClosureStructure {
  BodyIndex first = kGroundBody, second = kGroundBody;
  ClosureModel model = ClosureModel::cut;
  Stabilization stabilization = Stabilization::none;
  RowIndex row_begin{0}, row_end{0};           // in Mechanism::cut_rows or sde_rows
  VelocityIndex last_1, last_2;                // last velocity on each path to ground, or none
  int support_begin = 0, support_end = 0;      // in Mechanism::support
  bool needs_frames = false;                   // some row uses {1,e} or {2,e}
  bool has_line = false;                       // some row is a line of centres or a rod
  bool is_rod = false;                         // its points are apart
  bool point_rows = false;                     // rows start with the ground axes x y z
  VectorShape point_1 = VectorShape::general;  // closure points in their bodies
  VectorShape point_2 = VectorShape::general;
  bool operator==(const ClosureStructure&) const = default;
};

// Segments of a piecewise linear force; none: the force is linear.
struct CurveStructure {
  SegmentIndex begin{0}, end{0};
  bool is_linear() const { return begin == end; }
  bool operator==(const CurveStructure&) const = default;
};

// What an amplitude goes by.
struct CourseStructure {
  CourseShape shape = CourseShape::constant;
  PositionIndex q;  // coordinate of a table; none: time
  bool repeats = false;
  SegmentIndex begin{0}, end{0};  // of a table
  BendIndex bend{};               // of a table over a coordinate
  bool operator==(const CourseStructure&) const = default;
};

// Spring and damper on one coordinate of a tree joint, and a curve beside them.
struct JointSpring {
  PositionIndex q;
  VelocityIndex v;
  CurveStructure curve{};
  BendIndex bend{};  // of a curve
  bool operator==(const JointSpring&) const = default;
};

// Spring, damper and actuator between a point of each of two bodies.
struct PointSpringStructure {
  BodyIndex first = kGroundBody, second = kGroundBody;
  SpringActs acts = SpringActs::both;
  CurveStructure curve;
  bool is_driven = false;  // has an actuator
  CourseStructure course;
  BendIndex bend{};  // where it changes its stiffness or damping
  bool operator==(const PointSpringStructure&) const = default;
};

// Clearance of a revolute closure: its contacts, and which end is the bearing.
struct ClearanceStructure {
  ClosureIndex closure;
  bool bearing_first;
  bool hertz;  // exponent 3/2
  ApproachSpeed approach = ApproachSpeed::begin;
  ContactPoints points = ContactPoints::one;
  FreeBristle free_bristle = FreeBristle::reset;
  ContactIndex contact_begin, contact_end;  // planar 1, spatial 2
  bool operator==(const ClearanceStructure&) const = default;
};

// One place where a journal can touch its bearing, or a joint its end stop.
struct ContactStructure {
  ClearanceIndex clearance;  // none: of a stop
  double side;               // of the bearing's length, from its middle: 0, -1/2, 1/2
  BristleIndex z{};          // none: no friction
  StopIndex stop{};          // none: of a clearance
  bool operator==(const ContactStructure&) const = default;
};

// An end stop: contact where the coordinate is beyond its limit on one side.
struct StopStructure {
  PositionIndex q;
  VelocityIndex v;
  bool is_high;
  bool hertz;       // exponent 3/2
  bool is_viscous;  // damped by b d' in place of the law of an impact
  ApproachSpeed approach = ApproachSpeed::begin;
  ContactIndex contact;
  bool operator==(const StopStructure&) const = default;
};

// Friction in a tree joint: velocities it brakes (or none), and its first bristle.
struct JointFrictionStructure {
  BodyIndex body;
  VelocityIndex turn{}, slide{};
  BristleIndex z;
  bool operator==(const JointFrictionStructure&) const = default;
};

// Friction in a tree joint under a constant load: rates that rub as a vector, and their bristles.
struct ConstantFrictionStructure {
  BodyIndex body;
  VelocityIndex v;          // first rate
  int count;                // how many
  bool turns = false;       // the first of them
  bool has_angles = false;  // three rates of angles, which rub as the angular velocity
  BristleIndex z;
  bool operator==(const ConstantFrictionStructure&) const = default;
};

// A joint whose reaction is shared with the other joints of its loops.
struct LoopJoint {
  int group = 0;           // loops that have joints in common
  BodyIndex body{};        // that a tree joint carries, or
  ClosureIndex closure{};  // the closure
  bool counts = true;      // false inside a flexible link: takes what the others leave
  bool operator==(const LoopJoint&) const = default;
};

struct LoadStructure {
  LoadType type;
  VelocityIndex v{};  // drive, resistance
  BodyIndex body{};   // link_force, link_torque
  bool follows_link = false;
  CourseStructure course{};
  ResistanceShape law = ResistanceShape::linear;
  bool operator==(const LoadStructure&) const = default;
};

// A coordinate whose motion is prescribed.
struct MotionStructure {
  PositionIndex q;
  VelocityIndex v;
  MotionLaw law;
  bool rises = false;                    // a speed, after a time
  KnotIndex knot_begin{0}, knot_end{0};  // of a table, in Parameters::knots
  MotionSupportIndex support_begin{0}, support_end{0};
  bool operator==(const MotionStructure&) const = default;
};

// Which rows a closure has: multipliers or springs. Clearances keep multipliers for the directions
// that stay blocked.
enum class RowStorage : std::uint8_t { cut, sde };
constexpr RowStorage storage_of(ClosureModel model) {
  return model == ClosureModel::sde ? RowStorage::sde : RowStorage::cut;
}

// A relation between coordinates: one row behind those of the closures.
struct CouplingStructure {
  RowIndex row{0};                         // in MechanismStructure::cut_rows
  TermIndex term_begin{0}, term_end{0};    // in MechanismStructure::coupling_terms
  int support_begin = 0, support_end = 0;  // in MechanismStructure::support
  bool operator==(const CouplingStructure&) const = default;
};
struct CouplingTermStructure {
  PositionIndex q;
  VelocityIndex v;
  bool operator==(const CouplingTermStructure&) const = default;
};

// What decides the step loop: cases that agree in it may share one.
struct MechanismStructure {
  int nq = 0;
  int nv = 0;
  IndexedVector<BodyIndex, Body> bodies;  // (nb), [0] ground
  IndexedVector<StageIndex, Stage> stages;
  // (nv) previous velocity on the path to ground, or none
  IndexedVector<VelocityIndex, VelocityIndex> v_parent;
  IndexedVector<VelocityIndex, Velocity> velocities;  // (nv)
  std::vector<PositionIndex> ball_q;                  // first of every quaternion
  IndexedVector<ClosureIndex, ClosureStructure> closures;
  // (nc) constraint rows, closure by closure, of clearances too
  IndexedVector<RowIndex, Row> cut_rows;
  IndexedVector<RowIndex, Row> sde_rows;  // (ns)
  // By closure and coupling: velocities on the paths of both ends, or of all terms, to ground,
  // descending.
  std::vector<VelocityIndex> support;
  IndexedVector<LoadIndex, LoadStructure> loads;
  IndexedVector<JointSpringIndex, JointSpring> joint_springs;
  IndexedVector<PointSpringIndex, PointSpringStructure> point_springs;
  IndexedVector<ClearanceIndex, ClearanceStructure> clearances;
  IndexedVector<ContactIndex, ContactStructure> contacts;
  IndexedVector<StopIndex, StopStructure> stops;
  IndexedVector<FrictionIndex, JointFrictionStructure> frictions;
  IndexedVector<ConstantFrictionIndex, ConstantFrictionStructure> constant_frictions;
  int nz = 0;  // bristles
  int table_segments = 0;
  IndexedVector<CouplingIndex, CouplingStructure> couplings;
  IndexedVector<TermIndex, CouplingTermStructure> coupling_terms;
  IndexedVector<MotionIndex, MotionStructure> motions;
  // By motion: velocities that carry its body, or that it carries.
  IndexedVector<MotionSupportIndex, VelocityIndex> motion_support;
  int knots = 0;  // of the tables of motions
  int bent_springs = 0;
  bool projects = false;  // some cut closure asks for coordinate projection
  // How redundant reactions are shared (core/dynamics/shared_reactions.h); empty where they are
  // those of the multipliers.
  IndexedVector<LoopJointIndex, LoopJoint> loop_joints;  // those that count first
  // Of all closures with multipliers, idle rows included.
  IndexedVector<LoopRowIndex, Row> loop_rows;

  bool operator==(const MechanismStructure&) const = default;

  int body_count() const { return static_cast<int>(bodies.size()); }
  int cut_row_count() const { return static_cast<int>(cut_rows.size()); }
  int sde_row_count() const { return static_cast<int>(sde_rows.size()); }
  int contact_count() const { return static_cast<int>(contacts.size()); }
  int friction_count() const { return static_cast<int>(frictions.size()); }
};

struct Mechanism : MechanismStructure {
  // Of what is only looked at: chosen points. The step loop does not know them.
  IndexedVector<PointIndex, BodyIndex> point_bodies;

  // Names, for channels and messages only.
  IndexedVector<BodyIndex, std::string> link_names;
  IndexedVector<BodyIndex, std::string> joint_names;  // [0] empty
  IndexedVector<ClosureIndex, std::string> closure_names;
  IndexedVector<PointSpringIndex, std::string> spring_names;
  IndexedVector<MotionIndex, std::string> motion_names;
  IndexedVector<CouplingIndex, std::string> coupling_names;
  IndexedVector<PointIndex, std::string> point_names;
};

// True if cases of a and b may share a step loop (names and chosen points aside).
inline bool same_structure(const MechanismStructure& a, const MechanismStructure& b) {
  return a == b;
}

}  // namespace linkstudy

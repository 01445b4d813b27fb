// A linkage as its designer describes it: links, the joints of a spanning tree, the closures that
// make loops, loads, springs between points, and points to watch. Plain records with names; no
// state and no algorithms. Units: SI and radians. Frames: right-handed, fixed in the link that is
// named beside them. Source: topologies of [AugUrb18] fig. 1; closures of [Urbas16] sec. 2-4.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/laws/contact_law.h"
#include "core/laws/motion_law.h"
#include "core/laws/spring_acts.h"

namespace linkstudy {

// Name of the fixed link. It is never listed among Linkage::links.
inline constexpr const char* kGround = "ground";

// Pose of a frame F in the frame of its owner L: x_L = rotation * x_F + position.
struct Frame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // R_LF
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      // p_LF, m

  bool operator==(const Frame&) const = default;
};

// A beam modelled by rigid finite elements ([AugUrb18] sec. 3): `segments` spring-damping elements
// join segments + 1 rigid elements, the first and the last of half length. Mass, centre and inertia
// of the link stay those of the rigid link, which must be a uniform beam from `begin` to `end`.
// Beam axes: x along the beam, y and z across, y = `across` made perpendicular to x.
struct FlexibleBeam {
  int segments = 4;
  Eigen::Vector3d begin = Eigen::Vector3d::Zero();    // ends of the beam, link frame, m
  Eigen::Vector3d end = Eigen::Vector3d::UnitX();     // link frame, m
  Eigen::Vector3d across = Eigen::Vector3d::UnitY();  // link frame
  double young = 0.0;                                 // E, Pa
  double shear = 0.0;                                 // G, Pa
  double second_moment_y = 0.0;                       // J_y = integral z^2 dA: bending about y, m^4
  double second_moment_z = 0.0;                       // J_z = integral y^2 dA: bending about z, m^4
  double torsion_constant = 0.0;                      // J_t, m^4
  double retardation = 0.0;  // eta / E of Kelvin and Voigt, s: damping = stiffness * this
  // Start: psi, theta, phi of every sde from begin to end (core/flexible), and their rates; held
  // while the rest is assembled. Empty: straight, at rest.
  std::vector<double> position;  // (3 segments) rad
  std::vector<double> velocity;  // (3 segments) rad/s

  bool operator==(const FlexibleBeam&) const = default;
};

// One of the solids that a link is drawn as; it takes no part in the dynamics.
//   cylinder  from the middle of one face, `begin`, to that of the other, `end`
//   box       of `sides` along the axes of `frame`, its middle at the origin
//   sphere    about the origin of `frame`
enum class SolidKind { cylinder, box, sphere };
struct Solid {
  SolidKind kind = SolidKind::cylinder;
  Eigen::Vector3d begin = Eigen::Vector3d::Zero();  // cylinder: link frame, m
  Eigen::Vector3d end = Eigen::Vector3d::UnitX();   // cylinder: link frame, m
  double diameter = 1.0;                            // cylinder, sphere: m
  Eigen::Vector3d sides = Eigen::Vector3d::Ones();  // box: m
  Frame frame;                                      // box, sphere: in the link

  bool operator==(const Solid&) const = default;
};

struct Link {
  std::string name;
  double mass = 0.0;                                         // kg
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  // in the link frame, m
  // About the centre of mass, in axes parallel to the link frame, kg m^2. The off-diagonal entries
  // are those of the matrix, I_xy = -integral(x y dm).
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  std::optional<FlexibleBeam> flexible{};
  std::vector<Solid> shape{};  // none: drawn from joint to joint

  bool operator==(const Link&) const = default;
};

// Motions of a joint's child frame in its parent frame, in the order of its coordinates:
//   revolute     rotation about z                        prismatic   translation along z
//   cylindrical  rotation about z, translation along z   screw       rotation about z, advancing
//   universal    rotation about z, then about the new y  planar      translation x, y, rotation z
//   spherical    rotation z, new y, new x (psi, theta, phi), or a unit quaternion
//   free         translation x, y, z, then as spherical  fixed       none
// Of closures only:
//   pin_in_slot  a point of the second end stays on the x axis of the first, and turns freely
//   rod          the points of both ends stay at a distance: a link without mass between two balls
enum class JointType {
  revolute,
  prismatic,
  cylindrical,
  universal,
  spherical,
  planar,
  free,
  fixed,
  screw,
  pin_in_slot,
  rod
};

// Coordinates of the rotation in a spherical or free joint. zyx: three angles psi, theta, phi with
// R = Rz(psi) Ry(theta) Rx(phi), singular at theta = +-90 deg. quaternion: four positions (w x y z)
// and three velocities, the angular velocity of the child in its own joint axes.
enum class RotationCoordinates { zyx, quaternion };

// LuGre friction in coefficient form ([AugUrb18] eqs. (14)-(15)): friction force mu N with
//   mu = sigma0 z + sigma1 z_dot + sigma2 v,   z_dot = v - sigma0 |v| z / g(v),
//   g(v) = mu_k + (mu_s - mu_k) exp(-(v / v_s)^2);
// with a damping speed v_d > 0 sigma1 is weighted by exp(-(v / v_d)^2).
struct Friction {
  double mu_s = 0.0;    // static coefficient
  double mu_k = 0.0;    // kinetic coefficient
  double v_s = 0.01;    // Stribeck speed, m/s
  double sigma0 = 0.0;  // stiffness of the bristle, 1/m
  double sigma1 = 0.0;  // damping of the bristle, s/m
  double sigma2 = 0.0;  // viscous, s/m
  double v_d = 0.0;     // damping speed, m/s; 0: sigma1 does not depend on speed

  bool operator==(const Friction&) const = default;
};

// What presses the surfaces together: the joint's own reaction and the preload, or the preload
// alone.
enum class FrictionLoad { reaction, constant };

// Friction in a joint. Of a revolute, prismatic or cylindrical one by its own reaction: the joint
// is held at two supports, `length` apart along its axis; with F the reaction force across the axis
// and M the moment across it about the joint origin the normal load is
//   N = preload + |F / 2 + e x M / length| + |F / 2 - e x M / length|    (length 0: preload + |F|),
// and in a prismatic joint |M_axis| / radius more, with radius > 0. Sliding speed: radius * rate of
// turning, rate of translation, both as a vector in a cylindrical joint.
// In any joint that moves by a constant load N = preload (core/forces/constant_friction.h): turns
// are braked at `radius` (universal: each for itself; ball: about the axis of its turn), shifts as
// a vector.
struct JointFriction {
  Friction law;
  FrictionLoad load = FrictionLoad::reaction;
  double radius = 0.0;   // of the sliding surface, m
  double length = 0.0;   // between the supports, m; 0: moments are not felt
  double preload = 0.0;  // N

  bool operator==(const JointFriction&) const = default;
};

// A force piecewise linear over a length or a coordinate, constant beyond the first and the last
// point.
struct ForceCurve {
  std::vector<double> at;     // increasing, m or rad
  std::vector<double> force;  // N or N m

  bool operator==(const ForceCurve&) const = default;
};

// A moment over an angle or a force over a displacement of one coordinate of a joint, generalised
// force -curve(q): positive values at positive coordinates drive it back.
struct JointCurve {
  int coordinate = 0;
  ForceCurve curve;

  bool operator==(const JointCurve&) const = default;
};

// End stops of a joint's coordinates, an entry for each: beyond low and high a contact pushes back
// with f = K d^n (1 + D d' / v0) (core/laws/normal_contact.h) or, where a damping is given,
// f = max(K d^n + b d', 0), d the depth.
struct JointStops {
  std::vector<double> low, high;  // rad or m; empty: none on that side
  std::vector<double> stiffness;  // (nv) K, N/m^n or N m/rad^n; 0: the coordinate has no stops
  double exponent = 1.5;          // n
  ContactLaw law = ContactLaw::lankarani_nikravesh;
  double restitution = 1.0;     // of the law; 1 loses nothing
  std::vector<double> damping;  // (nv) b, N s/m or N m s/rad, in place of law and restitution
  ApproachSpeed approach = ApproachSpeed::begin;
  double least_speed = 1.0e-4;  // rad/s or m/s: floor of the approach speed

  bool operator==(const JointStops&) const = default;
};

// A joint of the spanning tree. X_parent_child = frame * X_joint(q) * child_frame^-1.
struct Joint {
  std::string name;
  JointType type = JointType::revolute;
  RotationCoordinates coordinates = RotationCoordinates::zyx;
  std::string parent;            // a link or kGround
  std::string child;             // a link; every link is the child of exactly one joint
  Frame frame;                   // joint frame in the parent
  Frame child_frame;             // joint frame in the child
  double pitch = 0.0;            // screw: advance per radian, m/rad
  std::vector<double> position;  // (nq) start, possibly approximate; empty: zero (identity)
  std::vector<double> velocity;  // (nv) start; empty: zero
  bool hold = false;             // assembly keeps position and velocity, statics the position
  bool elastic = false;          // of a flexible link: statics bends it though assembly does not
  // Spring and damper on every coordinate, generalised force -c (q - rest) - b v; empty: none.
  // Not for quaternions.
  std::vector<double> stiffness;           // (nv) c, N/m or N m/rad
  std::vector<double> damping;             // (nv) b, N s/m or N m s/rad
  std::vector<double> rest;                // (nv) empty: zero
  std::optional<JointCurve> spring_curve;  // beside them
  std::optional<JointStops> stop;          // not for quaternions
  std::optional<JointFriction> friction;

  bool operator==(const Joint&) const = default;
};

// Number of velocities (degrees of freedom) and of positions of a joint.
int velocity_count(JointType type);
int position_count(JointType type, RotationCoordinates coordinates);

// Directions of a closure: displacement of the second frame {2,e} relative to the first {1,e}.
// Translations x y z, then rotations phi theta psi about x y z. In a closure the axis of a
// revolute, cylindrical or prismatic joint and the normal of a planar joint is the x axis of the
// frames ([Urbas16] sec. 2: c_phi = 0); a universal joint turns about x of the first frame and y of
// the second.
enum Direction { kX, kY, kZ, kPhi, kTheta, kPsi, kDirections };

// How the loop is closed: exactly by multipliers, by a spring-damping element, with clearance.
enum class ClosureModel { cut, sde, clearance };
enum class Stabilization { none, baumgarte, projection };

// Fig. 1 of [Urbas16]: (c) one-direction elements along the axes; (a) one element along the line of
// centres; (b) a system of three elements along three given directions (full 3x3 stiffness).
enum class SdeForm { directional, line_of_centres, three_springs };
enum class SdeAxes { ground, first };
// How a turn of {2,e} in {1,e}, R = R_1^T R_2, is measured about x, y, z. linearized ([Urbas16]
// eq. (12)) and axis: sines of angles, entries of R; alone about one axis the moment of a stiffness
// k is (k/2) sin 2 phi, at most k/2. angle: the rotation vector of R, with the moment k phi and the
// energy k/2 phi^2 up to half a turn.
enum class TiltMeasure { axis, linearized, angle };
// closed: the stiff directions are shut when a run begins. given: they keep the deflection and the
// rate that the joints of the tree give them.
enum class SdeStart { closed, given };

// Spring-damping element, [Urbas16] sec. 2. Arrays are indexed by Direction.
struct Sde {
  SdeForm form = SdeForm::directional;
  SdeAxes axes = SdeAxes::ground;
  TiltMeasure tilt = TiltMeasure::axis;
  SdeStart start = SdeStart::closed;
  std::array<double, kDirections> stiffness{};  // N/m and N m/rad; zero means free
  std::array<double, kDirections> damping{};    // N s/m and N m s/rad; unused with damping_ratio
  // b = 2 zeta sqrt(c m_eff) with m_eff = 1 / max eig(J M^-1 J^T) at the start, separately for the
  // translational and the rotational rows.
  std::optional<double> damping_ratio;
  // form three_springs: unit directions (rows); element i has stiffness[i], damping[i].
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();

  bool operator==(const Sde&) const = default;
};

// Revolute closure with radial clearance ([AugUrb18] sec. 4). The x axis of the bearing end and the
// x axis of the journal end are the axes of the two. planar: axes stay parallel and nothing moves
// along them (three multipliers), one contact in the middle. spatial: only the motion along the
// axis is blocked (one multiplier); the journal's axis may skew, one contact at either end of the
// bearing, each with half of the stiffness, so that parallel axes give the planar force.
enum class ClearanceKind { planar, spatial };
// What the bristle of a contact does while there is no contact: it is zero, it relaxes by
// z_dot = -(sigma0 / sigma1) z, or it keeps its deflection.
enum class FreeBristle { reset, relax, hold };
// Where friction of a contact acts on journal and bearing. one: at one point in space, on the
// bearing's surface, equal and opposite there. two: [AugUrb18] eq. (17), each body at its own
// surface, a penetration apart.
enum class ContactPoints { one, two };

struct Material {
  double young = 207.0e9;  // E, Pa
  double poisson = 0.3;    // nu

  bool operator==(const Material&) const = default;
};

struct Clearance {
  ClearanceKind kind = ClearanceKind::planar;
  bool bearing_is_first = false;  // the other end carries the journal
  double radial = 0.0;            // c_r = r_b - r_j, m
  double bearing_radius = 0.0;    // r_b, m; carries friction, and K from materials
  double length = 0.0;            // of the bearing, m; spatial
  ContactLaw law = ContactLaw::lankarani_nikravesh;
  double restitution = 0.9;         // k_e
  double exponent = 1.5;            // n
  std::optional<double> stiffness;  // K, N/m^n; empty: from the materials and radii
  Material bearing, journal;
  ApproachSpeed approach = ApproachSpeed::begin;
  double least_speed = 1.0e-4;  // m/s: floor of the approach speed
  ContactPoints points = ContactPoints::one;
  FreeBristle free_bristle = FreeBristle::reset;
  std::optional<Friction> friction;

  bool operator==(const Clearance&) const = default;
};

struct ClosureEnd {
  std::string link;  // a link or kGround
  Frame frame;       // {c,e} in that link

  bool operator==(const ClosureEnd&) const = default;
};

// Force convention: the reported closure force acts on `first` at the closure point, its opposite
// on `second`.
struct Closure {
  std::string name;
  JointType type = JointType::spherical;  // not free, not screw
  ClosureEnd first;                       // chain 1
  ClosureEnd second;                      // chain 2
  double length = 0.0;                    // of a rod, m
  ClosureModel model = ClosureModel::cut;
  Stabilization stabilization = Stabilization::none;
  double alpha = 100.0;  // Baumgarte, 1/s, [AugUrb18] eq. (9): -2 alpha Phi_dot - beta^2 Phi
  double beta = 50.0;    // Baumgarte, 1/s
  Sde sde;
  Clearance clearance;

  bool operator==(const Closure&) const = default;
};

// Directions that a joint of this type blocks, as a bit mask (bit d for Direction d).
unsigned blocked_directions(JointType type);

// Directions that a closure of model sde holds shut when a run begins: those with a stiffness among
// the ones its type blocks; none with SdeStart::given. Three springs count in their own directions.
unsigned shut_directions(const Closure& closure);

// Course of a load or actuator over time, value * f(t / duration): ramp f = min(s, 1); smooth
// f = 3 s^2 - 2 s^3; constant f = 1; table: linear interpolation of (times, values), ends held, or
// over a joint coordinate of (positions, values). With a period it begins again after it, a table
// from its first entry on; before that entry it has been repeating too.
enum class CourseShape { constant, ramp, smooth, table };
struct JointCoordinate {
  std::string joint;
  int coordinate = 0;  // within the joint; not of a quaternion

  bool operator==(const JointCoordinate&) const = default;
};
struct Course {
  CourseShape shape = CourseShape::ramp;
  double value = 0.0;     // N or N m
  double duration = 0.0;  // s
  std::vector<double> times;
  std::vector<double> values;
  std::optional<JointCoordinate> over{};  // of a table; empty: time
  std::vector<double> positions{};        // rad or m, in place of times
  std::optional<double> period{};         // s, rad or m

  bool operator==(const Course&) const = default;
};

// Resistance against a joint's motion: linear value * (v / at_speed), quadratic
// value * (v / at_speed) |v / at_speed|; the load is minus that.
enum class ResistanceShape { linear, quadratic };
struct ResistanceLaw {
  ResistanceShape shape = ResistanceShape::linear;
  double value = 0.0;     // N or N m at at_speed
  double at_speed = 1.0;  // rad/s or m/s

  bool operator==(const ResistanceLaw&) const = default;
};

// drive: generalised force on one joint coordinate. resistance: against one joint coordinate.
// link_force, link_torque: force at a point of a link, torque on a link, along a direction.
enum class LoadType { drive, resistance, link_force, link_torque };
struct Load {
  std::string name;
  LoadType type = LoadType::drive;
  std::string joint;                                     // drive, resistance
  int coordinate = 0;                                    // velocity index within the joint
  std::string link;                                      // link_force, link_torque
  Eigen::Vector3d point = Eigen::Vector3d::Zero();       // in the link frame, m
  Eigen::Vector3d direction = Eigen::Vector3d::UnitX();  // unit vector
  bool follows_link = false;  // direction is given in the link frame (else in the ground frame)
  Course course;              // drive, link_force, link_torque
  ResistanceLaw law;          // resistance

  bool operator==(const Load&) const = default;
};

// Motion of a joint coordinate as a law of time, whatever it takes
// (core/laws/prescribed_motion.h). Not of a quaternion.
struct Motion {
  std::string name;
  std::string joint;
  int coordinate = 0;  // within the joint
  MotionLaw law = MotionLaw::speed;
  std::optional<double> from;     // rad or m; empty: where the joint starts; middle of a sine
  double to = 0.0;                // rad or m: linear, smooth, polynomial_345
  double duration = 0.0;          // s: from `from` to `to`
  double speed = 0.0;             // rad/s or m/s
  double rise = 0.0;              // s: time to full speed
  double amplitude = 0.0;         // rad or m: sine
  double frequency = 0.0;         // Hz
  double phase = 0.0;             // rad
  std::vector<double> times;      // s, rising: table
  std::vector<double> positions;  // rad or m, as many

  bool operator==(const Motion&) const = default;
};

// A linear relation between joint coordinates, held exactly: gears, racks, belts, differentials.
//   sum of factor * coordinate = offset
// in rad or m, as the coordinate of the first term is; factors in SI. Not of quaternions.
struct CouplingTerm {
  std::string joint;
  int coordinate = 0;  // within the joint
  double factor = 1.0;

  bool operator==(const CouplingTerm&) const = default;
};
struct Coupling {
  std::string name;
  std::vector<CouplingTerm> terms;
  std::optional<double> offset;  // empty: as the joints are described to start

  bool operator==(const Coupling&) const = default;
};

struct SpringEnd {
  std::string link;                                    // a link or kGround
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // in the link frame, m

  bool operator==(const SpringEnd&) const = default;
};

// Spring, damper and actuator along the line between two points; no mass. Its force is positive
// where it pulls the points together: that of spring and damper (core/laws/spring_force.h) over the
// length l of the line, f_e = stiffness (l - free_length) or the curve, and the actuator's. Where
// the points coincide the line has no direction, and no force acts.
struct PointSpring {
  std::string name;
  SpringEnd first, second;
  double stiffness = 0.0;              // k, N/m
  double damping = 0.0;                // b, N s/m
  std::optional<double> free_length;   // l_0, m; where stiffness or one-sided damping ask for it
  SpringActs acts = SpringActs::both;  // spring and damper, not the actuator
  std::optional<ForceCurve> force;     // in place of stiffness and free_length
  std::optional<Course> course;        // of the actuator, N

  bool operator==(const PointSpring&) const = default;
};

// A point of a link whose motion is asked for; it takes no part in the dynamics.
struct ChosenPoint {
  std::string name;
  std::string link;                                    // a link or kGround
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // in the link frame, m

  bool operator==(const ChosenPoint&) const = default;
};

struct Linkage {
  std::string name;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // m/s^2, ground frame
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Closure> closures;
  std::vector<Load> loads;
  std::vector<Motion> motions;
  std::vector<Coupling> couplings;
  std::vector<PointSpring> springs;
  std::vector<ChosenPoint> points;

  bool operator==(const Linkage&) const = default;
};

}  // namespace linkstudy

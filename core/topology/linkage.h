// A linkage as its designer describes it: links, the joints of a spanning tree, the closures that
// make loops, and loads. Plain records with names; no state and no algorithms.
// Units: SI and radians. Frames: right-handed, fixed in the link that is named beside them.
// Source: topologies of [AugUrb18] fig. 1; closures of [Urbas16] sec. 2-4.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace linkstudy {

// Name of the fixed link. It is never listed among Linkage::links.
inline constexpr const char* kGround = "ground";

// Pose of a frame F in the frame of its owner L: x_L = rotation * x_F + position.
struct Frame {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  // R_LF
  Eigen::Vector3d position = Eigen::Vector3d::Zero();      // p_LF, m
};

struct Link {
  std::string name;
  double mass = 0.0;                                         // kg
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  // in the link frame, m
  // About the centre of mass, in axes parallel to the link frame, kg m^2. The off-diagonal entries
  // are those of the matrix, I_xy = -integral(x y dm).
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

// Motions of a joint's child frame in its parent frame, in the order of its coordinates:
//   revolute     rotation about z                        prismatic   translation along z
//   cylindrical  rotation about z, translation along z   screw       rotation about z, advancing
//   universal    rotation about z, then about the new y  planar      translation x, y, rotation z
//   spherical    rotation z, new y, new x (psi, theta, phi), or a unit quaternion
//   free         translation x, y, z, then as spherical  fixed       none
enum class JointType {
  revolute,
  prismatic,
  cylindrical,
  universal,
  spherical,
  planar,
  free,
  fixed,
  screw
};

// Coordinates of the rotation in a spherical or free joint. zyx: three angles psi, theta, phi with
// R = Rz(psi) Ry(theta) Rx(phi), singular at theta = +-90 deg. quaternion: four positions (w x y z)
// and three velocities, the angular velocity of the child in its own joint axes.
enum class RotationCoordinates { zyx, quaternion };

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
  bool hold = false;             // assembly keeps position and velocity of this joint
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
enum class TiltMeasure { axis, linearized };

// Spring-damping element, [Urbas16] sec. 2. Arrays are indexed by Direction.
struct Sde {
  SdeForm form = SdeForm::directional;
  SdeAxes axes = SdeAxes::ground;
  TiltMeasure tilt = TiltMeasure::axis;
  std::array<double, kDirections> stiffness{};  // N/m and N m/rad; zero means free
  std::array<double, kDirections> damping{};    // N s/m and N m s/rad; unused with damping_ratio
  // b = 2 zeta sqrt(c m_eff) with m_eff = 1 / max eig(J M^-1 J^T) at the start, separately for the
  // translational and the rotational rows.
  std::optional<double> damping_ratio;
  // form three_springs: unit directions (rows); element i has stiffness[i], damping[i].
  Eigen::Matrix3d directions = Eigen::Matrix3d::Identity();
};

struct ClosureEnd {
  std::string link;  // a link or kGround
  Frame frame;       // {c,e} in that link
};

// Force convention: the reported closure force acts on `first` at the closure point, its opposite
// on `second`.
struct Closure {
  std::string name;
  JointType type = JointType::spherical;  // not free, not screw
  ClosureEnd first;                       // chain 1
  ClosureEnd second;                      // chain 2
  ClosureModel model = ClosureModel::cut;
  Stabilization stabilization = Stabilization::none;
  double alpha = 100.0;  // Baumgarte, 1/s, [AugUrb18] eq. (9): -2 alpha Phi_dot - beta^2 Phi
  double beta = 50.0;    // Baumgarte, 1/s
  Sde sde;
};

// Directions that a joint of this type blocks, as a bit mask (bit d for Direction d).
unsigned blocked_directions(JointType type);

// Course of a drive over time, value * f(t / duration): ramp f = min(s, 1); smooth
// f = 3 s^2 - 2 s^3; constant f = 1; table: linear interpolation of (times, values), ends held.
enum class CourseShape { constant, ramp, smooth, table };
struct Course {
  CourseShape shape = CourseShape::constant;
  double value = 0.0;     // N or N m
  double duration = 0.0;  // s
  std::vector<double> times;
  std::vector<double> values;
};

// Resistance against a joint's motion: linear value * (v / at_speed), quadratic
// value * (v / at_speed) |v / at_speed|; the load is minus that.
enum class ResistanceShape { linear, quadratic };
struct ResistanceLaw {
  ResistanceShape shape = ResistanceShape::linear;
  double value = 0.0;     // N or N m at at_speed
  double at_speed = 1.0;  // rad/s or m/s
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
};

struct Linkage {
  std::string name;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  // m/s^2, ground frame
  std::vector<Link> links;
  std::vector<Joint> joints;
  std::vector<Closure> closures;
  std::vector<Load> loads;
};

}  // namespace linkstudy

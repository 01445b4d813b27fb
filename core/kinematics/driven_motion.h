// Motion of a linkage whose one driven coordinate is prescribed: positions by Newton-Raphson,
// velocities and accelerations by linear solves ([Palcak] (4.99)-(4.105)).
//
// Without dimensions (scaled_closures.h), with theta the driven coordinate, y the dependent ones, N
// the column of theta in the closure Jacobian and M those of y:
//   positions      M dy = -r,  until residual and correction are both small
//   velocities     M t = -N,               t = dy/dtheta
//   accelerations  M c = -bias(t),         c = d2y/dtheta2
//   q_dot = t theta_dot,  q_ddot = c theta_dot^2 + t theta_ddot
// M may have redundant rows; where it leaves freedoms open (idle ones, several drives) they take
// the solution of least norm. Joints with hold = true rest, the driven one excepted, unless the
// drive could not move then.
// Transmission quality: the smallest singular value of M that is not always zero over the largest.
// Zero: a dependent joint can move while the drive rests.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/kinematics/mobility.h"

namespace linkstudy {

// A coordinate that can be driven: any but those of a quaternion.
struct Drive {
  std::string name;  // "joint.NAME", with .0 .1 .. where the joint has several coordinates
  int position = 0;  // index in q
  int velocity = 0;  // index in v
  bool turns = true;
};
std::vector<Drive> list_drives(const Mechanism& m);

struct DrivenPose {
  State<double> s;    // positions; velocities at unit theta_dot
  double theta = 0;   // rad or extents
  Eigen::VectorXd t;  // (nv)
  Eigen::VectorXd c;  // (nv)
  double quality = 0;
  double residual = 0;  // norm of the scaled rows
  // t and c are not determined by the linear solves but continued from a pose before.
  bool is_singular = false;
};

// Below this quality a pose counts as singular.
inline constexpr double kSingularQuality = 1e-6;

class DrivenLinkage {
 public:
  // `pose` is closed; `mobility` was found there. Keeps a reference to `closed`.
  DrivenLinkage(const Model& closed, const State<double>& pose, const MobilityReport& mobility,
                const Drive& drive);

  const Model& model() const { return *closed_; }
  const Drive& drive() const { return drive_; }
  const ClosureScale& scale() const { return scale_; }
  // Of M where it is largest: coordinates that the drive determines.
  int rank() const { return rank_; }
  // Joints with hold = true move all the same.
  bool releases_holds() const { return releases_holds_; }
  int undetermined() const { return static_cast<int>(dependent_.size()) - rank_; }

  // Driven coordinate (rad or m) and theta.
  double coordinate(double theta) const { return theta * unit_; }
  double theta(double coordinate) const { return coordinate / unit_; }

  // Pose moved by a displacement (nv, without dimensions), theta set exactly.
  State<double> moved(const State<double>& s, const Eigen::VectorXd& dy, double theta) const;

  // Newton-Raphson in the dependent coordinates. False if it does not converge quickly.
  bool close(State<double>& s) const;

  // Everything of a pose but its positions.
  DrivenPose evaluate(const State<double>& s) const;

  // Of all coordinates, in SI, where the driven one has this velocity and acceleration.
  Eigen::VectorXd velocity(const DrivenPose& pose, double rate) const;
  Eigen::VectorXd acceleration(const DrivenPose& pose, double rate, double rate_dot) const;

  // Joints that can move while the drive rests, judged by the weakest direction of M.
  std::vector<std::string> loose_joints(const State<double>& s) const;

 private:
  void choose_dependent(bool keep_holds);
  // Rank of M at the given poses where it is largest; tells whether the drive can move there.
  bool find_rank(const std::vector<const State<double>*>& poses);
  Eigen::MatrixXd dependent_jacobian(const State<double>& s) const;

  const Model* closed_;
  ClosureScale scale_;
  Drive drive_;
  double unit_ = 1.0;
  std::vector<int> dependent_;
  int rank_ = 0;
  bool releases_holds_ = false;
};

}  // namespace linkstudy

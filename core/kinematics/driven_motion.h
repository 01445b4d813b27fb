// Motion of a linkage whose driven coordinates are prescribed: positions by Newton-Raphson,
// velocities and accelerations by linear solves ([Palcak] (4.99)-(4.105)).
//
// Without dimensions (scaled_closures.h), with theta the driven coordinates (n), y the dependent
// ones (z), N and M their columns of the closure Jacobian:
//   positions      M dy = -r,  until residual and correction are both small
//   velocities     M y_dot = -N theta_dot
//   accelerations  M y_ddot = -N theta_ddot - bias(y_dot, theta_dot)
// M may have redundant rows. Where it leaves freedoms open (idle ones, coordinates that nobody
// drives) velocities are those of least norm, and accelerations their derivatives. Joints with hold
// = true rest, driven ones excepted, unless the drives could not move then.
//
// Transmission quality: the smallest singular value of M that is not always zero over the largest
// of (M, N) at the start. Zero: a dependent joint can move while the drives rest.
#pragma once

#include <string>
#include <vector>

#include "core/kinematics/mobility.h"
#include "core/numerics/dense.h"

namespace linkstudy {

// A coordinate that can be driven: any but those of a quaternion.
struct Drive {
  std::string name;  // "joint.NAME", with .0 .1 .. where the joint has several coordinates
  std::string joint;
  int coordinate = 0;  // within the joint
  PositionIndex position;
  VelocityIndex velocity;
  bool turns = true;
};
std::vector<Drive> list_drives(const Mechanism& m);

// Motion out of a pose at given rates of the drives, without dimensions; all coordinates (nv).
struct DrivenRates {
  Eigen::VectorXd drive;   // (n) rates of the drives, rad or extents, per unit of time
  Eigen::VectorXd first;   // y_dot, those of the drives among them
  Eigen::VectorXd second;  // y_ddot
  double quality = 1.0;    // transmission quality of the pose
  // Quality is so low that the linear solves do not tell the motion.
  bool is_singular = false;
};

// Below this quality a pose counts as singular.
inline constexpr double kSingularQuality = 1e-6;

// Ranks of [Palcak] (4.108)-(4.110): h of M, h_R of R = (M, N). A regular pose has h as large as it
// gets; h = h_R less than that: motions remain while the drives rest; h < h_R: the drives are
// stopped.
struct DriveRanks {
  int dependent = 0;  // z
  int h = 0;
  int h_r = 0;
};

class DrivenLinkage {
 public:
  // `pose` is closed; `mobility` was found there. Keeps a reference to `closed`.
  DrivenLinkage(const Model& closed, const State<double>& pose, const MobilityReport& mobility,
                std::vector<Drive> drives);

  const Model& model() const { return *closed_; }
  const std::vector<Drive>& drives() const { return drives_; }
  const ClosureScale& scale() const { return scale_; }
  // Of M where it is largest: coordinates that the drives determine.
  int rank() const { return rank_; }
  // Joints with hold = true move all the same.
  bool releases_holds() const { return releases_holds_; }
  int undetermined() const { return static_cast<int>(dependent_.size()) - rank_; }
  // The drives cannot move by themselves: they are more than the linkage has freedoms, or fixed.
  bool is_overdriven() const { return is_overdriven_; }
  // Numbers of the velocities that are y, rising.
  const std::vector<int>& dependent() const { return dependent_; }

  // Positions of the drives, rad or m, and the same without dimensions.
  Eigen::VectorXd drive_position(const State<double>& s) const;
  Eigen::VectorXd without_dimensions(const Eigen::VectorXd& of_drives) const;

  // Pose moved by a displacement (nv, without dimensions), drives set exactly (rad or m).
  State<double> moved(const State<double>& s, const Eigen::VectorXd& dy,
                      const Eigen::VectorXd& drive_position) const;

  // Newton-Raphson in the dependent coordinates. False if it does not converge quickly.
  bool close(State<double>& s) const;

  // Rates and second rates of the drives without dimensions.
  DrivenRates rates(const State<double>& s, const Eigen::VectorXd& rate,
                    const Eigen::VectorXd& second_rate) const;
  double quality(const State<double>& s) const;
  double residual(const State<double>& s) const;  // norm of the scaled rows
  // b less a (nv), without dimensions.
  Eigen::VectorXd difference(const State<double>& a, const State<double>& b) const;

  // Singular values below this part of the largest count as zero.
  DriveRanks ranks(const State<double>& s, double tolerance) const;

  // Which of the closed poses at these drives this is: the sign of the determinant of M, of the
  // rows that are not always zero, joints with three turns counted by their angular velocity
  // (three_turns.h). 0 at singular poses and where this M is not square.
  int branch(const State<double>& s) const;

  // Joints that can move while the drives rest, judged by the weakest direction of M.
  std::vector<std::string> loose_joints(const State<double>& s) const;

 private:
  void choose_dependent(bool keep_holds);
  // Rank of M at the given poses where it is largest; tells whether the drives can move there.
  bool find_rank(const std::vector<const State<double>*>& poses);
  void find_branch_rows(const std::vector<const State<double>*>& poses);
  void find_size(const State<double>& pose);
  std::vector<int> columns_of_m_and_n() const;
  Eigen::MatrixXd dependent_jacobian(const State<double>& s) const;
  Eigen::VectorXd turning_of_least_norm(const State<double>& s, const Eigen::MatrixXd& jacobian,
                                        const SingularValues& svd,
                                        const Eigen::VectorXd& rates) const;
  Eigen::VectorXd scatter_drives(const Eigen::VectorXd& of_drives) const;

  const Model* closed_;
  ClosureScale scale_;
  std::vector<Drive> drives_;
  std::vector<int> driven_;  // numbers of velocities
  std::vector<int> dependent_;
  std::vector<int> branch_rows_;  // none: M is not square
  int rank_ = 0;
  double size_ = 0.0;  // largest singular value of (M, N) at the pose
  bool releases_holds_ = false;
  bool is_overdriven_ = false;
};

}  // namespace linkstudy

// The matrix equation of a basic loop, cut at its closure ([Palcak] (4.30)):
//   T_1(y) P(p) = T_2(y)
// T_1, T_2: poses of {1,e}, {2,e} in the body where the two ways meet (in its internal frame, that
// of its tree joint; core/model/mechanism.h); P: motion of the cut joint.
// Of the 4x4 elements 12 are equations: a11 a21 a31 a12 .. a33 of the direction cosines, a14 a24
// a34 of the position (over the extent). Six at most are independent; the proper elements are those
// for which the determinant of the equations is largest, found among all choices: the volume
// sqrt(det(A A^T)) where there are more coordinates than equations. Fewer than six are chosen where
// the loop has a smaller rank, as in a plane. Because columns of direction cosines have unit length
// and are orthogonal, no choice has three elements of one of them, nor more than three of all.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "core/kinematics/basic_loops.h"
#include "core/kinematics/cut_joint.h"
#include "core/kinematics/scaled_closures.h"

namespace linkstudy {

inline constexpr int kElements = 12;
const char* element_name(int element);  // "a14"

class LoopEquations {
 public:
  // Keeps references.
  LoopEquations(const Model& closed, const ClosureScale& scale, const BasicLoop& loop);

  const CutJoint& cut_joint() const { return joint_; }

  // Coordinates of the cut joint that fit the tree's best.
  Eigen::VectorXd cut_position(const State<double>& s) const;

  // Elements of T_1 P - T_2.
  Eigen::Matrix<double, kElements, 1> residual(const State<double>& s,
                                               const Eigen::VectorXd& cut_position) const;
  // Their derivatives by the velocities of the tree and of the cut joint, without dimensions:
  // (12, nv + velocity_count). Columns of joints outside of the loop are zero.
  Eigen::MatrixXd jacobian(const State<double>& s, const Eigen::VectorXd& cut_position) const;

 private:
  struct Frames {
    Workspace<double> w;
    ClosureFrame first, second, reached;  // reached: {2,e} by T_1 P
    Eigen::Matrix3d common;               // rotation of the body where the ways meet
  };
  Frames frames(const State<double>& s, const Eigen::VectorXd* cut_position) const;

  const Model& closed_;
  const ClosureScale& scale_;
  const BasicLoop& loop_;
  CutJoint joint_;
};

struct ProperElements {
  std::vector<int> elements;  // rising; as many as the rank
  double conditioning = 0.0;  // smallest over largest singular value of the chosen equations
};

// From rows for all 12 elements and columns for the coordinates to be found.
ProperElements choose_proper_elements(const Eigen::MatrixXd& jacobian);
double conditioning_of(const Eigen::MatrixXd& jacobian, const std::vector<int>& elements);

}  // namespace linkstudy

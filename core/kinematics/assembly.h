// Assembly: from an approximate to a closed start, and velocities that the closures allow.
//
// Positions: least squares on the closure residual r (m and dimensionless rows) by
// Levenberg-Marquardt, moving all joints that are not held. A start that is already closed is left
// untouched; a worse one is never returned. If the given start does not lead to a closed pose,
// deterministic restarts around it are tried, nearest first.
// Rotation rows vanish for opposite axes too. A closed pose in which the axes of a closure point
// against each other (x_1 . x_2 < 0 where the closure aligns x, y_1 . y_2 < 0 where it aligns y) is
// taken only if none with aligned axes is found. Where the closure aligns x alone it is the same
// joint either way: the report names it (`flipped`). Where it holds the whole orientation the ends
// are half a turn from what is described: that pose does not count as closed (`turned`).
// Velocities: the smallest change of the free velocities that gives J v = 0.
// Which rows there are is the model's: compile_closed takes every closure as the exact joint of its
// type, compile_start (core/model) of replacement joints what must be shut when a run begins.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/model/compile.h"

namespace linkstudy {

struct AssemblyReport {
  bool closed = false;
  double residual_given = 0.0;  // norm of r at the given start
  double residual = 0.0;        // at the returned one
  double displacement = 0.0;    // norm of the change of the joint positions, rad and m
  int iterations = 0;
  int restarts = 0;  // 0: from the given start
  double velocity_residual = 0.0;
  int rows = 0;      // closure equations
  int rank = 0;      // independent ones at the start
  int mobility = 0;  // nv - rank at the start
  // Which of the closed poses this is: the sign of the determinant of the closure equations with
  // respect to the `dependent` velocities; 0 where rank < rows or at a singular pose. Joints with
  // three turns count by their angular velocity in the child frame, whatever their coordinates.
  int branch = 0;
  std::vector<int> dependent;  // velocity indices
  std::string worst_closure;   // largest residual, if not closed
  std::string worst_coupling;  // the same where it is one
  double worst_gap = 0.0;      // of it, m; of a coupling rad or m
  double worst_tilt = 0.0;     // of its axes, rad
  // Closures whose axis is opposite at the returned start, and those turned by half a turn.
  std::vector<std::string> flipped, turned;
};

// Norm of r, rows in metres over the extent of the mechanism (scaled_closures.h), below which a
// start counts as closed.
inline constexpr double kClosedTolerance = 1e-9;

// Singular values of the closure Jacobian below this part of the largest count as zero.
inline constexpr double kRankTolerance = 1e-7;

// Velocity indices of the joints that are not held.
std::vector<int> free_velocities(const Model& model);

// The same linkage with every closure cut, so that its closure equations can be evaluated, and with
// the freedoms that motions prescribe.
Model compile_closed(const Linkage& linkage);

// What is open, in words, and what may be wrong: "closure.C stays open: gap 0.003 m, ..."
std::string open_text(const AssemblyReport& report);
// A sentence for every flipped closure.
std::vector<std::string> flipped_texts(const AssemblyReport& report);

// Moves `start` (positions and velocities) of the compiled closed linkage.
AssemblyReport assemble_start(const Model& closed, State<double>& start);

// Residual r (nc) and Jacobian (nc, nv) of the cut rows at (q, v).
struct ClosureEquations {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
};
ClosureEquations compute_closure_equations(const Mechanism& m, const Parameters<double>& p,
                                           const State<double>& s);

// Cut rows that are independent at q, by kRankTolerance.
int closure_rank(const Mechanism& m, const Parameters<double>& p, const State<double>& s);

// q moved by a displacement in velocity coordinates.
State<double> displaced(const Mechanism& m, const State<double>& s, const Eigen::VectorXd& dq);

}  // namespace linkstudy

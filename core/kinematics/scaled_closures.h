// Closure equations without dimensions. Rows in metres are divided by the extent of the mechanism,
// velocities in m/s are measured in extents per second: singular values then do not depend on the
// unit of length, and ranks not on the size of the mechanism.
//   J_s = diag(row) J diag(velocity),   v = diag(velocity) y
// The extent is the diagonal of the box about joint origins, centres of mass and closure points.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/kinematics/assembly.h"

namespace linkstudy {

// Singular values below this part of the largest count as zero. Poses are closed to 1e-9.
inline constexpr double kMobilityTolerance = 1e-7;

// Scaled rows are of the size of one: singular values are measured by this where all are smaller.
inline constexpr double kLeastRowSize = 1e-3;

struct ClosureScale {
  double extent = 1.0;       // m
  Eigen::VectorXd row;       // (nc)
  Eigen::VectorXd velocity;  // (nv)
};

ClosureScale find_closure_scale(const Model& closed, const State<double>& s);

// Residual r, Jacobian J and bias J_dot v of the closure rows at (q, v), without dimensions.
struct ScaledClosures {
  Eigen::VectorXd residual;  // (nc)
  Eigen::VectorXd bias;      // (nc)
  Eigen::MatrixXd jacobian;  // (nc, nv)
};
ScaledClosures compute_scaled_closures(const Model& closed, const ClosureScale& scale,
                                       const State<double>& s);

// Moves all joints from `s` to a closed pose near by, without restarts, held joints too; returns
// the norm of the scaled residual that is left.
double close_from(const Model& closed, const ClosureScale& scale, State<double>& s);

// b less a in velocity coordinates, without dimensions; the turn between two quaternions is a
// rotation vector.
Eigen::VectorXd scaled_difference(const Mechanism& m, const ClosureScale& scale,
                                  const State<double>& a, const State<double>& b);

// Columns of a matrix, and the inverse: entries of `part` at their places among n zeros.
Eigen::MatrixXd take_columns(const Eigen::MatrixXd& a, const std::vector<int>& columns);
Eigen::VectorXd scatter_entries(const Eigen::VectorXd& part, const std::vector<int>& at, int n);

}  // namespace linkstudy

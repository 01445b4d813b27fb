// Stability of a static equilibrium: eigenvalues of the stiffness K = -d(tau - J^T lambda)/dq on
// the directions that held joints and cut joints leave free. Where joints turn and slide both,
// translations are measured in extents L of the mechanism (compute_extent), so that all entries are
// in N m/rad and the eigenvalues do not depend on the unit of length: K_s = D K D, D = 1 or L.
// Neutral: within the noise of the differences, 1e-12 of the largest stiffness (or of weights on
// the mechanism's length), or ten times their doubt.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

enum class Stability { stable, neutral, unstable };
enum class StiffnessUnit { translation, rotation, mixed };  // N/m; N m/rad; N m/rad with L

struct StabilityReport {
  Stability stability = Stability::neutral;
  int directions = 0;               // free ones; 0: a structure, nothing can move
  int neutral = 0;                  // of them without stiffness
  double smallest_stiffness = 0.0;  // least eigenvalue
  double smallest_beyond = 0.0;     // least one that is not neutral; 0 where all are
  StiffnessUnit unit = StiffnessUnit::rotation;
  double extent = 1.0;  // L, m
};

// What holds and closures leave free at a pose.
struct FreeDirections {
  StiffnessUnit unit = StiffnessUnit::rotation;
  double extent = 1.0;      // L, m
  Eigen::VectorXd measure;  // (free) D: 1, or L of translations beside rotations
  Eigen::MatrixXd basis;    // (free, directions) orthonormal in D^-1 dq
};
FreeDirections find_free_directions(const Model& model, const State<double>& s,
                                    const std::vector<int>& free, Workspace<double>& w);

StabilityReport judge_stability(const Model& model, const State<double>& s,
                                const Eigen::VectorXd& lambda, const std::vector<int>& free,
                                Workspace<double>& w);

}  // namespace linkstudy

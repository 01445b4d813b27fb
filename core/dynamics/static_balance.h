// Forces on a linkage at rest, and how they change with its pose: what the search for static
// equilibrium, the verdict on its stability and the reason of a failure have in common. `free` are
// the velocity indices that may move: joints with hold = true stay.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

struct Balance {
  Eigen::VectorXd tau;  // (nv) applied forces, gravity included
  Eigen::VectorXd phi;  // (nc) rows of cut joints, zero when closed
  Eigen::MatrixXd j;    // (nc, nv)
};

Balance compute_balance(const Model& model, const State<double>& s, Workspace<double>& w);

// The multipliers lambda (nc) that leave least of the forces on `free` over; of these the least.
Eigen::VectorXd least_multipliers(const Balance& b, const std::vector<int>& free);

// tau - J^T lambda (nv).
Eigen::VectorXd net_force(const Balance& b, const Eigen::VectorXd& lambda);

// d(tau - J^T lambda)/dq (free, free) by differences, and their own doubt, entry by entry.
struct ForceGradient {
  Eigen::MatrixXd value, doubt;
};
ForceGradient compute_force_gradient(const Model& model, const State<double>& s,
                                     const Eigen::VectorXd& lambda, const std::vector<int>& free,
                                     Workspace<double>& w);

// Newton's linear system for (dq, dlambda): a x = r, with the rows and columns of the closures
// times `scale`, since stiffness and geometry differ by many decades.
struct BalanceSystem {
  Eigen::MatrixXd a;
  Eigen::VectorXd r;
  double scale = 1.0;
};
BalanceSystem make_balance_system(const Eigen::MatrixXd& gradient, const Balance& b,
                                  const Eigen::VectorXd& force, const std::vector<int>& free);

Eigen::VectorXd take_entries(const Eigen::VectorXd& all, const std::vector<int>& at);

// Forces that equilibrium balances: the weights and, at time t, the loads. Resistances rest.
double force_scale(const Model& model, double t);

// "joint.A" or "joint.A.1", as channels name coordinates; "N" or "N m".
std::string velocity_name(const Mechanism& m, VelocityIndex velocity);
const char* effort_unit(const Mechanism& m, VelocityIndex velocity);

}  // namespace linkstudy

// Curves of solutions of f(x) = 0, one unknown more than independent equations, by pseudo-arclength
// continuation (E. L. Allgower and K. Georg, Introduction to Numerical Continuation Methods, SIAM,
// 2003, ch. 2 and 3): along the unit tangent t, J t = 0, the curve goes on where one unknown turns
// back, and corrections of least norm lead back onto it. Knows no mechanism: callers say how their
// unknowns move.
#pragma once

#include <Eigen/Core>

namespace linkstudy {

// Unit vector of the null space of J (rows, columns), rank columns - 1, in the sense of `sense`.
Eigen::VectorXd unit_tangent(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& sense);

// Gauss-Newton: x of least norm that minimises |r + J x| in the `rank` strongest directions of J.
Eigen::VectorXd least_correction(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual,
                                 int rank);

}  // namespace linkstudy

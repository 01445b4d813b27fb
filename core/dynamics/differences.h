// Derivatives with respect to joint coordinates by central differences of sixth order,
//   f' = 3/2 D_1 - 3/5 D_2 + 1/10 D_3 + O(h^6),   D_k = (f(k h) - f(-k h)) / (2 k h),
// with steps that follow the size of the mechanism: 1e-3 rad, or 1e-3 of its length. Truncation and
// rounding then both stay near 1e-13 of the stiffest derivative.
#pragma once

#include <Eigen/Core>

#include "core/model/compile.h"

namespace linkstudy {

// Of the origins, centres of mass, closure points and ends of springs of all bodies at a pose.
struct Extent {
  double length = 1.0;    // m, diagonal of the box around them; 1 where they coincide (to 1 um)
  double farthest = 0.0;  // m, largest distance from the ground's origin: what positions round by
};

Extent compute_extent(const Model& model, const State<double>& s);

// Step of every velocity coordinate (nv): rad or m, of a screw rad.
Eigen::VectorXd difference_steps(const Model& model, const State<double>& s);

struct Derivative {
  Eigen::VectorXd value;
  Eigen::VectorXd doubt;  // difference from the formula of fourth order, absolute
};

// Of f(x) at x = 0.
template <class Function>
Derivative differentiate(const Function& f, double h) {
  const auto slope = [&](double x) -> Eigen::VectorXd { return (f(x) - f(-x)) / (2.0 * x); };
  const Eigen::VectorXd d1 = slope(h);
  const Eigen::VectorXd d2 = slope(2.0 * h);
  const Eigen::VectorXd d3 = slope(3.0 * h);
  const Eigen::VectorXd value = 1.5 * d1 - 0.6 * d2 + 0.1 * d3;
  return {value, (value - (4.0 * d1 - d2) / 3.0).cwiseAbs()};
}

}  // namespace linkstudy

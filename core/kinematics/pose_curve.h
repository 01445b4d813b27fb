// Closed poses as a curve: the dependent coordinates y and the way x of the drives along a
// direction, which vary together so that
//   (M, N direction) (y_dot, x_dot) = 0.
// By its arc length (core/numerics/continuation.h) the curve goes on where the drives turn back (a
// lock: x_dot = 0). Only where the drives determine everything: elsewhere closed poses are no
// curve.
#pragma once

#include <optional>

#include "core/kinematics/driven_motion.h"

namespace linkstudy {

class PoseCurve {
 public:
  // `direction` (n): of the drives, without dimensions. Keeps a reference.
  PoseCurve(const DrivenLinkage& linkage, Eigen::VectorXd direction)
      : linkage_(linkage), direction_(std::move(direction)) {}

  static bool exists(const DrivenLinkage& linkage) {
    return linkage.undetermined() == 0 && linkage.rank() > 0;
  }

  // Unit tangent (dependent coordinates in their order, x last) in the sense of another vector.
  Eigen::VectorXd tangent(const State<double>& s, const Eigen::VectorXd& sense) const;
  Eigen::VectorXd rising() const;  // x alone

  // The closed pose next to s + way. Nothing if Newton-Raphson does not get there.
  std::optional<State<double>> at(const State<double>& s, const Eigen::VectorXd& way) const;

  // Way of the drives along the direction between two poses.
  double way_between(const State<double>& a, const State<double>& b) const;

 private:
  Eigen::Index count() const { return static_cast<Eigen::Index>(linkage_.dependent().size()); }
  // (rows, dependent + 1) of the curve's equations.
  Eigen::MatrixXd jacobian(const State<double>& s) const;
  State<double> moved(const State<double>& s, const Eigen::VectorXd& way) const;

  const DrivenLinkage& linkage_;
  Eigen::VectorXd direction_;
};

}  // namespace linkstudy

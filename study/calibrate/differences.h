// Jacobian of the residuals by differences in the cube: central ones; at a bound, of second order
// from the inside,
//   (4 r(u + h) - 3 r(u) - r(u + 2h)) / 2h;
// where one of the two points fails, from the other and r(u). Where both fail the column is zero.
#pragma once

#include <span>

#include "study/calibrate/fit_log.h"

namespace linkstudy::calibration {

// Where a Jacobian is taken: the coordinates that are not held, with the length of each difference.
struct DifferencePlan {
  Vector point;
  Vector lengths;
  std::vector<bool> held;

  bool is_held(Eigen::Index i) const { return held[static_cast<std::size_t>(i)]; }
};

// Two for each coordinate that is not held.
std::vector<Vector> list_difference_points(const DifferencePlan& plan);

// `here` at the point, `answers` as listed. Columns of held coordinates are zero.
Matrix make_jacobian(const DifferencePlan& plan, const Vector& here,
                     std::span<const FitSample* const> answers);

}  // namespace linkstudy::calibration

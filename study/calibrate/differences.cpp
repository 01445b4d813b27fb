#include "study/calibrate/differences.h"

namespace linkstudy::calibration {
namespace {

// In lengths of the difference.
struct OffsetPair {
  double one;
  double other;
};

OffsetPair offsets_at(double u, double length) {
  if (u + length > 1.0) return {-1.0, -2.0};
  if (u - length < 0.0) return {1.0, 2.0};
  return {1.0, -1.0};
}

Vector jacobian_column(const OffsetPair& offsets, double length, const Vector& here,
                       const FitSample& one, const FitSample& other) {
  const bool is_central = offsets.one == -offsets.other;
  if (one.is_ok() && other.is_ok()) {
    if (is_central) return (one.residuals - other.residuals) / (2.0 * length);
    return (4.0 * one.residuals - 3.0 * here - other.residuals) / (2.0 * offsets.one * length);
  }
  if (one.is_ok()) return (one.residuals - here) / (offsets.one * length);
  if (other.is_ok()) return (other.residuals - here) / (offsets.other * length);
  return Vector::Zero(here.size());
}

}  // namespace

std::vector<Vector> list_difference_points(const DifferencePlan& plan) {
  std::vector<Vector> points;
  for (Eigen::Index i = 0; i < plan.point.size(); ++i) {
    if (plan.is_held(i)) continue;
    const OffsetPair offsets = offsets_at(plan.point[i], plan.lengths[i]);
    for (const double offset : {offsets.one, offsets.other}) {
      points.push_back(plan.point);
      points.back()[i] += offset * plan.lengths[i];
    }
  }
  return points;
}

Matrix make_jacobian(const DifferencePlan& plan, const Vector& here,
                     std::span<const FitSample* const> answers) {
  Matrix jacobian = Matrix::Zero(here.size(), plan.point.size());
  std::size_t next = 0;
  for (Eigen::Index i = 0; i < plan.point.size(); ++i) {
    if (plan.is_held(i)) continue;
    jacobian.col(i) = jacobian_column(offsets_at(plan.point[i], plan.lengths[i]), plan.lengths[i],
                                      here, *answers[next], *answers[next + 1]);
    next += 2;
  }
  return jacobian;
}

}  // namespace linkstudy::calibration

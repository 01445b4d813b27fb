#include "study/calibrate/curvature.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include "core/numerics/dense.h"

namespace linkstudy::calibration {
namespace {

using Eigen::Index;

constexpr double kFlat = 1e-5;        // singular value, of the largest
constexpr double kFlatColumn = 1e-8;  // length of a column, of the longest
constexpr double kTakesPart = 0.05;   // entry of a direction, of its largest

FlatDirection make_direction(const FitProblem& problem, const Vector& scaled, const Vector& lengths,
                             const Vector& slopes) {
  FlatDirection direction;
  const double largest_part = scaled.lpNorm<Eigen::Infinity>();
  direction.along = Vector::Zero(scaled.size());
  Vector relative = direction.along;
  for (Index i = 0; i < scaled.size(); ++i) {
    if (std::abs(scaled[i]) < kTakesPart * largest_part) continue;
    direction.along[i] = scaled[i] / lengths[i];
    relative[i] = direction.along[i] * slopes[i];
  }
  Index first = 0;
  direction.along.cwiseAbs().maxCoeff(&first);
  direction.along /= direction.along[first];
  relative.cwiseAbs().maxCoeff(&first);
  relative /= relative[first];
  std::vector<std::string> names;
  std::vector<std::string> parts;
  for (Index i = 0; i < scaled.size(); ++i) {
    if (relative[i] == 0.0) continue;
    names.push_back(problem.parameters[static_cast<std::size_t>(i)].name);
    parts.push_back(fmt::format("{:.3g}", relative[i]));
  }
  direction.name = names.size() == 1
                       ? names.front()
                       : fmt::format("{} = {}", fmt::join(names, " : "), fmt::join(parts, " : "));
  return direction;
}

}  // namespace

bool Curvature::is_flat(Index i) const {
  return std::ranges::any_of(flat, [i](const FlatDirection& one) { return one.holds(i); });
}

Curvature compute_curvature(const FitProblem& problem, const Vector& point,
                            const Matrix& jacobian) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const Index n = jacobian.cols();
  Vector lengths = jacobian.colwise().norm().transpose();
  Matrix scaled = jacobian;
  const double longest = lengths.size() > 0 ? lengths.maxCoeff() : 0.0;
  for (Index i = 0; i < n; ++i) {
    if (lengths[i] > kFlatColumn * longest) {
      scaled.col(i) /= lengths[i];
    } else {  // rounding
      scaled.col(i).setZero();
      lengths[i] = 1.0;
    }
  }
  const SingularValues svd = decompose_singular(scaled, SingularVectors::thin);
  const Vector& sigma = svd.values;
  Curvature curvature;
  curvature.singular_values.assign(sigma.begin(), sigma.end());
  const Vector slopes = relative_slopes(problem, point);
  Matrix covariance = Matrix::Zero(n, n);
  for (Index k = 0; k < sigma.size(); ++k) {
    const Vector v = svd.v.col(k);
    if (sigma[k] > kFlat * sigma[0] && sigma[k] > 0.0) {
      const Vector part = v.cwiseQuotient(lengths) / sigma[k];
      covariance += part * part.transpose();
    } else {
      curvature.flat.push_back(make_direction(problem, v, lengths, slopes));
    }
  }
  curvature.correlation = Matrix::Constant(n, n, kNothing);
  for (Index i = 0; i < n; ++i) {
    for (Index k = 0; k < n; ++k) {
      if (curvature.is_flat(i) || curvature.is_flat(k)) continue;
      curvature.correlation(i, k) =
          covariance(i, k) / std::sqrt(covariance(i, i) * covariance(k, k));
    }
  }
  for (Index i = 0; i < n; ++i) {
    if (curvature.is_flat(i)) covariance(i, i) = std::numeric_limits<double>::infinity();
  }
  curvature.covariance = std::move(covariance);
  return curvature;
}

}  // namespace linkstudy::calibration

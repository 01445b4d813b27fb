#include "study/calibrate/descent.h"

#include <algorithm>
#include <cmath>
#include <unsupported/Eigen/NonLinearOptimization>

namespace linkstudy::calibration {
namespace {

constexpr double kFirstRegion = 0.3;  // of the cube, in each coordinate
constexpr double kLeastRatio = 1e-4;  // of actual to predicted fall that is accepted
constexpr double kGradient = 1e-10;   // cosine between a column and the residuals
constexpr double kExact = 1e-28;      // of the sum at the start: nothing is left but rounding
constexpr double kFailedShrink = 0.25;
constexpr double kOnBound = 1e-12;  // of the cube

Matrix columns_of(const Matrix& jacobian, const std::vector<Eigen::Index>& free) {
  return jacobian(Eigen::all, free);
}

// The step of the free coordinates within the region.
Vector solve_region(const Matrix& columns, const Vector& residuals, const Vector& scale,
                    double delta, double& damping) {
  const Eigen::ColPivHouseholderQR<Matrix> qr(columns);
  Vector rotated = residuals;
  rotated.applyOnTheLeft(qr.householderQ().adjoint());
  const Vector head = rotated.head(columns.cols());
  Vector step(columns.cols());
  Eigen::internal::lmpar2<double>(qr, scale, head, delta, damping, step);
  return -step;
}

}  // namespace

Descent::Descent(const FitProblem& problem, const DescentSettings& settings, Vector start,
                 std::vector<bool> held)
    : problem_(&problem), settings_(settings) {
  if (held.empty()) held.assign(static_cast<std::size_t>(start.size()), false);
  plan_ = {std::move(start), {}, std::move(held)};
}

std::vector<Vector> Descent::wanted() const {
  if (phase_ == Phase::start) return {plan_.point};
  if (phase_ == Phase::trial) return {moved()};
  return list_difference_points(plan_);
}

// A point within rounding of a bound is at it.
Vector Descent::moved() const {
  Vector point = plan_.point + step_;
  for (double& u : point) {
    if (u < kOnBound) u = 0.0;
    if (u > 1.0 - kOnBound) u = 1.0;
  }
  return point;
}

void Descent::take(std::vector<const FitSample*> answers) {
  if (std::ranges::any_of(answers,
                          [](const FitSample* one) { return one->status == Cause::cancelled; })) {
    return;  // the budget has ended
  }
  if (phase_ == Phase::start) return take_start(*answers.front());
  if (phase_ == Phase::trial) return take_trial(*answers.front());
  take_differences(answers);
}

void Descent::take_start(const FitSample& sample) {
  sample_ = &sample;
  start_sum_ = sample.sum;
  if (!sample.is_ok()) {
    end_ = DescentEnd::start_failed;
    return;
  }
  scale_ = Vector::Zero(plan_.point.size());
  begin_iteration();
}

void Descent::begin_iteration() {
  if (sample_->sum <= kExact * start_sum_ || sample_->sum == 0.0) {
    end_ = DescentEnd::exact;
    // The differences of the last point but one serve; of a start that fits there are none.
    if (iterations_ > 0) return;
    end_ = DescentEnd::running;
  }
  if (iterations_ >= settings_.max_iterations) {
    end_ = DescentEnd::iterations;
    return;
  }
  ++iterations_;
  plan_.lengths = difference_steps(*problem_, plan_.point, settings_.difference);
  phase_ = Phase::differences;
  if (std::ranges::all_of(plan_.held, std::identity())) end_ = DescentEnd::converged;
}

void Descent::take_differences(std::span<const FitSample* const> answers) {
  jacobian_ = make_jacobian(plan_, sample_->residuals, answers);
  scale_ = scale_.cwiseMax(jacobian_.colwise().norm().transpose());
  // lmpar divides by D; a flat coordinate has no column to be scaled by.
  const double least = scale_.maxCoeff() > 0.0 ? 1e-12 * scale_.maxCoeff() : 1.0;
  scale_ = scale_.cwiseMax(least);
  if (delta_ == 0.0) delta_ = kFirstRegion * scale_.norm();
  if (is_stationary()) {
    end_ = sample_->sum == 0.0 ? DescentEnd::exact : DescentEnd::converged;
    return;
  }
  want_trial();
}

// No coordinate can move with its gradient.
bool Descent::is_stationary() const {
  const Vector& r = sample_->residuals;
  for (Eigen::Index i = 0; i < plan_.point.size(); ++i) {
    if (plan_.is_held(i) || pushes_out(i, r)) continue;
    const auto column = jacobian_.col(i);
    if (std::abs(column.dot(r)) > kGradient * column.norm() * r.norm()) return false;
  }
  return true;
}

// At its bound, with a gradient that leads out.
bool Descent::pushes_out(Eigen::Index i, const Vector& residuals) const {
  const double slope = jacobian_.col(i).dot(residuals);
  const double u = plan_.point[i];
  return (u <= 0.0 && slope > 0.0) || (u >= 1.0 && slope < 0.0);
}

void Descent::find_step() {
  const Vector& u = plan_.point;
  Vector residuals = sample_->residuals;
  step_ = Vector::Zero(u.size());
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = 0; i < u.size(); ++i) {
    if (!plan_.is_held(i) && !pushes_out(i, residuals)) free.push_back(i);
  }
  while (!free.empty()) {
    const Vector part =
        solve_region(columns_of(jacobian_, free), residuals, scale_(free), delta_, damping_);
    std::vector<Eigen::Index> inside;
    for (std::size_t k = 0; k < free.size(); ++k) {
      const Eigen::Index i = free[k];
      const double end = u[i] + part[static_cast<Eigen::Index>(k)];
      if (end >= 0.0 && end <= 1.0) {
        step_[i] = part[static_cast<Eigen::Index>(k)];
        inside.push_back(i);
      } else {
        step_[i] = (end < 0.0 ? 0.0 : 1.0) - u[i];
        residuals += jacobian_.col(i) * step_[i];
      }
    }
    if (inside.size() == free.size()) break;
    free = std::move(inside);
  }
  const double after = (sample_->residuals + jacobian_ * step_).squaredNorm();
  predicted_ = 1.0 - after / sample_->sum;
}

void Descent::want_trial() {
  phase_ = Phase::trial;
  // What ends at a bound may climb where the region is wide: a shorter step does not.
  for (int i = 0; i < 60; ++i) {
    find_step();
    if (step_.lpNorm<Eigen::Infinity>() <= settings_.step_tolerance) break;
    if (predicted_ > 0.0) return;
    delta_ *= kFailedShrink;
  }
  end_ = meets_failures_ ? DescentEnd::stuck : DescentEnd::converged;
}

void Descent::resize_region(double ratio, double length) {
  if (ratio <= 0.25) {
    delta_ = (ratio > 0.0 ? 0.5 : kFailedShrink) * std::min(delta_, length);
  } else if (ratio >= 0.75 || damping_ == 0.0) {
    delta_ = std::max(delta_, 2.0 * length);
  }
}

void Descent::take_trial(const FitSample& sample) {
  const double length = scale_.cwiseProduct(step_).norm();
  if (!sample.is_ok()) {
    meets_failures_ = true;
    delta_ = kFailedShrink * std::min(delta_, length);
    return want_trial();
  }
  const double fall = 1.0 - sample.sum / sample_->sum;
  const double ratio = fall / predicted_;
  resize_region(ratio, length);
  const bool is_small = predicted_ <= settings_.tolerance && std::abs(fall) <= settings_.tolerance;
  if (ratio < kLeastRatio) {
    if (!is_small) return want_trial();
    end_ = DescentEnd::converged;
    return;
  }
  plan_.point = moved();
  sample_ = &sample;
  meets_failures_ = false;
  if (is_small) {
    end_ = DescentEnd::converged;
    return;
  }
  begin_iteration();
}

}  // namespace linkstudy::calibration

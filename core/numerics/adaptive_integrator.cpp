#include "core/numerics/adaptive_integrator.h"

#include <algorithm>
#include <cmath>

#include "core/numerics/adaptive_methods.h"

namespace linkstudy {
namespace {

constexpr double kLeastStep = 1e-14;  // of the time reached
constexpr double kFirstPart = 0.01;   // of the solution that a first step may change

bool all_finite(const std::vector<double>& y) {
  return std::all_of(y.begin(), y.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

AdaptiveIntegrator::AdaptiveIntegrator(AdaptiveProblem problem)
    : problem_(std::move(problem)),
      y_(problem_.absolute.size()),
      end_(y_.size()),
      ahead_(y_.size()),
      later_(y_.size()) {}

void AdaptiveIntegrator::evaluate(double t, const double* y, double* dy) {
  ++evaluations_;
  problem_.slopes(t, y, dy);
}

void AdaptiveIntegrator::start(double t, const double* y, double h) {
  t_old_ = t_ = t;
  std::copy(y, y + y_.size(), y_.begin());
  forget_slopes();
  forget_steps();
  next_ = h > 0.0 ? h : guess_step();
}

void AdaptiveIntegrator::replace(const double* y) {
  std::copy(y, y + y_.size(), y_.begin());
  forget_slopes();
}

void AdaptiveIntegrator::value_at(double time, double* out) {
  if (time == t_) {
    std::copy(y_.begin(), y_.end(), out);
  } else {
    interpolate(time, out);
  }
}

// The step that an explicit Euler step of a hundredth of the solution and the change of the slopes
// over it let expect (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, II.4).
double AdaptiveIntegrator::guess_step() {
  const double* f = slopes();
  double size = 0.0, rate = 0.0, bend = 0.0;
  const auto scale = [&](std::size_t i) {
    return problem_.absolute[i] + problem_.relative * std::fabs(y_[i]);
  };
  for (std::size_t i = 0; i < y_.size(); ++i) {
    size = std::max(size, std::fabs(y_[i]) / scale(i));
    rate = std::max(rate, std::fabs(f[i]) / scale(i));
  }
  const double euler = size > 1e-5 && rate > 1e-5 ? kFirstPart * size / rate : 1e-6;
  for (std::size_t i = 0; i < y_.size(); ++i) ahead_[i] = y_[i] + euler * f[i];
  evaluate(t_ + euler, ahead_.data(), later_.data());
  for (std::size_t i = 0; i < y_.size(); ++i) {
    bend = std::max(bend, std::fabs(later_[i] - f[i]) / scale(i) / euler);
  }
  const double fastest = std::max(rate, bend);
  if (!std::isfinite(fastest)) return euler;
  const double wanted =
      fastest > 1e-15 ? std::pow(kFirstPart / fastest, 0.2) : std::max(1e-6, 1e-3 * euler);
  return std::min(100.0 * euler, wanted);
}

// The last two steps before `latest` are of one length rather than the last one tiny.
double AdaptiveIntegrator::clip(double h, double latest) const {
  const double left = latest - t_;
  if (problem_.max_step > 0.0) h = std::min(h, problem_.max_step);
  if (h >= left * (1.0 - 1e-9)) return left;
  return h > 0.5 * left ? 0.5 * left : h;
}

void AdaptiveIntegrator::begin_step(double latest) {
  latest_ = latest;
  proposed_ = next_;
  h_ = clip(next_, latest);
  first_ = true;
}

StepResult AdaptiveIntegrator::step(double latest) {
  begin_step(latest);
  for (;;)
    if (const auto result = end_trial(attempt(h_, end_))) return *result;
}

std::optional<StepResult> AdaptiveIntegrator::end_trial(const Trial& trial) {
  if (trial.accepted && all_finite(end_)) {
    const bool clipped = first_ && h_ < proposed_;
    t_old_ = t_;
    t_ = h_ == latest_ - t_ ? latest_ : t_ + h_;
    y_.swap(end_);
    next_ = clipped ? std::max(trial.next, proposed_) : trial.next;
    ++steps_;
    return StepResult::accepted;
  }
  ++rejected_;
  h_ = std::min(trial.next, 0.9 * h_);
  first_ = false;
  if (h_ >= kLeastStep * std::max(std::fabs(t_), std::fabs(latest_))) return std::nullopt;
  return all_finite(end_) ? StepResult::too_small : StepResult::not_finite;
}

std::unique_ptr<AdaptiveIntegrator> make_adaptive_integrator(AdaptiveMethod method,
                                                             AdaptiveProblem problem) {
  return method == AdaptiveMethod::dormand_prince ? make_dormand_prince(std::move(problem))
                                                  : make_radau(std::move(problem));
}

}  // namespace linkstudy

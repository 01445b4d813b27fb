#include "core/numerics/dormand_prince_integrator.h"

#include <algorithm>
#include <cmath>

#include "core/numerics/adaptive_methods.h"

namespace linkstudy {
namespace {

// As Boost.odeint chooses the next step.
constexpr double kSafety = 0.9;         // of a step that is predicted
constexpr double kMostShrinkage = 0.2;  // of a step
constexpr double kWellWithin = 0.5;     // error of steps that may grow
constexpr double kLeastError = 3.2e-4;  // that counts: steps grow to 4.5 times at most

}  // namespace

DormandPrince::DormandPrince(AdaptiveProblem p)
    : AdaptiveIntegrator(std::move(p)),
      trial_(problem().absolute.size()),
      slope_(problem().absolute.size()) {}

const double* DormandPrince::slopes() {
  if (!known_) evaluate(t(), y(), slope_.data());
  known_ = true;
  return slope_.data();
}

void DormandPrince::replace(const double* y, const double* slopes) {
  replace(y);
  std::copy(slopes, slopes + slope_.size(), slope_.begin());
  known_ = true;
}

AdaptiveIntegrator::Trial DormandPrince::judge(double error, double h) const {
  if (error > 1.0)
    return {false, h * std::max(kSafety * std::pow(error, -1.0 / 3.0), kMostShrinkage)};
  if (error >= kWellWithin) return {true, h};
  return {true, h * kSafety * std::pow(std::max(error, kLeastError), -0.2)};
}

std::optional<StepResult> DormandPrince::end_trial(double error) {
  const auto result = AdaptiveIntegrator::end_trial(judge(error, trial_length()));
  if (result == StepResult::accepted) {
    std::copy_n(trial_.last_slope(), slope_.size(), slope_.begin());
    known_ = true;
  }
  return result;
}

AdaptiveIntegrator::Trial DormandPrince::attempt(double h, State& end) {
  std::copy_n(y(), trial_.size(), trial_.begin());
  std::copy_n(slopes(), trial_.size(), trial_.first_slope());
  trial_.advance(t(), h, [this](double s, const double* at, double* dy) { evaluate(s, at, dy); });
  const AdaptiveProblem& p = problem();
  const Trial trial = judge(
      trial_.error(trial_.size(), h,
                   [&p](std::size_t i, double size) { return p.absolute[i] + p.relative * size; }),
      h);
  std::copy_n(trial_.end(), trial_.size(), end.begin());
  if (trial.accepted) std::copy_n(trial_.last_slope(), slope_.size(), slope_.begin());
  return trial;
}

void DormandPrince::interpolate(double time, double* out) {
  trial_.write_inside((time - t_old()) / (t() - t_old()), out);
}

std::unique_ptr<AdaptiveIntegrator> make_dormand_prince(AdaptiveProblem problem) {
  return std::make_unique<DormandPrince>(std::move(problem));
}

}  // namespace linkstudy

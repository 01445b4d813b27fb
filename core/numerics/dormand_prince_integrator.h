// The integrator of Dormand and Prince (core/numerics/dormand_prince.h). Its trials are those of
// its own slopes, or are made elsewhere, as of several integrators side by side:
//   begin_step(latest), then one trial of trial_length() from t(), y() and slopes() after another
//   until end_trial() says how the step has ended
#pragma once

#include "core/numerics/adaptive_integrator.h"
#include "core/numerics/dormand_prince.h"

namespace linkstudy {

class DormandPrince final : public AdaptiveIntegrator {
 public:
  explicit DormandPrince(AdaptiveProblem problem);

  // f(t(), y()): the last slope of a step is the first of the next.
  const double* slopes() override;
  // Where a trial is put: begin, end, last slope, and what value_at() asks for, at the latest
  // before it does. `end` is to be written in trial_end() too.
  DormandPrinceStep<double>& trial() { return trial_; }
  using AdaptiveIntegrator::trial_end;
  // error: the largest over what is allowed, infinite where it is no number.
  std::optional<StepResult> end_trial(double error);
  using AdaptiveIntegrator::count_evaluations;

  // As replace(), where the slopes at y are known.
  void replace(const double* y, const double* slopes);
  using AdaptiveIntegrator::replace;

 private:
  Trial judge(double error, double h) const;
  void forget_slopes() override { known_ = false; }
  Trial attempt(double h, State& end) override;
  void interpolate(double time, double* out) override;

  DormandPrinceStep<double> trial_;
  State slope_;  // at (t(), y())
  bool known_ = false;
};

}  // namespace linkstudy

#include <boost/numeric/odeint/stepper/controlled_runge_kutta.hpp>
#include <boost/numeric/odeint/stepper/runge_kutta_dopri5.hpp>
#include <cmath>
#include <limits>

#include "core/numerics/adaptive_methods.h"

namespace linkstudy {
namespace {

namespace odeint = boost::numeric::odeint;
using State = std::vector<double>;

// Largest error over what it may be, an absolute tolerance for each unknown. No number is an error
// without bound: comparisons with it would accept the step.
class ErrorScale {
 public:
  explicit ErrorScale(const AdaptiveProblem& problem) : problem_(&problem) {}

  template <class Algebra>
  double error(Algebra&, const State& y, const State&, const State& estimate, double) const {
    double worst = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double allowed = problem_->absolute[i] + problem_->relative * std::fabs(y[i]);
      const double part = std::fabs(estimate[i]) / allowed;
      if (!std::isfinite(part)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, part);
    }
    return worst;
  }

 private:
  const AdaptiveProblem* problem_;
};

class DormandPrince final : public AdaptiveIntegrator {
 public:
  explicit DormandPrince(AdaptiveProblem p)
      : AdaptiveIntegrator(std::move(p)),
        stepper_(ErrorScale(problem())),
        begin_(problem().absolute.size()),
        begin_slope_(begin_),
        end_slope_(begin_),
        slope_(begin_),
        inside_(begin_) {}

 private:
  using Method = odeint::runge_kutta_dopri5<State>;
  using Stepper = odeint::controlled_runge_kutta<Method, ErrorScale>;

  void forget_slopes() override { known_ = false; }

  // The last slope of a step is the first of the next.
  const double* slopes() override {
    if (!known_) evaluate(t(), y(), slope_.data());
    known_ = true;
    return slope_.data();
  }

  Trial attempt(double h, State& end) override {
    slopes();
    begin_.assign(y(), y() + begin_.size());
    begin_slope_ = slope_;
    double time = t(), next = h;
    const auto system = [this](const State& at, State& dy, double s) {
      evaluate(s, at.data(), dy.data());
    };
    const auto result =
        stepper_.try_step(system, begin_, begin_slope_, time, end, end_slope_, next);
    const bool accepted = result == odeint::success;
    if (accepted) slope_ = end_slope_;
    return {accepted, next};
  }

  void interpolate(double time, double* out) override {
    stepper_.stepper().calc_state(time, inside_, begin_, begin_slope_, t_old(), inside_, end_slope_,
                                  t());
    std::copy(inside_.begin(), inside_.end(), out);
  }

  Stepper stepper_;
  State begin_, begin_slope_, end_slope_;  // of the last step
  State slope_;                            // at (t(), y())
  State inside_;
  bool known_ = false;
};

}  // namespace

std::unique_ptr<AdaptiveIntegrator> make_dormand_prince(AdaptiveProblem problem) {
  return std::make_unique<DormandPrince>(std::move(problem));
}

}  // namespace linkstudy

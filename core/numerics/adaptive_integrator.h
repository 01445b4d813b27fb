// Initial value problems y' = f(t, y) by steps whose length follows from their error, with the
// solution between the ends of the last step:
//   dormand_prince  explicit, order 5(4), dense output of order 4; 6 evaluations a step
//                   (dormand_prince.h)
//   radau           implicit (Radau IIA, three stages), order 5(3), dense output of order 3,
//                   stiffly accurate; 3 evaluations an iteration of Newton, and where the
//                   derivative is not known two a column of a new Jacobian (radau.cpp)
// A step is accepted when the estimate of its error stays below
//   absolute_i + relative max |y_i|
// in every unknown (dormand_prince) or in the mean square over them (radau). Knows no
// mechanics. A step that fails is a result; no exception leaves.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace linkstudy {

enum class AdaptiveMethod { dormand_prince, radau };

// Writes dy = f(t, y).
using Slopes = std::function<void(double t, const double* y, double* dy)>;

// Writes df/dy, by columns, of the unknowns whose errors count; false where it is not known.
using SlopeDerivative = std::function<bool(double t, const double* y, double* columns)>;

struct AdaptiveProblem {
  Slopes slopes;
  double relative = 1e-8;
  std::vector<double> absolute;  // (size) > 0, in the unit of each; infinite (of the last, passive
                                 // ones): errors do not count
  int passive = 0;               // trailing unknowns that f does not depend on
  double max_step = 0.0;         // 0: none
  SlopeDerivative derivative = nullptr;  // for radau; without it, or where it is not known:
                                         // differences
  int size() const { return static_cast<int>(absolute.size()); }
};

// not_finite: f or the solution is no number however short the step; too_small: the error asks for
// steps below 1e-14 of the time reached.
enum class StepResult { accepted, not_finite, too_small };

class AdaptiveIntegrator {
 public:
  explicit AdaptiveIntegrator(AdaptiveProblem problem);
  virtual ~AdaptiveIntegrator() = default;
  AdaptiveIntegrator(const AdaptiveIntegrator&) = delete;
  AdaptiveIntegrator& operator=(const AdaptiveIntegrator&) = delete;

  // Begins, or begins anew, at (t, y). h: length of the first try; 0: from the size of the slopes
  // and their change.
  void start(double t, const double* y, double h = 0.0);
  // One accepted step that does not pass `latest`; exactly there when it would.
  StepResult step(double latest);
  // The same begun, for methods whose trials are made elsewhere: their lengths.
  void begin_step(double latest);
  double trial_length() const { return h_; }
  // The state at the end of the last step was changed a little by the caller, or f was.
  void replace(const double* y);

  double t_old() const { return t_old_; }
  double t() const { return t_; }
  const double* y() const { return y_.data(); }
  // The solution of the last step at t_old() <= time <= t(); y() at t().
  void value_at(double time, double* out);

  double next_step() const { return next_; }  // the length proposed
  long steps() const { return steps_; }       // accepted
  long rejected() const { return rejected_; }
  long evaluations() const { return evaluations_; }  // of f, all of them

 protected:
  using State = std::vector<double>;
  void evaluate(double t, const double* y, double* dy);
  const AdaptiveProblem& problem() const { return problem_; }
  struct Trial {
    bool accepted;
    double next;  // the length to try next
  };
  // Of a step that has begun; none: to be tried again. trial_end: what the trial has reached.
  std::optional<StepResult> end_trial(const Trial& trial);
  State& trial_end() { return end_; }
  void count_evaluations(long count) { evaluations_ += count; }

 private:
  // f(t(), y()), kept until it is forgotten or a step is accepted.
  virtual const double* slopes() = 0;
  virtual void forget_slopes() = 0;
  // What earlier steps said about the length of the next is of no use any more.
  virtual void forget_steps() {}
  // Tries a step of length h from (t(), y()) to `end`.
  virtual Trial attempt(double h, State& end) = 0;
  virtual void interpolate(double time, double* out) = 0;

  double guess_step();
  double clip(double h, double latest) const;

  AdaptiveProblem problem_;
  double t_old_ = 0.0, t_ = 0.0;
  double next_ = 0.0;
  State y_, end_;
  double h_ = 0.0, latest_ = 0.0;  // of the step that has begun
  double proposed_ = 0.0;          // its length, had it no latest end
  bool first_ = true;              // trial of the step
  State ahead_, later_;            // scratch
  long steps_ = 0, rejected_ = 0, evaluations_ = 0;
};

std::unique_ptr<AdaptiveIntegrator> make_adaptive_integrator(AdaptiveMethod method,
                                                             AdaptiveProblem problem);

}  // namespace linkstudy

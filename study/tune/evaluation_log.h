// Every evaluation a tuner has asked for, by exact point and step factor.
//
// Judging an answer: ratio = max_i error_i / tolerance_i over the components. A point is feasible
// when ratio <= 1. An answer with a cause, or with an error that is negative or not finite, has an
// infinite ratio; a cause that may be the machine's and not the point's proves nothing.
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "study/record/transient.h"
#include "study/tune/tuning_problem.h"

namespace linkstudy::tuning {

struct Observation {
  Request request;
  Answer answer;
};

double compute_ratio(const Answer& answer, const std::vector<MatchComponent>& components);
// Index of the component with the largest error / tolerance; 0 when the answer has none.
std::size_t find_binding(const Answer& answer, const std::vector<MatchComponent>& components);
// diverged, energy_blowup, step_budget, step_too_coarse: the ends a too large step causes.
bool is_instability(Cause cause);

// A point is accepted when it is feasible at the base step and at half of it, rejected when it
// fails at one of them, and open while an answer is missing or transient.
enum class Acceptance { accepted, rejected, open };

class EvaluationLog {
 public:
  EvaluationLog(const TuningProblem& problem, const TuningOptions& options, EvaluateBatch evaluate);

  // Asks for what is not known yet, `batch` requests at a time, in order. Returns false when the
  // budget cut some off.
  bool evaluate(const std::vector<Request>& requests);

  const Observation* find(const std::vector<double>& x, double step_factor) const;
  // Ratio at one variable's value, nothing where it was not evaluated.
  std::optional<double> ratio(double value, double step_factor) const;
  Acceptance acceptance(const std::vector<double>& x) const;
  // Feasible at the base step, and not rejected at half of it.
  bool is_candidate(const std::vector<double>& x) const;
  // Values evaluated at the base step, ascending (one variable).
  std::vector<double> base_values() const;

  const std::vector<Observation>& observations() const { return observations_; }
  const TuningProblem& problem() const { return problem_; }
  const TuningOptions& options() const { return options_; }
  // What is minimised (tuning_problem.h).
  double objective(const Observation& seen) const;
  double objective(const std::vector<double>& x) const;  // infinite where it is not known
  // Less is no improvement: decades; of a response a part of its size.
  double least_gain(double objective) const;
  std::size_t budget() const;
  std::size_t remaining() const { return budget() - observations_.size(); }
  std::size_t rounds() const { return rounds_; }
  bool exhausted() const { return exhausted_; }

 private:
  using Key = std::pair<std::vector<double>, double>;

  void ask(const std::vector<Request>& requests);

  TuningProblem problem_;
  TuningOptions options_;
  EvaluateBatch evaluate_;
  std::vector<Observation> observations_;  // in the order asked
  std::map<Key, std::size_t> known_;       // -> index into observations_
  std::size_t rounds_ = 0;
  bool exhausted_ = false;
};

// Acceptance from the two answers, either of which may be missing.
Acceptance judge_acceptance(const Observation* base, const Observation* half,
                            const std::vector<MatchComponent>& components);

}  // namespace linkstudy::tuning

// What a tuner is asked and what it may ask back. It knows numbers only: the caller turns a
// request into simulations (all load cases) and reduces them to one error per match component.
//
// Tuned variables are positive and searched in log10, or of a linear range (variable_axis.h). The
// objective, which is minimised, is
//   sum_j weight_j log10 x_j     (all weights 1; or 1 or -1 of one value and 0 of the others)
// with the value itself of a linear range, or a number that evaluations answer. A component matches
// when error <= tolerance, both relative to the reference; that of a limit has tolerance 1.
#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/simulation/cause.h"
#include "core/topology/problem.h"
#include "study/config/search_options.h"
#include "study/record/evaluation.h"

namespace linkstudy::tuning {

struct TunedVariable {
  std::string path;  // "closure.S.sde.stiffness"
  std::string unit;  // "N/m"
  double low = 0.0;  // the declared range, in user units
  double high = 0.0;
  double weight = 1.0;  // of log10 of the value in the objective
  bool is_logarithmic = true;
};

struct MatchComponent {
  std::string name;  // "closure.S.force.x", with the load case in front where there are several
  double tolerance = 0.0;
  std::string bound = {};  // of a limit: "at most 12 N"
};

// What is minimised, where that is none of the sums above.
struct ResponseObjective {
  std::string name;  // "peak"
  bool maximizes = false;
};

struct TuningProblem {
  std::vector<TunedVariable> variables;       // (n)
  std::vector<MatchComponent> components;     // (m), over all load cases
  std::optional<ResponseObjective> response;  // its value is Answer::objective
};

// Several problems over one set of variables and components, with tolerances of their own or at
// another step.
struct TuningTarget {
  TuningProblem problem;
  double step_factor = 1.0;  // times the base step
};

struct TuningOptions : SearchOptions {
  double neighbourhood = 0.1;            // decades around k in which the error must fall
  std::size_t confirm_evaluations = 16;  // new ones for each algorithm of NLopt; 0 skips it
  std::size_t confirm_calls = 400;       // calls of any kind before NLopt is stopped
  // Wall time of NLopt. Finite values make the requests depend on the clock, so it is off unless
  // asked for.
  double confirm_time_s = std::numeric_limits<double>::infinity();
  double initial_step = 0.05;  // of NLopt, decades
  // Multiples of the step that are tried at the answer, ascending (step_reach.h).
  std::vector<int> step_multiples;
  std::uint64_t seed = 1;
};

// Budget of evaluations that is usual for a number of variables.
std::size_t usual_budget(std::size_t variables);

struct Request {
  std::vector<double> x;     // parameter values in user units, (n)
  double step_factor = 1.0;  // 1, 0.5, ...: the same point at that multiple of the step
  std::string purpose;       // "scan", "refine", "lower_end", ...
};

struct Answer {
  std::uint64_t id = 0;
  Cause status = Cause::ok;
  std::string message;           // what a cause has to say
  std::vector<double> errors;    // one per component; ignored unless status is ok
  double h_omega = 0.0;          // step times highest eigenfrequency; NaN or 0 when unknown
  double step_limit = 0.0;       // s, stability limit of the step; NaN or 0 when unknown
  double step = 0.0;             // s, the step this evaluation used
  double objective = 0.0;        // of a response, to be minimised; ignored unless status is ok
  std::vector<Trace> derived{};  // one value each: the damping in SI units that a ratio gives
};

// Answers come in the order of the requests. What is asked depends on earlier answers only.
using EvaluateBatch = std::function<std::vector<Answer>(const std::vector<Request>&)>;

// All problems in one pass; paths are those of a tune file.
std::vector<Problem> check(const TuningProblem& problem, const TuningOptions& options);

// sum_i log10 x_i
double compute_objective(const std::vector<double>& x);
// What is minimised at x: infinite where that is a response and there is none.
double compute_objective(const TuningProblem& problem, const std::vector<double>& x,
                         const Answer& answer);
// The least sum of log10 (of one linear range the least value), the objective unless another one is
// asked for.
bool is_lowest_sum(const TuningProblem& problem);

}  // namespace linkstudy::tuning

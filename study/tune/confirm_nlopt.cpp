#include "study/tune/confirm_nlopt.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "study/tune/nlopt_guard.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

constexpr double kPenalty = 3.0;
using Clock = std::chrono::steady_clock;

// State shared by the objective and the constraints of one algorithm.
class Run {
 public:
  Run(EvaluationLog& log, const std::vector<double>& start, std::size_t budget, nlopt::opt& opt)
      : log_(log), start_(start), budget_(budget), guard_(opt), begin_(Clock::now()) {
    const Observation* seen = log.find(start, 1.0);
    const double own = seen == nullptr ? 0.0 : std::abs(log.objective(*seen));
    if (own > 0.0 && std::isfinite(own)) scale_ = own;
  }

  static double objective(unsigned n, const double* s, double* /*gradient*/, void* run) {
    return static_cast<Run*>(run)->find_objective({s, s + n});
  }

  static void constraints(unsigned m, double* g, unsigned n, const double* s, double* /*gradient*/,
                          void* run) {
    static_cast<Run*>(run)->fill_constraints({s, s + n}, {g, g + m});
  }

  void rethrow() const { guard_.rethrow(); }

  std::vector<double> point_of(const std::vector<double>& s) const {
    std::vector<double> x = start_;
    for (std::size_t j = 0; j < x.size(); ++j) {
      x[j] = move_along(log_.problem().variables[j], start_[j], s[j]);
    }
    return x;
  }

  std::size_t calls() const { return calls_; }
  const std::string& stopped() const { return stopped_; }
  // Evaluations or time are used up: another algorithm would have none either.
  bool is_spent() const { return is_spent_; }

 private:
  struct Constraints {
    double* begin;
    double* end;
  };

  void count_call() {
    ++calls_;
    const std::chrono::duration<double> elapsed = Clock::now() - begin_;
    if (calls_ >= log_.options().confirm_calls) {
      stop("stopped at the call limit");
    } else if (elapsed.count() > log_.options().confirm_time_s) {
      stop("stopped at the time limit");
      is_spent_ = true;
    }
  }

  void stop(const std::string& why) {
    if (stopped_.empty()) stopped_ = why;
    guard_.stop();
  }

  bool may_go_on() const { return stopped_.empty() && !guard_.has_failed(); }

  double find_objective(const std::vector<double>& s) noexcept {
    const std::vector<TunedVariable>& variables = log_.problem().variables;
    if (!log_.problem().response) {
      guard_.run([&] { count_call(); });
      double sum = 0.0;
      for (std::size_t j = 0; j < s.size(); ++j) sum += variables[j].weight * s[j];
      return sum;
    }
    double value = worst_ + 1.0;  // of what has none
    guard_.run([&] {
      count_call();
      const Observation* seen = may_go_on() ? observe(s) : nullptr;
      if (seen == nullptr || !std::isfinite(log_.objective(*seen))) return;
      value = log_.objective(*seen) / scale_;
      worst_ = std::max(worst_, value);
    });
    return value;
  }

  void fill_constraints(const std::vector<double>& s, Constraints g) noexcept {
    std::fill(g.begin, g.end, kPenalty);
    guard_.run([&] {
      count_call();
      const Observation* observation = may_go_on() ? observe(s) : nullptr;
      if (observation != nullptr) write(observation->answer, g);
    });
  }

  const Observation* observe(const std::vector<double>& s) {
    const std::vector<double> x = point_of(s);
    if (log_.find(x, 1.0) == nullptr) {
      if (budget_ == 0) {
        stop("stopped at the evaluation limit");
        is_spent_ = true;
        return nullptr;
      }
      --budget_;
      log_.evaluate({{x, 1.0, "nlopt"}});
    }
    return log_.find(x, 1.0);
  }

  void write(const Answer& answer, Constraints g) const {
    const std::vector<MatchComponent>& components = log_.problem().components;
    if (!std::isfinite(compute_ratio(answer, components))) return;
    for (std::size_t i = 0; i < components.size(); ++i) {
      const double ratio = std::log10(answer.errors[i] / components[i].tolerance);
      g.begin[i] = std::clamp(ratio, -kPenalty, kPenalty);
    }
  }

  EvaluationLog& log_;
  const std::vector<double>& start_;
  std::size_t budget_;
  NloptGuard guard_;
  Clock::time_point begin_;
  double scale_ = 1.0;  // of a response
  double worst_ = 0.0;  // over the scale
  std::size_t calls_ = 0;
  std::string stopped_;
  bool is_spent_ = false;
};

// Largest g_i of an answer, at most the penalty.
double find_violation(const Answer& answer, const std::vector<MatchComponent>& components) {
  const double ratio = compute_ratio(answer, components);
  return std::isfinite(ratio) ? std::min(std::log10(ratio), kPenalty) : kPenalty;
}

std::string describe(nlopt::result result) {
  switch (result) {
    case nlopt::XTOL_REACHED:
      return "step tolerance reached";
    case nlopt::MAXEVAL_REACHED:
      return "NLopt's own evaluation limit";
    case nlopt::FTOL_REACHED:
      return "objective tolerance reached";
    default:
      return "result code " + std::to_string(static_cast<int>(result));
  }
}

// What an algorithm said in the end.
struct Ending {
  std::vector<double> x;
  bool ended_by_itself = false;
  bool is_spent = false;
  std::string ended;
};

void set_up(nlopt::opt& opt, Run& run, const EvaluationLog& log, const std::vector<double>& start) {
  std::vector<double> low(start.size());
  std::vector<double> high(start.size());
  for (std::size_t j = 0; j < start.size(); ++j) {
    const TunedVariable& variable = log.problem().variables[j];
    low[j] = std::min(0.0, distance(variable, start[j], variable.low));
    high[j] = std::max(0.0, distance(variable, start[j], variable.high));
  }
  opt.set_min_objective(&Run::objective, &run);
  opt.add_inequality_mconstraint(&Run::constraints, &run,
                                 std::vector<double>(log.problem().components.size(), 0.0));
  opt.set_lower_bounds(low);
  opt.set_upper_bounds(high);
}

void set_ends(nlopt::opt& opt, const TuningOptions& options) {
  opt.set_initial_step(options.initial_step);
  opt.set_xtol_abs(0.5 * options.resolution);
  opt.set_maxeval(static_cast<int>(options.confirm_calls));
}

Ending optimize(nlopt::opt& opt, const Run& run, const std::vector<double>& start) {
  Ending ending;
  std::vector<double> s(start.size(), 0.0);
  double value = 0.0;
  try {
    const nlopt::result result = opt.optimize(s, value);
    ending.ended = describe(result);
    ending.ended_by_itself = result > 0 && result != nlopt::MAXEVAL_REACHED;
  } catch (const std::exception& error) {
    ending.ended = error.what();
  }
  run.rethrow();
  if (!run.stopped().empty()) {
    ending.ended = run.stopped();
    ending.ended_by_itself = false;
    ending.is_spent = run.is_spent();
  }
  ending.x = run.point_of(s);
  return ending;
}

// Our own incumbent: the lowest feasible point among the start and what was seen since `first`.
std::vector<double> find_lowest(const EvaluationLog& log, const std::vector<double>& start,
                                std::size_t first) {
  std::vector<double> lowest = start;
  const Observation* begin = log.find(start, 1.0);
  bool is_feasible_yet =
      begin == nullptr || compute_ratio(begin->answer, log.problem().components) <= 1.0;
  for (std::size_t i = first; i < log.observations().size(); ++i) {
    const Observation& seen = log.observations()[i];
    const bool is_feasible = compute_ratio(seen.answer, log.problem().components) <= 1.0;
    if (!is_feasible || seen.request.step_factor != 1.0) continue;
    if (!is_feasible_yet || log.objective(seen) < log.objective(lowest)) {
      lowest = seen.request.x;
      is_feasible_yet = true;
    }
  }
  return lowest;
}

// Why a claim does not verify; empty where it does.
std::string find_fault(const EvaluationLog& log, const Ending& ending,
                       const std::vector<double>& lowest) {
  const double slack = 2.0 * log.options().resolution;
  const Observation* seen = log.find(ending.x, 1.0);
  if (!ending.ended_by_itself) return ending.ended;
  if (seen == nullptr) return "it returned a point it never tried";
  if (find_violation(seen->answer, log.problem().components) > slack) {
    return "it returned a point that does not match";
  }
  const double least = log.objective(lowest);
  if (log.objective(ending.x) > least + 2.0 * log.least_gain(least)) {
    return "it returned a point above one that matches";
  }
  return {};
}

Ending run_cobyla(EvaluationLog& log, const std::vector<double>& start, std::size_t budget,
                  NloptReport& report) {
  nlopt::opt opt(nlopt::LN_COBYLA, static_cast<unsigned>(start.size()));
  Run run(log, start, budget, opt);
  set_up(opt, run, log, start);
  set_ends(opt, log.options());
  report.algorithm = "COBYLA";
  Ending ending = optimize(opt, run, start);
  report.calls += run.calls();
  return ending;
}

Ending run_augmented_lagrangian(EvaluationLog& log, const std::vector<double>& start,
                                std::size_t budget, NloptReport& report) {
  nlopt::opt opt(nlopt::LN_AUGLAG, static_cast<unsigned>(start.size()));
  nlopt::opt inner(nlopt::LN_BOBYQA, static_cast<unsigned>(start.size()));
  Run run(log, start, budget, opt);
  set_up(opt, run, log, start);
  set_ends(opt, log.options());
  set_ends(inner, log.options());
  opt.set_local_optimizer(inner);
  report.algorithm = "AUGLAG with BOBYQA";
  Ending ending = optimize(opt, run, start);
  report.calls += run.calls();
  return ending;
}

}  // namespace

NloptReport confirm_with_nlopt(EvaluationLog& log, const std::vector<double>& start,
                               std::size_t reserve) {
  NloptReport report;
  const std::size_t first = log.observations().size();
  const auto budget = [&] {
    const std::size_t available = log.remaining() > reserve ? log.remaining() - reserve : 0;
    return std::min(available, log.options().confirm_evaluations);
  };
  if (budget() == 0) {
    report.ended = "skipped: no evaluations left for it";
    return report;
  }
  nlopt::srand(static_cast<unsigned long>(log.options().seed));
  report.ran = true;
  Ending ending = run_cobyla(log, start, budget(), report);
  std::vector<double> lowest = find_lowest(log, start, first);
  std::string fault = find_fault(log, ending, lowest);
  report.ended = ending.ended;
  if (!fault.empty() && !ending.is_spent && budget() > 0) {
    report.ended = "COBYLA not verified: " + fault + "; ";
    ending = run_augmented_lagrangian(log, lowest, budget(), report);
    lowest = find_lowest(log, start, first);
    fault = find_fault(log, ending, lowest);
    report.ended += ending.ended;
  }
  report.verified = fault.empty();
  if (!report.verified && fault != ending.ended) report.ended += ", not verified: " + fault;
  report.evaluations = log.observations().size() - first;
  report.lowest = lowest.front();
  const double least = log.objective(lowest);
  report.found_lower = log.objective(start) - least > log.least_gain(least);
  return report;
}

}  // namespace linkstudy::tuning

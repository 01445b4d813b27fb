#include "study/tune/confirm_nlopt.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <nlopt.hpp>

namespace linkstudy::tuning {
namespace {

constexpr double kPenalty = 3.0;
constexpr double kInitialStep = 0.05;  // decades
using Clock = std::chrono::steady_clock;

// State shared by the objective and the constraints of one NLopt run.
class Run {
 public:
  Run(EvaluationLog& log, const std::vector<double>& start, std::size_t budget, nlopt::opt& opt)
      : log_(log), start_(start), budget_(budget), opt_(opt), begin_(Clock::now()) {}

  static double objective(unsigned n, const double* s, double* /*gradient*/, void* run) {
    static_cast<Run*>(run)->count_call();
    double sum = 0.0;
    for (unsigned j = 0; j < n; ++j) {
      sum += s[j];
    }
    return sum;
  }

  static void constraints(unsigned m, double* g, unsigned n, const double* s, double* /*gradient*/,
                          void* run) {
    static_cast<Run*>(run)->fill_constraints({s, s + n}, {g, g + m});
  }

  void rethrow() const {
    if (error_) {
      std::rethrow_exception(error_);
    }
  }

  std::size_t calls() const { return calls_; }
  const std::string& stopped() const { return stopped_; }

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
    }
  }

  void stop(const std::string& why) {
    if (stopped_.empty()) {
      stopped_ = why;
    }
    opt_.force_stop();
  }

  // Nothing may leave through the frames of NLopt's C code.
  void fill_constraints(const std::vector<double>& s, Constraints g) noexcept {
    std::fill(g.begin, g.end, kPenalty);
    try {
      count_call();
      const Observation* observation = stopped_.empty() ? observe(s) : nullptr;
      if (observation != nullptr) {
        write(observation->answer, g);
      }
    } catch (...) {
      error_ = std::current_exception();
      stopped_ = "an evaluation threw";
      opt_.force_stop();
    }
  }

  const Observation* observe(const std::vector<double>& s) {
    std::vector<double> x = start_;
    for (std::size_t j = 0; j < x.size(); ++j) {
      const TunedVariable& variable = log_.problem().variables[j];
      x[j] = std::clamp(start_[j] * std::pow(10.0, s[j]), variable.low, variable.high);
    }
    if (log_.find(x, 1.0) == nullptr) {
      if (budget_ == 0) {
        stop("stopped at the evaluation limit");
        return nullptr;
      }
      --budget_;
      log_.evaluate({{x, 1.0, "nlopt"}});
    }
    return log_.find(x, 1.0);
  }

  void write(const Answer& answer, Constraints g) const {
    const std::vector<MatchComponent>& components = log_.problem().components;
    if (!std::isfinite(compute_ratio(answer, components))) {
      return;
    }
    for (std::size_t i = 0; i < components.size(); ++i) {
      const double ratio = std::log10(answer.errors[i] / components[i].tolerance);
      g.begin[i] = std::clamp(ratio, -kPenalty, kPenalty);
    }
  }

  EvaluationLog& log_;
  const std::vector<double>& start_;
  std::size_t budget_;
  nlopt::opt& opt_;
  Clock::time_point begin_;
  std::size_t calls_ = 0;
  std::string stopped_;
  std::exception_ptr error_;
};

std::string describe(nlopt::result result) {
  switch (result) {
    case nlopt::XTOL_REACHED:
      return "step tolerance reached";
    case nlopt::MAXEVAL_REACHED:
      return "NLopt's own evaluation limit";
    default:
      return "result code " + std::to_string(static_cast<int>(result));
  }
}

void set_up(nlopt::opt& opt, Run& run, const EvaluationLog& log, const std::vector<double>& start) {
  std::vector<double> low(start.size());
  std::vector<double> high(start.size());
  for (std::size_t j = 0; j < start.size(); ++j) {
    low[j] = std::min(0.0, std::log10(log.problem().variables[j].low / start[j]));
    high[j] = std::max(0.0, std::log10(log.problem().variables[j].high / start[j]));
  }
  opt.set_min_objective(&Run::objective, &run);
  opt.add_inequality_mconstraint(&Run::constraints, &run,
                                 std::vector<double>(log.problem().components.size(), 0.0));
  opt.set_lower_bounds(low);
  opt.set_upper_bounds(high);
  opt.set_initial_step(kInitialStep);
  opt.set_xtol_abs(0.5 * log.options().resolution);
  opt.set_maxeval(static_cast<int>(log.options().confirm_calls));
}

std::string optimize(nlopt::opt& opt, const Run& run, std::size_t n) {
  std::vector<double> s(n, 0.0);
  double value = 0.0;
  try {
    const nlopt::result result = opt.optimize(s, value);
    return run.stopped().empty() ? describe(result) : run.stopped();
  } catch (const std::exception& error) {
    return run.stopped().empty() ? std::string(error.what()) : run.stopped();
  }
}

}  // namespace

NloptReport confirm_with_nlopt(EvaluationLog& log, const std::vector<double>& start,
                               std::size_t reserve) {
  NloptReport report;
  const std::size_t available = log.remaining() > reserve ? log.remaining() - reserve : 0;
  const std::size_t budget = std::min(available, log.options().confirm_evaluations);
  if (budget == 0) {
    report.ended = "skipped: no evaluations left for it";
    return report;
  }
  nlopt::srand(static_cast<unsigned long>(log.options().seed));
  nlopt::opt opt(nlopt::LN_COBYLA, static_cast<unsigned>(start.size()));
  Run run(log, start, budget, opt);
  set_up(opt, run, log, start);
  const std::size_t first = log.observations().size();
  report.ran = true;
  report.algorithm = "COBYLA";
  report.ended = optimize(opt, run, start.size());
  run.rethrow();
  report.calls = run.calls();
  report.evaluations = log.observations().size() - first;
  report.lowest = start.front();
  for (std::size_t i = first; i < log.observations().size(); ++i) {
    const Observation& seen = log.observations()[i];
    if (compute_ratio(seen.answer, log.problem().components) <= 1.0) {
      report.lowest = std::min(report.lowest, seen.request.x.front());
    }
  }
  report.found_lower = std::log10(start.front() / report.lowest) > log.options().resolution;
  return report;
}

}  // namespace linkstudy::tuning

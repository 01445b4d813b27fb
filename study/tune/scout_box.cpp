#include "study/tune/scout_box.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <nlopt.hpp>

#include "study/tune/lockstep.h"
#include "study/tune/polish_point.h"
#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

constexpr std::size_t kScouts = 4;
constexpr std::size_t kScoutedPerVariable = 150;
constexpr double kFarOff = 3.0;  // decades, of what has a cause
constexpr unsigned kPopulationPerVariable = 6;

// A point matches: the searches have nothing more to do.
class MatchSeen : public std::exception {};

class Scout {
 public:
  Scout(const TuningProblem& problem, const EvaluateBatch& ask, std::size_t budget)
      : problem_(problem), ask_(ask), budget_(budget) {}

  void run(nlopt::algorithm algorithm, std::uint64_t seed) {
    const auto n = static_cast<unsigned>(problem_.variables.size());
    nlopt::srand(static_cast<unsigned long>(seed));  // of this thread
    nlopt::opt opt(algorithm, n);
    opt_ = &opt;
    std::vector<double> low(n);
    std::vector<double> high(n);
    std::vector<double> t(n);
    for (std::size_t j = 0; j < n; ++j) {
      low[j] = position_of(problem_.variables[j], problem_.variables[j].low);
      high[j] = position_of(problem_.variables[j], problem_.variables[j].high);
      t[j] = 0.5 * (low[j] + high[j]);
    }
    opt.set_lower_bounds(low);
    opt.set_upper_bounds(high);
    opt.set_min_objective(&Scout::objective, this);
    opt.set_population(kPopulationPerVariable * n);
    opt.set_maxeval(static_cast<int>(budget_));
    double value = 0.0;
    try {
      opt.optimize(t, value);
    } catch (const std::exception&) {
      // It has seen what it has seen.
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  // Nothing may leave through the frames of NLopt's C code.
  static double objective(unsigned n, const double* t, double* /*gradient*/, void* self) noexcept {
    auto& scout = *static_cast<Scout*>(self);
    try {
      return scout.miss_at({t, t + n});
    } catch (...) {
      if (!scout.error_) scout.error_ = std::current_exception();
      scout.opt_->force_stop();
      return kFarOff;
    }
  }

  double miss_at(const std::vector<double>& t) {
    if (error_ || asked_ == budget_) {
      opt_->force_stop();
      return kFarOff;
    }
    ++asked_;
    std::vector<double> x(t.size());
    for (std::size_t j = 0; j < x.size(); ++j) x[j] = from_axis(problem_.variables[j], t[j]);
    const Answer answer = ask_({{x, 1.0, "scout"}}).front();
    const double ratio = compute_ratio(answer, problem_.components);
    return std::isfinite(ratio) ? std::clamp(std::log10(ratio), -kFarOff, kFarOff) : kFarOff;
  }

  const TuningProblem& problem_;
  const EvaluateBatch& ask_;
  std::size_t budget_;
  std::size_t asked_ = 0;
  nlopt::opt* opt_ = nullptr;
  std::exception_ptr error_;
};

// Answers from the log; throws MatchSeen once one of them matches.
EvaluateBatch ask_until_match(EvaluationLog& log) {
  return [&log, ask = ask_log(log), has_match = false](const std::vector<Request>& all) mutable {
    if (has_match) throw MatchSeen();
    std::vector<Answer> answers = ask(all);
    has_match = std::ranges::any_of(answers, [&](const Answer& one) {
      return compute_ratio(one, log.problem().components) <= 1.0;
    });
    return answers;
  };
}

}  // namespace

std::size_t scout_box(EvaluationLog& log, std::size_t reserve) {
  const std::size_t first = log.observations().size();
  const std::size_t available = log.remaining() > reserve ? log.remaining() - reserve : 0;
  const std::size_t budget =
      std::min(available, kScoutedPerVariable * log.problem().variables.size()) / kScouts;
  if (budget == 0) return 0;
  std::vector<LockstepSearch> searches;
  for (std::size_t i = 0; i < kScouts; ++i) {
    searches.push_back([&, i](const EvaluateBatch& ask) {
      const nlopt::algorithm algorithm = i == 0 ? nlopt::GN_DIRECT_L : nlopt::GN_ISRES;
      Scout(log.problem(), ask, budget).run(algorithm, log.options().seed + i);
    });
  }
  try {
    run_in_lockstep(ask_until_match(log), searches);
  } catch (const MatchSeen&) {
    // What it was for.
  }
  return log.observations().size() - first;
}

}  // namespace linkstudy::tuning

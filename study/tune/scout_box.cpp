#include "study/tune/scout_box.h"

#include <algorithm>
#include <cmath>
#include <exception>

#include "study/tune/lockstep.h"
#include "study/tune/nlopt_guard.h"
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
  Scout(const TuningProblem& problem, const EvaluateBatch& ask, std::size_t budget,
        nlopt::algorithm algorithm)
      : problem_(problem),
        ask_(ask),
        budget_(budget),
        opt_(algorithm, static_cast<unsigned>(problem.variables.size())),
        guard_(opt_) {}

  void run(std::uint64_t seed) {
    const unsigned n = opt_.get_dimension();
    nlopt::srand(static_cast<unsigned long>(seed));  // of this thread
    std::vector<double> low(n);
    std::vector<double> high(n);
    std::vector<double> t(n);
    for (std::size_t j = 0; j < n; ++j) {
      low[j] = position_of(problem_.variables[j], problem_.variables[j].low);
      high[j] = position_of(problem_.variables[j], problem_.variables[j].high);
      t[j] = 0.5 * (low[j] + high[j]);
    }
    opt_.set_lower_bounds(low);
    opt_.set_upper_bounds(high);
    opt_.set_min_objective(&Scout::objective, this);
    opt_.set_population(kPopulationPerVariable * n);
    opt_.set_maxeval(static_cast<int>(budget_));
    double value = 0.0;
    try {
      opt_.optimize(t, value);
    } catch (const std::exception&) {
      // It has seen what it has seen.
    }
    guard_.rethrow();
  }

 private:
  static double objective(unsigned n, const double* t, double* /*gradient*/, void* self) noexcept {
    auto& scout = *static_cast<Scout*>(self);
    double miss = kFarOff;
    scout.guard_.run([&] { miss = scout.miss_at({t, t + n}); });
    return miss;
  }

  double miss_at(const std::vector<double>& t) {
    if (guard_.has_failed() || asked_ == budget_) {
      guard_.stop();
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
  nlopt::opt opt_;
  NloptGuard guard_;
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
      Scout(log.problem(), ask, budget, algorithm).run(log.options().seed + i);
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

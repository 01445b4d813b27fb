#include "study/tune/step_reach.h"

#include <algorithm>

namespace linkstudy::tuning {
namespace {

constexpr std::size_t kMostEvaluations = 16;

class Reach {
 public:
  Reach(EvaluationLog& log, const std::vector<double>& point)
      : log_(log), point_(point), multiples_(log.options().step_multiples) {
    multiples_.insert(multiples_.begin(), 1);
  }

  StepReach run() {
    std::size_t good = 0;  // positions among the multiples
    std::size_t bad = multiples_.size();
    for (const std::size_t i : ask_doubled()) {
      if (!matches(i)) {
        bad = i;
        break;
      }
      good = i;
    }
    while (bad - good > 1) {
      const std::size_t middle = good + (bad - good) / 2;
      (matches(middle) ? good : bad) = middle;
    }
    return describe(good, bad);
  }

 private:
  // 1, 2, 4, ... and the last position, all in one round: together they cost less than one run.
  std::vector<std::size_t> ask_doubled() {
    std::vector<std::size_t> positions;
    std::vector<Request> requests;
    const std::size_t last = multiples_.size() - 1;
    for (std::size_t i = 1; i < last; i *= 2) positions.push_back(i);
    positions.push_back(last);
    for (const std::size_t i : positions) {
      requests.push_back({point_, static_cast<double>(multiples_[i]), "step"});
    }
    log_.evaluate(requests);
    return positions;
  }

  const Observation& ask(std::size_t i) {
    const double factor = multiples_[i];
    log_.evaluate({{point_, factor, "step"}});
    return *log_.find(point_, factor);
  }

  bool matches(std::size_t i) {
    return compute_ratio(ask(i).answer, log_.problem().components) <= 1.0;
  }

  StepReach describe(std::size_t good, std::size_t bad) {
    StepReach reach;
    reach.step = ask(good).answer.step;
    if (bad >= multiples_.size()) return reach;
    const Answer& failing = ask(bad).answer;
    reach.fails_at = failing.step;
    reach.ratio = compute_ratio(failing, log_.problem().components);
    reach.cause = failing.status;
    reach.evaluation = failing.id;
    return reach;
  }

  EvaluationLog& log_;
  const std::vector<double>& point_;
  std::vector<int> multiples_;
};

}  // namespace

std::optional<StepReach> find_step_reach(EvaluationLog& log, const std::vector<double>& point) {
  if (log.options().step_multiples.empty() || log.remaining() < kMostEvaluations) {
    return std::nullopt;
  }
  return Reach(log, point).run();
}

}  // namespace linkstudy::tuning

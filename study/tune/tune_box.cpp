#include "study/tune/tune_box.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/tune/branch_and_bound.h"
#include "study/tune/polish_point.h"
#include "study/tune/scan_box.h"
#include "study/tune/scout_box.h"
#include "study/tune/start_nlopt.h"
#include "study/tune/step_reach.h"

namespace linkstudy::tuning {
namespace {

constexpr int kMostPolishes = 6;
constexpr std::size_t kStarts = 4;
constexpr double kWideStep = 0.25;    // of NLopt from the scan, decades
constexpr double kNarrowStep = 0.03;  // from a match that the proof found

std::size_t evidence_reserve(const EvaluationLog& log) {
  return std::min<std::size_t>(log.budget() / 4, 8 + 24 * log.problem().variables.size());
}

class BoxTuning {
 public:
  BoxTuning(const TuningProblem& problem, const TuningOptions& options,
            const EvaluateBatch& evaluate)
      : log_(problem, options, evaluate), reserve_(evidence_reserve(log_)) {
    result_.problem = problem;
  }

  TuningResult run() {
    scan_ = make_box_scan(log_.problem(), log_.options().scan);
    std::vector<Request> requests;
    for (const std::vector<double>& x : scan_) requests.push_back({x, 1.0, "scan"});
    log_.evaluate(requests);
    const std::size_t starts = std::min(kStarts, log_.options().batch);
    result_.nlopt = search_from(log_, choose_starts(log_, starts), kWideStep, reserve_);
    if (!settle_lowest(log_, reserve_)) look_elsewhere();
    if (settle_lowest(log_, reserve_)) {
      search();
      describe_point();
    } else {
      describe_no_match();
    }
    finish();
    return std::move(result_);
  }

 private:
  // Where neither the scan nor what NLopt finds around its points matches.
  void look_elsewhere() {
    if (scout_box(log_, reserve_) == 0) return;
    const std::size_t starts = std::min(kStarts, log_.options().batch);
    const NloptReport more = search_from(log_, choose_starts(log_, starts), kWideStep, reserve_);
    result_.nlopt.evaluations += more.evaluations;
  }

  void search() {
    for (int pass = 0; pass < kMostPolishes; ++pass) {
      point_ = polish(settle_lowest(log_, reserve_).value());
      gather_evidence();
      if (settle_lowest(log_, 0).value() != point_ && improves()) continue;
      if (!can_be_proven(log_.problem())) return;
      bound_ = gather_proof(log_, point_, 0);
      if (bound_->end != BoundEnd::lower_match) return;
      const NloptReport more =
          search_from(log_, {settle_lowest(log_, 0).value()}, kNarrowStep, reserve_);
      result_.nlopt.evaluations += more.evaluations;
    }
  }

  std::vector<double> polish(std::vector<double> point) {
    return is_lowest_sum(log_.problem()) ? polish_point(log_, std::move(point), reserve_)
                                         : polish_freely(log_, std::move(point), reserve_);
  }

  bool improves() {
    const double own = log_.objective(point_);
    return own - log_.objective(settle_lowest(log_, 0).value()) > log_.least_gain(own);
  }

  void gather_evidence() {
    const std::size_t kept = 6 + 4 * point_.size();
    windows_ = find_windows(log_, point_, std::min(kept, log_.remaining()));
    std::vector<double> margins;
    for (std::size_t j = 0; j < point_.size(); ++j) margins.push_back(windows_[j].margin);
    terms_ = make_terms(log_, point_, margins, scan_);
    log_.evaluate(list_requests(terms_, log_));
    log_.evaluate(list_requests(terms_, log_));  // half steps of what the first round showed
  }

  void describe_point() {
    const std::vector<double> lowest = settle_lowest(log_, 0).value();
    if (log_.acceptance(lowest) == Acceptance::accepted && lowest != point_ && improves()) {
      point_ = lowest;  // the passes ended before it was followed
      gather_evidence();
    }
    result_.point = point_;
    result_.answer = log_.find(point_, 1.0)->answer;
    result_.answer_value = point_.front();
    result_.binding = find_binding(result_.answer, log_.problem().components);
    result_.objective = log_.objective(point_);
    result_.windows = windows_;
    result_.window = windows_.front();
    result_.certificate = make_certificate(terms_, log_);
    result_.status = status_of(result_.certificate->verdict);
    result_.reason = result_.certificate->reason;
    result_.staircase =
        can_be_proven(log_.problem()) ? find_staircase(log_) : std::vector<Observation>{};
    if (result_.status == TuningStatus::inconclusive) result_.reason += say_end();
  }

  std::string say_end() const {
    const BoundEnd end = bound_ ? bound_->end : BoundEnd::closed;
    if (log_.remaining() == 0 || end == BoundEnd::budget) return "; " + budget_reason(log_);
    if (end == BoundEnd::undecided) return "; with this mu no smaller gap can be proven";
    if (end == BoundEnd::step_ends_it) return say_step_failure();
    if (end == BoundEnd::not_monotone) return "; such errors are not monotone";
    return {};
  }

  // A range that reaches far past what the step can run.
  std::string say_step_failure() const {
    const auto& all = log_.observations();
    const auto seen = std::ranges::find_if(
        all, [&](const Observation& one) { return one.answer.id == bound_->blocked_by; });
    if (seen == all.end()) return {};
    const bool has_ended = seen->answer.status != Cause::ok;
    return fmt::format(
        "; what lies below {:.4g} cannot be excluded at this step, whatever mu: the run there {} "
        "(evaluation {}) and tells nothing of softer ones; end the ranges where runs are stable, "
        "or take a smaller step",
        fmt::join(seen->request.x, ", "),
        has_ended ? fmt::format("ends as {}", linkstudy::name_of(seen->answer.status))
                  : std::string("fails by its step"),
        seen->answer.id);
  }

  void describe_no_match() {
    const std::vector<std::vector<double>> nearest = choose_starts(log_, 1);
    result_.status = TuningStatus::infeasible;
    result_.reason = "no point of the box matches";
    if (!nearest.empty()) describe_nearest(nearest.front());
    doubt_no_match(log_, result_);
  }

  void describe_nearest(const std::vector<double>& x) {
    result_.answer = log_.find(x, 1.0)->answer;
    result_.answer_value = x.front();
    result_.binding = find_binding(result_.answer, log_.problem().components);
    const MatchComponent& component = log_.problem().components[result_.binding];
    result_.reason += fmt::format("; nearest is {:.4g}, where {} misses by a factor of {:.3g}",
                                  fmt::join(x, ", "), component.name,
                                  compute_ratio(result_.answer, log_.problem().components));
    if (log_.remaining() > 0) log_.evaluate({{x, 0.5, "half_step"}});
    const Observation* half = log_.find(x, 0.5);
    const bool is_helped =
        half != nullptr && compute_ratio(half->answer, log_.problem().components) <= 1.0;
    if (is_helped) {
      result_.reason +=
          fmt::format("; at half the step it matches: use step <= {:.2g} s", half->answer.step);
    }
  }

  void finish() {
    result_.points = classify_box(log_, scan_);
    if (!result_.point.empty()) result_.step_reach = find_step_reach(log_, point_);
    result_.observations = log_.observations();
    result_.rounds = log_.rounds();
    result_.first_failure = find_first_failure(log_);
    if (!result_.point.empty()) add_notes();
    if (result_.problem.variables.size() == 1) result_.windows.clear();
  }

  void add_notes() {
    for (std::size_t j = 0; j < point_.size() && !log_.problem().response; ++j) {
      const TunedVariable& variable = log_.problem().variables[j];
      const bool is_open = variable.weight > 0.0
                               ? windows_[j].low_open
                               : variable.weight < 0.0 && point_[j] == variable.high;
      if (!is_open) continue;
      result_.notes.push_back(
          fmt::format("'{}' matches to the end of its range at {:.6g}: extend it to find the "
                      "boundary",
                      variable.path, point_[j]));
    }
    note_coarse_step(result_);
  }

  EvaluationLog log_;
  std::size_t reserve_;
  TuningResult result_;
  std::vector<std::vector<double>> scan_;
  std::vector<double> point_;
  std::vector<Window> windows_;
  CertificateTerms terms_;
  std::optional<BoundReport> bound_;
};

}  // namespace

TuningResult tune_box(const TuningProblem& problem, const TuningOptions& options,
                      const EvaluateBatch& evaluate) {
  return BoxTuning(problem, options, evaluate).run();
}

}  // namespace linkstudy::tuning

#include "study/calibrate/calibrate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace linkstudy::calibration {
namespace {

using Eigen::Index;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kMostReturns = 3;        // to a better point that a profile or the check has found
constexpr double kSameMinimum = 1e-3;  // of the rise, or of S where that is nothing
constexpr double kFarAway = 0.02;      // of the cube
constexpr double kNoRise = 1e-3;       // of the rise at the end of an interval
constexpr double kNoResidual = 1e-18;  // of the greatest S of a start: rounding
// The same of the check at an exact minimum, which it leaves 1e-6 of the cube away: S rises by some
// hundred times the square of that.
constexpr double kNoResidualOfCheck = 1e-10;

// One of the two points of each column, at least: else its parameter would pass for one without
// effect.
bool have_all_columns(const std::vector<const FitSample*>& answers) {
  for (std::size_t i = 0; i + 1 < answers.size(); i += 2) {
    if (!answers[i]->is_ok() && !answers[i + 1]->is_ok()) return false;
  }
  return true;
}

Curvature unknown_curvature(Index n) {
  Curvature unknown;
  unknown.covariance = Matrix::Constant(n, n, std::numeric_limits<double>::infinity());
  unknown.correlation = Matrix::Constant(n, n, kNan);
  return unknown;
}

class Fit {
 public:
  Fit(const FitProblem& problem, const FitOptions& options, EvaluateBatch evaluate)
      : log_(problem, options, std::move(evaluate)) {
    result_.problem = problem;
    result_.options = options;
  }

  FitResult run() {
    std::vector<Descent> descents = run_starts(log_);
    for (const Descent& one : descents) {
      if (std::isfinite(one.start_sum())) {
        greatest_start_ = std::max(greatest_start_, one.start_sum());
      }
      consider(one);
    }
    if (best_ != nullptr) describe_best();
    report_starts(descents);
    judge();
    result_.evaluations = log_.evaluations();
    result_.failed = log_.failed();
    result_.rounds = log_.rounds();
    return std::move(result_);
  }

 private:
  const FitProblem& problem() const { return log_.problem(); }
  std::size_t count() const { return problem().parameters.size(); }

  void consider(const Descent& descent) {
    const FitSample* sample = descent.sample();
    if (sample == nullptr || !sample->is_ok()) return;
    if (best_ != nullptr && sample->sum >= best_->sum) return;
    best_ = sample;
    point_ = descent.point();
  }

  void descend_from(const Vector& start) {
    DescentSettings settings;
    settings.difference = log_.options().difference;
    std::vector<Descent> again;
    again.emplace_back(problem(), settings, start);
    run_together(log_, again);
    consider(again.front());
  }

  // What is found below the best point sends the fit back there.
  void describe_best() {
    for (int i = 0; i <= kMostReturns; ++i) {
      measure();
      // Of S: below it neither method can tell two minima apart.
      const double slack = is_exact() ? kNoResidualOfCheck * greatest_start_
                                      : std::max(0.01 * result_.figures.rise, 1e-6 * best_->sum);
      result_.check = cross_check(log_, {point_, best_->sum, slack});
      const bool is_lower = result_.check.ran && result_.check.sum < best_->sum - slack;
      if (is_lower) {
        descend_from(result_.check.point);
        continue;
      }
      if (!wants_profiles()) break;
      profiles_ = trace_profiles(log_, {point_, best_->sum, result_.figures.rise}, curvature_);
      if (profiles_->better == nullptr) break;
      descend_from(to_cube(problem(), profiles_->better->values));
    }
    report_estimates();
    report_profiles();
  }

  bool is_exact() const { return best_->sum <= kNoResidual * greatest_start_; }
  bool wants_profiles() const {
    return log_.options().profiles && result_.figures.is_usable() && !is_exact() &&
           !log_.is_exhausted();
  }

  // Jacobian, curvature and figures at the best point.
  void measure() {
    DifferencePlan plan{point_, difference_steps(problem(), point_, log_.options().difference),
                        std::vector<bool>(count(), false)};
    const std::vector<const FitSample*> answers = log_.ask(list_difference_points(plan));
    curvature_ =
        have_all_columns(answers)
            ? compute_curvature(problem(), point_, make_jacobian(plan, best_->residuals, answers))
            : unknown_curvature(point_.size());
    result_.figures = compute_figures(problem(), best_->residuals, count(), log_.options());
  }

  double value_at(Index i, double u) const {
    Vector point = point_;
    point[i] = u;
    return to_values(problem(), point)[static_cast<std::size_t>(i)];
  }

  void report_estimates() {
    for (Index i = 0; i < point_.size(); ++i) result_.estimates.push_back(estimate_of(i));
    result_.sum = best_->sum;
    result_.evaluation = best_->id;
    result_.residuals.assign(best_->residuals.begin(), best_->residuals.end());
    result_.correlation = curvature_.correlation;
    result_.singular_values = curvature_.singular_values;
    for (const FlatDirection& one : curvature_.flat) result_.flat.push_back(one.name);
  }

  Estimate estimate_of(Index i) const {
    Estimate estimate;
    estimate.value = value_at(i, point_[i]);
    if (point_[i] <= 0.0) estimate.at_bound = AtBound::low;
    if (point_[i] >= 1.0) estimate.at_bound = AtBound::high;
    add_linear(i, estimate);
    add_profile(i, estimate);
    judge_identifiability(i, estimate);
    return estimate;
  }

  void add_linear(Index i, Estimate& estimate) const {
    const ResidualFigures& figures = result_.figures;
    const double deviation = std::sqrt(figures.variance * curvature_.covariance(i, i));
    estimate.standard_error = kNan;
    estimate.linear = {kNan, kNan};
    if (!figures.is_usable() || !std::isfinite(deviation)) return;
    const FitParameter& parameter = problem().parameters[static_cast<std::size_t>(i)];
    const double span = parameter.is_logarithmic ? std::log(parameter.high / parameter.low)
                                                 : parameter.high - parameter.low;
    estimate.standard_error = deviation * span * (parameter.is_logarithmic ? estimate.value : 1.0);
    const double half = figures.quantile * deviation;
    if (point_[i] - half >= 0.0 && estimate.at_bound == AtBound::no) {
      estimate.linear.low = value_at(i, point_[i] - half);
    }
    if (point_[i] + half <= 1.0 && estimate.at_bound == AtBound::no) {
      estimate.linear.high = value_at(i, point_[i] + half);
    }
  }

  void add_profile(Index i, Estimate& estimate) const {
    estimate.profile = {kNan, kNan};
    if (!profiles_) return;
    const auto index = static_cast<std::size_t>(i);
    const ProfileSide& low = profiles_->low[index];
    const ProfileSide& high = profiles_->high[index];
    estimate.low_end = low.end;
    estimate.high_end = high.end;
    if (low.end == ProfileEnd::crossed) estimate.profile.low = value_at(i, low.u);
    if (high.end == ProfileEnd::crossed) estimate.profile.high = value_at(i, high.u);
  }

  // A direction that is flat at the best point may rise at a distance; its profile tells.
  bool stays_flat(Index i) const {
    if (!profiles_) return true;
    return std::ranges::any_of(profiles_->points, [&](const ProfilePoint& one) {
      return one.parameter == i && std::abs(one.point[i] - point_[i]) > kFarAway &&
             one.sum - best_->sum < kNoRise * result_.figures.rise;
    });
  }

  void judge_identifiability(Index i, Estimate& estimate) const {
    const Interval& interval = profiles_ ? estimate.profile : estimate.linear;
    const bool has_low = std::isfinite(interval.low) || estimate.at_bound == AtBound::low;
    const bool has_high = std::isfinite(interval.high) || estimate.at_bound == AtBound::high;
    const bool is_open = !std::isfinite(interval.low) && !std::isfinite(interval.high);
    for (const FlatDirection& one : curvature_.flat) {
      if (!one.holds(i) || !stays_flat(i)) continue;
      estimate.identifiability = Identifiability::structurally_flat;
      estimate.combination = one.name;
      // Where it ends is for the bounds of the others to say, not for the data.
      estimate.profile = estimate.linear = {kNan, kNan};
      estimate.low_end = estimate.high_end = ProfileEnd::bound;
      return;
    }
    const bool is_known = is_exact() || (has_low && has_high && !is_open);
    if (!is_known) estimate.identifiability = Identifiability::practically_not;
  }

  void report_profiles() {
    if (!profiles_) return;
    for (const ProfilePoint& one : profiles_->points) {
      const std::vector<double> values = to_values(problem(), one.point);
      const auto index = static_cast<std::size_t>(one.parameter);
      result_.profiles.push_back(
          {index, values[index], (one.sum - best_->sum) / result_.figures.rise, values});
    }
  }

  void report_starts(const std::vector<Descent>& descents) {
    double near = 0.0;
    if (best_ != nullptr) {
      near = is_exact() ? kNoResidual * greatest_start_
                        : kSameMinimum * std::max(result_.figures.rise, best_->sum * 1e-3);
    }
    for (const Descent& one : descents) {
      StartReport report;
      report.to = to_values(problem(), one.point());
      const FitSample* sample = one.sample();
      report.from_sum = one.start_sum();
      report.to_sum = sample == nullptr ? kNan : sample->sum;
      report.end = one.end();
      report.iterations = one.iterations();
      report.is_best = best_ != nullptr && report.to_sum <= best_->sum + near;
      result_.starts.push_back(std::move(report));
    }
    const std::vector<Vector> points = list_starts(problem(), log_.options().seed, descents.size());
    for (std::size_t i = 0; i < descents.size(); ++i) {
      result_.starts[i].from = to_values(problem(), points[i]);
    }
  }

  void judge() {
    if (best_ == nullptr) {
      result_.reason =
          log_.first_failure() == nullptr
              ? "no evaluation was made"
              : fmt::format("every start failed; the first: {}: {}",
                            name_of(log_.first_failure()->status), log_.first_failure()->message);
      return;
    }
    const auto not_known = std::ranges::count_if(result_.estimates, [](const Estimate& one) {
      return one.identifiability != Identifiability::identifiable;
    });
    result_.status = not_known == 0 ? FitStatus::fitted : FitStatus::ambiguous;
    if (!result_.figures.is_usable() && !is_exact()) {
      result_.reason = fmt::format(
          "the residuals are so correlated that {:.3g} effective samples are left for {} "
          "parameters: there are no intervals",
          result_.figures.effective, count());
    } else if (not_known > 0) {
      result_.reason =
          fmt::format("{} of {} parameters are not determined by these data", not_known, count());
    } else if (is_exact()) {
      result_.reason = "the data are met to rounding, so that nothing tells of intervals";
    }
    if (log_.is_exhausted()) {
      result_.status = FitStatus::ambiguous;
      result_.reason =
          fmt::format("the budget of {} evaluations is used up", log_.options().max_evaluations);
    } else if (result_.check.ran && !result_.check.confirms) {
      result_.reason +=
          fmt::format("{}{} does not confirm the minimum ({})", result_.reason.empty() ? "" : "; ",
                      result_.check.algorithm, result_.check.ended);
    }
  }

  FitLog log_;
  FitResult result_;
  const FitSample* best_ = nullptr;
  Vector point_;
  double greatest_start_ = 0.0;
  Curvature curvature_;
  std::optional<Profiles> profiles_;
};

}  // namespace

FitResult calibrate(const FitProblem& problem, const FitOptions& options, EvaluateBatch evaluate) {
  return Fit(problem, options, std::move(evaluate)).run();
}

}  // namespace linkstudy::calibration

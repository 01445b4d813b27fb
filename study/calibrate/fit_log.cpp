#include "study/calibrate/fit_log.h"

#include <algorithm>
#include <limits>
#include <set>

namespace linkstudy::calibration {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

FitSample to_sample(std::vector<double> values, FitAnswer answer) {
  FitSample sample{std::move(values),         answer.id, answer.status,
                   std::move(answer.message), {},        kInfinity};
  if (answer.status != Cause::ok) return sample;
  const Eigen::Map<const Vector> residuals(answer.residuals.data(),
                                           static_cast<Eigen::Index>(answer.residuals.size()));
  const double sum = residuals.squaredNorm();
  // A run that is fine and tells no numbers is no run to go by.
  if (!std::isfinite(sum)) {
    sample.status = Cause::diverged;
    sample.message = "a residual is not finite";
    return sample;
  }
  sample.residuals = residuals;
  sample.sum = sum;
  return sample;
}

}  // namespace

FitLog::FitLog(const FitProblem& problem, const FitOptions& options, EvaluateBatch evaluate)
    : problem_(problem), options_(options), evaluate_(std::move(evaluate)) {
  cut_off_.sum = kInfinity;
  cut_off_.message = "the budget is used up";
}

std::vector<const FitSample*> FitLog::ask(const std::vector<Vector>& points) {
  std::vector<std::vector<double>> values;
  std::vector<std::vector<double>> missing;
  std::set<std::vector<double>> asked;
  for (const Vector& point : points) {
    values.push_back(to_values(problem_, point));
    const bool is_new = !known_.contains(values.back()) && asked.insert(values.back()).second;
    if (is_new) missing.push_back(values.back());
  }
  evaluate(std::move(missing));
  std::vector<const FitSample*> samples;
  for (const std::vector<double>& one : values) {
    const auto found = known_.find(one);
    samples.push_back(found == known_.end() ? &cut_off_ : &found->second);
  }
  return samples;
}

void FitLog::evaluate(std::vector<std::vector<double>> values) {
  const std::size_t left = static_cast<std::size_t>(options_.max_evaluations) - known_.size();
  if (values.size() > left) {
    values.resize(left);
    is_exhausted_ = true;
  }
  if (values.empty()) return;
  ++rounds_;
  std::vector<FitAnswer> answers = evaluate_(values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::vector<double> key = values[i];
    const FitSample& sample = known_[key] =
        to_sample(std::move(values[i]), std::move(answers.at(i)));
    if (sample.is_ok()) continue;
    ++failed_;
    if (first_failure_ == nullptr) first_failure_ = &sample;
  }
}

}  // namespace linkstudy::calibration

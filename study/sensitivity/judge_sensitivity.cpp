#include "study/sensitivity/judge_sensitivity.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/config/case_selection.h"
#include "study/design/design.h"
#include "study/design/samples.h"
#include "study/metrics/response_list.h"
#include "study/sensitivity/elementary_effects.h"
#include "study/sensitivity/variance_indices.h"

namespace linkstudy::sensitivity {
namespace {

constexpr std::size_t kLeastBlocks = 2;
// Of a share of the variance, and of the greatest mu*: less is not worth telling from 0.
constexpr double kLeastShare = 0.01;
// Of the greatest value: smaller differences are rounding, and no effects.
constexpr double kRounding = 1e-12;

Finding finding_of(double value, const Interval& interval) {
  if (std::isnan(value) || std::isnan(interval.low)) return Finding::untold;
  if (value == 0.0 && interval.low == 0.0 && interval.high == 0.0) return Finding::none;
  return interval.contains(0.0) ? Finding::indistinct : Finding::acts;
}

Estimate judge(double value, const Interval& interval, std::size_t n, double least) {
  Estimate estimate{value, interval, finding_of(value, interval)};
  if (estimate.finding == Finding::indistinct) {
    estimate.needed = blocks_to_settle(value, interval, n, least);
  }
  return estimate;
}

using Blocks = std::vector<std::vector<double>>;

// Takes differences that are rounding out of the blocks; false where all values are the same.
bool clear_rounding(Design design, Blocks& blocks) {
  double low = blocks.front().front();
  double high = low;
  for (const std::vector<double>& block : blocks) {
    const auto [least, greatest] = std::ranges::minmax(block);
    low = std::min(low, least);
    high = std::max(high, greatest);
  }
  const double floor = kRounding * std::max(std::abs(low), std::abs(high));
  for (std::vector<double>& block : blocks) {
    for (std::size_t j = 1; j < block.size(); ++j) {
      const double before = block[design == Design::morris ? j - 1 : 0];
      if (std::abs(block[j] - before) <= floor) block[j] = before;
    }
  }
  return high - low > floor;
}

std::vector<std::size_t> all_rows(std::size_t n) {
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  return rows;
}

class Judging {
 public:
  Judging(const StudyInput& input, const std::vector<Response>& responses,
          const std::map<std::uint64_t, Evaluation>& evaluations)
      : input_(input),
        responses_(responses),
        evaluations_(evaluations),
        k_(input.vary.size()),
        size_(block_size(input.design.type, k_)),
        blocks_(count_points(input.design, axes_of(input)) / size_) {}

  Sensitivity run() {
    result_.name = input_.name;
    result_.design = input_.design.type;
    for (const VaryInput& vary : input_.vary) result_.parameters.push_back(vary.parameter);
    for (const std::size_t index : list_quantities()) judge_quantity(index);
    result_.evaluations = evaluations_.size();
    result_.failed = static_cast<std::size_t>(std::ranges::count_if(
        evaluations_, [](const auto& entry) { return entry.second.status != Cause::ok; }));
    result_.failures = find_failure_regions(evaluations_);
    return std::move(result_);
  }

 private:
  // Among the responses.
  std::vector<std::size_t> list_quantities() const {
    std::vector<std::size_t> quantities;
    for (const StoredCase& one : split_responses(responses_)) {
      for (std::size_t m = 0; m < one.matches.size(); ++m) {
        const bool is_rms = input_.match[m].norm == ErrorNorm::rms;
        const std::size_t first = is_rms ? one.matches[m].rms : one.matches[m].max;
        for (std::size_t c = 0; c < one.matches[m].channels.size(); ++c) {
          quantities.push_back(first + c);
        }
      }
      quantities.insert(quantities.end(), one.responses.begin(), one.responses.end());
    }
    return quantities;
  }

  // Of one block in the order of its ids; nothing where one is missing.
  std::optional<std::vector<double>> values_of(std::uint64_t block, std::size_t index) const {
    std::vector<double> values;
    for (std::uint64_t member = 0; member < size_; ++member) {
      const auto found = evaluations_.find(block * size_ + member);
      const bool is_there = found != evaluations_.end() && found->second.status == Cause::ok &&
                            index < found->second.responses.size() &&
                            std::isfinite(found->second.responses[index]);
      if (!is_there) return std::nullopt;
      values.push_back(found->second.responses[index]);
    }
    return values;
  }

  void judge_quantity(std::size_t index) {
    const Response& response = responses_[index];
    QuantitySensitivity quantity;
    quantity.name = response.name;
    quantity.unit = response.unit == "1" ? "" : response.unit;
    std::vector<std::uint64_t> complete;
    Blocks values;
    for (std::uint64_t block = 0; block < blocks_; ++block) {
      auto found = values_of(block, index);
      if (!found) continue;
      complete.push_back(block);
      values.push_back(std::move(*found));
    }
    quantity.blocks = complete.size();
    quantity.left_out = blocks_ - complete.size();
    quantity.parameters.resize(k_);
    for (std::size_t i = 0; i < k_; ++i) quantity.parameters[i].parameter = i;
    const bool tells = complete.size() >= kLeastBlocks && clear_rounding(result_.design, values);
    if (tells) {
      input_.design.type == Design::morris ? judge_effects(complete, values, quantity)
                                           : judge_indices(values, quantity);
    }
    result_.quantities.push_back(std::move(quantity));
  }

  void judge_effects(const std::vector<std::uint64_t>& trajectories,
                     const std::vector<std::vector<double>>& values,
                     QuantitySensitivity& quantity) const {
    std::vector<std::vector<double>> effects(k_);  // by parameter, then by trajectory
    for (std::size_t t = 0; t < trajectories.size(); ++t) {
      std::vector<std::vector<double>> points;
      for (std::uint64_t s = 0; s < size_; ++s) {
        points.push_back(make_unit_point(input_.design, k_, trajectories[t] * size_ + s));
      }
      const std::vector<double> own = elementary_effects(points, values[t]);
      for (std::size_t i = 0; i < k_; ++i) effects[i].push_back(own[i]);
    }
    const std::size_t n = trajectories.size();
    const auto measure = [&](std::span<const std::size_t> rows) {
      std::vector<double> both(2 * k_);
      for (std::size_t i = 0; i < k_; ++i) {
        const EffectMeasures one = measure_effects(effects[i], rows);
        both[i] = one.mu;
        both[k_ + i] = one.mu_star;
      }
      return both;
    };
    const std::vector<Interval> intervals = bootstrap_intervals(n, input_.design.seed, measure);
    std::vector<EffectMeasures> measures;
    double greatest = 0.0;
    for (std::size_t i = 0; i < k_; ++i) {
      measures.push_back(measure_effects(effects[i], all_rows(n)));
      greatest = std::max(greatest, measures[i].mu_star);
    }
    for (std::size_t i = 0; i < k_; ++i) {
      const double least = kLeastShare * greatest;
      quantity.parameters[i].main = judge(measures[i].mu, intervals[i], n, least);
      quantity.parameters[i].total = judge(measures[i].mu_star, intervals[k_ + i], n, least);
      quantity.parameters[i].sigma = measures[i].sigma;
    }
  }

  void judge_indices(const std::vector<std::vector<double>>& values,
                     QuantitySensitivity& quantity) const {
    const std::size_t n = values.size();
    Eigen::MatrixXd blocks(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(size_));
    for (std::size_t row = 0; row < n; ++row) {
      for (std::size_t j = 0; j < size_; ++j) {
        blocks(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(j)) = values[row][j];
      }
    }
    const auto estimate = [&](std::span<const std::size_t> rows) {
      VarianceIndices indices = estimate_indices(blocks, rows);
      indices.first.insert(indices.first.end(), indices.total.begin(), indices.total.end());
      return indices.first;
    };
    const VarianceIndices indices = estimate_indices(blocks, all_rows(n));
    quantity.mean = indices.mean;
    quantity.deviation = std::sqrt(indices.variance);
    const std::vector<Interval> intervals = bootstrap_intervals(n, input_.design.seed, estimate);
    for (std::size_t i = 0; i < k_; ++i) {
      quantity.parameters[i].main = judge(indices.first[i], intervals[i], n, kLeastShare);
      quantity.parameters[i].total = judge(indices.total[i], intervals[k_ + i], n, kLeastShare);
    }
  }

  const StudyInput& input_;
  const std::vector<Response>& responses_;
  const std::map<std::uint64_t, Evaluation>& evaluations_;
  std::size_t k_;
  std::uint64_t size_;
  std::uint64_t blocks_;
  Sensitivity result_;
};

}  // namespace

Sensitivity judge_sensitivity(const StudyInput& input, const std::vector<Response>& responses,
                              const std::map<std::uint64_t, Evaluation>& evaluations) {
  return Judging(input, responses, evaluations).run();
}

}  // namespace linkstudy::sensitivity

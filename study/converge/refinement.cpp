#include "study/converge/refinement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/converge/observed_order.h"

namespace linkstudy::convergence {
namespace {

constexpr double kSafety = 1.25;         // three levels or more
constexpr double kCautiousSafety = 3.0;  // two, or an order that is too good
// Only changes below this fraction of the scale can be the noise of rounding: sqrt of epsilon where
// they grow, and less where they merely leave their order.
constexpr double kMostNoise = 1.5e-8;
constexpr double kMostDisturbed = 1e-10;
// A change is told from noise that is ten times less: it moves an order by log2(1.1) = 0.14.
constexpr double kAboveNoise = 10.0;
constexpr double kDisturbed = 0.1;  // of its order: a tiny change that is not all noise
// Orders of neighbouring triples that count as the same: relative.
constexpr double kSameOrder = 0.1;

double larger(double a, double b) {
  return std::isnan(a) ? b : std::isnan(b) ? a : std::max(a, b);
}

class Judge {
 public:
  Judge(const Ladder& ladder, const RefinementOptions& options)
      : ladder_(ladder), options_(options) {
    result_.formal_order = options.formal_order;
    for (std::size_t i = 0; i < ladder.h.size(); ++i) {
      RefinementRow row;
      row.h = ladder.h[i];
      row.value = ladder.value[i];
      row.change = ladder.change[i];
      if (!ladder.error.empty()) row.error = ladder.error[i];
      if (!std::isnan(row.value)) used_.push_back(i);
      result_.rows.push_back(row);
    }
  }

  Refinement run() {
    for (std::size_t k = 1; k < used_.size(); ++k) row(k).ratio = row(k - 1).h / row(k).h;
    mark_floor();
    for (std::size_t k = 1; k < used_.size(); ++k) judge_errors(k);
    for (std::size_t k = 2; k < used_.size(); ++k) judge_triple(k);
    fit_differences();
    conclude();
    remark_ratios();
    return std::move(result_);
  }

 private:
  // Levels with values, 0 the coarsest.
  RefinementRow& row(std::size_t k) { return result_.rows[used_[k]]; }
  double change_of(std::size_t k) { return std::abs(row(k).change); }

  void mark_floor() {
    const double rounding = options_.floor * ladder_.scale;
    double limit = rounding;
    const std::size_t start = find_noise();
    for (std::size_t k = start; k < used_.size(); ++k) {
      result_.noise = std::max(result_.noise, change_of(k));
      row(k).is_floor = true;
    }
    limit = std::max(limit, kAboveNoise * result_.noise);
    for (std::size_t k = 1; k < used_.size(); ++k) {
      if (change_of(k) > limit) continue;
      row(k).is_floor = true;
      result_.noise = std::max(result_.noise, change_of(k));
    }
    mark_disturbed();
  }

  // Few changes may show less noise than there is: a tiny one that does not go on as those before
  // is not believed.
  void mark_disturbed() {
    for (std::size_t k = used_.size(); k-- > 3;) {
      if (row(k).is_floor) continue;
      const double before = order_between(k - 1);
      const bool is_tiny = change_of(k) < kMostDisturbed * ladder_.scale;
      const bool goes_on = row(k).change * row(k - 1).change > 0.0 &&
                           std::abs(order_between(k) - before) <= kDisturbed * before;
      if (!is_tiny || goes_on) return;
      row(k).is_floor = true;
      result_.noise = std::max(result_.noise, change_of(k));
    }
  }

  // The first of the finest changes that are noise: tiny, and at least as large as a coarser one,
  // or falling less than half as fast as those before. One past the end: none.
  std::size_t find_noise() {
    const double most = kMostNoise * ladder_.scale;
    for (std::size_t k = 2; k < used_.size(); ++k) {
      if (change_of(k) > most) continue;
      const double order = order_between(k);
      const bool grows = change_of(k) >= change_of(k - 1) && change_of(k - 1) <= most;
      const bool stalls = k >= 3 && order < 0.5 * order_between(k - 1);
      if (grows || stalls) return k;
    }
    return used_.size();
  }

  // How fast changes fall from one to the next, as if h^p.
  double order_between(std::size_t k) {
    return std::log(change_of(k - 1) / change_of(k)) / std::log(row(k - 1).h / row(k).h);
  }

  void judge_errors(std::size_t k) {
    if (row(k).is_floor) return;
    row(k).error_order = order_of_errors(row(k).error, row(k - 1).error, row(k).ratio);
  }

  void judge_triple(std::size_t k) {
    RefinementRow& fine = row(k);
    if (fine.is_floor || row(k - 1).is_floor) {
      fine.behaviour = Behaviour::floor;
      return;
    }
    const double e21 = -fine.change;
    const double e32 = -row(k - 1).change;
    const double r32 = row(k - 1).ratio;
    const auto order = order_of_differences(e21, e32, fine.ratio, r32);
    if (!order) {
      const bool turns = e21 * e32 < 0.0 && std::abs(e21) < std::abs(e32);
      fine.behaviour = turns ? Behaviour::oscillatory : Behaviour::divergent;
      return;
    }
    fine.behaviour = Behaviour::monotone;
    fine.order = *order;
    extrapolate(fine, *order, safety_of(*order));
    fine.asymptotic_ratio = asymptotic_ratio(k, *order);
  }

  bool is_too_good(double order) const { return order > 2.0 * options_.formal_order; }

  double safety_of(double order) const { return is_too_good(order) ? kCautiousSafety : kSafety; }

  void extrapolate(RefinementRow& fine, double order, double safety) {
    const double rest = fine.change / (std::pow(fine.ratio, order) - 1.0);
    if (ladder_.has_limit) fine.extrapolated = fine.value + rest;
    const double trusted = is_too_good(order) ? options_.formal_order : order;
    fine.uncertainty = safety * std::abs(fine.change) / (std::pow(fine.ratio, trusted) - 1.0);
    const double unit = ladder_.is_relative ? 1.0 : std::abs(fine.value);
    if (unit > 0.0) fine.gci = fine.uncertainty / unit;
  }

  // Safety factors cancel.
  double asymptotic_ratio(std::size_t k, double order) {
    const double coarse =
        change_of(k - 1) / std::abs(row(k - 1).value) / (std::pow(row(k - 1).ratio, order) - 1.0);
    const double fine =
        change_of(k) / std::abs(row(k).value) / (std::pow(row(k).ratio, order) - 1.0);
    const double ratio = coarse / (std::pow(row(k).ratio, order) * fine);
    return std::isfinite(ratio) ? ratio : kUnknown;
  }

  void fit_differences() {
    std::vector<Level> differences;
    for (std::size_t k = 1; k < used_.size(); ++k) {
      if (!row(k).is_floor) differences.push_back({row(k).h, row(k).change});
    }
    result_.difference_order = fit_difference_order(differences);
  }

  // The finest level above the floor; 0 where there is none with two coarser ones.
  std::size_t finest_triple() {
    for (std::size_t k = used_.size(); k-- > 2;)
      if (row(k).behaviour != Behaviour::floor) return k;
    return 0;
  }

  void conclude() {
    if (used_.size() < result_.rows.size()) {
      remark(fmt::format("{} of {} levels have no value", result_.rows.size() - used_.size(),
                         result_.rows.size()));
    }
    if (used_.size() < 3) return conclude_without_order();
    const std::size_t k = finest_triple();
    if (k == 0) {
      result_.behaviour = Behaviour::floor;
      result_.finest = used_.back();
      result_.extrapolated = ladder_.has_limit ? row(used_.size() - 1).value : kUnknown;
      result_.uncertainty = result_.noise;
      return remark_floor();
    }
    result_.finest = used_[k];
    result_.behaviour = row(k).behaviour;
    if (k + 1 < used_.size()) remark_floor();
    const std::size_t run = count_run(k);
    if (is_noise(k, run)) {
      result_.behaviour = Behaviour::noise;
      return remark(fmt::format("differences of changing sign do not fall with h: scatter {:.2g}",
                                greatest_change()));
    }
    if (result_.behaviour == Behaviour::monotone) return conclude_monotone(k, run);
    remark_without_order(k);
  }

  // Two levels: the formal order, with caution.
  void conclude_without_order() {
    remark("fewer than three levels show no order");
    if (used_.size() < 2 || row(1).is_floor || std::isnan(options_.formal_order)) return;
    extrapolate(row(1), options_.formal_order, kCautiousSafety);
    take(row(1));
    result_.finest = used_[1];
    result_.safety_factor = kCautiousSafety;
  }

  void take(const RefinementRow& fine) {
    result_.order = fine.order;
    result_.extrapolated = fine.extrapolated;
    result_.uncertainty = fine.uncertainty;
    result_.gci = fine.gci;
  }

  // Triples that end at k, k - 1, ... with the order of the one at k.
  std::size_t count_run(std::size_t k) {
    std::size_t count = 0;
    const double order = row(k).order;
    while (k >= 2 && row(k).behaviour == Behaviour::monotone &&
           std::abs(row(k).order - order) <= kSameOrder * order) {
      ++count;
      --k;
    }
    return count;
  }

  // No two triples that agree, while signs change and nothing falls. One change of sign may be
  // another error that takes over.
  bool is_noise(std::size_t k, std::size_t run) {
    if (run > 1 || k < 3) return false;
    int turns = 0;
    bool falls = true;
    for (std::size_t i = 2; i <= k; ++i) {
      if (row(i).change * row(i - 1).change < 0.0) ++turns;
      falls = falls && change_of(i) < change_of(i - 1);
    }
    return turns > 1 && !falls;
  }

  double greatest_change() {
    double most = 0.0;
    for (std::size_t k = 1; k < used_.size(); ++k) most = larger(most, change_of(k));
    return most;
  }

  void conclude_monotone(std::size_t k, std::size_t run) {
    take(row(k));
    result_.safety_factor = safety_of(result_.order);
    result_.asymptotic = run + 2;
    std::vector<Level> levels;
    for (std::size_t i = k + 1 - result_.asymptotic; i <= k; ++i) {
      levels.push_back({row(i).h, row(i).value});
    }
    if (ladder_.has_limit && run > 1) result_.fit = fit_order(levels);
    if (run == 1 && k > 2) {
      remark("orders of neighbouring triples differ: not asymptotic yet, or not any more");
    }
    if (is_too_good(result_.order)) {
      remark(
          fmt::format("order {:.3g} is more than twice the formal {:g}: factor 3, and GCI with "
                      "the formal order",
                      result_.order, options_.formal_order));
    }
    if (result_.order < 0.5 * options_.formal_order) {
      remark(fmt::format("order {:.3g} is less than half the formal {:g}", result_.order,
                         options_.formal_order));
    }
  }

  void remark_without_order(std::size_t k) {
    if (result_.behaviour == Behaviour::oscillatory) {
      return remark(fmt::format("oscillates about its limit, differences fall as h^{:.2g}",
                                result_.difference_order));
    }
    std::size_t good = k;
    while (good > 2 && row(good).behaviour == Behaviour::divergent) --good;
    if (row(good).behaviour == Behaviour::monotone) {
      remark(
          "differences grow again at the finest levels: something else than the refined value "
          "decides there");
    }
  }

  void remark_floor() {
    remark(
        fmt::format("changes of {:.1e} and less are rounding or noise, left out", result_.noise));
  }

  void remark_ratios() {
    for (std::size_t k = 1; k < used_.size(); ++k) {
      if (row(k).ratio >= kLeastRatio) continue;
      return remark(
          fmt::format("a ratio of {:.3g} is below {}: differences of so close levels "
                      "are mostly noise",
                      row(k).ratio, kLeastRatio));
    }
  }

  void remark(std::string text) { result_.remarks.push_back(std::move(text)); }

  const Ladder& ladder_;
  const RefinementOptions& options_;
  std::vector<std::size_t> used_;  // levels with values
  Refinement result_;
};

}  // namespace

Ladder make_ladder(std::vector<Level> levels, std::optional<double> limit,
                   std::optional<double> scale) {
  std::ranges::stable_sort(levels, std::ranges::greater(), &Level::h);
  Ladder ladder;
  double greatest = 0.0;
  double before = kUnknown;
  for (const Level& level : levels) {
    ladder.h.push_back(level.h);
    ladder.value.push_back(level.value);
    ladder.change.push_back(level.value - before);
    if (limit) ladder.error.push_back(std::abs(level.value - *limit));
    if (std::isnan(level.value)) continue;
    before = level.value;
    greatest = std::max(greatest, std::abs(level.value));
  }
  ladder.scale = scale.value_or(greatest);
  return ladder;
}

bool Refinement::is_settled() const {
  return behaviour == Behaviour::floor ||
         (behaviour == Behaviour::monotone && std::isfinite(order));
}

Refinement judge_refinement(const Ladder& ladder, const RefinementOptions& options) {
  return Judge(ladder, options).run();
}

}  // namespace linkstudy::convergence

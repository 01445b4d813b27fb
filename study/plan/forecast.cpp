#include "study/plan/forecast.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "study/evaluate/form_packs.h"
#include "study/plan/pull_schedule.h"

namespace linkstudy::plan {
namespace {

constexpr std::size_t kMostRanksTried = 256;  // one by one; beyond, powers of two
constexpr double kServiceS = 2e-6;            // of rank 0 for a task (tests/bench/dispatch.cpp)
constexpr double kNoShorter = 1.001;
constexpr std::size_t kMostLayouts = 8;

class Layouts {
 public:
  Layouts(const Evaluator& study, const PlannedWork& work, const Costs* costs, int lanes)
      : study_(study), work_(work), costs_(costs), lanes_(lanes) {}

  // The points that are certain, in the batches they are asked for.
  Layout certain(int ranks) const {
    Layout layout;
    layout.ranks = ranks;
    double work_s = 0.0;
    double wall_s = 0.0;
    for (std::size_t i = 0; i < work_.points.size(); i += work_.batch) {
      const std::size_t end = std::min(i + work_.batch, work_.points.size());
      const std::vector<Point> batch(work_.points.begin() + static_cast<std::ptrdiff_t>(i),
                                     work_.points.begin() + static_cast<std::ptrdiff_t>(end));
      std::vector<double> seconds;
      const int width = pack_width(study_, batch, lanes_, ranks);
      for (const auto& pack : form_packs(batch, study_.parameters(), width, ranks)) {
        ++layout.packs;
        layout.widest = std::max(layout.widest, pack.size());
        seconds.push_back(costs_ == nullptr ? 0.0 : costs_->slowdown(ranks) * costs_->pack_s(pack));
        work_s += seconds.back();
      }
      std::ranges::sort(seconds, std::greater());  // as they are handed out
      wall_s += pull(seconds, ranks, kServiceS).wall_s;
    }
    if (wall_s > 0.0) layout.busy = work_s / (wall_s * ranks);
    const Costs::References references = references_on(ranks);
    layout.cpu_s = references.cpu_s + work_s + kServiceS * static_cast<double>(layout.packs);
    layout.wall_s = references.wall_s + wall_s;
    return layout;
  }

  // The whole budget, as the points that are certain go on.
  Layout most(int ranks) const {
    Layout layout = certain(ranks);
    if (work_.points.empty() || work_.points.size() == work_.most) return layout;
    const double more = static_cast<double>(work_.most) / static_cast<double>(work_.points.size());
    const Costs::References references = references_on(ranks);
    layout.packs = static_cast<std::size_t>(std::ceil(static_cast<double>(layout.packs) * more));
    layout.cpu_s = references.cpu_s + more * (layout.cpu_s - references.cpu_s);
    layout.wall_s = references.wall_s + more * (layout.wall_s - references.wall_s);
    return layout;
  }

  // The least number of ranks that nothing beats.
  int useful_ranks() const {
    const std::vector<int> tried = list_ranks();
    std::vector<double> wall_s;
    for (const int ranks : tried) wall_s.push_back(most(ranks).wall_s);
    const double enough = *std::ranges::min_element(wall_s) * kNoShorter;
    const auto first = std::ranges::find_if(wall_s, [&](double one) { return one <= enough; });
    return first == wall_s.end() ? tried.back()
                                 : tried[static_cast<std::size_t>(first - wall_s.begin())];
  }

 private:
  std::vector<int> list_ranks() const {
    const std::size_t together =
        std::max<std::size_t>(1, std::min(work_.batch, work_.points.size()));
    std::vector<int> ranks;
    for (std::size_t i = 1; i < together; i = i < kMostRanksTried ? i + 1 : 2 * i) {
      ranks.push_back(static_cast<int>(i));
    }
    ranks.push_back(static_cast<int>(together));
    return ranks;
  }

  Costs::References references_on(int ranks) const {
    return costs_ == nullptr ? Costs::References() : costs_->references(ranks);
  }

  const Evaluator& study_;
  const PlannedWork& work_;
  const Costs* costs_;
  int lanes_;
};

std::vector<int> shown_ranks(int asked, int useful) {
  std::set<int> ranks = {asked, useful};
  for (int i = 1; i < useful && ranks.size() < kMostLayouts; i *= 2) ranks.insert(i);
  return {ranks.begin(), ranks.end()};
}

void describe_steps(const RunKinds& kinds, Forecast& forecast) {
  forecast.invalid = kinds.invalid();
  for (const RunKind& kind : kinds.all()) {
    if (!kind.has_constant_steps()) {
      forecast.has_adaptive = true;
      continue;
    }
    const long count = kind.grid.count;
    forecast.steps += static_cast<double>(count) * static_cast<double>(kind.points.size());
    forecast.least_steps =
        forecast.least_steps == 0 ? count : std::min(forecast.least_steps, count);
    forecast.most_steps = std::max(forecast.most_steps, count);
  }
}

}  // namespace

Forecast make_forecast(Evaluator& study, const ForecastOptions& options) {
  Forecast forecast;
  forecast.lanes = options.lanes;
  forecast.load_cases = study.load_case_count();
  for (std::size_t i = 0; i < study.load_case_count(); ++i) {
    if (study.has_reference(i)) ++forecast.references;
  }
  forecast.work = list_work(study);
  const RunKinds kinds(study, forecast.work.points);
  describe_steps(kinds, forecast);
  // Before any run, so that what is resident is the program as it begins.
  const std::size_t widest =
      Layouts(study, forecast.work, nullptr, options.lanes).certain(options.ranks).widest;
  forecast.sizes = find_sizes(study, kinds, forecast.work.most, widest);
  std::optional<Costs> costs;
  if (options.probe_s > 0.0) {
    costs.emplace(study, kinds, options.lanes, std::min(options.ranks, options.processors),
                  options.probe_s);
    forecast.measured = costs->measured();
    forecast.references_s = costs->references(options.ranks).cpu_s;
  }
  const Layouts layouts(study, forecast.work, costs ? &*costs : nullptr, options.lanes);
  forecast.asked = layouts.certain(options.ranks);
  forecast.most = layouts.most(options.ranks);
  if (!costs) return forecast;
  forecast.useful_ranks = layouts.useful_ranks();
  for (const int ranks : shown_ranks(options.ranks, forecast.useful_ranks)) {
    forecast.layouts.push_back(layouts.most(ranks));
  }
  return forecast;
}

}  // namespace linkstudy::plan

#include "study/plan/costs.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "study/evaluate/form_packs.h"
#include "study/plan/at_once.h"
#include "study/plan/pull_schedule.h"

namespace linkstudy::plan {
namespace {

constexpr double kReferencePart = 0.3;        // of the time for measuring
constexpr std::size_t kMostKindsProbed = 32;  // those with the most runs
constexpr double kShortestProbe = 0.02;       // s
constexpr double kSlowdownPart = 0.1;         // of the time for measuring, alone and at once
constexpr double kAloneOverBeside = 0.5;  // a full pack of lanes takes about as long as two alone

// Kinds with the most to do first.
std::vector<std::size_t> by_weight(const std::vector<RunKind>& kinds) {
  std::vector<std::size_t> order(kinds.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  const auto weight = [&](std::size_t i) {
    return static_cast<double>(kinds[i].points.size()) * static_cast<double>(kinds[i].grid.count);
  };
  std::ranges::stable_sort(order, [&](auto a, auto b) { return weight(a) > weight(b); });
  order.resize(std::min(order.size(), kMostKindsProbed));
  return order;
}

}  // namespace

Costs::Costs(const Evaluator& study, const RunKinds& kinds, int lanes, int at_once, double seconds)
    : kinds_(kinds), lanes_(lanes), costs_(kinds_.all().size()) {
  measured_.kinds = costs_.size();
  if (costs_.empty()) return;
  const std::vector<Value>& first = kinds_.all().front().points.front()->values;
  for (std::size_t i = 0; i < study.load_case_count(); ++i) {
    probes_.push_back(std::make_unique<Probe>(study, i, first));
  }
  measure_references(study, kReferencePart * seconds);
  measure_kinds(seconds - std::min(measured_.spent_s, 0.5 * seconds));
  fill_gaps();
  if (at_once > 1) measure_slowdown(at_once, kSlowdownPart * seconds);
}

void Costs::measure_references(const Evaluator& study, double seconds) {
  for (std::size_t i = 0; i < study.load_case_count(); ++i) {
    if (!study.has_reference(i)) continue;
    const double part = seconds / static_cast<double>(study.load_case_count());
    const RunPace pace = probes_[i]->measure_reference(std::max(part, kShortestProbe));
    references_s_.push_back(pace.run_s);
    measured_.spent_s += pace.spent_s;
  }
}

void Costs::take(std::size_t kind, std::span<const Point> points, double seconds,
                 std::optional<RunPace>& pace) {
  pace = probes_[kinds_.all()[kind].load_case]->measure(points, seconds);
  measured_.steps += pace->steps;
  measured_.spent_s += pace->spent_s;
}

void Costs::measure_kinds(double seconds) {
  const std::vector<std::size_t> order = by_weight(kinds_.all());
  measured_.probed = order.size();
  double parts = 0.0;
  for (const std::size_t i : order) {
    const RunKind& kind = kinds_.all()[i];
    parts += kind.fills_lanes() && kind.points.size() > 1 && lanes_ > 1 ? 2.0 : 1.0;
  }
  const double part = std::max(seconds / parts, kShortestProbe);
  for (const std::size_t i : order) {
    const RunKind& kind = kinds_.all()[i];
    const std::vector<Point> points = points_beside(kind);
    take(i, {points.data(), 1}, part, costs_[i].alone);
    if (points.size() > 1) take(i, points, part, costs_[i].beside);
  }
}

std::vector<Point> Costs::points_beside(const RunKind& kind) const {
  const std::size_t width =
      kind.fills_lanes() ? std::min(kind.points.size(), static_cast<std::size_t>(lanes_)) : 1;
  std::vector<Point> points;
  for (std::size_t k = 0; k < width; ++k) points.push_back(*kind.points[k]);
  return points;
}

// Of the kind with the most to do.
void Costs::measure_slowdown(int at_once, double seconds) {
  const RunKind& kind = kinds_.all()[by_weight(kinds_.all()).front()];
  const std::vector<Point> points = points_beside(kind);
  const double time = std::max(seconds, kShortestProbe);
  const auto measure = [&] { return probes_[kind.load_case]->seconds_a_step(points, time); };
  const double alone = measure();
  const std::vector<double> beside = measure_at_once(at_once, measure);
  measured_.spent_s += 2.0 * time;
  double sum = 0.0;
  for (const double one : beside) sum += one;
  const double slowdown = sum / static_cast<double>(beside.size()) / alone;
  if (!std::isfinite(slowdown)) return;  // no step was made
  measured_.at_once = at_once;
  measured_.slowdown = std::max(1.0, slowdown);
}

double Costs::slowdown(int ranks) const {
  const int most = measured_.at_once;
  if (most == 1) return 1.0;
  const double part = static_cast<double>(std::min(ranks, most) - 1) / (most - 1);
  return 1.0 + part * (measured_.slowdown - 1.0);
}

// Kinds that were not probed are taken for the nearest that was, by their steps.
void Costs::fill_gaps() {
  for (std::size_t i = 0; i < costs_.size(); ++i) {
    if (costs_[i].alone) continue;
    std::size_t nearest = costs_.size();
    for (std::size_t k = 0; k < costs_.size(); ++k) {
      if (!costs_[k].alone || costs_[k].alone->spent_s == 0.0) continue;
      const bool is_nearer = nearest == costs_.size() ||
                             (kinds_.all()[k].load_case == kinds_.all()[i].load_case &&
                              kinds_.all()[nearest].load_case != kinds_.all()[i].load_case);
      if (is_nearer) nearest = k;
    }
    if (nearest == costs_.size()) continue;
    costs_[i] = costs_[nearest];
    const double ratio = static_cast<double>(kinds_.all()[i].grid.count) /
                         static_cast<double>(kinds_.all()[nearest].grid.count);
    for (std::optional<RunPace>* pace : {&costs_[i].alone, &costs_[i].beside}) {
      if (!*pace) continue;
      (*pace)->run_s *= ratio;
      (*pace)->spent_s = 0.0;
    }
  }
}

double Costs::run_s(std::size_t kind, std::size_t count) const {
  const KindCost& cost = costs_[kind];
  if (!cost.alone) return 0.0;
  const double alone = cost.alone->run_s;
  if (count == 1 || !kinds_.all()[kind].fills_lanes() || lanes_ == 1) {
    return alone * static_cast<double>(count);
  }
  const double beside = cost.beside ? cost.beside->run_s : alone / kAloneOverBeside;
  return beside * std::ceil(static_cast<double>(count) / static_cast<double>(lanes_));
}

Costs::References Costs::references(int ranks) const {
  References all;
  std::vector<double> tasks;
  const std::size_t size = pack_size(references_s_.size(), lanes_, ranks);
  for (const std::vector<double>& together : split(references_s_, size)) {
    const double alone = std::accumulate(together.begin(), together.end(), 0.0);
    const double beside = *std::ranges::max_element(together) / kAloneOverBeside;
    tasks.push_back(slowdown(ranks) * std::min(alone, beside));
    all.cpu_s += tasks.back();
  }
  all.wall_s = pull(tasks, ranks).wall_s;
  return all;
}

double Costs::pack_s(std::span<const Point> pack) const {
  const std::size_t count = kinds_.of(pack.front()).size();
  const std::size_t together =
      std::max(std::size_t{1}, static_cast<std::size_t>(lanes_) / pack.size());
  double seconds = 0.0;
  for (std::size_t i = 0; i < count; i += together) {
    seconds += load_cases_s(pack, i, std::min(i + together, count));
  }
  return seconds;
}

double Costs::load_cases_s(std::span<const Point> pack, std::size_t first, std::size_t last) const {
  std::vector<std::pair<std::size_t, std::size_t>> counts;  // of kinds that share their steps
  double seconds = 0.0;
  for (const Point& point : pack) {
    const std::vector<std::size_t>& kinds = kinds_.of(point);
    for (std::size_t i = first; i < std::min(last, kinds.size()); ++i) {
      if (costs_[kinds[i]].alone) seconds += costs_[kinds[i]].alone->setup_s;
      const auto found = std::ranges::find_if(counts, [&](const auto& known) {
        return shares_steps(kinds_.all()[known.first], kinds_.all()[kinds[i]]);
      });
      if (found == counts.end()) {
        counts.emplace_back(kinds[i], 1);
      } else {
        ++found->second;
      }
    }
  }
  for (const auto& [kind, runs] : counts) seconds += run_s(kind, runs);
  return seconds;
}

}  // namespace linkstudy::plan

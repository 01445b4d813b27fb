#include "study/tune/branch_and_bound.h"

#include <algorithm>
#include <cmath>

#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

// Part of an edge that a split before a point in the way must gain to be worth it.
constexpr double kWorthwhile = 0.2;
// Distance kept from a point in the way, beyond what its ratio asks for, decades.
constexpr double kSpare = 2e-3;
// The same from a point of which no ratio is known.
constexpr double kUnknownDistance = 0.3;

struct BoundBox {
  Position a;
  Position b;
  double lowest() const { return sum_of(a); }
};

class BoundSearch {
 public:
  BoundSearch(EvaluationLog& log, const std::vector<double>& point, std::size_t reserve)
      : log_(log),
        variables_(log.problem().variables),
        reserve_(reserve),
        limit_(sum_of(position_of(point)) - log.options().gap),
        mu_(log.options().mu) {
    for (const TunedVariable& variable : variables_) {
      root_.a.push_back(std::log10(variable.low));
      root_.b.push_back(std::log10(variable.high));
    }
  }

  BoundReport run(const std::vector<double>& point) {
    const std::size_t first = log_.observations().size();
    ask_step_bounds(point);
    learn();
    open_ = {root_};
    BoundReport report;
    do {
      while (!decide(report)) {
        const std::vector<Position> corners = choose_corners();
        if (corners.empty()) continue;
        ask(corners);
        learn();
      }
    } while (report.end == BoundEnd::closed && resolve_doubts());
    report.evaluations = log_.observations().size() - first;
    return report;
  }

 private:
  bool has_budget() const { return log_.remaining() > reserve_; }

  // Whether there is no more to do, and why.
  bool decide(BoundReport& report) {
    if (worst_ > kMostContradiction) {
      report.end = BoundEnd::not_monotone;
    } else if (has_lower_match()) {
      report.end = BoundEnd::lower_match;
    } else if (is_undecided_) {
      report.end = blocked_by_ ? BoundEnd::step_ends_it : BoundEnd::undecided;
      report.blocked_by = blocked_by_.value_or(0);
    } else if (open_.empty()) {
      report.end = BoundEnd::closed;
    } else if (!has_budget()) {
      report.end = BoundEnd::budget;
    } else {
      return false;
    }
    return true;
  }

  // Farther up all axes, so that most points have a bound of what their step adds.
  void ask_step_bounds(const std::vector<double>& point) {
    std::vector<Request> requests;
    for (const double decades : {0.5, 1.0}) {
      std::vector<double> x = point;
      for (std::size_t j = 0; j < x.size(); ++j) x[j] = move_along(variables_[j], x[j], decades);
      requests.push_back({x, 1.0, "bound"});
      requests.push_back({x, 0.5, "bound"});
    }
    log_.evaluate(requests);
  }

  // What the evaluations prove; where that asks for a larger mu, all boxes are open again.
  void learn() {
    const auto& components = log_.problem().components;
    const std::vector<KnownPoint> points = find_known_points(components, log_.observations());
    const MonotoneAudit audit = audit_monotony(points, false);
    worst_ = audit.worst;
    const double mu = choose_mu(log_.options().mu, audit);
    if (mu > mu_) {
      mu_ = mu;
      open_ = {root_};
      is_undecided_ = false;
    }
    proofs_.clear();
    in_the_way_.clear();
    for (const KnownPoint& point : points) {
      const bool is_proof = std::isfinite(point.ratio) && point.net() > 1.0 + mu_;
      if (is_proof) proofs_.push_back(point);
      if (!is_proof && !may_prove_yet(point)) in_the_way_.push_back(point);
    }
  }

  // It fails, and half its step was not tried: then it may still be a proof.
  bool may_prove_yet(const KnownPoint& point) const {
    const bool fails = std::isfinite(point.ratio) && point.ratio > 1.0 + mu_;
    return fails && !point.was_halved;
  }

  // Half the step of points that may contradict monotony. Returns false when nothing was asked.
  bool resolve_doubts() {
    const std::vector<KnownPoint> points =
        find_known_points(log_.problem().components, log_.observations());
    const std::vector<std::size_t> doubts = find_doubts(points, mu_);
    std::vector<Request> requests;
    for (const Observation& seen : log_.observations()) {
      const auto is_it = [&](std::size_t i) { return points[i].id == seen.answer.id; };
      if (std::ranges::any_of(doubts, is_it)) requests.push_back({seen.request.x, 0.5, "audit"});
    }
    const std::size_t before = log_.remaining();
    log_.evaluate(requests);
    if (log_.remaining() == before) return false;
    learn();
    return true;
  }

  bool has_lower_match() const {
    return std::ranges::any_of(log_.observations(), [&](const Observation& seen) {
      return seen.request.step_factor == 1.0 && compute_objective(seen.request.x) < limit_ &&
             log_.is_candidate(seen.request.x);
    });
  }

  // Returns false when nothing is left of the box.
  bool reduce(BoundBox& box) const {
    bool has_changed = true;
    while (has_changed) {
      has_changed = false;
      const double spare = limit_ - box.lowest();
      if (spare <= 0.0) return false;
      for (std::size_t j = 0; j < box.a.size(); ++j) {
        box.b[j] = std::min(box.b[j], box.a[j] + spare);
        if (box.b[j] <= box.a[j]) return false;
      }
      for (const KnownPoint& proof : proofs_) {
        std::optional<std::size_t> short_in;
        bool is_apart = false;
        for (std::size_t j = 0; j < box.a.size(); ++j) {
          if (proof.t[j] + 1e-9 >= box.b[j]) continue;
          is_apart = is_apart || short_in || proof.t[j] <= box.a[j];
          short_in = j;
        }
        if (is_apart) continue;
        if (!short_in) return false;
        box.a[*short_in] = proof.t[*short_in];
        has_changed = true;
        break;
      }
    }
    return true;
  }

  struct Split {
    std::size_t direction = 0;
    double at = 0.0;
    double gain = -1.0;  // part of the edge
  };

  // Before the points at or below b that prove nothing; nothing where there are none.
  std::optional<Split> find_split(const BoundBox& box) const {
    std::vector<double> before = box.b;
    bool is_free = true;
    for (const KnownPoint& point : in_the_way_) {
      if (!reaches_above(box.b, point.t)) continue;
      is_free = false;
      const bool is_near = std::isfinite(point.ratio) && point.ratio < 1.0 + mu_;
      const double distance = is_near
                                  ? std::log10((1.0 + mu_) / std::max(point.ratio, 0.01)) + kSpare
                                  : kUnknownDistance;
      for (std::size_t j = 0; j < before.size(); ++j) {
        before[j] = std::min(before[j], point.t[j] - distance);
      }
    }
    if (is_free) return std::nullopt;
    Split best;
    std::size_t longest = 0;
    for (std::size_t j = 0; j < before.size(); ++j) {
      const double edge = box.b[j] - box.a[j];
      const double gain = (before[j] - box.a[j]) / edge;
      if (gain > best.gain) best = {j, before[j], gain};
      if (edge > box.b[longest] - box.a[longest]) longest = j;
    }
    if (best.gain < kWorthwhile) {
      best = {longest, 0.5 * (box.a[longest] + box.b[longest]), best.gain};
    }
    return best;
  }

  // The softest point in the way of a box that fails by its step, where none is in it for mu.
  std::optional<std::uint64_t> find_step_failure(const BoundBox& box) const {
    const KnownPoint* softest = nullptr;
    for (const KnownPoint& point : in_the_way_) {
      if (!reaches_above(box.b, point.t)) continue;
      if (std::isfinite(point.ratio) && point.ratio <= 1.0 + mu_) return std::nullopt;
      if (softest == nullptr || sum_of(point.t) < sum_of(softest->t)) softest = &point;
    }
    return softest == nullptr ? std::nullopt : std::optional(softest->id);
  }

  static double longest_edge(const BoundBox& box) {
    double longest = 0.0;
    for (std::size_t j = 0; j < box.a.size(); ++j) longest = std::max(longest, box.b[j] - box.a[j]);
    return longest;
  }

  // Corners to evaluate next; boxes they belong to stay open.
  std::vector<Position> choose_corners() {
    std::vector<Position> corners;
    std::vector<BoundBox> waiting;
    const auto later = [](const BoundBox& x, const BoundBox& y) { return x.lowest() > y.lowest(); };
    std::ranges::make_heap(open_, later);
    while (!open_.empty() && corners.size() < log_.options().batch) {
      std::ranges::pop_heap(open_, later);
      BoundBox box = std::move(open_.back());
      open_.pop_back();
      if (!reduce(box)) continue;
      const std::optional<Split> split = find_split(box);
      if (!split) {
        corners.push_back(box.b);
        waiting.push_back(std::move(box));
        continue;
      }
      if (longest_edge(box) < log_.options().resolution) {
        is_undecided_ = corners.empty();
        blocked_by_ = find_step_failure(box);
        waiting.push_back(std::move(box));
        break;
      }
      BoundBox upper = box;
      box.b[split->direction] = split->at;
      upper.a[split->direction] = split->at;
      for (BoundBox* half : {&box, &upper}) {
        open_.push_back(std::move(*half));
        std::ranges::push_heap(open_, later);
      }
    }
    open_.insert(open_.end(), waiting.begin(), waiting.end());
    return corners;
  }

  void ask(const std::vector<Position>& corners) {
    std::vector<Request> requests;
    for (const Position& corner : corners) {
      requests.push_back({values_at(variables_, corner), 1.0, "bound"});
    }
    log_.evaluate(requests);
    const std::vector<KnownPoint> points =
        find_known_points(log_.problem().components, log_.observations());
    std::vector<Request> halves;
    for (const Request& request : requests) {
      const Observation* seen = log_.find(request.x, 1.0);
      if (seen == nullptr) continue;
      const double ratio = compute_ratio(seen->answer, log_.problem().components);
      const bool is_lower_match = ratio <= 1.0 && compute_objective(request.x) < limit_;
      const auto known = std::ranges::find(points, seen->answer.id, &KnownPoint::id);
      const bool may_prove = std::isfinite(ratio) && ratio > 1.0 + mu_ && known != points.end() &&
                             known->net() <= 1.0 + mu_;
      if (is_lower_match || may_prove) halves.push_back({request.x, 0.5, "bound"});
    }
    log_.evaluate(halves);
  }

  EvaluationLog& log_;
  const std::vector<TunedVariable>& variables_;
  std::size_t reserve_;
  double limit_;  // F
  double mu_;
  double worst_ = 0.0;
  BoundBox root_;
  std::vector<BoundBox> open_;
  std::vector<KnownPoint> proofs_;
  std::vector<KnownPoint> in_the_way_;
  bool is_undecided_ = false;
  std::optional<std::uint64_t> blocked_by_;
};

}  // namespace

BoundReport gather_proof(EvaluationLog& log, const std::vector<double>& point,
                         std::size_t reserve) {
  return BoundSearch(log, point, reserve).run(point);
}

}  // namespace linkstudy::tuning

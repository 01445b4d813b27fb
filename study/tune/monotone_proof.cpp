#include "study/tune/monotone_proof.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <set>

#include "study/tune/variable_axis.h"

namespace linkstudy::tuning {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kNearTolerance = 1.5;
// Positions are told apart to this many decades; rounding of powers of ten is far below it.
constexpr double kReach = 1e-9;
// Corners looked at before the cover is called incomplete.
constexpr std::size_t kMostCorners = 400000;

struct StepBound {
  Position t;
  double coarse = 0.0;
};

std::optional<double> find_coarse(const Answer& base, const Answer& half,
                                  const std::vector<MatchComponent>& components) {
  if (!std::isfinite(compute_ratio(base, components))) return std::nullopt;
  if (!std::isfinite(compute_ratio(half, components))) return std::nullopt;
  double coarse = 0.0;
  for (std::size_t i = 0; i < components.size(); ++i) {
    const double change = std::abs(base.errors[i] - half.errors[i]);
    coarse = std::max(coarse, 16.0 / 15.0 * change / components[i].tolerance);
  }
  return coarse;
}

// What was evaluated at half the step, by point.
using HalfSteps = std::map<std::vector<double>, const Observation*>;

std::vector<StepBound> find_bounds(const std::vector<MatchComponent>& components,
                                   const std::vector<Observation>& observations,
                                   const HalfSteps& halves) {
  std::vector<StepBound> bounds;
  for (const Observation& seen : observations) {
    const auto half = halves.find(seen.request.x);
    if (seen.request.step_factor != 1.0 || half == halves.end()) continue;
    const auto coarse = find_coarse(seen.answer, half->second->answer, components);
    if (!coarse) continue;
    bounds.push_back({position_of(seen.request.x), *coarse});
  }
  return bounds;
}

bool is_strictly_below(const Position& a, const Position& b) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (!(a[j] < b[j])) return false;
  return true;
}

// The proof that reaches farthest above a corner in its nearest direction.
const Position* find_farthest(const Position& corner, const std::vector<Position>& proofs) {
  const Position* farthest = nullptr;
  double best = 0.0;
  for (const Position& proof : proofs) {
    if (!is_strictly_below(corner, proof)) continue;
    double nearest = kNoBound;
    for (std::size_t j = 0; j < corner.size(); ++j) {
      nearest = std::min(nearest, proof[j] - corner[j]);
    }
    if (nearest > best) {
      best = nearest;
      farthest = &proof;
    }
  }
  return farthest;
}

// Of proofs below others nothing is left to say.
std::vector<Position> keep_maximal(const std::vector<Position>& proofs) {
  std::vector<Position> maximal;
  for (std::size_t i = 0; i < proofs.size(); ++i) {
    bool is_needed = true;
    for (std::size_t k = 0; k < proofs.size() && is_needed; ++k) {
      const bool is_covered = k != i && reaches_above(proofs[k], proofs[i]);
      is_needed = !is_covered || (proofs[i] == proofs[k] && i < k);
    }
    if (is_needed) maximal.push_back(proofs[i]);
  }
  return maximal;
}

}  // namespace

bool can_be_proven(const TuningProblem& problem) {
  const std::size_t n = problem.variables.size();
  return is_lowest_sum(problem) && (n == 2 || n == 3) &&
         std::ranges::count(problem.variables, false, &TunedVariable::is_logarithmic) == 0;
}

Position position_of(const std::vector<double>& x) {
  Position t(x.size());
  for (std::size_t j = 0; j < x.size(); ++j) t[j] = std::log10(x[j]);
  return t;
}

std::vector<double> values_at(const std::vector<TunedVariable>& variables, const Position& t) {
  std::vector<double> x(t.size());
  for (std::size_t j = 0; j < t.size(); ++j) x[j] = from_axis(variables[j], t[j]);
  return x;
}

double sum_of(const Position& t) {
  double sum = 0.0;
  for (const double one : t) sum += one;
  return sum;
}

bool reaches_above(const Position& b, const Position& a) {
  for (std::size_t j = 0; j < a.size(); ++j)
    if (a[j] > b[j] + kReach) return false;
  return true;
}

std::vector<KnownPoint> find_known_points(const std::vector<MatchComponent>& components,
                                          const std::vector<Observation>& observations) {
  HalfSteps halves;
  for (const Observation& seen : observations) {
    if (seen.request.step_factor == 0.5) halves[seen.request.x] = &seen;
  }
  const std::vector<StepBound> bounds = find_bounds(components, observations, halves);
  std::vector<KnownPoint> points;
  for (const Observation& seen : observations) {
    if (seen.request.step_factor != 1.0) continue;
    KnownPoint point{position_of(seen.request.x), compute_ratio(seen.answer, components), kNoBound,
                     seen.answer.id, halves.contains(seen.request.x)};
    for (const StepBound& bound : bounds) {
      const bool is_less = bound.coarse < point.coarse && reaches_above(bound.t, point.t);
      if (is_less) point.coarse = bound.coarse;
    }
    points.push_back(std::move(point));
  }
  return points;
}

MonotoneAudit audit_monotony(const std::vector<KnownPoint>& points, bool counts_pairs) {
  MonotoneAudit audit;
  for (const KnownPoint& b : points) {
    if (!std::isfinite(b.ratio) || !std::isfinite(b.coarse)) continue;
    if (!counts_pairs && b.net() <= 1.0) continue;
    for (const KnownPoint& a : points) {
      if (&a == &b || !std::isfinite(a.ratio)) continue;
      if (!counts_pairs && a.ratio > kNearTolerance) continue;
      if (!reaches_above(b.t, a.t)) continue;
      ++audit.pairs;
      const double allowed = std::max(1.0, a.ratio);
      if (a.ratio > kNearTolerance || b.net() <= allowed) continue;
      ++audit.contradictions;
      const double rise = b.net() / allowed - 1.0;
      if (rise <= audit.worst) continue;
      audit.worst = rise;
      audit.lower_id = a.id;
      audit.upper_id = b.id;
    }
  }
  return audit;
}

std::vector<std::size_t> find_doubts(const std::vector<KnownPoint>& points, double mu) {
  std::vector<std::size_t> doubts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const KnownPoint& b = points[i];
    if (!std::isfinite(b.ratio) || b.was_halved) continue;
    const bool is_doubt = std::ranges::any_of(points, [&](const KnownPoint& a) {
      const double allowed = (1.0 + 0.5 * mu) * std::max(1.0, a.ratio);
      return a.ratio <= kNearTolerance && b.ratio > allowed && b.net() <= allowed &&
             reaches_above(b.t, a.t);
    });
    if (is_doubt) doubts.push_back(i);
  }
  return doubts;
}

double choose_mu(double asked, const MonotoneAudit& audit) {
  return std::max(asked, 2.0 * audit.worst);
}

double find_lowest_uncovered(const Position& low, const Position& high,
                             const std::vector<Position>& proofs, double limit) {
  const std::vector<Position> maximal = keep_maximal(proofs);
  using Corner = std::pair<double, Position>;
  std::priority_queue<Corner, std::vector<Corner>, std::greater<>> corners;
  std::set<Position> known;
  const auto push = [&](Position corner) {
    const double f = sum_of(corner);
    if (f < limit && known.insert(corner).second) corners.emplace(f, std::move(corner));
  };
  push(low);
  while (!corners.empty()) {
    const auto [f, corner] = corners.top();
    corners.pop();
    const Position* proof = find_farthest(corner, maximal);
    if (proof == nullptr || known.size() > kMostCorners) return f;
    for (std::size_t j = 0; j < corner.size(); ++j) {
      Position next = corner;
      next[j] = (*proof)[j];
      if (next[j] < high[j]) push(std::move(next));
    }
  }
  return limit;
}

MonotoneProof prove(const std::vector<TunedVariable>& variables,
                    const std::vector<MatchComponent>& components, const std::vector<double>& point,
                    double asked_mu, const std::vector<Observation>& evidence) {
  const std::vector<KnownPoint> points = find_known_points(components, evidence);
  MonotoneProof proof;
  proof.audit = audit_monotony(points, true);
  proof.mu = choose_mu(asked_mu, proof.audit);
  proof.doubts = find_doubts(points, proof.mu).size();
  proof.objective = sum_of(position_of(point));
  std::vector<Position> proofs;
  for (const KnownPoint& known : points) {
    if (!std::isfinite(known.ratio) || !(known.net() > 1.0 + proof.mu)) continue;
    Position reach = known.t;
    for (double& t : reach) t += kReach;
    proofs.push_back(std::move(reach));
  }
  Position low;
  Position high;
  for (const TunedVariable& variable : variables) {
    low.push_back(std::log10(variable.low));
    high.push_back(std::log10(variable.high));
  }
  proof.covered = find_lowest_uncovered(low, high, proofs, proof.objective);
  return proof;
}

std::vector<Observation> find_staircase(const EvaluationLog& log) {
  std::vector<Observation> accepted;
  for (const Observation& seen : log.observations()) {
    const bool is_base = seen.request.step_factor == 1.0;
    if (is_base && log.is_candidate(seen.request.x)) accepted.push_back(seen);
  }
  std::vector<Observation> minimal;
  for (const Observation& one : accepted) {
    const bool is_minimal = std::ranges::none_of(accepted, [&](const Observation& other) {
      return other.request.x != one.request.x && is_below(other.request.x, one.request.x);
    });
    if (is_minimal) minimal.push_back(one);
  }
  std::ranges::stable_sort(minimal, {},
                           [](const Observation& one) { return compute_objective(one.request.x); });
  return minimal;
}

}  // namespace linkstudy::tuning

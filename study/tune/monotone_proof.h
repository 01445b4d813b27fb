// C4: that no point far below k* matches, from finitely many runs.
//
// Positions are t, decades along the axes (variable_axis.h), f = sum_j t_j. Let r = max error /
// tolerance, and call errors monotone to mu when for a <= b (in every variable)
//   r(b) <= (1 + mu) max(1, r(a)).
// Then a point p with r(p) > 1 + mu proves that nothing at or below it matches, and a set of such
// points proves all of {f < F} when every point there lies below one of them. The proven gap is
// f(k*) less the lowest f that is not so covered.
//
// That holds on the left branch only, where errors fall because the joint gets stiffer; a point
// that fails by its step proves nothing. Errors that a step adds are of fourth order in it and grow
// along the axes, so that a point c that ran at half its step too bounds them for all p <= c:
//   coarse(p) <= 16/15 max_i |e_i(c, h) - e_i(c, h/2)| / tolerance_i,
// and r(p) less the least such bound stands for r(p); a point without a bound proves nothing.
//
// The audit looks at all pairs a <= b of evaluated points, b with a bound. A pair contradicts
// monotony where r(a) <= 1.5 and r(b) less its bound exceeds max(1, r(a)), by the ratio of the two
// less 1. mu is the larger of what was asked for and twice the worst contradiction: it is never
// made smaller by what is seen. A point b that would contradict by more than mu / 2 but for its
// bound is a doubt, unless half its step was tried: that tells whether it fails by its step. With
// doubts no gap is closed.
#pragma once

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

// Contradictions above this are no noise: such errors are not monotone at all.
inline constexpr double kMostContradiction = 0.5;

using Position = std::vector<double>;

struct KnownPoint {
  Position t;
  double ratio = 0.0;   // infinite where the run ended by a cause
  double coarse = 0.0;  // least bound of what the step adds; infinite where none is known
  std::uint64_t id = 0;
  bool was_halved = false;  // half the step was tried
  double net() const { return ratio - coarse; }
};

struct MonotoneAudit {
  std::size_t pairs = 0;
  std::size_t contradictions = 0;
  double worst = 0.0;          // 0.033: a rise by 3.3 %
  std::uint64_t lower_id = 0;  // of the worst pair
  std::uint64_t upper_id = 0;
};

struct MonotoneProof {
  std::size_t doubts = 0;
  double mu = 0.0;
  double objective = 0.0;  // f(k*)
  double covered = 0.0;    // everything with a smaller f is proven to fail
  MonotoneAudit audit;
  double gap() const { return objective - covered; }
};

// Of two or three variables whose sum of log10 is minimised.
bool can_be_proven(const TuningProblem& problem);

Position position_of(const std::vector<double>& x);
std::vector<double> values_at(const std::vector<TunedVariable>& variables, const Position& t);
double sum_of(const Position& t);
// Whether b is nowhere below a, to rounding.
bool reaches_above(const Position& b, const Position& a);

// Points at the base step, in the order evaluated.
std::vector<KnownPoint> find_known_points(const std::vector<MatchComponent>& components,
                                          const std::vector<Observation>& observations);

// Without `counts_pairs` only the contradictions are counted.
MonotoneAudit audit_monotony(const std::vector<KnownPoint>& points, bool counts_pairs);
double choose_mu(double asked, const MonotoneAudit& audit);

// Positions in the list of points whose half step was not tried and would tell of a contradiction.
std::vector<std::size_t> find_doubts(const std::vector<KnownPoint>& points, double mu);

// The lowest f of a point of the range that is below none of the proofs, at most `limit`.
double find_lowest_uncovered(const Position& low, const Position& high,
                             const std::vector<Position>& proofs, double limit);

MonotoneProof prove(const std::vector<TunedVariable>& variables,
                    const std::vector<MatchComponent>& components, const std::vector<double>& point,
                    double asked_mu, const std::vector<Observation>& evidence);

// Accepted points with no other accepted point below them, by their objective.
std::vector<Observation> find_staircase(const EvaluationLog& log);

}  // namespace linkstudy::tuning

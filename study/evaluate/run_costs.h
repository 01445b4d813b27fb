// What packs cost, one over the other, so that the longest are begun first and no rank is left with
// a long one at the end: over all load cases, steps times the square of the freedoms. Runs with
// steps of their own count by the instants of their grid.
#pragma once

#include <map>

#include "study/evaluate/evaluator.h"

namespace linkstudy {

class RunCosts {
 public:
  // `evaluator` outlives this.
  explicit RunCosts(const Evaluator& evaluator) : evaluator_(evaluator) {}

  // 0 where the first point is no valid model. Models are looked at once for all points that agree
  // in what decides the steps, and for no more than some thousands of such kinds: those beyond
  // count like the mean.
  double of(const std::vector<Point>& pack);

 private:
  double look_at(const Point& point) const;

  const Evaluator& evaluator_;
  std::map<std::vector<Value>, double> known_;
  double sum_ = 0.0;  // of known_
};

// Longest first; equal ones stay in their order.
void sort_by_cost(std::vector<std::vector<Point>>& packs, RunCosts& costs);

}  // namespace linkstudy

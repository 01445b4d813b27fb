// Runs sorted by what decides how long one takes: load case, structure of the mechanism, step grid,
// integrator. Runs of a kind are forecast from one of them.
#pragma once

#include <map>

#include "core/model/mechanism.h"
#include "core/simulation/simulate.h"
#include "study/evaluate/evaluator.h"

namespace linkstudy::plan {

struct RunKind {
  std::size_t load_case = 0;
  SimulationOptions options;
  MechanismStructure structure;
  StepGrid grid{};
  std::vector<const Point*> points{};  // of this kind, in their order

  bool has_constant_steps() const { return options.integrator == Integrator::rk4; }
  bool fills_lanes() const { return options.integrator != Integrator::stiff; }
};

// Whether runs of both go side by side.
bool shares_steps(const RunKind& a, const RunKind& b);

class RunKinds {
 public:
  // Of these points, which must outlive it. The first 2000 are looked at one by one; of the others,
  // those that share all words and all values of the simulation with one of them are of its kind.
  RunKinds(const Evaluator& evaluator, const std::vector<Point>& points);

  const std::vector<RunKind>& all() const { return kinds_; }
  // By load case: the kinds of a point; nothing where it is no valid model.
  const std::vector<std::size_t>& of(const Point& point) const { return by_point_.at(point.id); }
  std::size_t invalid() const { return invalid_; }

 private:
  std::vector<std::size_t> find(const Evaluator& evaluator, const Point& point);
  std::size_t find_kind(RunKind wanted);

  std::vector<RunKind> kinds_;
  std::map<std::uint64_t, std::vector<std::size_t>> by_point_;
  std::size_t invalid_ = 0;
};

}  // namespace linkstudy::plan

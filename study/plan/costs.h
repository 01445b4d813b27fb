// What every run of a study costs, from probes (plan/probe.h) of its kinds.
#pragma once

#include "study/plan/probe.h"
#include "study/plan/run_kinds.h"

namespace linkstudy::plan {

struct Measured {
  std::size_t kinds = 0;  // of runs that there are
  std::size_t probed = 0;
  double steps = 0.0;
  double spent_s = 0.0;  // CPU
  // What a step takes in as many processes at once, over what it takes alone: 1 where each has a
  // core of its own, up to 2 where two hardware threads share one.
  int at_once = 1;
  double slowdown = 1.0;
};

class Costs {
 public:
  // Spends about that many seconds of this process on measuring. `lanes`: points side by side;
  // `at_once`: processes that this machine runs at once of those that are planned.
  Costs(const Evaluator& study, const RunKinds& kinds, int lanes, int at_once, double seconds);

  const Measured& measured() const { return measured_; }
  // All reference runs, side by side in the lanes of so many ranks.
  struct References {
    double cpu_s = 0.0;
    double wall_s = 0.0;
  };
  References references(int ranks) const;
  // Points that are evaluated together, and load cases beside them where they leave lanes free.
  // Alone on the machine.
  double pack_s(std::span<const Point> pack) const;
  // Among so many ranks it takes longer by this.
  double slowdown(int ranks) const;

 private:
  struct KindCost {
    std::optional<RunPace> alone;
    std::optional<RunPace> beside;  // as many as there are lanes, or points
  };

  void measure_references(const Evaluator& study, double seconds);
  void measure_kinds(double seconds);
  void measure_slowdown(int at_once, double seconds);
  std::vector<Point> points_beside(const RunKind& kind) const;
  void take(std::size_t kind, std::span<const Point> points, double seconds,
            std::optional<RunPace>& pace);
  void fill_gaps();
  double run_s(std::size_t kind, std::size_t count) const;
  double load_cases_s(std::span<const Point> pack, std::size_t first, std::size_t last) const;

  const RunKinds& kinds_;
  int lanes_;
  std::vector<std::unique_ptr<Probe>> probes_;  // by load case
  std::vector<KindCost> costs_;                 // by kind
  std::vector<double> references_s_;            // each alone
  Measured measured_;
};

}  // namespace linkstudy::plan

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
};

class Costs {
 public:
  // Spends about that many seconds of this process on measuring. `lanes`: points side by side.
  Costs(const Evaluator& study, const RunKinds& kinds, int lanes, double seconds);

  const Measured& measured() const { return measured_; }
  // All reference runs, CPU s.
  double references_s() const { return references_s_; }
  // Points that are evaluated together: every load case, one after the other.
  double pack_s(std::span<const Point> pack) const;

 private:
  struct KindCost {
    std::optional<RunPace> alone;
    std::optional<RunPace> beside;  // as many as there are lanes, or points
  };

  void measure_references(const Evaluator& study, double seconds);
  void measure_kinds(double seconds);
  void take(std::size_t kind, std::span<const Point> points, double seconds,
            std::optional<RunPace>& pace);
  void fill_gaps();
  double run_s(std::size_t kind, std::size_t count) const;

  const RunKinds& kinds_;
  int lanes_;
  std::vector<std::unique_ptr<Probe>> probes_;  // by load case
  std::vector<KindCost> costs_;                 // by kind
  double references_s_ = 0.0;
  Measured measured_;
};

}  // namespace linkstudy::plan

// Begins of runs, measured: what a run costs is what its begin took, times the part of it that
// remains. CPU time of this process, so that others on the machine do not count.
#pragma once

#include <memory>

#include "study/evaluate/evaluator.h"

namespace linkstudy::plan {

struct RunPace {
  double setup_s = 0.0;  // CPU of one evaluation before its run
  double run_s = 0.0;    // CPU of the whole run, of all that run side by side
  double share = 1.0;    // of it that was run
  double steps = 0.0;    // that were run, of all
  double spent_s = 0.0;  // CPU of the measurement
};

class Probe {
 public:
  // Of one load case of a study.
  Probe(const Evaluator& study, std::size_t load_case, const std::vector<Value>& first);

  // The reference run, at most that many seconds of it. Where it does not end in them, cases are
  // compared with zeros, which takes as long. Throws ReferenceFailure where it fails.
  RunPace measure_reference(double seconds);

  // Points that run side by side, once their setup is known. A run that ends by itself counts as it
  // is.
  RunPace measure(std::span<const Point> points, double seconds);

  // CPU of a step of runs that are begun again and again for so long.
  double seconds_a_step(std::span<const Point> points, double seconds);

 private:
  void assume_reference();

  std::unique_ptr<Evaluator> evaluator_;
};

}  // namespace linkstudy::plan

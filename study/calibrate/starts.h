// Where fits begin: the declared start (the middle for parameters without one), then points of a
// Sobol sequence (Boost.Random, direction numbers of Joe and Kuo 2008) shifted modulo one by the
// seed. Points whose evaluation fails are replaced by further ones, up to five times as many as
// asked for, so that a failing region ends nothing.
#pragma once

#include "study/calibrate/descent.h"

namespace linkstudy::calibration {

struct StartReport {
  std::vector<double> from;  // values of the parameters
  std::vector<double> to;
  double from_sum = 0.0;  // S; infinite where it failed
  double to_sum = 0.0;
  DescentEnd end = DescentEnd::running;
  int iterations = 0;
  bool is_best = false;  // it ended at the best point
};

// In the order of the sequence.
std::vector<Vector> list_starts(const FitProblem& problem, std::uint64_t seed, std::size_t count);

// Descents from all starts side by side. One at least where the budget allows any.
std::vector<Descent> run_starts(FitLog& log);

}  // namespace linkstudy::calibration

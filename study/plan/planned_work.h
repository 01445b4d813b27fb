// What a file asks for before anything has run: the evaluations that are certain, with their
// values, and the most there can be.
#pragma once

#include "study/evaluate/evaluator.h"

namespace linkstudy::plan {

struct PlannedWork {
  // A design in whole; of a tune the scan at every step asked for, of a calibration the starts:
  // what comes after depends on what they find.
  std::vector<Point> points;
  std::uint64_t most = 0;  // evaluations
  // Points that are asked for together: the next are asked for when these have answers. Those of a
  // calibration change: about one for each start.
  std::size_t batch = 0;
  // "the scan": what those points are, where they are not all.
  const char* certain_are = "";
};

// Of a calibration, runs that stand for measurements are made here: its starts depend on them.
PlannedWork list_work(Evaluator& evaluator);

}  // namespace linkstudy::plan

// What is kept of a reference run: the matched signals at every step, histories for tables, and a
// few poses along it.
#pragma once

#include <vector>

#include "core/model/state.h"
#include "core/simulation/observers.h"
#include "core/simulation/simulate.h"
#include "study/config/measured_input.h"
#include "study/record/evaluation.h"

namespace linkstudy {

struct ReferenceRecord {
  StepGrid grid{};
  std::vector<Series> match;          // by [[match]]; every step from 0 on
  std::vector<TimeWindow> cycles;     // by [[match]], where one has a cycle; others are empty
  std::vector<Trace> traces;          // time first, every output interval
  std::vector<Trace> responses;       // what it has of [[response]], one value each
  std::vector<std::string> joints;    // that the coordinates of the poses belong to
  std::vector<State<double>> poses;   // equally spaced, without the start
  std::vector<std::string> warnings;  // of model and start; not stored with it
};

}  // namespace linkstudy

// One varied parameter and the values it takes, in the order they were declared.
#pragma once

#include <vector>

#include "study/record/evaluation.h"

namespace linkstudy {

struct Axis {
  Parameter parameter;
  std::vector<Value> values;
};

// An axis over numbers, as linspace, logspace and ladder make them.
Axis make_axis(Parameter parameter, const std::vector<double>& numbers);

// Raises std::invalid_argument for an axis without values or a parameter varied twice.
void check_axes(const std::vector<Axis>& axes);

}  // namespace linkstudy

// One varied parameter: the values it takes, in the order they were declared, or what its samples
// follow.
#pragma once

#include <optional>
#include <vector>

#include "study/design/distribution.h"
#include "study/record/evaluation.h"

namespace linkstudy {

struct Axis {
  Parameter parameter;
  std::vector<Value> values = {};
  std::size_t center = 0;                         // of a centered design, by position
  std::optional<Distribution> distribution = {};  // of a sampled design, in place of values
};

// An axis over numbers, as linspace, logspace and ladder make them.
Axis make_axis(Parameter parameter, const std::vector<double>& numbers);

// Raises std::invalid_argument for an axis without values (or, `is_sampled`, without a
// distribution) or a parameter varied twice.
void check_axes(const std::vector<Axis>& axes, bool is_sampled);

}  // namespace linkstudy

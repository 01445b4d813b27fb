#include "study/design/axis.h"

#include <fmt/core.h>

#include <set>
#include <stdexcept>
#include <string>
#include <utility>

namespace linkstudy {

Axis make_axis(Parameter parameter, const std::vector<double>& numbers) {
  return {std::move(parameter), std::vector<Value>(numbers.begin(), numbers.end())};
}

void check_axes(const std::vector<Axis>& axes, bool is_sampled) {
  std::set<std::string> seen;
  for (const Axis& axis : axes) {
    const std::string& path = axis.parameter.path;
    if (is_sampled ? !axis.distribution : axis.values.empty())
      throw std::invalid_argument(
          fmt::format("'{}' has no values to take; give one or leave it out", path));
    if (!seen.insert(path).second)
      throw std::invalid_argument(
          fmt::format("'{}' is varied twice; join its values in one entry", path));
  }
}

}  // namespace linkstudy

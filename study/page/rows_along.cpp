#include "study/page/rows_along.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace linkstudy {
namespace {

double most_frequent(const std::vector<double>& values) {
  std::map<double, int> counts;
  for (const double value : values) ++counts[value];
  return std::ranges::max_element(counts, {}, [](const auto& one) { return one.second; })->first;
}

}  // namespace

std::optional<std::vector<double>> parameter_numbers(const std::vector<Evaluation>& rows,
                                                     std::size_t parameter) {
  std::vector<double> values;
  for (const Evaluation& row : rows) {
    const double* number = std::get_if<double>(&row.point.values.at(parameter));
    if (number == nullptr) return std::nullopt;
    values.push_back(*number);
  }
  return values;
}

std::vector<std::size_t> rows_along(const std::vector<Evaluation>& rows, std::size_t parameter) {
  const std::optional<std::vector<double>> own = parameter_numbers(rows, parameter);
  if (!own || rows.empty()) return {};
  std::vector<std::size_t> chosen(rows.size());
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  for (std::size_t other = 0; other < rows.front().point.values.size(); ++other) {
    const auto values = other == parameter ? std::nullopt : parameter_numbers(rows, other);
    if (!values) continue;
    const double usual = most_frequent(*values);
    std::erase_if(chosen, [&](std::size_t row) { return (*values)[row] != usual; });
  }
  std::ranges::stable_sort(chosen, {}, [&](std::size_t row) { return (*own)[row]; });
  return chosen;
}

}  // namespace linkstudy

#include "study/page/rows_along.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace linkstudy {
namespace {

// Of equals the first.
Value usual_value(const std::vector<Evaluation>& rows, const std::vector<std::size_t>& chosen,
                  std::size_t parameter) {
  std::map<Value, std::size_t> counts;
  for (const std::size_t row : chosen) ++counts[rows[row].point.values.at(parameter)];
  const auto count_of = [&](std::size_t row) {
    return counts.at(rows[row].point.values.at(parameter));
  };
  return rows[*std::ranges::max_element(chosen, {}, count_of)].point.values.at(parameter);
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

std::vector<std::size_t> usual_rows(const std::vector<Evaluation>& rows,
                                    const std::vector<std::size_t>& free) {
  std::vector<std::size_t> chosen(rows.size());
  std::iota(chosen.begin(), chosen.end(), std::size_t{0});
  for (std::size_t p = 0; !rows.empty() && p < rows.front().point.values.size(); ++p) {
    if (std::ranges::count(free, p) > 0) continue;
    const Value usual = usual_value(rows, chosen, p);
    std::erase_if(chosen, [&](std::size_t row) { return rows[row].point.values.at(p) != usual; });
  }
  return chosen;
}

std::vector<std::size_t> rows_along(const std::vector<Evaluation>& rows, std::size_t parameter) {
  const std::optional<std::vector<double>> own = parameter_numbers(rows, parameter);
  if (!own || rows.empty()) return {};
  std::vector<std::size_t> free = {parameter};
  for (std::size_t p = 0; p < rows.front().point.values.size(); ++p) {
    if (!parameter_numbers(rows, p)) free.push_back(p);
  }
  std::vector<std::size_t> chosen = usual_rows(rows, free);
  std::ranges::stable_sort(chosen, {}, [&](std::size_t row) { return (*own)[row]; });
  return chosen;
}

}  // namespace linkstudy

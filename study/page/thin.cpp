#include "study/page/thin.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace linkstudy {

std::vector<std::uint32_t> thin_rows(std::span<const double> values, std::size_t count) {
  const std::size_t n = values.size();
  std::vector<std::uint32_t> rows;
  if (n <= count) {
    rows.resize(n);
    std::iota(rows.begin(), rows.end(), 0U);
    return rows;
  }
  const auto add = [&](std::size_t row) {
    if (rows.empty() || rows.back() < row) rows.push_back(static_cast<std::uint32_t>(row));
  };
  const std::size_t stretches = std::max<std::size_t>(1, count / 2);
  add(0);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * n / stretches;
    const std::size_t end = (k + 1) * n / stretches;
    std::size_t least = begin;
    std::size_t greatest = begin;
    for (std::size_t row = begin; row < end; ++row) {
      if (std::isnan(values[row])) continue;
      if (std::isnan(values[least]) || values[row] < values[least]) least = row;
      if (std::isnan(values[greatest]) || values[row] > values[greatest]) greatest = row;
    }
    add(std::min(least, greatest));
    add(std::max(least, greatest));
  }
  add(n - 1);
  return rows;
}

}  // namespace linkstudy

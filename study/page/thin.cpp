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

std::vector<std::size_t> even_rows(std::size_t rows, std::size_t most) {
  std::vector<std::size_t> chosen;
  if (rows == 0) return chosen;
  const std::size_t stride = std::max<std::size_t>(1, (rows + most - 1) / most);
  for (std::size_t row = 0; row < rows; row += stride) chosen.push_back(row);
  if (chosen.back() != rows - 1) chosen.push_back(rows - 1);
  return chosen;
}

}  // namespace linkstudy

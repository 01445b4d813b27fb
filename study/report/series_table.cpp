#include "study/report/series_table.h"

namespace linkstudy {

Table series_table(const Series& series) {
  Table table;
  for (const Channel& channel : series.channels) {
    table.columns.push_back({channel.name, channel.unit});
  }
  const std::size_t n = series.channels.size();
  for (std::size_t row = 0; row < series.rows(); ++row) {
    std::vector<Cell> cells(n);
    for (std::size_t c = 0; c < n; ++c) cells[c] = series.values[row * n + c];
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace linkstudy

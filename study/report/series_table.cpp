#include "study/report/series_table.h"

namespace linkstudy {

Table series_table(const Series& series) {
  Table table;
  for (const Channel& channel : series.channels) {
    table.columns.push_back({channel.name, channel.unit});
  }
  const std::size_t n = series.channels.size();
  for (std::size_t row = 0; row < series.rows(); ++row) {
    append_row(table, std::span(series.values).subspan(row * n, n));
  }
  return table;
}

}  // namespace linkstudy

// Which samples of a long time history a drawing needs: extremes stay.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace linkstudy {

// Rows, ascending: the first and the last, and of each of count / 2 stretches of equal length the
// ones with the least and the greatest value. All rows where these are no more than `count`.
// Missing values (NaN) are no extremes; a stretch of them alone gives its first row.
std::vector<std::uint32_t> thin_rows(std::span<const double> values, std::size_t count);

// Every n-th of so many rows, n as small as leaves no more than `most`, and the last.
std::vector<std::size_t> even_rows(std::size_t rows, std::size_t most);

}  // namespace linkstudy

// Counts and lists of ids in texts.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace linkstudy {

// "1 run", "3 runs"
std::string counted(std::int64_t count, std::string_view thing);

// Ascending ids, neighbours as first-last, at most twenty pieces: "0-7, 9, 12-13, ...".
std::string listed(const std::vector<std::uint64_t>& ids);

}  // namespace linkstudy

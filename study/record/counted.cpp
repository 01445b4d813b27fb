#include "study/record/counted.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace linkstudy {
namespace {

constexpr std::size_t kMostPieces = 20;

}  // namespace

std::string counted(std::int64_t count, std::string_view thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::uint64_t>& ids) {
  std::vector<std::string> pieces;
  for (std::size_t i = 0, end = 0; i < ids.size(); i = end) {
    if (pieces.size() == kMostPieces) {
      pieces.emplace_back("...");
      break;
    }
    for (end = i + 1; end < ids.size() && ids[end] == ids[end - 1] + 1;) ++end;
    pieces.push_back(end - i == 1 ? fmt::format("{}", ids[i])
                                  : fmt::format("{}-{}", ids[i], ids[end - 1]));
  }
  return fmt::format("{}", fmt::join(pieces, ", "));
}

}  // namespace linkstudy

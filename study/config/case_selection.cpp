#include "study/config/case_selection.h"

#include <algorithm>

#include "study/design/design.h"
#include "study/record/sequence.h"

namespace linkstudy {
namespace {

// `count` positions of 0 .. size - 1, evenly, both ends included.
std::vector<std::size_t> spaced(std::size_t size, std::size_t most) {
  const std::size_t count = std::min(size, most);
  std::vector<std::size_t> positions;
  for (std::size_t i = 0; i < count; ++i) {
    positions.push_back(count == 1 ? 0 : i * (size - 1) / (count - 1));
  }
  return positions;
}

CasePositions grid_case(const std::vector<std::size_t>& sizes, std::size_t id) {
  CasePositions positions(sizes.size());
  for (std::size_t i = sizes.size(); i-- > 0;) {
    positions[i] = id % sizes[i];
    id /= sizes[i];
  }
  return positions;
}

std::vector<CasePositions> along_axes(const std::vector<std::size_t>& sizes, std::size_t most) {
  std::vector<CasePositions> cases;
  const CasePositions first(sizes.size(), 0);
  CasePositions last;
  for (const std::size_t size : sizes) last.push_back(size - 1);
  for (std::size_t axis = 0; axis < sizes.size(); ++axis) {
    for (const std::size_t position : spaced(sizes[axis], most)) {
      for (CasePositions one : {first, last}) {
        one[axis] = position;
        cases.push_back(std::move(one));
      }
    }
  }
  return cases;
}

}  // namespace

std::vector<Axis> axes_of(const StudyInput& input) {
  return {input.vary.begin(), input.vary.end()};
}

std::vector<std::uint64_t> choose_ids(const DesignOptions& design, const std::vector<Axis>& axes,
                                      std::size_t most) {
  const std::vector<std::size_t> ids = spaced(count_points(design, axes), most);
  return {ids.begin(), ids.end()};
}

std::optional<std::uint64_t> count_cases(Design design, const std::vector<std::size_t>& sizes) {
  if (design != Design::grid && !sizes.empty()) return sizes.front();
  std::uint64_t count = 1;
  for (const std::size_t size : sizes) {
    if (size > 0 && count > kMaxPoints / size) return std::nullopt;
    count *= size;
  }
  return count;
}

std::vector<CasePositions> choose_cases(Design design, const std::vector<std::size_t>& sizes,
                                        std::size_t most) {
  std::vector<CasePositions> cases;
  if (design != Design::grid && !sizes.empty()) {
    for (const std::size_t i : spaced(sizes.front(), most)) cases.emplace_back(sizes.size(), i);
    return cases;
  }
  const std::optional<std::uint64_t> count = count_cases(design, sizes);
  if (!count || *count > most) return along_axes(sizes, most);
  for (std::size_t id = 0; id < *count; ++id) cases.push_back(grid_case(sizes, id));
  return cases;
}

}  // namespace linkstudy

// The levels of one refined value, coarse to fine, among the points of the design. Of two refined
// values the first is followed at every value of the second, the second at the finest of the first.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "study/config/study_input.h"
#include "study/design/axis.h"

namespace linkstudy::convergence {

struct LevelCourse {
  std::size_t axis = 0;  // of [[refine]]
  std::string at;  // the other value, "closure.S.sde.stiffness = 1e+06 N/m"; empty without one
  bool at_finest = true;
  std::vector<double> sizes;  // refined value
  std::vector<double> h;      // size, or 1 / size
  std::vector<std::uint64_t> ids;
};

std::vector<LevelCourse> list_courses(const StudyInput& input);

double h_of_size(RefineLimit limit, double size);

}  // namespace linkstudy::convergence

// A second method about the best fit: NLopt's BOBYQA (COBYLA for one parameter), which knows
// neither residuals nor derivatives, minimises S from a point beside it. NLopt is not trusted:
// budget and incumbent are ours, a failed run is a large finite S, an exception is kept and thrown
// again.
#pragma once

#include "study/calibrate/fit_log.h"

namespace linkstudy::calibration {

struct CrossCheck {
  bool ran = false;
  bool confirms = false;  // its least S is that of the fit to within the slack
  std::string algorithm;
  std::string ended;
  std::size_t calls = 0;
  Vector point;  // with its least S
  double sum = 0.0;
};

struct CrossCheckCentre {
  Vector point;
  double sum = 0.0;
  double slack = 0.0;  // of S
};

CrossCheck cross_check(FitLog& log, const CrossCheckCentre& centre);

}  // namespace linkstudy::calibration

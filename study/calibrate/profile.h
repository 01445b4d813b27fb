// Profile of a parameter: the least S over all others, as a function of it. Its interval is where
//   S <= S_min + rise                          (profile likelihood; Bates and Watts 1988, chapter
//   6)
// Each side is followed outwards from the best point: the first step by the linear model, further
// ones by the secant of sqrt(S - S_min), which is straight where the model is linear. Both sides of
// all parameters go side by side.
#pragma once

#include <string_view>

#include "study/calibrate/curvature.h"
#include "study/calibrate/descent.h"

namespace linkstudy::calibration {

enum class ProfileEnd { crossed, bound, failed, unknown };

}  // namespace linkstudy::calibration

namespace linkstudy {

template <>
inline constexpr auto kWords<calibration::ProfileEnd> =
    make_words<calibration::ProfileEnd>({{calibration::ProfileEnd::crossed, "found"},
                                         {calibration::ProfileEnd::bound, "none within the bound"},
                                         {calibration::ProfileEnd::failed, "runs fail before"},
                                         {calibration::ProfileEnd::unknown, "not found"}});

}  // namespace linkstudy

namespace linkstudy::calibration {

struct ProfilePoint {
  Eigen::Index parameter = 0;
  Vector point;  // best one with this value of the parameter
  double sum = 0.0;
};

struct ProfileSide {
  ProfileEnd end = ProfileEnd::unknown;
  double u = 0.0;  // of the end, where it was crossed
};

struct Profiles {
  std::vector<ProfileSide> low, high;  // by parameter
  std::vector<ProfilePoint> points;    // by parameter, ascending
  // A point that is better than the one they are about by more than a thousandth of the rise, or
  // null.
  const FitSample* better = nullptr;
};

struct ProfileCentre {
  Vector point;
  double sum = 0.0;
  double rise = 0.0;
};

Profiles trace_profiles(FitLog& log, const ProfileCentre& centre, const Curvature& curvature);

}  // namespace linkstudy::calibration

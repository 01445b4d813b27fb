// The window scan: log-spaced points over the range, and on which side each failing one failed.
//
// At a fixed step h the error is two-sided in the stiffness c: e ~ A / c + B c^2 h^4. It falls,
// reaches a minimum, then grows until the step is unstable. A failing point is therefore
//   too_soft         on the falling side (below the window, or left of the smallest ratio)
//   step_too_coarse  on the rising side, or past the stability limit though still finite
//   diverged         ended by an instability
//   failed           ended by any other cause
// Where the feasible set has gaps, a point in a gap is judged by the slope between its neighbours.
//
// When no scan point is feasible the scan is refined where a window could still hide. Lower bound
// between neighbours a < b of log ratio f, with f falling at most kSteepestFall decades per decade
// and rising at most kSteepestRise (a Piyavskii-Shubert bound): intervals whose bound is positive
// are left alone, the others are split, lowest bound first. Beside a point that ended with a cause
// only the other end counts, since a window may end at a cliff of stability. What remains out of
// reach is a window between two points that both ended with a cause, and one that falls more
// steeply. Along a linear range 1/c has any slope: there both bounds are twice the steepest slope
// between neighbours that were seen, where that is more.
#pragma once

#include <string_view>

#include "core/base/words.h"

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

inline constexpr double kSteepestFall = 2.0;
inline constexpr double kSteepestRise = 8.0;

enum class Side { feasible, too_soft, step_too_coarse, diverged, failed };

}  // namespace linkstudy::tuning

namespace linkstudy {

template <>
inline constexpr auto kWords<tuning::Side> =
    make_words<tuning::Side>({{tuning::Side::feasible, "feasible"},
                              {tuning::Side::too_soft, "too soft"},
                              {tuning::Side::step_too_coarse, "step too coarse"},
                              {tuning::Side::diverged, "diverged"},
                              {tuning::Side::failed, "failed"}});

}  // namespace linkstudy

namespace linkstudy::tuning {

struct ScanPoint {
  double value = 0.0;          // of the first variable
  std::vector<double> x = {};  // all values, of several variables
  double ratio = 0.0;          // max error / tolerance; infinite without errors
  Side side = Side::feasible;
  Cause cause = Cause::ok;
  std::uint64_t evaluation = 0;
  double h_omega = 0.0;
  bool declared = false;  // of the scan or its refinement
};

// The declared scan of one variable: equal distances along its axis, ends exact.
std::vector<double> make_scan_values(const TunedVariable& variable, std::size_t count);

// log10 of the ratio kept in [-12, 12], so that zero and failed answers stay comparable.
double compute_log_ratio(double ratio);

// Bounds of the slope of the log ratio along an axis.
struct Steepest {
  double fall = kSteepestFall;
  double rise = kSteepestRise;
};

// Lower bound of the log ratio between two values a < b, and where it is attained.
struct IntervalBound {
  double log_ratio = 0.0;
  double value = 0.0;
};
IntervalBound bound_between(const TunedVariable& variable, double a, double log_ratio_a, double b,
                            double log_ratio_b, const Steepest& steepest = {});

// Every point evaluated at the base step, ascending, with its side.
std::vector<ScanPoint> classify_points(const EvaluationLog& log);

// Splits intervals until a feasible point appears, none can hide a window wider than the
// resolution, or the budget ends. Returns true when a feasible point is known.
bool refine_scan(EvaluationLog& log);

bool any_feasible(const EvaluationLog& log);

}  // namespace linkstudy::tuning

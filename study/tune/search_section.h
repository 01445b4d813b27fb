// Section search of one end of the feasible set between a failing and a feasible value.
//
// A round evaluates up to `batch` values inside the bracket: a pair close about a log-log secant
// estimate of where ratio = 1, a wider pair, and equal sections for the rest. The secant's slope
// d log(ratio) / d log(value) is kept in [-2, -0.3] at the lower end (the error falls about as
// 1/c) and in [0.3, 4] at the upper end; on a linear axis, where slopes depend on the range, only
// its sign and a least size are kept. A bracket that was not at least halved by a round gets
// equal sections in the next, so the number of rounds is bounded for any error function.
//
// Lower end: the bracket closes on the lowest feasible value seen. Upper end: on the first failing
// value above the feasible end, so that [low, high] has no known gap.
#pragma once

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

struct Bracket {
  double failing = 0.0;
  double feasible = 0.0;
};

enum class WindowEnd { lower, upper };
// What counts as feasible: the base step alone, or the base step and half of it.
enum class Steps { base, both };

struct SectionSettings {
  WindowEnd end = WindowEnd::lower;
  Steps steps = Steps::base;
  double resolution = 1e-3;  // decades
  std::string purpose;
  TunedVariable variable{};  // whose axis it is; search_section takes that of the log
};

// log10 ratios at the ends of a bracket, kept in [-12, 12].
struct EndRatios {
  double failing = 0.0;
  double feasible = 0.0;
};

// Up to `count` values strictly inside the bracket, ascending.
std::vector<double> place_section(const Bracket& bracket, const EndRatios& ends,
                                  const SectionSettings& settings, std::size_t count,
                                  bool equal_sections);

// Closes the bracket to the resolution, or as far as the budget goes.
Bracket search_section(EvaluationLog& log, Bracket bracket, SectionSettings settings);

double width_of(const TunedVariable& variable, const Bracket& bracket);

}  // namespace linkstudy::tuning

// When no stiffness in the range matches: which step would open a window.
//
// Each component's error is fitted as e(c, h) = A / c + B c^2 h^4, A and B not negative, by least
// squares in relative error over the finite points within a decade of the smallest ratio and under
// 0.9 of the stability limit, half-step answers included (they tell A from B where the scan alone
// does not). At a stiffness c component i matches up to
//   h_i(c) = ((tol_i - A_i / c) / (B_i c^2))^(1/4),
// never past the stability limit, which is interpolated between the limits the answers report and
// falls as c^(-1/2) beyond them. At the largest min_i h_i(c) over the range the window is a point.
// Where softness alone asks for more than the range has, its end is to be raised; but where values
// below that end fail by their step, that is no help at the same step, and both are advised.
// The suggestion is 0.7 of that, rounded down to two digits: the step error at its lower end is
// then at most a quarter of what closed the window, small enough for a certificate.
#pragma once

#include <optional>

#include "study/tune/evaluation_log.h"

namespace linkstudy::tuning {

struct ErrorModel {
  double soft = 0.0;    // A, in the variable's unit
  double coarse = 0.0;  // B, in 1 / (unit^2 s^4)
};

struct ErrorSample {
  double stiffness = 0.0;  // c
  double step = 0.0;       // h, s
  double error = 0.0;
};

struct StepSuggestion {
  double opens_at = 0.0;  // s; the window is a point at this step
  double step = 0.0;      // s, to use; 0 when no step in sight opens a window in the range
  double value = 0.0;     // the stiffness at which the window opens
  std::string message;    // one sentence for the user
  // Set when the half step was tried and a point matched there.
  std::optional<std::uint64_t> confirmed_by;
};

// Least squares with both terms kept non-negative; all zero without samples.
ErrorModel fit_error_model(const std::vector<ErrorSample>& samples);

// Spends up to two evaluations at half the step near the smallest ratio.
void probe_half_step(EvaluationLog& log);

StepSuggestion suggest_step(const EvaluationLog& log);

}  // namespace linkstudy::tuning

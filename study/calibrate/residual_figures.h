// What the residuals of the best fit say about themselves.
//   rho   autocorrelation of neighbours, rho' = sum e_t e_(t+1) / sum e_t^2, and what the fit of p
//         parameters has taken away: rho = rho' + (p (1 + rho') + 2 rho') / n (for p = 1, the mean,
//         Marriott and Pope 1954); 0 where rho' + p / n is below 2 / sqrt(n), as in white noise
//   n_eff = n (1 - rho) / (1 + rho), the number of independent samples that say as much about a
//         mean (Bayley and Hammersley 1946); sums over the series
//   s^2   = S / (n_eff - p), variance factor
// Intervals take nu = n_eff - p degrees of freedom. Residuals that are white give n_eff = n and the
// textbook's numbers.
#pragma once

#include "study/calibrate/fit_problem.h"

namespace linkstudy::calibration {

struct SeriesFigures {
  double rms = 0.0;  // of the weighted residuals
  double autocorrelation = 0.0;
  double effective = 0.0;  // samples
};

struct ResidualFigures {
  std::vector<SeriesFigures> series;
  double samples = 0.0;
  double effective = 0.0;
  double freedom = 0.0;   // nu; not positive: nothing can be said
  double variance = 0.0;  // s^2
  double quantile = 0.0;  // t of Student, two-sided, at the confidence
  double rise = 0.0;      // of S at the end of an interval: s^2 t^2
  bool is_usable() const { return freedom > 0.0; }
};

ResidualFigures compute_figures(const FitProblem& problem, const Vector& residuals,
                                std::size_t parameters, const FitOptions& options);

}  // namespace linkstudy::calibration

// Relative error of a signal against its reference, per component c, over the instants t of a
// window on the common grid:
//   error_max_c = max_t |x_c - r_c| / s_c,       s_c = max(max_t |r_c|, floor max_k max_t |r_k|)
//   error_rms_c = sqrt(mean_t (x_c - r_c)^2) / s_c,  s_c likewise with root mean squares of r,
// means over time by the trapezoidal rule (observers.h).
// The floor serves components that are nearly zero throughout: they are scaled by that fraction of
// the largest component. With scale = "vector" every s_c is max_t |r| (the root mean square of
// |r|), |r| the length of the vector. Where s_c is zero the error is 0 if nothing differs, else
// infinite. Both norms are always kept; match.norm says which one is judged.
#pragma once

#include <span>
#include <vector>

#include "study/config/study_input.h"
#include "study/metrics/reference_record.h"

namespace linkstudy {

// What errors are divided by, by component.
struct ErrorScales {
  std::vector<double> max;
  std::vector<double> rms;
};

// From the greatest absolute values and root mean squares of the components, and of the length of
// their vector.
ErrorScales make_scales(const MatchInput& match, std::vector<double> largest,
                        std::vector<double> root_mean, double longest, double root_mean_length);

double relative_error(double error, double scale);

class MatchError {
 public:
  // Throws InvalidPoint when the two runs share no instants in the window.
  MatchError(const MatchInput& match, const std::vector<Channel>& channels, const StepGrid& grid,
             const Series& reference, const StepGrid& reference_grid);

  // The comparison points into this object.
  Comparison make_comparison() const;

  // error_max of every component, then error_rms of every component.
  std::vector<double> reduce(const Comparison& comparison) const;

 private:
  void measure_reference(const MatchInput& match);

  std::vector<Channel> channels_;
  Sampling sampling_;
  double sign_;
  std::vector<double> reference_;  // (samples, channels)
  ErrorScales scales_;
};

}  // namespace linkstudy

#include "study/metrics/match_error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "study/metrics/common_grid.h"
#include "study/metrics/invalid_point.h"

namespace linkstudy {
namespace {

CommonGrid require_common_grid(const MatchInput& match, double step, double reference_step) {
  const std::optional<CommonGrid> grid = find_common_grid(step, reference_step);
  if (grid) return *grid;
  throw InvalidPoint(
      fmt::format("the steps {:.17g} s of the case and {:.17g} s of the reference have no common "
                  "time grid, so that '{}' cannot be compared; choose steps with a simple ratio",
                  step, reference_step, match.signal));
}

void raise_to_floor(std::vector<double>& scales, double floor) {
  const double least = floor * *std::ranges::max_element(scales);
  for (double& scale : scales) scale = std::max(scale, least);
}

double relative(double error, double scale) {
  return error == 0.0 ? 0.0 : error / scale;
}

}  // namespace

MatchError::MatchError(const MatchInput& match, const std::vector<Channel>& channels,
                       const StepGrid& grid, const Series& reference,
                       const StepGrid& reference_grid)
    : channels_(channels), sign_(match.reference_sign) {
  const CommonGrid common = require_common_grid(match, grid.h, reference_grid.h);
  sampling_ = sample_window(grid, common.stride, match.window);
  const std::size_t n = channels_.size();
  for (long step = sampling_.begin; step <= sampling_.end; step += common.stride) {
    const auto row = static_cast<std::size_t>(step / common.stride * common.reference_stride);
    if (row >= reference.rows()) {
      throw InvalidPoint(fmt::format("the window of '{}' reaches past the end of the reference run",
                                     match.signal));
    }
    const double* values = reference.values.data() + row * n;
    reference_.insert(reference_.end(), values, values + n);
  }
  if (reference_.empty()) {
    throw InvalidPoint(
        fmt::format("the window of '{}' holds no instant that both runs reach", match.signal));
  }
  measure_reference(match);
}

void MatchError::measure_reference(const MatchInput& match) {
  const std::size_t n = channels_.size();
  const std::size_t samples = reference_.size() / n;
  std::vector<double> squares(n, 0.0);
  max_scale_.assign(n, 0.0);
  double max_square = 0.0;
  double square = 0.0;
  for (std::size_t row = 0; row < samples; ++row) {
    const long step = sampling_.begin + static_cast<long>(row) * sampling_.stride;
    const double weight = time_weight(sampling_, {}, step);
    double length_square = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
      const double r = reference_[row * n + c];
      max_scale_[c] = std::max(max_scale_[c], std::abs(r));
      squares[c] += weight * r * r;
      length_square += r * r;
    }
    max_square = std::max(max_square, length_square);
    square += weight * length_square;
  }
  const double length = total_weight(sampling_, {});
  const auto mean_root = [&](double sum) { return std::sqrt(sum / length); };
  rms_scale_.clear();
  for (const double sum : squares) rms_scale_.push_back(mean_root(sum));
  if (match.scale == ErrorScale::vector) {
    max_scale_.assign(n, std::sqrt(max_square));
    rms_scale_.assign(n, mean_root(square));
  } else {
    raise_to_floor(max_scale_, match.floor);
    raise_to_floor(rms_scale_, match.floor);
  }
}

Comparison MatchError::make_comparison() const {
  Comparison comparison;
  comparison.channels = channels_;
  comparison.sampling = sampling_;
  comparison.reference = reference_.data();
  comparison.sign.assign(channels_.size(), sign_);
  return comparison;
}

std::vector<double> MatchError::reduce(const Comparison& comparison) const {
  std::vector<double> errors;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    errors.push_back(relative(comparison.max_error[c], max_scale_[c]));
  }
  const double length = total_weight(sampling_, {});
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    errors.push_back(relative(std::sqrt(comparison.square_error[c] / length), rms_scale_[c]));
  }
  return errors;
}

}  // namespace linkstudy

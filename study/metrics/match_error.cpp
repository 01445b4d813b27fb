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

}  // namespace

ErrorScales make_scales(const MatchInput& match, std::vector<double> largest,
                        std::vector<double> root_mean, double longest, double root_mean_length) {
  if (match.scale == ErrorScale::vector) {
    largest.assign(largest.size(), longest);
    root_mean.assign(root_mean.size(), root_mean_length);
  } else {
    raise_to_floor(largest, match.floor);
    raise_to_floor(root_mean, match.floor);
  }
  return {std::move(largest), std::move(root_mean)};
}

double relative_error(double error, double scale) {
  return error == 0.0 ? 0.0 : error / scale;
}

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
  std::vector<double> largest(n, 0.0);
  double max_square = 0.0;
  double square = 0.0;
  for (std::size_t row = 0; row < samples; ++row) {
    const long step = sampling_.begin + static_cast<long>(row) * sampling_.stride;
    const double weight = time_weight(sampling_, {}, step);
    double length_square = 0.0;
    for (std::size_t c = 0; c < n; ++c) {
      const double r = reference_[row * n + c];
      largest[c] = std::max(largest[c], std::abs(r));
      squares[c] += weight * r * r;
      length_square += r * r;
    }
    max_square = std::max(max_square, length_square);
    square += weight * length_square;
  }
  const double length = total_weight(sampling_, {});
  const auto mean_root = [&](double sum) { return std::sqrt(sum / length); };
  std::vector<double> root_mean;
  for (const double sum : squares) root_mean.push_back(mean_root(sum));
  scales_ = make_scales(match, std::move(largest), std::move(root_mean), std::sqrt(max_square),
                        mean_root(square));
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
    errors.push_back(relative_error(comparison.max_error[c], scales_.max[c]));
  }
  const double length = total_weight(sampling_, {});
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    errors.push_back(
        relative_error(std::sqrt(comparison.square_error[c] / length), scales_.rms[c]));
  }
  return errors;
}

}  // namespace linkstudy

#include "core/numerics/difference_jacobian.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace linkstudy {
namespace {

const double kIncrement = std::sqrt(std::numeric_limits<double>::epsilon());

}  // namespace

DifferenceJacobian::DifferenceJacobian(std::vector<double> floor, int passive)
    : floor_(std::move(floor)),
      active_(static_cast<int>(floor_.size()) - passive),
      by_unknown_(floor_.size(), std::vector<double>(floor_.size(), 0.0)),
      by_time_(floor_.size(), 0.0),
      moved_(floor_.size()) {}

void DifferenceJacobian::update(const Slopes& f, double t, const double* y, const double* slopes,
                                double span) {
  moved_.assign(y, y + floor_.size());
  for (std::size_t k = 0; k < static_cast<std::size_t>(active_); ++k) {
    // What is added is what the sum keeps of it.
    moved_[k] = y[k] + kIncrement * std::max(std::fabs(y[k]), floor_[k]);
    f(t, moved_.data(), by_unknown_[k].data());
    divide(slopes, moved_[k] - y[k], by_unknown_[k]);
    moved_[k] = y[k];
  }
  const double later = t + kIncrement * std::max(std::fabs(t), span);
  f(later, y, by_time_.data());
  divide(slopes, later - t, by_time_);
}

void DifferenceJacobian::divide(const double* slopes, double increment,
                                std::vector<double>& column) const {
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = (column[i] - slopes[i]) / increment;
}

}  // namespace linkstudy

#include "core/numerics/difference_jacobian.h"

#include <algorithm>
#include <cmath>

namespace linkstudy {
namespace {

constexpr double kIncrement = 1e-8;

}  // namespace

DifferenceJacobian::DifferenceJacobian(std::vector<double> floor, int passive)
    : floor_(std::move(floor)),
      active_(static_cast<int>(floor_.size()) - passive),
      by_unknown_(floor_.size(), std::vector<double>(floor_.size(), 0.0)),
      moved_(floor_.size()),
      before_(floor_.size()) {}

void DifferenceJacobian::update(const Slopes& f, double t, const double* y) {
  moved_.assign(y, y + floor_.size());
  for (std::size_t k = 0; k < static_cast<std::size_t>(active_); ++k) {
    // What the sums keep of the increment is what is divided by.
    const double increment = kIncrement * std::max(std::fabs(y[k]), floor_[k]);
    const double low = y[k] - increment, high = y[k] + increment;
    moved_[k] = low;
    f(t, moved_.data(), before_.data());
    moved_[k] = high;
    f(t, moved_.data(), by_unknown_[k].data());
    divide(high - low, by_unknown_[k]);
    moved_[k] = y[k];
  }
}

void DifferenceJacobian::divide(double way, std::vector<double>& column) const {
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = (column[i] - before_[i]) / way;
}

}  // namespace linkstudy

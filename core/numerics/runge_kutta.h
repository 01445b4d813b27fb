// Explicit Runge-Kutta methods with constant step over a tableau (A, b, c):
//   k_i = f(t + c_i h, y + h sum_j a_ij k_j),   y' = y + h sum_i b_i k_i.
// Knows no mechanics. The first slope is computed by the caller, who may look at it before the
// step is taken.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/real.h"

namespace linkstudy {

// Classical method of order 4 ([Urbas16] sec. 4).
struct ClassicalRungeKutta {
  static constexpr int stages = 4;
  static constexpr int order = 4;
  static constexpr std::array<std::array<double, 4>, 4> a{
      {{0, 0, 0, 0}, {0.5, 0, 0, 0}, {0, 0.5, 0, 0}, {0, 0, 1, 0}}};
  static constexpr std::array<double, 4> b{1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
  static constexpr std::array<double, 4> c{0.0, 0.5, 0.5, 1.0};
};

template <class Tableau, class Real>
class RungeKutta {
 public:
  explicit RungeKutta(std::size_t n) : n_(n), stage_(n) {
    for (auto& k : slopes_) k.assign(n, Real(0.0));
  }

  Real* first_slope() { return slopes_[0].data(); }

  // f(t, y, dy) writes dy; first_slope() must hold f(t, y).
  template <class F>
  void advance(double t, double h, Real* y, F&& f) {
    for (int i = 1; i < Tableau::stages; ++i) {
      const auto row = static_cast<std::size_t>(i);
      combine(Tableau::a[row], i, h, y, stage_.data());
      f(t + Tableau::c[row] * h, stage_.data(), slopes_[row].data());
    }
    combine(Tableau::b, Tableau::stages, h, y, y);
  }

 private:
  // out = y + h sum of the first `count` slopes, zero weights skipped
  void combine(const std::array<double, Tableau::stages>& weights, int count, double h,
               const Real* y, Real* out) const {
    for (std::size_t j = 0; j < n_; ++j) {
      Real x = y[j];
      for (int i = 0; i < count; ++i) {
        const auto s = static_cast<std::size_t>(i);
        if (weights[s] != 0.0) x = madd(Real(h * weights[s]), slopes_[s][j], x);
      }
      out[j] = x;
    }
  }

  std::size_t n_;
  std::vector<Real> stage_;
  std::array<std::vector<Real>, Tableau::stages> slopes_;
};

}  // namespace linkstudy

// Explicit Runge-Kutta methods with constant step over a tableau (A, b, c):
//   k_i = f(t + c_i h, y + h sum_j a_ij k_j),   y' = y + h sum_i b_i k_i.
// Knows no mechanics. The first slope is computed by the caller, who may look at it before the
// step is taken.
#pragma once

#include <array>
#include <cstddef>
#include <utility>
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
  explicit RungeKutta(std::size_t n) : stage_(n) {
    for (auto& k : slopes_) k.assign(n, Real(0.0));
  }

  Real* first_slope() { return slopes_[0].data(); }

  // f(t, y, dy) writes dy, and may set right what it knows of y; first_slope() must hold f(t, y).
  template <class F>
  void advance(Real t, Real h, Real* y, F&& f) {
    advance_stages(t, h, y, f, std::make_index_sequence<Tableau::stages - 1>());
    combine<Tableau::stages>(Tableau::b, h, y, y);
  }

 private:
  template <class F, std::size_t... Row>
  void advance_stages(Real t, Real h, const Real* y, F& f, std::index_sequence<Row...>) {
    (advance_stage<Row + 1>(t, h, y, f), ...);
  }

  template <std::size_t Row, class F>
  void advance_stage(Real t, Real h, const Real* y, F& f) {
    combine<Row>(Tableau::a[Row], h, y, stage_.data());
    f(t + Real(Tableau::c[Row]) * h, stage_.data(), slopes_[Row].data());
  }

  // out = y + h sum of the first slopes, zero weights skipped
  template <std::size_t Count>
  void combine(const std::array<double, Tableau::stages>& weights, Real h, const Real* y,
               Real* out) const {
    std::array<Real, Count> steps;
    for (std::size_t i = 0; i < Count; ++i) steps[i] = h * Real(weights[i]);
    for (std::size_t j = 0; j < stage_.size(); ++j) {
      Real x = y[j];
      for (std::size_t i = 0; i < Count; ++i) {
        if (weights[i] != 0.0) x = madd(steps[i], slopes_[i].data()[j], x);
      }
      out[j] = x;
    }
  }

  std::vector<Real> stage_;
  std::array<std::vector<Real>, Tableau::stages> slopes_{};
};

}  // namespace linkstudy

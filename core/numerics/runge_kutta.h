// Explicit Runge-Kutta methods with constant step over a tableau (A, b, c):
//   k_i = f(t + c_i h, y + h sum_j a_ij k_j),   y' = y + h sum_i b_i k_i.
// Knows no mechanics. The first slope is computed by the caller, who may look at it before the
// step is taken.
#pragma once

#include <array>
#include <cstddef>

#include "core/base/real.h"
#include "core/base/walk.h"

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

// Size: number of unknowns if the type tells it, or -1.
template <class Tableau, class Real, int Size = -1>
class RungeKutta {
 public:
  explicit RungeKutta(std::size_t n) {
    if constexpr (Size < 0) {
      stage_.resize(n);
      for (auto& k : slopes_) k.assign(n, Real(0.0));
    }
  }

  Real* first_slope() { return slopes_[0].data(); }

  // f(t, y, dy) writes dy; first_slope() must hold f(t, y).
  template <class F>
  void advance(Real t, Real h, Real* y, F&& f) {
    for_range(Index<1>(), Index<Tableau::stages>(), [&](auto i) {
      constexpr auto row = static_cast<std::size_t>(i());
      combine<i()>(Tableau::a[row], h, y, stage_.data());
      f(t + Real(Tableau::c[row]) * h, stage_.data(), slopes_[row].data());
    });
    combine<Tableau::stages>(Tableau::b, h, y, y);
  }

 private:
  // out = y + h sum of the first slopes, zero weights skipped
  template <int Count>
  void combine(const std::array<double, Tableau::stages>& weights, Real h, const Real* y,
               Real* out) const {
    std::array<Real, Tableau::stages> steps;
    for_range(Index<0>(), Index<Count>(), [&](auto i) { at(steps, i) = h * Real(at(weights, i)); });
    const auto add_slopes = [&](auto j) {
      Real x = y[j];
      for_range(Index<0>(), Index<Count>(), [&](auto i) {
        if (at(weights, i) != 0.0) x = madd(at(steps, i), at(slopes_[i()], j), x);
      });
      out[j] = x;
    };
    if constexpr (Size < 0) {
      for_range(0, static_cast<int>(stage_.size()), add_slopes);
    } else {
      for_range(Index<0>(), Index<Size>(), add_slopes);
    }
  }

  Array<Real, Size> stage_;
  std::array<Array<Real, Size>, Tableau::stages> slopes_{};
};

}  // namespace linkstudy

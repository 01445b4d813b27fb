// The method of Dormand and Prince, explicit, order 5(4), with the solution inside a step (Hairer,
// Norsett, Wanner, Solving Ordinary Differential Equations I, II.5 and II.6), over any scalar:
//   k_i = f(t + c_i h, y + h sum_j a_ij k_j),   y' = y + h sum_j a_7j k_j,   k_7 = f(t + h, y')
//   error = h sum_i e_i k_i
//   y(t + s h) = y + s (d_1 + r (d_2 + s (d_3 + r d_4))),   r = 1 - s,
//   d_1 = y' - y,   d_2 = h k_1 - d_1,   d_3 = d_1 - h k_7 - d_2,   d_4 = h sum_i w_i k_i
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/real.h"

namespace linkstudy {

struct DormandPrinceTableau {
  static constexpr std::size_t stages = 7;
  using Weights = std::array<double, stages>;
  static constexpr std::array<Weights, stages> a{
      {{},
       {1.0 / 5.0},
       {3.0 / 40.0, 9.0 / 40.0},
       {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
       {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
       {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0},
       {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0}}};
  static constexpr Weights c{0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0};
  static constexpr Weights e{71.0 / 57600.0,      0.0,          -71.0 / 16695.0, 71.0 / 1920.0,
                             -17253.0 / 339200.0, 22.0 / 525.0, -1.0 / 40.0};
  static constexpr Weights w{-12715105075.0 / 11282082432.0,  0.0,
                             87487479700.0 / 32700410799.0,   -10690763975.0 / 1880347072.0,
                             701980252875.0 / 199316789632.0, -1453857185.0 / 822651844.0,
                             69997945.0 / 29380423.0};
};

// One step. Allocates nothing once made.
template <class Real>
class DormandPrinceStep {
 public:
  static constexpr int evaluations = 6;  // k_1 is known
  static constexpr int powers = 4;       // d_1 to d_4

  explicit DormandPrinceStep(std::size_t n)
      : begin_(n, Real(0.0)), end_(n, Real(0.0)), stage_(n, Real(0.0)) {
    for (auto& k : slopes_) k.assign(n, Real(0.0));
    for (auto& d : inside_) d.assign(n, Real(0.0));
  }

  std::size_t size() const { return begin_.size(); }
  // y and k_1, to be set; then y', k_7 and d_1 to d_4.
  Real* begin() { return begin_.data(); }
  Real* first_slope() { return slopes_.front().data(); }
  Real* end() { return end_.data(); }
  Real* last_slope() { return slopes_.back().data(); }
  Real* inside(int power) { return inside_[static_cast<std::size_t>(power)].data(); }

  // f(t, y, dy) writes dy, and may change y, which is a copy.
  template <class F>
  void advance(Real t, Real h, F&& f) {
    advance_stages(t, h, f, std::make_index_sequence<Tableau::stages - 2>());
    combine<Tableau::stages - 1>(Tableau::a.back(), h, end_.data());
    for (std::size_t i = 0; i < size(); ++i) stage_.data()[i] = end_.data()[i];
    f(t + h, stage_.data(), last_slope());
    prepare_inside(h);
  }

  // The largest error of the first `count` unknowns over what allowed(i, |y_i|) says; infinite
  // where one is no number.
  template <class Allowed>
  Real error(std::size_t count, Real h, Allowed&& allowed) const {
    Real worst(0.0), sum(0.0);
    for (std::size_t i = 0; i < count; ++i) {
      const Real estimate = weighted(Tableau::e, i);
      const Real part = abs(h * estimate) / allowed(i, abs(begin_.data()[i]));
      sum = sum + part;
      worst = max(worst, part);
    }
    return select(is_finite(sum), worst, Real(std::numeric_limits<double>::infinity()));
  }

  // The solution at the part s of the step, 0 <= s <= 1.
  void write_inside(Real s, Real* out) const {
    const Real r = Real(1.0) - s;
    for (std::size_t i = 0; i < size(); ++i) {
      Real x = madd(r, inside_[3].data()[i], inside_[2].data()[i]);
      x = madd(s, x, inside_[1].data()[i]);
      x = madd(r, x, inside_[0].data()[i]);
      out[i] = madd(s, x, begin_.data()[i]);
    }
  }

 private:
  using Tableau = DormandPrinceTableau;

  template <class F, std::size_t... Row>
  void advance_stages(Real t, Real h, F& f, std::index_sequence<Row...>) {
    (advance_stage<Row + 1>(t, h, f), ...);
  }

  template <std::size_t Row, class F>
  void advance_stage(Real t, Real h, F& f) {
    combine<Row>(Tableau::a[Row], h, stage_.data());
    f(t + Real(Tableau::c[Row]) * h, stage_.data(), slopes_[Row].data());
  }

  // out = y + h sum of the first slopes, zero weights skipped
  template <std::size_t Count>
  void combine(const Tableau::Weights& weights, Real h, Real* out) const {
    std::array<Real, Count> steps;
    for (std::size_t i = 0; i < Count; ++i) steps[i] = h * Real(weights[i]);
    for (std::size_t j = 0; j < size(); ++j) {
      Real x = begin_.data()[j];
      for (std::size_t i = 0; i < Count; ++i) {
        if (weights[i] != 0.0) x = madd(steps[i], slopes_[i].data()[j], x);
      }
      out[j] = x;
    }
  }

  Real weighted(const Tableau::Weights& weights, std::size_t j) const {
    Real x = Real(weights[0]) * slopes_[0].data()[j];
    for (std::size_t i = 1; i < Tableau::stages; ++i) {
      if (weights[i] != 0.0) x = madd(Real(weights[i]), slopes_[i].data()[j], x);
    }
    return x;
  }

  void prepare_inside(Real h) {
    for (std::size_t j = 0; j < size(); ++j) {
      const Real change = end_.data()[j] - begin_.data()[j];
      const Real bend = msub(h, slopes_.front().data()[j], change);
      inside_[0].data()[j] = change;
      inside_[1].data()[j] = bend;
      inside_[2].data()[j] = nmadd(h, slopes_.back().data()[j], change) - bend;
      inside_[3].data()[j] = h * weighted(Tableau::w, j);
    }
  }

  std::vector<Real> begin_, end_, stage_;
  std::array<std::vector<Real>, Tableau::stages> slopes_{};
  std::array<std::vector<Real>, powers> inside_{};
};

}  // namespace linkstudy

// One step of the classical Runge-Kutta method for tests of single laws: dy = f(t, y).
#pragma once

#include <array>
#include <cstddef>

#include "core/numerics/runge_kutta.h"

namespace linkstudy::testing {

// f(t, y, dy) writes dy; y and dy are pointers to N numbers.
template <std::size_t N, class F>
void fixed_step(double t, double h, std::array<double, N>& y, F&& f) {
  RungeKutta<ClassicalRungeKutta, double> method(N);
  f(t, y.data(), method.first_slope());
  method.advance(t, h, y.data(), f);
}

}  // namespace linkstudy::testing

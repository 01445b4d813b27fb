// Derivatives of a function at a place by central differences of sixth order, h apart.
#pragma once

namespace linkstudy::testing {

template <class F>
double slope(F f, double x, double h = 4e-3) {
  return (45 * (f(x + h) - f(x - h)) - 9 * (f(x + 2 * h) - f(x - 2 * h)) +
          (f(x + 3 * h) - f(x - 3 * h))) /
         (60 * h);
}

template <class F>
double curvature(F f, double x, double h = 1.5e-2) {
  return (-490 * f(x) + 270 * (f(x + h) + f(x - h)) - 27 * (f(x + 2 * h) + f(x - 2 * h)) +
          2 * (f(x + 3 * h) + f(x - 3 * h))) /
         (180 * h * h);
}

}  // namespace linkstudy::testing

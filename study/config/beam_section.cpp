#include "study/config/beam_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace linkstudy {
namespace {

double torsion_of_rectangle(double longer, double shorter) {
  // tanh x = 1 - 2 / (exp(2 x) + 1), and the ones add up to 31 zeta(5) / 32. What is left falls as
  // exp(-pi k): terms after k = 11 are below the last bit.
  double sum = 31.0 / 32.0 * std::riemann_zeta(5.0);
  for (int k = 1; k <= 11; k += 2) {
    sum -= 2.0 / (std::exp(k * std::numbers::pi * longer / shorter) + 1.0) / std::pow(k, 5);
  }
  const double edges = 64.0 * shorter / (std::pow(std::numbers::pi, 5) * longer) * sum;
  return longer * std::pow(shorter, 3) * (1.0 / 3.0 - edges);
}

}  // namespace

BeamSection circle_section(double diameter) {
  return tube_section(diameter, 0.0);
}

BeamSection tube_section(double outer_diameter, double inner_diameter) {
  const double moment =
      std::numbers::pi / 64.0 * (std::pow(outer_diameter, 4) - std::pow(inner_diameter, 4));
  return {moment, moment, 2.0 * moment};
}

BeamSection rectangle_section(double along_y, double along_z) {
  const double longer = std::max(along_y, along_z);
  const double shorter = std::min(along_y, along_z);
  return {along_y * std::pow(along_z, 3) / 12.0, along_z * std::pow(along_y, 3) / 12.0,
          torsion_of_rectangle(longer, shorter)};
}

}  // namespace linkstudy

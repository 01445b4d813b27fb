#include "core/laws/normal_contact.h"

#include <boost/math/special_functions/log1p.hpp>
#include <boost/math/tools/roots.hpp>
#include <cmath>
#include <cstdint>

namespace linkstudy {

double contact_damping(ContactLaw law, double restitution) {
  const double e = restitution;
  switch (law) {
    case ContactLaw::flores:
      return 8.0 * (1.0 - e) / (5.0 * e);
    case ContactLaw::hunt_crossley:
      return 1.5 * (1.0 - e);
    case ContactLaw::lankarani_nikravesh:
      break;
  }
  return 0.75 * (1.0 - e * e);
}

// With t = -ln(1 - D e) the equation is t + exp(-t) - 1 = D - ln(1 + D) =: loss, and t lies between
// loss and loss + 1. Small D lose digits in it and have a series: e = 1 - 2/3 D + 4/9 D^2 - ...
double contact_restitution(double damping) {
  if (std::isinf(damping)) return 0.0;
  if (damping < 1e-4) return 1.0 - damping * (2.0 / 3.0 - damping * 4.0 / 9.0);
  const double loss = -boost::math::log1pmx(damping);
  const auto equation = [&](double t) { return t + std::expm1(-t) - loss; };
  std::uintmax_t iterations = 200;
  const auto [low, high] = boost::math::tools::toms748_solve(
      equation, loss, loss + 1.0, boost::math::tools::eps_tolerance<double>(52), iterations);
  return -std::expm1(-0.5 * (low + high)) / damping;
}

double hertz_stiffness(const ContactBody& bearing, const ContactBody& journal) {
  const auto compliance = [](const ContactBody& b) {
    return (1.0 - b.poisson * b.poisson) / b.young;
  };
  const double radius =
      bearing.radius * journal.radius / (bearing.radius - journal.radius);  // of equal spheres
  return 4.0 / (3.0 * (compliance(bearing) + compliance(journal))) * std::sqrt(radius);
}

}  // namespace linkstudy

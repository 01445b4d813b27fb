#include "core/simulation/step_limit.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/simulation/looks.h"

namespace linkstudy {
namespace {

// Takes n numbers of a row.
template <class Numbers = std::vector<double>>
Numbers take(const double*& row, int n) {
  Numbers numbers(row, row + n);
  row += n;
  return numbers;
}

}  // namespace

StepLimit worse(const StepLimit& limit, const Spectrum& spectrum, double t) {
  StepLimit worst = limit;
  worst.omega_max = std::fmax(limit.omega_max, spectrum.omega_max);
  const bool unknown = std::isnan(spectrum.step_limit) && std::isinf(limit.seconds);
  if (spectrum.step_limit < limit.seconds || std::isnan(limit.seconds) || unknown) {
    worst.seconds = spectrum.step_limit;
    worst.t = t;
  }
  return worst;
}

StepLimit find_step_limit(const Mechanism& m, const Parameters<double>& p,
                          const std::vector<double>& looks, bool evenly, const LaneEnd& end,
                          const StepLimit& known) {
  StepLimit worst = known;
  const Model model{m, p, make_state<double>(m), {}};
  for (int i = evenly ? 0 : kEvenLooks; i < look_count(m); ++i) {
    const double* row = looks.data() + i * look_size(m);
    State<double> s;
    s.t = *row++;
    if (std::isnan(s.t)) continue;
    s.q = take<decltype(s.q)>(row, m.nq);
    s.v = take<decltype(s.v)>(row, m.nv);
    s.z = take<decltype(s.z)>(row, m.nz);
    row += work_count(m);
    const std::vector<double> approach = take(row, static_cast<int>(m.contacts.size()));
    worst = worse(worst, compute_spectrum(model, s, approach), s.t);
  }
  if (end.bristle_rate > 0.0) {
    worst = worse(worst, spectrum_of({-end.bristle_rate}), end.bristle_time);
  }
  return worst;
}

std::string describe_past_limit(double h, const StepLimit& limit) {
  char text[160];
  std::snprintf(text, sizeof text,
                "simulation.step = %.4g s is past the stability limit %.4g s of RK4 at t = %.4g s",
                h, limit.seconds, limit.t);
  return text;
}

}  // namespace linkstudy

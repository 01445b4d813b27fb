#include "study/report/modes_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/dynamics/static_balance.h"

namespace linkstudy {
namespace {

constexpr std::size_t kMostNamed = 3;
constexpr double kLeastPart = 0.05;  // of the largest

double hertz(const Mode& mode) {
  return mode.frequency / (2.0 * std::numbers::pi);
}

// Coordinates by how far they swing; of real shapes with their sign.
std::string shape_text(const Mechanism& m, const Mode& mode) {
  std::vector<int> order(static_cast<std::size_t>(m.nv));
  for (int k = 0; k < m.nv; ++k) order[static_cast<std::size_t>(k)] = k;
  std::ranges::stable_sort(
      order, [&](int a, int b) { return std::abs(mode.shape[a]) > std::abs(mode.shape[b]); });
  std::string text;
  for (std::size_t i = 0; i < std::min(order.size(), kMostNamed); ++i) {
    const std::complex<double> x = mode.shape[order[i]];
    if (std::abs(x) < kLeastPart * std::abs(mode.shape[order[0]])) break;
    const double phase = std::arg(x) * 180.0 / std::numbers::pi;
    const bool is_real = std::abs(x.imag()) <= 0.01 * std::abs(x);
    text +=
        fmt::format("{}{} {:.3g}", text.empty() ? "" : ", ",
                    velocity_name(m, VelocityIndex(order[i])), is_real ? x.real() : std::abs(x));
    if (!is_real) text += fmt::format(" at {:.0f} deg", phase);
  }
  return text;
}

}  // namespace

Table modes_table(const Mechanism& m, const std::vector<Mode>& modes) {
  TableOf<Mode> table("modes", "response", modes);
  table.add("frequency", "Hz", "|eigenvalue| / 2 pi; 0: nothing holds the motion", hertz, "{:.6g}");
  table.add(
      "damping_ratio", "", "1 and -1 do not swing", [](const Mode& mode) { return mode.damping; },
      "{:.4g}");
  table.add(
      "decay", "1/s", "rate at which the mode dies away",
      [](const Mode& mode) { return 0.0 - mode.eigenvalue.real(); }, "{:.6g}");
  for (const VelocityIndex v : indices_of(m.velocities)) {
    const bool slides = m.velocities[v].kind == VelocityKind::translation;
    const int k = v.value();
    table.add(
        velocity_name(m, v), slides ? "m" : "rad", "amplitude, the largest is 1",
        [k](const Mode& mode) { return std::abs(mode.shape[k]); }, "{:.4g}");
    table.add(
        velocity_name(m, v) + ".phase", "rad", "of the amplitude",
        [k](const Mode& mode) { return std::arg(mode.shape[k]); }, "{:.4g}");
  }
  return table.take();
}

std::string modes_text(const Mechanism& m, const std::vector<Mode>& modes, int count) {
  std::string text = "\nmode     frequency Hz  damping ratio  swings most\n";
  const auto shown = std::min(modes.size(), static_cast<std::size_t>(std::max(count, 0)));
  for (std::size_t i = 0; i < shown; ++i) {
    text += fmt::format("{:>4} {:>16.6g} {:>14.4g}  {}\n", i + 1, hertz(modes[i]), modes[i].damping,
                        shape_text(m, modes[i]));
  }
  if (modes.empty()) text += "none: nothing can move\n";
  return text;
}

std::string modes_json(const Mechanism& m, const std::vector<Mode>& modes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Mode& mode : modes) {
    nlohmann::ordered_json shape = nlohmann::ordered_json::object();
    for (const VelocityIndex k : indices_of(m.velocities)) {
      const std::complex<double> x = mode.shape[k.value()];
      shape[velocity_name(m, k)] = {x.real(), x.imag()};
    }
    all.push_back({{"frequency", hertz(mode)},
                   {"damping_ratio", mode.damping},
                   {"decay", 0.0 - mode.eigenvalue.real()},
                   {"shape", shape}});
  }
  return all.dump();
}

}  // namespace linkstudy

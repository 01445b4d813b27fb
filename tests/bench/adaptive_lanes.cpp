// Cases per second of adaptive runs with contacts located: the RSUP linkage with planar clearance,
// load sets slow and fast, and fast without friction, masses and clearances varied. Runs alone by
// the general loop and by written code against runs in the lanes of a pack, in one process, side by
// side; medians of ratios. The same contacts in all of them, or it fails.
//
// usage: bench_adaptive_lanes [MINIMUM_RATIO]   exits 1 if lanes with written code are not so many
// times as fast as the general loop alone in one of the sets, 77 if this machine cannot have any
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "core/simulation/simulate.h"
#include "tests/bench/engine_runs.h"
#include "tests/mechanisms/rsup.h"

namespace linkstudy::testing {
namespace {

constexpr double kEnd = 1.0, kGrid = 1e-3;  // s
constexpr int kCases = 16, kChunks = 5;

struct AdaptiveCase {
  Model model;
  Observers observers;
};

Linkage loose_rsup(const Rsup& set, int i) {
  Rsup other = set;
  other.radial *= 1.0 - 0.01 * i;
  Linkage linkage = rsup(other);
  for (Link& link : linkage.links) {
    link.mass *= 1.0 + 0.005 * i;
    link.inertia *= 1.0 + 0.005 * i;
  }
  for (Closure& c : linkage.closures)
    if (c.clearance.friction) c.clearance.friction->v_d = c.clearance.friction->v_s;
  return linkage;
}

// As a study watches: the largest contact force at every instant of the grid, and the contacts.
std::vector<AdaptiveCase> make_cases(const Rsup& set) {
  std::vector<AdaptiveCase> cases;
  for (int i = 0; i < kCases; ++i) {
    AdaptiveCase& made = cases.emplace_back(AdaptiveCase{compile(loose_rsup(set, i)), {}});
    ChannelReduction peak;
    peak.channel =
        find_channels(list_channels(made.model.mechanism), "closure.R.normal_force.0")[0];
    peak.sampling = {0, std::lround(kEnd / kGrid), 1};
    made.observers.reductions = {peak};
    made.observers.contacts.most = 1000;
  }
  return cases;
}

struct Measured {
  double seconds;
  long contacts = 0;
};

Measured run(const Rsup& set, const SimdLevel& level) {
  std::vector<AdaptiveCase> made = make_cases(set);
  SimulationOptions options;
  options.end_time = kEnd;
  options.step = kGrid;
  options.integrator = Integrator::adaptive;
  options.relative_tolerance = 1e-6;
  options.absolute_tolerance = 1e-8;
  std::vector<BatchCase> cases;
  for (AdaptiveCase& c : made) {
    cases.push_back({&c.model.parameters, &c.model.start, &c.observers, {}});
  }
  Measured measured{
      seconds([&] { simulate_batch(made.front().model.mechanism, options, cases, {}, level); })};
  for (const BatchCase& c : cases) {
    if (c.outcome.cause != Cause::ok) throw std::runtime_error(c.outcome.message);
    measured.contacts += c.outcome.contacts;
  }
  return measured;
}

struct Row {
  SimdLevel level;
  double best = std::numeric_limits<double>::infinity();  // s of all cases
  std::vector<double> ratios = {};                        // to the general loop alone

  double ratio() const {
    std::vector<double> sorted = ratios;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
  }
};

// The median ratio of lanes with written code; of a guard once, and nothing else.
double measure(const char* name, const Rsup& set, bool is_guard) {
  SimdLevel level = simd_level();
  const SimdLevel alone{level.isa, 1, Kernels::general};
  level.kernels = Kernels::written;
  std::vector<Row> rows{{alone},
                        {{level.isa, 1, Kernels::written}},
                        {{level.isa, level.lanes, Kernels::general}},
                        {level}};
  if (is_guard) rows = {{level}};
  const Measured first = run(set, alone);
  const long contacts = first.contacts;
  for (int chunk = 0; chunk < (is_guard ? 1 : kChunks); ++chunk) {
    double before = is_guard ? first.seconds : run(set, alone).seconds;
    for (Row& row : rows) {
      const Measured own = run(set, row.level);
      const double after = run(set, alone).seconds;
      if (own.contacts != contacts) throw std::runtime_error("other contacts");
      row.best = std::min(row.best, own.seconds);
      row.ratios.push_back(0.5 * (before + after) / own.seconds);
      before = after;
    }
  }
  for (const Row& row : rows) {
    fmt::print("{:<14}{:<10}{:>6}  {:<8}{:>10.1f}{:>10.1f}{:>10}\n", name, name_of(row.level.isa),
               row.level.lanes, name_of(row.level.kernels), kCases / row.best, row.ratio(),
               contacts);
  }
  return rows.back().ratio();
}

}  // namespace
}  // namespace linkstudy::testing

int main(int argc, char** argv) {
  using namespace linkstudy::testing;
  using linkstudy::ClearanceKind;
  if (!linkstudy::machine_has(linkstudy::InstructionSet::avx2)) return 77;
  fmt::print("cases of {} s per second, one thread, g++ {}\n", kEnd, __VERSION__);
  fmt::print("{:<14}{:<10}{:>6}  {:<8}{:>10}{:>10}{:>10}\n", "set", "", "lanes", "loop", "cases/s",
             "ratio", "contacts");
  const auto planar = ClearanceKind::planar;
  const bool is_guard = argc > 1;
  const double slow = measure("slow", {.clearance = planar}, is_guard);
  const double fast = measure("fast", {.clearance = planar, .at_speed = kFast}, is_guard);
  const double smooth = measure(
      "frictionless", {.clearance = planar, .friction = false, .at_speed = kFast}, is_guard);
  return !is_guard || std::min({slow, fast, smooth}) >= std::atof(argv[1]) ? 0 : 1;
}

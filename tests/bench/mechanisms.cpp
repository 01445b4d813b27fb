// The written steps of every shipped mechanism beside its own general loop, in all lanes of the
// widest instruction set, two packs side by side where that gains: medians of ratios taken in turn
// in one process. Whole runs are timed, with energy ledger and the first closure's force compared
// with a reference at every step.
//
// usage: bench_mechanisms [MINIMUM_RATIO]   exits 1 if one is below that, 77 if this machine has no
// written steps
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "core/simulation/written_steps.h"
#include "core/topology/linkage_words.h"
#include "tests/bench/engine_runs.h"
#include "tests/pack/shipped_models.h"

namespace linkstudy::testing {
namespace {

constexpr double kLongestStep = 1e-5;  // s, stable for all of them
constexpr int kPairs = 11;

struct Found {
  double general_ns = std::numeric_limits<double>::infinity(), written_ns = general_ns;
  double ratio = 0.0;
  double to_write_ms = 0.0;
  int lanes = 0;
};

Found measure(const Model& model, double step, const SimdLevel& level, int packs) {
  const long steps = std::max(200L, 12000L / (1 + model.mechanism.nv));
  EngineRun general(model, level, step, steps, false);
  const double before = written_report().seconds;
  EngineRun written(model, level, step, steps, true, packs);
  Found found;
  found.to_write_ms = 1e3 * (written_report().seconds - before);
  found.lanes = written.lanes();
  if (!written.is_written()) return found;
  std::vector<double> ratios;
  for (int i = 0; i < kPairs; ++i) {
    const double g = general.run(), w = written.run();
    found.general_ns = std::min(found.general_ns, 1e9 * g);
    found.written_ns = std::min(found.written_ns, 1e9 * w);
    ratios.push_back(g / w);
  }
  std::nth_element(ratios.begin(), ratios.begin() + kPairs / 2, ratios.end());
  found.ratio = ratios[kPairs / 2];
  return found;
}

// The better of one pack and two.
Found measure(const Model& model, double step, const SimdLevel& level) {
  Found best = measure(model, step, level, 1);
  if (packs_beside(level) > 1) {
    const Found two = measure(model, step, level, 2);
    if (two.ratio > best.ratio) best = two;
  }
  return best;
}

int run(double least_wanted) {
  SimdLevel level = simd_level();
  level.kernels = Kernels::written;
  if (!why_not_written(level).empty()) return 77;
  fmt::print("ns per right-hand side and case, one thread, {}, g++ {}\n", name_of(level.isa),
             __VERSION__);
  fmt::print("{:<26}{:<9}{:>6}{:>10}{:>10}{:>7}{:>8}{:>14}\n", "mechanism", "closures", "lanes",
             "general", "written", "lanes", "ratio", "to write, ms");
  double least = std::numeric_limits<double>::infinity();
  for (const std::string& path : shipped_models()) {
    for (const ClosureModel closures : {ClosureModel::cut, ClosureModel::sde}) {
      ModelInput input = read_model(path);
      if (input.linkage.closures.empty()) continue;
      const bool changes = set_closures(closures, input.linkage);
      if (closures == ClosureModel::sde && !changes) continue;
      const Preparation p = prepare(input.linkage, input.options);
      const Found f = measure(p.model, std::min(input.options.step, kLongestStep), level);
      least = std::min(least, f.ratio);
      fmt::print("{:<26}{:<9}{:>6}{:>10.1f}{:>10.1f}{:>7}{:>8.2f}{:>14.1f}\n",
                 std::filesystem::path(path).stem().string(),
                 changes ? std::string(name_of(closures)) : "loose", level.lanes, f.general_ns,
                 f.written_ns, f.lanes, f.ratio, f.to_write_ms);
    }
  }
  fmt::print("least ratio {:.2f}\n", least);
  return least >= least_wanted ? 0 : 1;
}

}  // namespace
}  // namespace linkstudy::testing

int main(int argc, char** argv) {
  return linkstudy::testing::run(argc > 1 ? std::atof(argv[1]) : 0.0);
}

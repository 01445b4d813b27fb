// Cost of one right-hand side of the RSRRP linkage (set R1), per case: runs of the engine on every
// instruction set and lane count of this machine, by the general loop and by the steps that the
// program writes for this structure, against the transcription of the trace formulas that the tests
// keep as oracle. How ratios are taken: engine_runs.h.
//
// usage: bench_step_loop [MINIMUM_RATIO]   exits 1 if the written steps of all lanes are slower
// than that for the spring or the cut joint, 77 if this machine cannot have any
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "core/flexible/rigid_finite_elements.h"
#include "tests/bench/engine_runs.h"
#include "tests/mechanisms/rsup.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing {
namespace {

constexpr double kStep = 1e-5;  // s, stable for all of them
constexpr long kSteps = 2000;

std::vector<EngineRow> rows_of_all_sets(const Model& model) {
  std::vector<EngineRow> rows;
  for (const auto isa : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!machine_has(isa)) continue;
    for (EngineRow& row : engine_rows(model, isa, kStep, kSteps)) rows.push_back(std::move(row));
  }
  return rows;
}

// Seconds per right-hand side of the trace formulas, in about `seconds_wanted`.
class Oracle {
 public:
  explicit Oracle(const Linkage& linkage)
      : trace_(make_trace_model(linkage)), state_(start_state(trace_)) {
    calls_ = std::clamp(static_cast<int>(5e-4 / run(3)), 1, 200);
  }
  double run() { return run(calls_); }

 private:
  double run(int calls) {
    return seconds([&] {
             for (int i = 0; i < calls; ++i) {
               state_.q[0] = 1e-9 * i;
               sink_ = sink_ + oracle_acceleration(trace_, 0.1, state_.q, state_.v).qdd[0];
             }
           }) /
           calls;
  }

  TraceModel trace_;
  OracleState state_;
  int calls_ = 1;
  volatile double sink_ = 0.0;
};

// The best ratio of written steps; 0 where there are none.
double measure(const char* name, const Linkage& linkage) {
  const Model model = compile(linkage);
  Oracle oracle(linkage);
  std::vector<EngineRow> rows = rows_of_all_sets(model);
  const double least = measure_beside([&] { return oracle.run(); }, rows);
  print_rows(name, "trace", least, rows);
  double best = 0.0;
  for (const EngineRow& r : rows)
    if (r.load.is_written()) best = std::max(best, r.ratio());
  return best;
}

// RSRRP with its coupler as six rigid finite elements: 4 + 3 * 5 freedoms.
Linkage flexible_rsrrp() {
  Linkage linkage = rsrrp_test_vector(ClosureModel::sde);
  Link& coupler = *std::find_if(linkage.links.begin(), linkage.links.end(),
                                [](const Link& link) { return link.name == "coupler"; });
  coupler.flexible = steel_rod(5);
  return expand_flexible_links(linkage);
}

}  // namespace
}  // namespace linkstudy::testing

int main(int argc, char** argv) {
  using namespace linkstudy::testing;
  using linkstudy::ClosureModel;
  print_heading();
  const double spring = measure("spring", rsrrp_test_vector(ClosureModel::sde));
  const double cut = measure("cut joint", rsrrp_test_vector(ClosureModel::cut));
  linkstudy::Linkage revolute = linkstudy::testing::rsrrp_revolute();
  revolute.closures[0].model = ClosureModel::sde;
  measure("revolute", revolute);
  measure("clearance", rsup({.clearance = linkstudy::ClearanceKind::planar}));
  measure("flexible", flexible_rsrrp());
  if (argc < 2) return 0;
  if (spring == 0.0) return 77;
  return std::min(spring, cut) >= std::atof(argv[1]) ? 0 : 1;
}

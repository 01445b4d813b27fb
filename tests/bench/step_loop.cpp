// Cost of one right-hand side of the RSRRP linkage (set R1): the engine against the transcription
// of the trace formulas that the tests keep as oracle. Both in one process, in interleaved short
// chunks, the minimum of many; a ratio, never a time, is what may be compared between machines.
//
// usage: bench_step_loop [MINIMUM_SPRING MINIMUM_CUT]   exits 1 if a ratio is below its minimum
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "core/dynamics/equations_of_motion.h"
#include "core/model/compile.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing {
namespace {

using Clock = std::chrono::steady_clock;

template <class F>
double seconds_per_call(int calls, F&& f) {
  const auto begin = Clock::now();
  for (int i = 0; i < calls; ++i) f(1e-9 * i);
  return std::chrono::duration<double>(Clock::now() - begin).count() / calls;
}

// Trace formulas over engine.
double measure(ClosureModel closure) {
  const Linkage linkage = rsrrp_test_vector(closure);
  Model model = compile(linkage);
  Workspace<double> w = make_workspace<double>(model.mechanism);
  const TraceModel trace = make_trace_model(linkage);
  OracleState state = start_state(trace);
  double engine = std::numeric_limits<double>::infinity();
  double oracle = engine;
  volatile double sink = 0.0;
  for (int chunk = 0; chunk < 200; ++chunk) {
    engine = std::min(engine, seconds_per_call(2000, [&](double q0) {
                        model.start.q[0] = q0;
                        evaluate(model.mechanism, model.parameters, 0.1, model.start.q.data(),
                                 model.start.v.data(), w);
                        sink = sink + w.qdd[0];
                      }));
    oracle = std::min(oracle, seconds_per_call(100, [&](double q0) {
                        state.q[0] = q0;
                        sink = sink + oracle_acceleration(trace, 0.1, state.q, state.v).qdd[0];
                      }));
  }
  fmt::print("{:<12}{:>10.0f}{:>14.0f}{:>10.1f}\n",
             closure == ClosureModel::cut ? "cut joint" : "spring", engine * 1e9, oracle * 1e9,
             oracle / engine);
  return oracle / engine;
}

}  // namespace
}  // namespace linkstudy::testing

int main(int argc, char** argv) {
  fmt::print("RSRRP, ns per right-hand side, one thread, {}\n", __VERSION__);
  fmt::print("{:<12}{:>10}{:>14}{:>10}\n", "closure", "engine", "trace", "ratio");
  const double spring = linkstudy::testing::measure(linkstudy::ClosureModel::sde);
  const double cut = linkstudy::testing::measure(linkstudy::ClosureModel::cut);
  if (argc < 3) return 0;
  return spring >= std::atof(argv[1]) && cut >= std::atof(argv[2]) ? 0 : 1;
}

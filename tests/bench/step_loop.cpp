// Cost of one right-hand side of the RSRRP linkage (set R1), per case: runs of the engine on every
// instruction set and lane count of this machine, with the step loop for any mechanism and with the
// one made for this structure, against the transcription of the trace formulas that the tests keep
// as oracle. All in one process, in interleaved short chunks, the minimum of many; a ratio, never a
// time, is what may be compared between machines. Runs are whole: steps, observers and all.
//
// usage: bench_step_loop [MINIMUM_RATIO]   exits 1 if one lane of the set in use is slower than
// that
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <limits>

#include "core/model/compile.h"
#include "core/simulation/kernels.h"
#include "core/simulation/prepare.h"
#include "core/simulation/simulate.h"
#include "study/specialize/fixed_kernels.h"
#include "tests/mechanisms/rsrrp.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing {
namespace {

using Clock = std::chrono::steady_clock;

template <class F>
double seconds(F&& f) {
  const auto begin = Clock::now();
  f();
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

constexpr long kSteps = 1000;
constexpr int kChunks = 40;

Cause never(void*, double) {
  return Cause::ok;
}

// A study's run: closure force compared with a stored reference at every step.
class Load {
 public:
  Load(const Model& model, int lanes) : model_(model), lanes_(lanes) {
    y_ = model.start.q;
    y_.insert(y_.end(), model.start.v.begin(), model.start.v.end());
    y_.insert(y_.end(), 2, 0.0);
    Comparison<double> c;
    c.channels = find_channels(list_channels(model.mechanism), "closure.S.force");
    c.sampling = {0, kSteps, 1};
    reference_.assign(3 * (kSteps + 1), 1.0);
    c.reference = reference_.data();
    c.sign.assign(3, 1.0);
    c.max_error.assign(3, 0.0);
    c.square_error.assign(3, 0.0);
    observers_.resize(static_cast<std::size_t>(lanes));
    for (auto& o : observers_) o.comparisons = {c};
    ends_.resize(observers_.size());
    finals_.assign(observers_.size(), y_);
    for (std::size_t i = 0; i < observers_.size(); ++i) {
      cases_.push_back(
          {&model_.parameters, y_.data(), finals_[i].data(), &observers_[i], nullptr, &ends_[i]});
    }
  }

  // Seconds per right-hand side and case.
  double run(const Kernel& kernel) {
    const KernelRun setting{0.0, 1e-4, kSteps, 100, 1.0, never, nullptr};
    const double spent =
        seconds([&] { kernel.run(model_.mechanism, setting, cases_.data(), lanes_); });
    return spent / (4.0 * kSteps * lanes_);
  }

 private:
  const Model& model_;
  int lanes_;
  std::vector<double> y_, reference_;
  std::vector<Observers<double>> observers_;
  std::vector<LaneEnd> ends_;
  std::vector<std::vector<double>> finals_;
  std::vector<LaneCase> cases_;
};

struct Row {
  const Kernel* kernel;
  Load load;
  bool fixed;
  double best = std::numeric_limits<double>::infinity();
};

std::vector<Row> make_rows(const Model& model) {
  std::vector<Row> rows;
  for (const auto isa : {InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!machine_has(isa)) continue;
    const SimdLevel level = choose_simd_level(std::string(name_of(isa)).c_str(), nullptr);
    for (const int lanes : {1, level.lanes}) {
      for (const bool general : {true, false}) {
        const Kernel& kernel = find_kernel(model.mechanism, isa, lanes, general);
        if (!general && kernel.serves == nullptr) continue;
        rows.push_back({&kernel, Load(model, lanes), !general});
      }
    }
  }
  return rows;
}

// The best ratio of one lane.
double measure(const char* name, ClosureModel closure) {
  const Linkage linkage = rsrrp_test_vector(closure);
  const Model model = compile(linkage);
  const TraceModel trace = make_trace_model(linkage);
  OracleState state = start_state(trace);
  volatile double sink = 0.0;
  double oracle = std::numeric_limits<double>::infinity();
  std::vector<Row> rows = make_rows(model);
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    constexpr int calls = 200;
    oracle =
        std::min(oracle, seconds([&] {
                           for (int i = 0; i < calls; ++i) {
                             state.q[0] = 1e-9 * i;
                             sink = sink + oracle_acceleration(trace, 0.1, state.q, state.v).qdd[0];
                           }
                         }) / calls);
    for (Row& r : rows) r.best = std::min(r.best, r.load.run(*r.kernel));
  }
  double one_lane = 0.0;
  fmt::print("{:<10}{:<10}{:>6}  {:<8}{:>10.0f}\n", name, "trace", 1, "", oracle * 1e9);
  for (const Row& r : rows) {
    fmt::print("{:<10}{:<10}{:>6}  {:<8}{:>10.1f}{:>10.1f}\n", name, name_of(r.kernel->isa),
               r.kernel->lanes, r.fixed ? "fixed" : "general", r.best * 1e9, oracle / r.best);
    if (r.kernel->lanes == 1) one_lane = std::max(one_lane, oracle / r.best);
  }
  return one_lane;
}

}  // namespace
}  // namespace linkstudy::testing

int main(int argc, char** argv) {
  linkstudy::add_fixed_kernels();
  fmt::print("RSRRP, ns per right-hand side and case, one thread, g++ {}\n", __VERSION__);
  fmt::print("{:<10}{:<10}{:>6}  {:<8}{:>10}{:>10}\n", "closure", "set", "lanes", "step loop", "ns",
             "ratio");
  const double spring = linkstudy::testing::measure("spring", linkstudy::ClosureModel::sde);
  const double cut = linkstudy::testing::measure("cut joint", linkstudy::ClosureModel::cut);
  return argc < 2 || std::min(spring, cut) >= std::atof(argv[1]) ? 0 : 1;
}

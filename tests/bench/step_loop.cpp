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

constexpr double kStep = 1e-5;  // s, stable for all of them
constexpr long kSteps = 2000;
constexpr int kChunks = 15;
constexpr double kNever = std::numeric_limits<double>::infinity();

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
    c.channels = find_channels(list_channels(model.mechanism),
                               "closure." + model.mechanism.closure_names.front() + ".force");
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
    const KernelRun setting{0.0, kStep, kSteps, 100, 1.0, never, nullptr};
    const double spent =
        seconds([&] { kernel.run(model_.mechanism, setting, cases_.data(), lanes_); });
    for (const LaneEnd& end : ends_) {
      if (end.cause == Cause::ok && !end.abandoned && end.steps == kSteps) continue;
      throw std::runtime_error(fmt::format("a run ended early: {}", name_of(end.cause)));
    }
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
  double best;
  std::vector<double> ratios;

  double ratio() {
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::nth_element(ratios.begin(), middle, ratios.end());
    return *middle;
  }
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
        rows.push_back({&kernel, Load(model, lanes), !general, kNever, {}});
      }
    }
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

void print(const char* name, double oracle, std::vector<Row>& rows) {
  fmt::print("{:<12}{:<10}{:>6}  {:<8}{:>10.0f}\n", name, "trace", 1, "", oracle * 1e9);
  for (Row& r : rows) {
    fmt::print("{:<12}{:<10}{:>6}  {:<8}{:>10.1f}{:>10.1f}\n", name, name_of(r.kernel->isa),
               r.kernel->lanes, r.fixed ? "fixed" : "general", r.best * 1e9, r.ratio());
  }
}

// The best ratio of one lane.
double measure(const char* name, const Linkage& linkage) {
  const Model model = compile(linkage);
  Oracle oracle(linkage);
  std::vector<Row> rows = make_rows(model);
  double least = kNever;
  for (int chunk = 0; chunk < kChunks; ++chunk) {
    for (Row& r : rows) {
      const double before = oracle.run();
      const double own = r.load.run(*r.kernel);
      const double after = oracle.run();
      least = std::min({least, before, after});
      r.best = std::min(r.best, own);
      r.ratios.push_back(0.5 * (before + after) / own);
    }
  }
  print(name, least, rows);
  double one_lane = 0.0;
  for (Row& r : rows) {
    if (r.kernel->lanes == 1) one_lane = std::max(one_lane, r.ratio());
  }
  return one_lane;
}

// RSRRP with its coupler cut into pieces joined by spherical joints: 4 + 3 (pieces - 1) freedoms.
Linkage segmented_rsrrp(int pieces) {
  Linkage linkage = rsrrp_test_vector(ClosureModel::sde);
  const auto coupler = std::find_if(linkage.links.begin(), linkage.links.end(),
                                    [](const Link& link) { return link.name == "coupler"; });
  const double length = 0.5 / pieces;
  coupler->mass /= pieces;
  coupler->inertia /= pieces;
  coupler->center_of_mass /= pieces;
  const Link piece = *coupler;
  std::string before = "coupler";
  for (int i = 1; i < pieces; ++i) {
    Link link = piece;
    link.name = fmt::format("coupler_{}", i);
    Joint joint;
    joint.name = fmt::format("J_{}", i);
    joint.type = JointType::spherical;
    joint.parent = before;
    joint.child = before = link.name;
    joint.frame.position = {0.0, length, 0.0};
    linkage.links.push_back(link);
    linkage.joints.push_back(joint);
  }
  linkage.closures[0].second.link = before;
  linkage.closures[0].second.frame.position = {0.0, length, 0.0};
  return linkage;
}

}  // namespace
}  // namespace linkstudy::testing

int main(int argc, char** argv) {
  using namespace linkstudy::testing;
  using linkstudy::ClosureModel;
  linkstudy::add_fixed_kernels();
  fmt::print("ns per right-hand side and case, one thread, g++ {}\n", __VERSION__);
  fmt::print("{:<12}{:<10}{:>6}  {:<8}{:>10}{:>10}\n", "model", "set", "lanes", "loop", "ns",
             "ratio");
  const double spring = measure("spring", rsrrp_test_vector(ClosureModel::sde));
  const double cut = measure("cut joint", rsrrp_test_vector(ClosureModel::cut));
  linkstudy::Linkage revolute = linkstudy::testing::rsrrp_revolute();
  revolute.closures[0].model = ClosureModel::sde;
  measure("revolute", revolute);
  measure("19 freedoms", segmented_rsrrp(6));
  return argc < 2 || std::min(spring, cut) >= std::atof(argv[1]) ? 0 : 1;
}

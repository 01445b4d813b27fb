// The RSRRP linkage (set R1) in Simbody beside the engine: the same bodies, joints, loads and
// closure, built from the same Linkage, and the same method (classical Runge-Kutta, constant step;
// no projection). First both must agree: joint positions along the first second, h = 1e-4 s, for
// every step loop that is then measured. After that the cost of one right-hand side as ratios, how:
// engine_runs.h.
//
// usage: bench_peer_simbody      exits 1 with a message if the two disagree
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "tests/bench/engine_runs.h"
#include "tests/bench/simbody_run.h"
#include "tests/mechanisms/rsrrp.h"

namespace linkstudy::testing {
namespace {

constexpr double kStep = 1e-4;        // s
constexpr long kSteps = 2000;         // of an engine run
constexpr int kRuns = 5;              // compared, one after the other: 1 s
constexpr double kAgreement = 1e-11;  // of joint positions, relative; 0.1 % more damping: 2e-10
constexpr long kSimbodySteps = 20;    // of a measured chunk: as short as the engine's
constexpr int kChunks = 101;

// Largest relative difference of joint positions; not finite if any of them is not.
double difference(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) throw std::logic_error("not the same joints");
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::abs(a[i] - b[i]) / std::abs(b[i]);
    if (!(d <= largest)) largest = d;
  }
  return largest;
}

// At the end of every run of every step loop, in every lane; throws if it is too large.
double compare(const char* name, SimbodyRun& simbody, const Model& model, InstructionSet isa) {
  std::vector<EngineRow> rows = engine_rows(model, isa, kStep, kSteps);
  double largest = 0.0;
  simbody.restart();
  for (int run = 0; run < kRuns; ++run) {
    simbody.advance(kStep, kSteps);
    const std::vector<double> expected = simbody.positions();
    for (EngineRow& r : rows) {
      r.load.run();
      for (int lane = 0; lane < r.load.lanes(); ++lane) {
        const double d = difference(r.load.positions(lane), expected);
        if (!(d <= kAgreement)) {
          throw std::runtime_error(
              fmt::format("{}: engine ({} lanes, lane {}) and Simbody differ by {:.1e} after {} s",
                          name, r.load.lanes(), lane, d, kStep * kSteps * (run + 1)));
        }
        largest = std::max(largest, d);
      }
      r.load.go_on();
    }
  }
  return largest;
}

void measure(const char* name, ClosureModel closure) {
  const Linkage linkage = rsrrp_test_vector(closure);
  const Model model = compile(linkage);
  SimbodyRun simbody(linkage);
  const InstructionSet isa = simd_level().isa;
  const double largest = compare(name, simbody, model, isa);
  std::vector<EngineRow> rows = engine_rows(model, isa, kStep, kSteps);
  const auto simbody_chunk = [&] {
    simbody.restart();
    return seconds([&] { simbody.advance(kStep, kSimbodySteps); }) / (4.0 * kSimbodySteps);
  };
  const double least = measure_beside(simbody_chunk, rows, kChunks);
  print_rows(name, "Simbody", least, rows);
  fmt::print("{:<12}joint positions agree to {:.1e} along 1 s\n", name, largest);
}

void print_version() {
  fmt::print(
      "Simbody {}, Debian package (its checks on; a clean source build was 2.2-2.6 times faster)\n",
      simbody_version());
}

}  // namespace
}  // namespace linkstudy::testing

int main() {
  using namespace linkstudy::testing;
  using linkstudy::ClosureModel;
  try {
    print_version();
    print_heading();
    measure("spring", ClosureModel::sde);
    measure("cut joint", ClosureModel::cut);
  } catch (const std::exception& e) {
    fmt::print(stderr, "bench_peer_simbody: {}\n", e.what());
    return 1;
  }
  return 0;
}

// Runs of the engine for the benchmarks, and their speed beside something else that computes the
// same right-hand side: one process, interleaved short chunks, medians of ratios taken side by
// side. A ratio, never a time, is what may be compared between machines. Runs are whole: steps,
// observers and all.
#pragma once

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "core/model/compile.h"
#include "core/simulation/kernels.h"
#include "core/simulation/pack_code.h"

namespace linkstudy::testing {

// Wall time, s.
template <class F>
double seconds(F&& f) {
  const auto begin = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

// The same case in every lane of a pack, or of two side by side, run as a study does: closure force
// compared with a stored reference at every step.
class EngineRun {
 public:
  EngineRun(const Model& model, const SimdLevel& level, double step, long steps, bool written,
            int packs = 1);
  EngineRun(EngineRun&&) = default;  // no copies: members point into each other's storage

  // One run of all steps from the start; seconds per right-hand side and case. Throws if a lane
  // ends early.
  double run();

  bool is_written() const { return code_ && code_->get() != nullptr; }
  int lanes() const { return static_cast<int>(cases_.size()); }
  InstructionSet isa() const { return kernel_->isa; }

  // The next run starts where the last one ended.
  void go_on();

  // Joint positions at the end of the last run.
  std::vector<double> positions(int lane) const;

 private:
  const Model& model_;
  const Kernel* kernel_;
  double step_;
  long steps_;
  double begin_ = 0.0;  // s
  std::vector<double> y_, reference_;
  std::vector<Observers> observers_;
  std::vector<LaneEnd> ends_;
  std::vector<std::vector<double>> finals_;
  std::vector<LaneCase> cases_;
  std::unique_ptr<PackCode> code_;
};

// A step loop that is measured. ratios: time of the other over that of the engine.
struct EngineRow {
  EngineRun load;
  double best;  // s per right-hand side and case
  std::vector<double> ratios;

  double ratio() const;  // median
};

// The loops for a model on one instruction set: one lane and all lanes, general and, if there is
// one, written for this structure, for two packs too if it is short enough.
std::vector<EngineRow> engine_rows(const Model& model, InstructionSet isa, double step, long steps);

// Fills the rows; `other` returns its seconds per right-hand side. Returns the least of those.
template <class F>
double measure_beside(F&& other, std::vector<EngineRow>& rows, int chunks = 15) {
  double least = other();
  for (int chunk = 0; chunk < chunks; ++chunk) {
    for (EngineRow& r : rows) {
      const double before = other();
      const double own = r.load.run();
      const double after = other();
      least = std::min({least, before, after});
      r.best = std::min(r.best, own);
      r.ratios.push_back(0.5 * (before + after) / own);
    }
  }
  return least;
}

void print_heading();
void print_rows(const std::string& model, const std::string& other, double least,
                const std::vector<EngineRow>& rows);

}  // namespace linkstudy::testing

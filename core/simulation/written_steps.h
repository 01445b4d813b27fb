// Steps of constant length, and trials of adaptive ones, that the program writes for a structure
// when it meets it, and keeps for the rest of the process. A parameter that is 0, 1 or -1 in all
// lanes is a constant of the code; a pack that does not fit has another code written that fits
// both. No bit of a result depends on which code runs: all give those of the general step loop of a
// fused instruction set.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/isa.h"
#include "core/codegen/frame_code.h"
#include "core/codegen/written_code.h"
#include "core/simulation/kernel.h"
#include "core/simulation/step_trace.h"

namespace linkstudy {

enum class WrittenKind { step, trial };

// For AVX2; where a slot has more numbers, for AVX-512 too (core/codegen/frame_code.h).
struct WrittenStep {
  WrittenKind kind = WrittenKind::step;
  int slot_numbers = 0;
  int packs = 1;                 // that go side by side, each on a frame of its own
  bool rows_may_depend = false;  // right for cut rows that depend on each other, too
  StepSlots slots;               // of a trial: `fine` and `end` (core/simulation/trial_slots.h)
  std::vector<Channel> observed;
  std::vector<Known> known;
  std::vector<codegen::SlotValue> constants;
  int frame_slots = 0;         // of one frame
  std::size_t code_bytes = 0;  // of the widest code
  double call_s = 0.0;         // it takes, here and now
  std::vector<std::unique_ptr<codegen::WrittenCode>> pages;
  std::unique_ptr<codegen::FrameCode> code;
  std::unique_ptr<codegen::FrameCode> inside;  // of trials: instants inside steps

  // Writes the constants into the frames for this code.
  void put_constants(double* frame) const;
};

// What has been written in this process.
struct WrittenReport {
  int kernels = 0;
  double seconds = 0.0;  // it took
  int distrusted = 0;    // whose AVX-512 code differed from that for AVX2, which serves
  int untraceable = 0;   // structures whose step cannot be traced
  std::string why;       // the last of them could not
};
WrittenReport written_report();

// Why this process runs the general step loop alone, or empty. Asks for executable memory once.
std::string why_not_written(const SimdLevel& level);

// The step for a pack, or for two (those of the last cases), that writes these channels, on frames
// of `slot_numbers` a slot, or null: its structure cannot be traced, two packs gain nothing side by
// side, this machine has no AVX2 or refuses executable memory, or what is left to run is too little
// to gain by it. Right for cut rows that depend on each other if they do at the start of the first
// case, or rows_may_depend says so, whatever it gains. May be called by several threads.
std::shared_ptr<const WrittenStep> written_step(const Mechanism& m, std::span<const LaneCase> cases,
                                                const std::vector<Channel>& observed, long steps,
                                                const SimdLevel& level, int slot_numbers,
                                                bool rows_may_depend = false, int packs = 1);

// The same of trials and instants inside steps, where the equations of motion have been evaluated
// so often since the last question.
std::shared_ptr<const WrittenStep> written_trial(const Mechanism& m,
                                                 std::span<const LaneCase> cases,
                                                 const std::vector<Channel>& observed,
                                                 long evaluations, const SimdLevel& level,
                                                 int slot_numbers, bool rows_may_depend = false);

// False of channels that are fitted lane by lane: reactions shared in loops.
bool is_writable(const Mechanism& m, const Channel& channel);

}  // namespace linkstudy

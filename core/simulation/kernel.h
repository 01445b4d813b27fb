// The boundary between the program and the step loops compiled for one instruction set each: plain
// pointers and numbers, so that code for a wide instruction set stays in its own objects.
#pragma once

#include "core/base/isa.h"
#include "core/codegen/frame_code.h"
#include "core/forces/contact_log.h"
#include "core/model/parameters.h"
#include "core/simulation/cause.h"
#include "core/simulation/observers.h"
#include "core/simulation/step_slots.h"
#include "core/simulation/trial_slots.h"

namespace linkstudy {

class ContactRecorder;

// One contact at an accepted state and the one before it.
struct ContactStep {
  ContactIndex contact;
  double t0, t1;  // s
  double depth0, rate0, depth1, rate1;
  double approach;        // its speed of approach, m/s or rad/s
  bool touched, touches;  // before, now
};
// Compiled once, for all instruction sets.
void record_contact(ContactRecorder& recorder, const ContactStep& step);

// How the run of one lane ended.
struct LaneEnd {
  Cause cause = Cause::ok;
  bool redundant = false;  // cut rows were dependent at some instant
  int least_rank = -1;     // of the cut rows, over the steps
  int greatest_rank = -1;
  long steps = 0;  // accepted
  double drift_max = 0.0;
  double energy_residual_max = 0.0;
  double energy_scale = 0.0;
  double contacts = 0.0;                    // begun
  double least_contact_steps = kNoContact;  // steps in the shortest contact that has ended
  double bristle_rate = 0.0;                // fastest relaxation of a bristle, 1/s
  double bristle_time = 0.0;                // and when, s
};

struct LaneCase {
  const Parameters<double>* parameters;
  const double* y;       // start (core/simulation/run_state.h)
  double* final_y;       // the same at the end
  Observers* observers;  // sized; of the same form in all lanes
  std::size_t* samples;  // (series) rows written
  LaneEnd* end;
  double* looks = nullptr;              // rows of core/simulation/looks.h, or none
  ContactRecorder* contacts = nullptr;  // or none
};

// Numbers that a slot of a frame has for a kernel of so many lanes: the fewest that code does.
constexpr int slot_numbers(int lanes) {
  return lanes < native_lanes(InstructionSet::avx2) ? native_lanes(InstructionSet::avx2) : lanes;
}

// Code for a whole step (core/simulation/written_steps.h) and the frame of a pack, or those of two.
struct StepCode {
  codegen::FrameCode* code = nullptr;
  StepSlots slots;
  double* frame = nullptr;
  int frame_numbers = 0;  // from here to the frame of the second pack
  // First channel of each observer, comparisons, reductions and series in this order, among those
  // that the code writes; below 0 of one whose channels it does not write, and when those look.
  const int* first_observed = nullptr;
  const Sampling* beyond = nullptr;
  int beyond_count = 0;
  // Code for the same pack, asked for once where this fails too often; may be none.
  const StepCode* (*instead)(void* context) = nullptr;
  void* context = nullptr;
};

struct KernelRun {
  double t0;
  double h;
  long count;          // steps
  long energy_stride;  // steps between looks at the energy ledger
  double drift_limit;
  // Called now and then: anything but ok ends all lanes.
  Cause (*poll)(void* context, double t);
  void* context;
  const StepCode* code = nullptr;  // none: the general step loop alone
};

// Trials of adaptive steps and instants inside them by the general loop, on a frame of
// slot_numbers(lanes) a slot.
class TrialPack {
 public:
  TrialPack() = default;
  virtual ~TrialPack();
  TrialPack(const TrialPack&) = delete;
  TrialPack& operator=(const TrialPack&) = delete;

  virtual void set_parameters(int lane, const Parameters<double>& p) = 0;
  virtual void try_steps(double* frame) = 0;
  virtual void look_inside(double* frame) = 0;
};

struct TrialSetting {
  TrialSlots slots;
  const Channel* observed;  // that instants give
  int observed_count;
};

// cases: up to as many as the kernel has lanes, or with code for two packs up to twice as many.
struct Kernel {
  InstructionSet isa;
  int lanes;
  void (*run)(const Mechanism&, const KernelRun&, const LaneCase* cases, int count);
  // To be deleted by the caller.
  TrialPack* (*make_trials)(const Mechanism&, const TrialSetting&, const LaneCase* cases,
                            int count);
};

}  // namespace linkstudy

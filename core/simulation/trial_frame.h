// The frame on which a pack of adaptive runs has its trials made and instants inside its steps
// evaluated: by the general loop, and once enough of them have been made by code written for the
// structure, with the same bits.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/simulation/code_failures.h"
#include "core/simulation/kernel.h"
#include "core/simulation/observed_channels.h"
#include "core/simulation/written_steps.h"

namespace linkstudy {

class TrialFrame {
 public:
  // cases: all that will be run on it, of one structure. Its lanes begin with the first of them,
  // or copies of the last.
  TrialFrame(const Mechanism& m, std::span<const LaneCase> cases, const SimdLevel& level,
             int lanes);

  int lanes() const { return lanes_; }
  const TrialSlots& slots() const { return slots_; }
  const ObservedChannels& observed() const { return observed_; }
  void set_case(int lane, const LaneCase& c);

  double get(int lane, int slot) const { return numbers()[slot * width_ + lane]; }
  void get(int lane, int slot, int count, double* to) const {
    const double* from = numbers() + slot * width_ + lane;
    for (int k = 0; k < count; ++k) to[k] = from[k * width_];
  }
  void put(int lane, int slot, double x) { numbers()[slot * width_ + lane] = x; }
  void put(int lane, int slot, int count, const double* from) {
    double* to = numbers() + slot * width_ + lane;
    for (int k = 0; k < count; ++k) to[k * width_] = from[k];
  }

  // A trial in each lane, the last one again where none is asked for; an instant in each. Of the
  // lanes in `counting`, one bit each, all is right.
  void try_steps(unsigned counting);
  void look_inside(unsigned counting);

 private:
  double* numbers() const { return numbers_; }
  void use(std::shared_ptr<const WrittenStep> written);
  void leave();
  // Asks for code now and then, until there is some.
  void count_evaluations(long count);
  bool run(codegen::FrameCode& code, int fine, unsigned counting);
  bool is_fine(int slot, unsigned counting) const;

  const Mechanism& m_;
  std::span<const LaneCase> cases_;
  SimdLevel level_;
  int lanes_, width_;
  ObservedChannels observed_;
  TrialSlots slots_;
  codegen::FrameNumbers frame_;
  double* numbers_;
  std::unique_ptr<TrialPack> general_;
  std::shared_ptr<const WrittenStep> written_;
  long untold_ = 0, next_question_ = 0;  // evaluations since the last question for code
  CodeFailures failures_;
  bool may_be_written_, rows_may_depend_ = false;
};

}  // namespace linkstudy

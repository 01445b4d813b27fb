// The written step of one pack (core/simulation/written_steps.h) with a frame of its own: what a
// kernel takes as StepCode.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "core/base/isa.h"
#include "core/simulation/kernel.h"
#include "core/simulation/observed_channels.h"
#include "core/simulation/written_steps.h"

namespace linkstudy {

class PackCode {
 public:
  // The step for these cases, of which each is `steps` long, in a kernel of `lanes`: up to as many,
  // or two packs side by side. None where written_step has none. Where observers look it writes
  // what they see, unless that is seldom. Where it fails since cut rows come to depend on each
  // other, another is written for these.
  PackCode(const Mechanism& m, std::span<const LaneCase> cases, long steps, const SimdLevel& level,
           int lanes);
  PackCode(const PackCode&) = delete;  // members point into each other's storage
  PackCode& operator=(const PackCode&) = delete;

  const StepCode* get() const { return first_.written ? &first_.code : nullptr; }

 private:
  // A step and the frame that it runs on.
  struct Placed {
    std::shared_ptr<const WrittenStep> written;
    codegen::FrameNumbers frame;
    StepCode code;
  };

  void place(bool rows_may_depend, Placed& at);
  const StepCode* place_for_dependent_rows();

  const Mechanism& m_;
  std::span<const LaneCase> cases_;
  long steps_;
  SimdLevel level_;
  int lanes_, packs_;
  ObservedChannels observed_;
  Placed first_;
  Placed dependent_;  // where the first fails
};

}  // namespace linkstudy

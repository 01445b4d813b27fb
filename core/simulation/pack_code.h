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
  // None, until there is one.
  PackCode() = default;

  // The step for these cases, of which each is `steps` long, in a kernel of `lanes`; none where
  // written_step has none. Where observers look it writes what they see, unless that is seldom.
  PackCode(const Mechanism& m, std::span<const LaneCase> cases, long steps, const SimdLevel& level,
           int lanes);
  PackCode(PackCode&&) = default;  // no copies: members point into each other's storage
  PackCode& operator=(PackCode&&) = default;

  const StepCode* get() const { return written_ ? &code_ : nullptr; }

 private:
  void fill_frame();

  ObservedChannels observed_;
  std::shared_ptr<const WrittenStep> written_;
  codegen::FrameNumbers frame_;
  StepCode code_;
};

}  // namespace linkstudy

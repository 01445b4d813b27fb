#include "core/simulation/pack_code.h"

#include <algorithm>
#include <bit>

namespace linkstudy {

PackCode::PackCode(const Mechanism& m, std::span<const LaneCase> cases, long steps,
                   const SimdLevel& level, int lanes) {
  observed_ = ObservedChannels(m, *cases[0].observers);
  written_ = written_step(m, cases, observed_.all(), steps, level, slot_numbers(lanes));
  if (written_) fill_frame();
}

void PackCode::fill_frame() {
  const int numbers = written_->slot_numbers;
  frame_ = codegen::FrameNumbers(written_->frame_slots * numbers);
  for (const auto& [slot, bits] : written_->constants) {
    std::fill_n(frame_.data() + slot * numbers, numbers, std::bit_cast<double>(bits));
  }
  code_ = {written_->code.get(),
           written_->slots,
           frame_.data(),
           observed_.first().data(),
           observed_.beyond().data(),
           static_cast<int>(observed_.beyond().size())};
}

}  // namespace linkstudy

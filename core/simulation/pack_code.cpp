#include "core/simulation/pack_code.h"

#include <algorithm>
#include <bit>

namespace linkstudy {
namespace {

constexpr long kOften = 8;  // steps: what is looked at more rarely takes a general evaluation

}  // namespace

PackCode::PackCode(const Mechanism& m, std::span<const LaneCase> cases, long steps,
                   const SimdLevel& level, int lanes) {
  list_observed(m, *cases[0].observers);
  written_ = written_step(m, cases, observed_, steps, level, slot_numbers(lanes));
  if (written_) fill_frame();
}

void PackCode::list_observed(const Mechanism& m, const Observers& form) {
  const auto add = [&](const Sampling& sampling, std::span<const Channel> channels) {
    const bool is_written = sampling.stride < kOften &&
                            std::all_of(channels.begin(), channels.end(),
                                        [&m](const Channel& c) { return is_writable(m, c); });
    first_.push_back(is_written ? static_cast<int>(observed_.size()) : -1);
    if (is_written) {
      observed_.insert(observed_.end(), channels.begin(), channels.end());
    } else {
      beyond_.push_back(sampling);
    }
  };
  for (const auto& s : form.comparisons) add(s.sampling, s.channels);
  for (const auto& s : form.reductions) {
    std::vector<Channel> channels = {s.channel};
    channels.insert(channels.end(), s.place.begin(), s.place.end());
    add(s.sampling, channels);
  }
  for (const auto& s : form.series) add(s.sampling, s.channels);
}

void PackCode::fill_frame() {
  const int numbers = written_->slot_numbers;
  frame_ = codegen::FrameNumbers(written_->frame_slots * numbers);
  for (const auto& [slot, bits] : written_->constants) {
    std::fill_n(frame_.data() + slot * numbers, numbers, std::bit_cast<double>(bits));
  }
  code_ = {written_->code.get(), written_->slots, frame_.data(),
           first_.data(),        beyond_.data(),  static_cast<int>(beyond_.size())};
}

}  // namespace linkstudy

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
  written_ = written_step(m, cases, observed_, steps, level);
  if (written_) fill_frames((lanes + kFrameLanes - 1) / kFrameLanes);
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
  for (const auto& s : form.reductions) add(s.sampling, {&s.channel, 1});
  for (const auto& s : form.series) add(s.sampling, s.channels);
}

void PackCode::fill_frames(int frames) {
  frames_.resize(static_cast<std::size_t>(frames * written_->frame_slots));
  for (int i = 0; i < frames; ++i) {
    for (const auto& [slot, bits] : written_->constants) {
      Slot& place = frames_[static_cast<std::size_t>(i * written_->frame_slots + slot)];
      for (double& number : place.numbers) number = std::bit_cast<double>(bits);
    }
  }
  code_ = {written_->code->function(),          written_->slots, frames_.front().numbers,
           written_->frame_slots * kFrameLanes, first_.data(),   beyond_.data(),
           static_cast<int>(beyond_.size())};
}

}  // namespace linkstudy

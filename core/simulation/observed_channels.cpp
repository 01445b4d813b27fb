#include "core/simulation/observed_channels.h"

#include <algorithm>

namespace linkstudy {
namespace {

constexpr long kOften = 8;  // steps: what is looked at more rarely takes a general evaluation

}  // namespace

ObservedChannels::ObservedChannels(const Mechanism& m, const Observers& form) {
  const auto add = [&](const Sampling& sampling, std::span<const Channel> channels) {
    const bool is_written = sampling.stride < kOften &&
                            std::all_of(channels.begin(), channels.end(),
                                        [&m](const Channel& c) { return is_writable(m, c); });
    first_.push_back(is_written ? static_cast<int>(all_.size()) : -1);
    if (is_written) {
      all_.insert(all_.end(), channels.begin(), channels.end());
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

bool ObservedChannels::leaves_out(long step) const {
  return std::any_of(beyond_.begin(), beyond_.end(),
                     [step](const Sampling& s) { return s.hits(step); });
}

}  // namespace linkstudy

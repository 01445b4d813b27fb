// Channels that code written for a structure gives to observers, in a row.
#pragma once

#include <span>
#include <vector>

#include "core/simulation/written_steps.h"

namespace linkstudy {

class ObservedChannels {
 public:
  ObservedChannels() = default;
  // Of observers of one form: those that look often, and at what can be written.
  ObservedChannels(const Mechanism& m, const Observers& form);

  const std::vector<Channel>& all() const { return all_; }
  // By observer, comparisons, reductions and series in this order: the place of its first channel,
  // below 0 of one that is left out.
  const std::vector<int>& first() const { return first_; }
  // When those look that are left out.
  const std::vector<Sampling>& beyond() const { return beyond_; }

  bool leaves_out(long step) const;

 private:
  std::vector<Channel> all_;
  std::vector<int> first_;
  std::vector<Sampling> beyond_;
};

}  // namespace linkstudy

// The channels that the signals of a study name in one mechanism, and the checks of those names.
#pragma once

#include <vector>

#include "core/simulation/channels.h"
#include "study/config/study_input.h"

namespace linkstudy {

struct StudySignals {
  std::vector<std::vector<Channel>> match;     // by [[match]]
  std::vector<std::vector<Channel>> response;  // by [[response]]
  // One channel or none: angles of cycles, by [[match]] (of a reference only) and by [[response]];
  // what is wanted where extremes are.
  std::vector<std::vector<Channel>> match_cycle, response_cycle, response_place;
  std::vector<Channel> trace;              // of all [[trace]], once each; not time
  std::vector<std::vector<Channel>> gaps;  // by closure: x y z
  std::vector<Channel> measured;           // of the experiment, one for each of its signals
};

// Whether two runs show the same under these: names, units and what is looked up for them.
bool same_channel(const Channel& a, const Channel& b);
bool same_channels(const std::vector<Channel>& a, const std::vector<Channel>& b);

// Signals as they stand, in the case's mechanism. What is not there is reported at its place.
StudySignals find_case_signals(const StudyInput& input, const std::vector<Channel>& channels,
                               Diagnostics& diagnostics);

// reference_signal of every match; responses and traces as far as the reference has them, the
// matched signals included.
StudySignals find_reference_signals(const StudyInput& input, const std::vector<Channel>& channels,
                                    Diagnostics& diagnostics);

// A signal and what it is compared with have equally many components.
void check_signals(const StudyInput& input, const StudySignals& cases,
                   const StudySignals& reference, Diagnostics& diagnostics);

}  // namespace linkstudy

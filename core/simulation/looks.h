// States of a run at which its spectrum is taken afterwards, since stiffness changes along a run:
// some evenly spread, and the heaviest of every joint with friction and of every contact.
// A row: t (not a number where none was taken), y (core/simulation/run_state.h), and the approach
// speed of each contact that acts, below zero of one that does not.
#pragma once

#include "core/model/walk.h"
#include "core/simulation/run_state.h"

namespace linkstudy {

inline constexpr int kEvenLooks = 8;
inline constexpr double kNoApproach = -1.0;

// Rows: even ones, one a joint with friction (largest load), two a contact (largest force, largest
// damping).
template <class M>
inline int look_count(const M& m) {
  return kEvenLooks + friction_count(m) + 2 * contact_count(m);
}

template <class M>
inline int look_size(const M& m) {
  return 1 + state_size(m) + contact_count(m);
}

}  // namespace linkstudy

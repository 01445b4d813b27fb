// States of a run at which its spectrum is taken afterwards, since stiffness changes along a run:
// some evenly spread, and the heaviest of every joint with friction, of every contact and of every
// spring whose stiffness changes.
// A row: t (not a number where none was taken), y (core/simulation/run_state.h), and the approach
// speed of each contact that acts, below zero of one that does not.
#pragma once

#include "core/model/walk.h"
#include "core/simulation/run_state.h"

namespace linkstudy {

inline constexpr int kEvenLooks = 8;
inline constexpr double kNoApproach = -1.0;

// Rows: even ones, one a joint with friction (largest load), two a contact (largest force, largest
// damping), one a spring that bends (steepest).
[[gnu::always_inline]] inline int look_count(const Mechanism& m) {
  return kEvenLooks + m.friction_count() + 2 * m.contact_count() + m.bent_springs;
}

[[gnu::always_inline]] inline int look_size(const Mechanism& m) {
  return 1 + state_size(m) + m.contact_count();
}

}  // namespace linkstudy

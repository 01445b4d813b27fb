// Depths and rates of all contacts from positions and rates alone.
#pragma once

#include "core/forces/end_stops.h"
#include "core/kinematics/contact_kinematics.h"
#include "core/kinematics/forward_kinematics.h"
#include "core/simulation/run_state.h"

namespace linkstudy {

// f(contact, depth, rate) at the state y (core/simulation/run_state.h). Leaves the kinematics there
// in w.
template <class Real, class F>
inline void for_nearness(const Mechanism& m, const Parameters<Real>& p, const Real* y,
                         Workspace<Real>& w, F&& f) {
  update_kinematics(m, p, y, y + m.nq, w);
  for_journals(m, p, w, [&](ClearanceIndex c, const JournalInBearing<Real>& j) {
    for (const ContactIndex i : contacts_of(m.clearances[c])) {
      const auto k = contact_geometry(j, m.contacts[i], p.clearances[c]);
      f(i, k.depth, k.rate);
    }
  });
  for (const StopIndex i : indices_of(m.stops)) {
    const StopStructure& s = m.stops[i];
    f(s.contact, stop_depth(s, p.stops[i], y),
      towards_stop(s, Velocities<const Real>(y + m.nq)[s.v]));
  }
}

}  // namespace linkstudy

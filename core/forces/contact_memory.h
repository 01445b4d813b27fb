// What contacts remember from one accepted state to the next.
#pragma once

#include "core/forces/contact_log.h"
#include "core/model/walk.h"
#include "core/model/workspace.h"

namespace linkstudy {

// No contact acts, wherever the journals are.
template <class Real>
inline void hold_contacts_open(const Mechanism& m, Workspace<Real>& w) {
  for (const ContactIndex i : indices_of(m.contacts)) {
    w.memory[i].least_depth = Real(std::numeric_limits<double>::infinity());
  }
}

// A contact before a run.
template <class Real>
inline ContactMemory<Real> fresh_contact() {
  ContactMemory<Real> memory;
  memory.touching = memory.approach = Real(0.0);
  return memory;
}

// After an evaluation at the start: what touches there begins there, with the rate it has.
template <class Real>
inline void begin_contact_memory(const Mechanism& m, Workspace<Real>& w) {
  for (const ContactIndex i : indices_of(m.contacts)) {
    w.memory[i].depth = w.contacts[i].depth;
    w.memory[i].rate = w.contacts[i].rate;
  }
}

// After an evaluation at an accepted state. `steps` counts states in each contact, (contacts);
// bristles that start afresh are set to zero in z (nz).
template <class Real>
inline void update_contact_memory(const Mechanism& m, Workspace<Real>& w, Real* steps,
                                  Bristles<Real> z, ContactLog<Real>& log) {
  const Real none(0.0), one(1.0);
  for (const ContactIndex i : indices_of(m.contacts)) {
    const ContactStructure& contact = m.contacts[i];
    const ContactState<Real>& s = w.contacts[i];
    ContactMemory<Real>& memory = w.memory[i];
    const auto touches = s.depth > memory.least_depth;
    const auto touched = memory.touching > Real(0.5);
    const auto ended = touched && !touches;
    memory.approach = select(touches, s.approach, none);
    log.begun = log.begun + select(touches && !touched, one, none);
    log.least_steps = select(ended, min(log.least_steps, steps[i.value()]), log.least_steps);
    steps[i.value()] = select(touches, select(touched, steps[i.value()] + one, one), none);
    memory.touching = select(touches, one, none);
    memory.depth = s.depth;
    memory.rate = s.rate;
    if (!contact.z.exists() || m.clearances[contact.clearance].free_bristle != FreeBristle::reset) {
      continue;
    }
    z[contact.z] = select(touches, z[contact.z], none);
  }
}

}  // namespace linkstudy

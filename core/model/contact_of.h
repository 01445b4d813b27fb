// The law of a contact, whether of a clearance or of an end stop.
#pragma once

#include "core/base/indices.h"
#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

template <class Real>
inline const NormalContact<Real>& law_of_contact(const Mechanism& m, const Parameters<Real>& p,
                                                 ContactIndex contact) {
  const ContactStructure& c = m.contacts[contact];
  return c.stop.exists() ? p.stops[c.stop].contact : p.clearances[c.clearance].contact;
}

inline ApproachSpeed approach_of_contact(const Mechanism& m, ContactIndex contact) {
  const ContactStructure& c = m.contacts[contact];
  return c.stop.exists() ? m.stops[c.stop].approach : m.clearances[c.clearance].approach;
}

}  // namespace linkstudy

// The law of a contact, whether of a clearance or of an end stop.
#pragma once

#include "core/base/indices.h"
#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

template <class Real>
inline const NormalContact<Real>& law_of_contact(const Mechanism& m, const Parameters<Real>& p,
                                                 int contact) {
  const ContactStructure& c = at(m.contacts, contact);
  return c.stop >= 0 ? at(p.stops, c.stop).contact : at(p.clearances, c.clearance).contact;
}

inline ApproachSpeed approach_of_contact(const Mechanism& m, int contact) {
  const ContactStructure& c = at(m.contacts, contact);
  return c.stop >= 0 ? at(m.stops, c.stop).approach : at(m.clearances, c.clearance).approach;
}

}  // namespace linkstudy

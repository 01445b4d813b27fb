// Every bristle of a mechanism with the friction law that it belongs to.
#pragma once

#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

// f(the bristle, its LugreParameters)
template <class Real, class F>
inline void for_bristles(const Mechanism& m, const Parameters<Real>& p, F&& f) {
  for (const FrictionIndex i : indices_of(m.frictions)) {
    const JointFrictionStructure& s = m.frictions[i];
    f(s.z, p.frictions[i].law);
    if (s.turn.exists() && s.slide.exists()) f(s.z + 1, p.frictions[i].law);
  }
  for (const ConstantFrictionIndex i : indices_of(m.constant_frictions)) {
    const ConstantFrictionStructure& s = m.constant_frictions[i];
    for (int k = 0; k < s.count; ++k) f(s.z + k, p.constant_frictions[i].law);
  }
  for (const ContactIndex i : indices_of(m.contacts)) {
    const ContactStructure& c = m.contacts[i];
    if (c.z.exists()) f(c.z, p.clearances[c.clearance].friction);
  }
}

}  // namespace linkstudy

// Every bristle of a mechanism with the friction law that it belongs to.
#pragma once

#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

// f(number of the bristle, its LugreParameters)
template <class Real, class F>
inline void for_bristles(const Mechanism& m, const Parameters<Real>& p, F&& f) {
  for (const int i : indices_of(m.frictions)) {
    const JointFrictionStructure& s = at(m.frictions, i);
    f(s.z, at(p.frictions, i).law);
    if (s.turn >= 0 && s.slide >= 0) f(s.z + 1, at(p.frictions, i).law);
  }
  for (const int i : indices_of(m.constant_frictions)) {
    const ConstantFrictionStructure& s = at(m.constant_frictions, i);
    for (int k = 0; k < s.count; ++k) f(s.z + k, at(p.constant_frictions, i).law);
  }
  for (const int i : indices_of(m.contacts)) {
    const ContactStructure& c = at(m.contacts, i);
    if (c.z >= 0) f(c.z, at(p.clearances, c.clearance).friction);
  }
}

}  // namespace linkstudy

// The approach speed of a contact, which its law divides by: that of its beginning (or more, if it
// is driven faster later and ApproachSpeed::greatest is asked for). In the step where it begins
// that speed is found from the states around the crossing; a contact that is there at the start has
// begun with its rate.
#pragma once

#include "core/laws/normal_contact.h"
#include "core/model/workspace.h"

namespace linkstudy {

template <class Real>
inline Real approach_speed(ApproachSpeed which, const ContactMemory<Real>& memory, Real depth,
                           Real rate) {
  const Real begin = select(memory.touching > Real(0.5), memory.approach,
                            crossing_speed(memory.depth, memory.rate, depth, rate));
  return dividing_speed(which, begin, rate);
}

}  // namespace linkstudy

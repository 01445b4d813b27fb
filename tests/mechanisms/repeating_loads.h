// Loads of every type whose courses repeat or go over a joint coordinate, added to any linkage.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// joint: its first coordinate is driven and gone over; link: forces, and an actuator from ground,
// act on it. Of the order of `size`, N or N m.
void add_repeating_loads(const std::string& joint, const std::string& link, double size,
                         Linkage& linkage);

}  // namespace linkstudy::testing

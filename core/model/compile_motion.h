// A prescribed motion of a coordinate in a mechanism.
#pragma once

#include "core/model/compile.h"

namespace linkstudy {

// `body` hangs on the joint that moves; all bodies and their starts are there. The coordinate
// starts as the law has it, and is held there.
void compile_motion(const Motion& motion, const Body& body, Model& model);

}  // namespace linkstudy

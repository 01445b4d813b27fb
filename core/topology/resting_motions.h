// A linkage whose prescribed motions stay where they begin: what statics takes of them.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy {

Linkage with_resting_motions(Linkage linkage);

}  // namespace linkstudy

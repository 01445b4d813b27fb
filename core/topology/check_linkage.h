// Checks of a description that need connections and single values only: names unique and legal,
// references exist, every link the child of exactly one joint, no loop in the tree and no link
// unreachable from ground, masses positive, inertias those of a body (positive definite, triangle
// inequality of the principal moments), rotations proper (orthonormal to 1e-6, determinant +1),
// coordinate counts, closure types, loads that name an existing joint coordinate, laws of contact
// and friction, flexible links that are uniform beams and whose parts take nobody's name.
// All problems in one pass; a problem is not reported again through its consequences.
#pragma once

#include <vector>

#include "core/topology/linkage.h"
#include "core/topology/problem.h"

namespace linkstudy {

std::vector<Problem> check(const Linkage& linkage);

}  // namespace linkstudy

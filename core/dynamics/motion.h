// The equations of motion for those outside the step loop (statics, linearisation, preparation):
// one compiled copy of `evaluate` for double.
#pragma once

#include <Eigen/Core>

#include "core/model/compile.h"
#include "core/model/workspace.h"

namespace linkstudy {

void compute_motion(const Mechanism& m, const Parameters<double>& p, const State<double>& s,
                    Workspace<double>& w);

// Mass matrix (nv, nv) at a state, from its factors: M = L^T D L. Rows and columns of
// driven coordinates are zero (core/dynamics/driven_coordinates.h).
Eigen::MatrixXd compute_mass_matrix(const Mechanism& m, const Parameters<double>& p,
                                    const State<double>& s);

}  // namespace linkstudy

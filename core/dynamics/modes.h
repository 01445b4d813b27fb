// Modes of a linkage about an equilibrium: the linear system of core/dynamics/spectrum.h in the
// directions that cut joints and couplings leave free,
//   dq = P u,   u'' = P^T (A_q P u + A_v P u' + A_z z),   z' = Z_q P u + Z_v P u' + Z_z z,
// P an orthonormal basis of the null space of J; driven coordinates rest. An eigenvalue lambda has
// the frequency |lambda| and the damping ratio -Re(lambda) / |lambda|.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "core/model/compile.h"

namespace linkstudy {

struct Mode {
  std::complex<double> eigenvalue;  // 1/s; of a pair the one with Im > 0
  double frequency = 0.0;           // rad/s: |eigenvalue|; 0 where nothing holds the motion
  double damping = 0.0;             // ratio; 1 and -1 do not swing; 0 where the frequency is 0
  // (nv) rad or m. The largest is 1, shifts counted in extents of the linkage.
  Eigen::VectorXcd shape;
};

// Slowest first; none where nothing can move. Of a double zero there is one.
std::vector<Mode> compute_modes(const Model& model, const State<double>& s);

}  // namespace linkstudy

// A journal in a bearing with radial clearance and parallel axes, [AugUrb18] eqs. (10)-(17), by
// products of transforms:
//   e = r_b - r_j across the bearing's axis, delta = |e| - c_r, delta_dot = e . e_dot / |e|
//   f_n = K delta^n (1 + D delta_dot / v0), v0 = max(approach, least speed), and |delta_dot| if the
//   greatest speed is asked for; never below 0
//   mu = sigma0 z + sigma1 z_dot + sigma2 v_t,  z_dot = v_t (1 - sigma0 z sgn(v_t) / g(v_t))
//   generalised forces f^T (dr_K(b)/dq - dr_K(j)/dq), f on the bearing, at the point K where the
//   bearing is touched; v_t: speed of the journal there against the bearing, along t = axis x u,
//   u the direction from the bearing's centre to the journal's. With two points the journal's is
//   K + delta u, as eq. (17) has it, and v_t is between the two.
// Needs beside q and v what a state of contact has of its own: approach speed and bristle.
#pragma once

#include "tests/support/trace_closures.h"

namespace linkstudy::testing {

struct OracleContact {
  double approach = 0.0;  // m/s
  double bristle = 0.0;   // z, m
};

struct ContactResult {
  bool touches = false;
  double depth = 0.0;                               // delta, m; negative: a gap is left
  double rate = 0.0;                                // delta_dot, m/s
  double sliding = 0.0;                             // v_t, m/s
  double normal = 0.0;                              // |f_n|, N
  double friction = 0.0;                            // mu |f_n|, N, on the journal along -t
  double bristle_rate = 0.0;                        // z_dot, m/s; of a contact that is there
  double stored = 0.0;                              // K delta^(n + 1) / (n + 1), J
  double dissipated_power = 0.0;                    // W
  Vector generalised;                               // (dof)
  Eigen::Vector3d force = Eigen::Vector3d::Zero();  // on first, N
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // K, ground axes, m
};

ContactResult contact_result(const TraceClosure& closure, const ClosureFrames& frames,
                             const OracleContact& contact);

}  // namespace linkstudy::testing

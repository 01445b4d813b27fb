// A free body that carries a journal inside a bearing on ground: nothing but the clearance acts on
// it (and gravity, if given). Axis of the bearing: ground z. Tree joint F: free, with a quaternion.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct JournalInBearing {
  ClearanceKind kind = ClearanceKind::planar;
  double mass = 1.0;
  Eigen::Vector3d moments{2e-3, 2e-3, 1e-3};           // kg m^2, about the journal's centre
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // of the journal's centre, m
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  // turned by this vector, rad
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();  // of the centre, ground axes, m/s
  Eigen::Vector3d turning = Eigen::Vector3d::Zero();   // rad/s, in the body's axes
};

// 1 mm radial clearance, bearing radius 5 mm, length 20 mm, K = 1e10 N/m^1.5, k_e = 0.9, no
// friction; the journal is the first end.
Clearance loose_bearing();

// [AugUrb18] table 1.
Friction table_1_friction();

Linkage journal_in_bearing(const JournalInBearing& journal, const Clearance& clearance);

}  // namespace linkstudy::testing

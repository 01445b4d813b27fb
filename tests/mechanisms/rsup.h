// The RSUP linkage of [AugUrb18]: the linkage of rsrrp.h, cut at the revolute joint R between the
// coupler and the yoke, whose two pins make the universal joint U. Reference set R1 (physics.md
// section 8). R is an ideal joint or a bearing with clearance: bearing on the yoke, journal on the
// coupler, radii 5 mm and 5 mm - c_r, steel on steel, friction of table 1. Loads: 10 N m, ramped
// in over 2 s, against 10 N m at `at_speed`; 9 rad/s is the set R1, 30 rad/s the set "fast", whose
// journal keeps impacting.
// Assumed for the flexible coupler: round steel, 22 mm, with 1e-5 s of retardation.
#pragma once

#include <optional>

#include "tests/mechanisms/rsrrp.h"

namespace linkstudy::testing {

struct Rsup {
  std::optional<ClearanceKind> clearance{};  // empty: ideal joint
  double radial = 1e-3;                      // c_r, m
  bool friction = true;                      // in the clearance
  int segments = 0;                          // of the coupler; 0: rigid
  double at_speed = 9.0;                     // rad/s
  ApproachSpeed approach = ApproachSpeed::begin;
};

// The flexible coupler: along y of the link frame, from its origin.
FlexibleBeam steel_rod(int segments);

inline constexpr double kFast = 30.0;  // rad/s, load set "fast"

// Tree A, S (zyx angles), P, Q as in rsrrp_revolute, then the joints inside the coupler; closure R,
// stabilised by Baumgarte with the numbers of [AugUrb18]. A flexible coupler comes expanded.
Linkage rsup(const Rsup& options = {});

}  // namespace linkstudy::testing

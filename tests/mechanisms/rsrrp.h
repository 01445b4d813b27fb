// The RSRRP linkage of [Urbas16] with reference set R1 (physics.md section 8): crank on ground (A,
// about z), spherical joint S, coupler, revolute R, yoke, revolute Q, slider on ground (P, along
// z). Closed form, with crank angle psi, crank l, coupler L, h the drop from A to the slider's pin
// line:
//   d^2 = L^2 - l^2 - h^2 - 2 l h cos(psi)       (= 0.0625 + 2 l h (1 - cos psi) for R1)
//   psi22 = atan2(l sin psi, l cos psi + h),  psi23 = -acos(d / L)
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct RsrrpGeometry {
  double crank = 0.10;                     // m
  double coupler = 0.50;                   // m
  double pin = 0.05;                       // yoke pin above the slider's origin, m
  double start_tilt = 1.0471975511965976;  // of the coupler against the slider's axis, rad
  double slider_drop() const;              // y0: slider axis below A
  double pin_drop() const;                 // h = y0 - pin
};

struct RsrrpPose {
  double psi, d, psi22, psi23;
};
RsrrpPose rsrrp_pose(double psi, const RsrrpGeometry& geometry = {});

// Tree A, P, Q, R in this order (psi11, d, psi22, psi23); closure S, crank first, coupler second,
// as a cut joint. Its sde is ready too: 1e6 N/m, 1e3 N s/m, ground axes.
Linkage rsrrp();

// The same with the coupler's Iyy = 1e-3 kg m^2, as in the two test vectors of performance.md.
// Their "crank Ixx = Izz = 8.33e-4" stands for m l^2 / 12: with that all printed digits are met,
// with the rounded number only six of them.
Linkage rsrrp_test_vector(ClosureModel model);

// Tree A, S (spherical, zyx), P, Q in this order; closure R, coupler first, yoke second, x of both
// frames along the pin; the frames coincide at the start. Sde ready: 1e6 N/m, 1e3 N s/m, 1e4 N
// m/rad, 10 N m s/rad.
Linkage rsrrp_revolute();

}  // namespace linkstudy::testing

// Flexible links as chains of rigid finite elements, modified formulation of [AugUrb18] sec. 3.
// A beam of length L in n = segments parts of length D = L / n has a spring-damping element (sde)
// in the middle of each part; between them are n + 1 rigid elements (rfe), the first and the last
// of half length. An sde is a spherical tree joint with the angles
//   psi about z, theta about y, phi about x,   R = Rz(psi) Ry(theta) Rx(phi),
// of the outer element in the inner one, in the axes of the beam (x from begin to end) whichever
// way the tree grows, with stiffness in N m/rad and damping in N m s/rad
//   c_psi = E J_z / D,  c_theta = E J_y / D,  c_phi = G J_t / D,  b = retardation * c
// (Kelvin and Voigt). At zero angles everything is where it is on the rigid link, and mass, centre
// and inertia of the link are kept exactly: element k of length l_k has the mass m l_k / L, its
// centre in its middle, and of the link's inertia beyond that of a thin rod the share l_k / L,
//   I_k = m l_k / L * l_k^2 / 12 (e_y e_y^T + e_z e_z^T) + l_k / L * (I - I_rod).
// Of a uniform beam (axial moment = sum of the two of I - I_rod across) these are inertias of
// bodies; where the axial moment is larger, short elements have one that no body has, which is
// positive definite all the same.
#pragma once

#include "core/topology/linkage.h"

namespace linkstudy {

// The linkage with every flexible link replaced: elements <link>_rfe0 .. n in the place of the
// link, all with the frame of the link, and joints <link>_sde1 .. n behind the link's own joint.
// The tree grows from the element of the link's own joint towards both ends. What is attached to
// the link (joints, ends of closures, loads, springs, chosen points) goes to the element whose span
// holds the projection of its point on the beam; where two spans meet, the one towards `end`;
// beyond the ends, the outermost. A torque has its point too (Load::point), which on a rigid link
// makes no difference. Loads that follow the link follow the element. The shape of the link is that
// of the element of its own joint, in whole: to draw it bent is up to who draws. Other links are
// untouched. Of a linkage in which check() finds nothing.
Linkage expand_flexible_links(const Linkage& linkage);

}  // namespace linkstudy

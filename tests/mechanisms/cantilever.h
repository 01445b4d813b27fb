// A uniform beam, clamped to ground, with the closed forms of beam theory for it (Euler and
// Bernoulli, Saint-Venant; small angles): with L its length, m its mass
//   tip force P:   deflection P L^3 / (3 E J), slope P L^2 / (2 E J)
//   end moment M:  deflection M L^2 / (2 E J), slope M L / (E J)
//   end torque T:  twist T L / (G J_t)
//   bending frequencies  beta_j^2 sqrt(E J / (m L^3)),  cos beta cosh beta = -1
//   torsion frequencies  (2 j - 1) pi / 2 sqrt(G J_t / (I_axial L))
#pragma once

#include <Eigen/Core>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

struct BeamData {
  double length = 0.8;              // m
  double mass = 1.3;                // kg
  double axial = 2.0e-4;            // moment of inertia about the axis, kg m^2
  double young = 2.0e11;            // Pa
  double shear = 8.0e10;            // Pa
  double second_moment_y = 3.0e-9;  // m^4
  double second_moment_z = 5.0e-9;  // m^4
  double torsion_constant = 4.0e-9;
  double retardation = 0.0;  // s

  double bending_z() const { return young * second_moment_z; }  // N m^2
  double bending_y() const { return young * second_moment_y; }
  double torsion() const { return shear * torsion_constant; }
};

// Where a beam lies in its link.
struct BeamPlace {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero();
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();   // any length
  Eigen::Vector3d across = Eigen::Vector3d::UnitY();  // any length, not along
};

// A flexible link without inertia of its section across (as beam theory has it).
Link beam_link(const std::string& name, const BeamData& data, int segments,
               const BeamPlace& place = {});

// Link "beam" along ground x from the origin, joint "wall" (fixed) at `wall` along it. No gravity.
Linkage cantilever(const BeamData& data, int segments, double wall = 0.0);

// rad/s, j = 1, 2, 3.
double bending_frequency(const BeamData& data, double bending, int j);
double torsion_frequency(const BeamData& data, int j);

}  // namespace linkstudy::testing

// Highest eigenfrequency of the linearised equations of motion at a state, and the largest stable
// step of the classical Runge-Kutta method for them. All applied forces are in (damping and
// resistance too); the linear system is d/dt (dq, dv, dz) = A (dq, dv, dz) with the bristles z of
// friction in joints and contacts, A by central differences.
// Where a ball turns with the angular velocity omega (in its own axes), dq' = dv - omega x dq.
// An element along the line of centres whose gap is shut has no direction: it counts with its
// stiffness and damping along all three axes, which bounds every direction it can take.
// Springs between points count with their slope and damping at the state: a rope that is slack with
// nothing.
// Contacts of clearances are held open, or shut with the approach speed that they are given.
// Step limit: the largest h with |R(h lambda)| <= 1 for every eigenvalue, R(z) = 1 + z + z^2/2 +
// z^3/6 + z^4/24; eigenvalues in the right half plane (an unstable equilibrium, not an unstable
// method) count with their real part set to zero.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <vector>

#include "core/model/compile.h"

namespace linkstudy {

struct Spectrum {
  std::vector<std::complex<double>> eigenvalues;  // 1/s
  double omega_max = 0.0;                         // largest |lambda|, rad/s
  double step_limit = 0.0;                        // s; infinite if nothing moves
};

// approach: speeds of the contacts (contacts), below zero of one that is open; empty: all are.
// Where a joint jams nothing is known: omega_max and step_limit are not numbers.
Spectrum compute_spectrum(const Model& model, const State<double>& s,
                          const std::vector<double>& approach = {});

// A of the linear system above, (2 nv + nz)^2; not finite where a joint jams.
Eigen::MatrixXd linear_system(const Model& model, const State<double>& s,
                              const std::vector<double>& approach = {});

Spectrum spectrum_of(std::vector<std::complex<double>> eigenvalues);

// Largest h > 0 with |R(h' z)| <= 1 for all h' <= h, z = min(Re lambda, 0) + i Im lambda; infinite
// for z = 0.
double stable_step(std::complex<double> lambda);

}  // namespace linkstudy

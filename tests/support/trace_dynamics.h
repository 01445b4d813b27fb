// Equations of motion of the tree by traces, [Urbas16] sec. 4 below eq. (18.3):
//   a_ij = sum_p tr(T_i H T_j^T)
//   h_i  = sum_p sum_mn tr(T_i H T_mn^T) qd_m qd_n
//   g_i  = -sum_p m g_vec . T_i r_C      (g_vec is the acceleration of gravity; printed for -y)
//   a qdd + h + g = generalised loads
// The double sum over m, n is left as printed: this is the reference and the benchmark baseline.
#pragma once

#include "tests/support/trace_kinematics.h"

namespace linkstudy::testing {

struct TreeEquations {
  Matrix mass_matrix;  // a, (dof x dof)
  Vector velocity;     // h, (dof)
  Vector gravity;      // g, (dof)
};

TreeEquations tree_equations(const TraceModel& model, const std::vector<LinkTransform>& transforms,
                             const Vector& v);

// 1/2 sum_p tr(T_dot H T_dot^T) and -sum_p m g_vec . T r_C (zero at the ground origin).
double kinetic_energy(const TraceModel& model, const Vector& q, const Vector& v);
double gravity_energy(const TraceModel& model, const Vector& q);

}  // namespace linkstudy::testing

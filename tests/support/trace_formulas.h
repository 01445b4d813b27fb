// Reference dynamics of any linkage of rigid links, by the trace formulas of [Urbas16]: the second
// route that the fast engine is compared with, and the baseline it is timed against.
//   [ a  Phi_q^T ] [qdd   ]   [ Q - h - g - sde ]      Phi = r2 - r1 etc., see trace_closures.h
//   [ Phi_q  0   ] [lambda] = [ gamma           ]      ([Urbas16] eqs. (18.1)-(18.3))
//   gamma = -Phi_q_dot v, with Baumgarte - 2 alpha Phi_dot - beta^2 Phi ([AugUrb18] eq. (9))
// A planar clearance has the rows of a planar joint and the contact forces of trace_contact.h
// ([AugUrb18] eq. (18)).
// Gauss elimination where the system is regular. Where rows are redundant: Gauss' principle of
// least constraint in the metric of a, and multipliers of minimum norm.
#pragma once

#include "tests/support/trace_closures.h"
#include "tests/support/trace_contact.h"
#include "tests/support/trace_dynamics.h"
#include "tests/support/trace_loads.h"

namespace linkstudy::testing {

struct OracleResult {
  Vector qdd;                           // (dof)
  Vector multipliers;                   // of all cut rows, closure by closure
  std::vector<ClosureResult> closures;  // in the order of Linkage::closures
  std::vector<ContactResult> contacts;  // likewise; filled where there is clearance
  bool redundant = false;               // multipliers are not unique
};

// contacts: one for each closure, or none: no approach speed, bristles not bent.
OracleResult oracle_acceleration(const TraceModel& model, double t, const Vector& q,
                                 const Vector& v, const std::vector<OracleContact>& contacts = {});
OracleResult oracle_acceleration(const Linkage& linkage, double t, const Vector& q,
                                 const Vector& v);

// All cut rows stacked, those of clearances with them: Phi (m or 1), Phi_q, and sum_kl Phi_kl v_k
// v_l.
struct Constraints {
  Vector value;
  Matrix jacobian;
  Vector velocity_terms;
};
Constraints cut_constraints(const TraceModel& model, const Vector& q, const Vector& v);

struct OracleState {
  double t = 0.0;
  Vector q, v;
};
OracleState start_state(const TraceModel& model);

// Classical Runge-Kutta of fourth order; v = dq/dt in the oracle's coordinates.
void rk4_step(const TraceModel& model, double h, OracleState& state);
OracleState rk4(const TraceModel& model, double h, long steps, OracleState state);

// Energy of motion, gravity, sdes, springs of joints and contacts together, J.
double total_energy(const TraceModel& model, const OracleState& state);

// Nearest configuration (minimum-norm Newton steps) that closes all cut joints, then velocities
// changed least in the plain norm. Joints with `hold` keep theirs. Throws without convergence.
OracleState closed_state(const TraceModel& model, const OracleState& state);

}  // namespace linkstudy::testing

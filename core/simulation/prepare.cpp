#include "core/simulation/prepare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/dynamics/effective_mass.h"
#include "core/dynamics/motion.h"
#include "core/kinematics/idle_rows.h"
#include "core/numerics/rank.h"
#include "core/simulation/simulate.h"

namespace linkstudy {
namespace {

constexpr double kLinearTurn = 45.0;  // deg

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

void fail(Preparation& p, Cause cause, std::string message) {
  p.cause = cause;
  p.message = std::move(message);
}

// Replacement joints have no multipliers: only cut joints can be redundant.
void warn_of_redundancy(const Linkage& linkage, Preparation& p) {
  const int rows = compile(linkage).mechanism.cut_row_count();
  const int held = p.model.mechanism.cut_row_count();
  const ClosureEquations e =
      compute_closure_equations(p.model.mechanism, p.model.parameters, p.model.start);
  const int rank = held > 0 ? numerical_rank(e.jacobian, kRankTolerance).rank : 0;
  if (rank == rows) return;
  p.warnings.push_back(std::to_string(rows - rank) + " of " + std::to_string(rows) +
                       " closure equations are redundant at the start: multipliers are those "
                       "of least norm, single reactions are not unique");
  const auto& closures = p.model.mechanism.closures;
  const bool drifts = std::any_of(closures.begin(), closures.end(), [](const auto& c) {
    return c.model == ClosureModel::cut && c.stabilization == Stabilization::none;
  });
  if (rank == held || !drifts) return;
  p.warnings.push_back(
      "redundant cut joints without stabilization drift apart, which may change how many equations "
      "are redundant: use stabilization = \"baumgarte\" or \"projection\"");
}

bool accept_velocities(const AssemblyReport& a, Preparation& p) {
  if (a.velocity_residual <= 1e-6) return true;
  fail(p, Cause::assembly_failed,
       "the held velocities do not fit the closures: residual " + number(a.velocity_residual));
  return false;
}

void warn_of_flipped(const AssemblyReport& a, Preparation& p) {
  for (const std::string& name : a.flipped) {
    p.warnings.push_back("closure '" + name +
                         "': the axes of its two ends point against each other at the start; turn "
                         "one of its frames by 180 deg, or start nearer to the pose you mean");
  }
}

bool assemble(const Linkage& linkage, const Model& closed, Preparation& p) {
  p.assembly = assemble_start(closed, p.model.start);
  const AssemblyReport& a = p.assembly;
  if (!a.closed) {
    fail(p, Cause::assembly_failed,
         "closure '" + a.worst_closure + "' cannot be closed from the given start: residual " +
             number(a.residual) + " after " + std::to_string(a.restarts) + " restarts");
    return false;
  }
  if (!accept_velocities(a, p)) return false;
  if (a.restarts > 0) {
    p.warnings.push_back("the given start did not lead to a closed pose; used restart " +
                         std::to_string(a.restarts) + ", " + number(a.displacement) + " away");
  }
  warn_of_flipped(a, p);
  warn_of_redundancy(linkage, p);
  return true;
}

// At rest nothing tells where a loose journal lies: equilibrium is that of the ideal joints.
Linkage with_ideal_bearings(const Linkage& linkage) {
  Linkage ideal = linkage;
  for (Closure& c : ideal.closures) {
    if (c.model == ClosureModel::clearance) c.model = ClosureModel::cut;
  }
  return ideal;
}

bool find_equilibrium(const Linkage& linkage, Preparation& p) {
  const Linkage ideal = with_ideal_bearings(linkage);
  p.statics = solve_statics(compile(ideal, find_idle_directions(ideal)), p.model.start);
  if (!p.statics->converged) {
    fail(p, Cause::statics_failed,
         "no static equilibrium after " + std::to_string(p.statics->iterations) +
             " iterations: force residual " + number(p.statics->force_residual));
    return false;
  }
  if (p.statics->stability == Stability::unstable) {
    p.warnings.push_back("the static equilibrium at the start is unstable");
  }
  return true;
}

void warn_of_step(const SimulationOptions& options, Preparation& p) {
  if (options.integrator != Integrator::rk4) return;  // they choose their own
  const double h = make_step_grid(options).h;
  const double product = h * p.spectrum.omega_max;
  if (h > p.spectrum.step_limit) {
    p.warnings.push_back("simulation.step = " + number(h) + " s is past the stability limit " +
                         number(p.spectrum.step_limit) +
                         " s of RK4 (omega_max = " + number(p.spectrum.omega_max) + " rad/s)");
  } else if (product > kAccuracyLimit) {
    p.warnings.push_back("h omega_max = " + number(product) +
                         ": stable, but the stiffest motion is not resolved; a step below " +
                         number(kAccuracyLimit / p.spectrum.omega_max) + " s is");
  }
}

// Turn of the second frame about the common x axis of closure i at a state, rad.
double turn_of(const Model& model, const State<double>& s, std::size_t i) {
  Workspace<double> w = make_workspace<double>(model.mechanism);
  compute_motion(model.mechanism, model.parameters, s, w);
  const Vec3<double>& y = w.closures[i].r2.y;
  return std::atan2(dot(y, w.closures[i].r1.z), dot(y, w.closures[i].r1.y));
}

// What is known here is the start: a run may still turn such a joint too far.
void warn_of_tilt(const Linkage& linkage, Preparation& p) {
  for (std::size_t i = 0; i < linkage.closures.size(); ++i) {
    const Closure& c = linkage.closures[i];
    const bool turns = c.sde.stiffness[kPhi] == 0.0;
    const bool tilts = c.sde.stiffness[kTheta] != 0.0 || c.sde.stiffness[kPsi] != 0.0;
    if (c.model != ClosureModel::sde || c.sde.tilt != TiltMeasure::linearized || !turns || !tilts) {
      continue;
    }
    const double turn = std::abs(turn_of(p.model, p.model.start, i)) * 180.0 / std::numbers::pi;
    if (turn <= kLinearTurn) continue;
    p.warnings.push_back("closure '" + c.name + "': its ends are turned by " + number(turn) +
                         " deg at the start; tilt = \"linearized\" is meant for up to 45 deg and "
                         "holds no tilt in one direction at 90 deg: use tilt = \"axis\"");
  }
}

}  // namespace

Preparation prepare(const Linkage& linkage, const SimulationOptions& options) {
  Preparation p;
  p.model = compile(linkage, find_idle_directions(linkage));
  const Model closed = compile_closed(linkage);
  if (!assemble(linkage, closed, p)) return p;
  resolve_damping(linkage, p.model.start, p.model);
  const std::vector<double> velocities = p.model.start.v;
  if (options.start == Start::equilibrium) {
    if (!find_equilibrium(linkage, p)) return p;
    p.model.start.v = velocities;
    // Statics moved the pose, still closed; velocities must fit the cut joints there.
    if (p.model.mechanism.sde_rows.empty() &&
        !accept_velocities(assemble_start(closed, p.model.start), p)) {
      return p;
    }
  }
  p.spectrum = compute_spectrum(p.model, p.model.start);
  warn_of_step(options, p);
  warn_of_tilt(linkage, p);
  return p;
}

}  // namespace linkstudy

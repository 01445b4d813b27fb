#include "core/simulation/prepare.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "core/dynamics/effective_mass.h"
#include "core/dynamics/motion.h"
#include "core/dynamics/static_balance.h"
#include "core/forces/constant_friction.h"
#include "core/kinematics/forward_kinematics.h"
#include "core/kinematics/idle_rows.h"
#include "core/kinematics/mobility.h"
#include "core/kinematics/three_turns.h"
#include "core/model/loop_joints.h"
#include "core/model/undriven.h"
#include "core/simulation/motion_start.h"
#include "core/simulation/simulate.h"
#include "core/spatial/rotation_vector.h"
#include "core/topology/resting_motions.h"

namespace linkstudy {
namespace {

constexpr double kLinearTurn = 45.0;         // deg
constexpr double kLargeTurn = 150.0;         // deg
constexpr double kFoundVelocity = 1e-9;      // of the largest given velocity: more is a motion
constexpr double kVelocityTolerance = 1e-6;  // of the largest velocity
constexpr double kStatedVelocity = 1e-3;     // of the largest: stated ones are rounded
constexpr double kSlightEffort = 1e-9;       // of the largest weight or load
constexpr double kSlightForce = 1e-6;        // N
constexpr double kPressed = 0.05;  // of the clearance: a journal that rests on its bearing

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}

void fail(Preparation& p, Cause cause, std::string message) {
  p.cause = cause;
  p.message = std::move(message);
}

// Joints that hold a motion twice, " (a, b)", or nothing.
std::string holding_joints(const MobilityReport& r) {
  std::string names;
  for (const CarriedRedundancy& joint : r.redundant_joints) {
    names += (names.empty() ? " (held twice: " : ", ") + joint.joint;
  }
  return names.empty() ? names : names + ")";
}

// Which of the reactions that balance the linkage are taken.
std::string taken_text(RedundantReactions way) {
  const std::string text =
      ": single reactions are not unique, the compliance of joints and links decides them; "
      "simulation.redundant_reactions = ";
  if (way == RedundantReactions::loops) {
    return text +
           "\"loops\": those of all joints of the loops are least together, moments and forces "
           "times the spread of the joints";
  }
  return text +
         "\"cut\": multipliers of the cut joints are those of least norm, tree joints bear the "
         "rest; \"loops\" lets all joints of the loops share";
}

// Whether the linkage has fewer independent equations everywhere, or at the start only.
void describe_redundancy(const Linkage& linkage, RedundantReactions way, int redundant, int rows,
                         Preparation& p) {
  Linkage cuts = linkage;
  std::erase_if(cuts.closures, [](const Closure& c) { return c.model == ClosureModel::sde; });
  const MobilityReport r = analyse_mobility(compile(cuts), p.model.start);
  if (r.state == SingularState::instantaneous) {
    p.warnings.push_back("the start is a singular position: " + std::to_string(r.rank.rank) +
                         " of " + std::to_string(rows) +
                         " closure equations are independent there, " +
                         std::to_string(r.regular_rank) +
                         " around it; reactions there are not determined: start elsewhere");
    return;
  }
  p.warnings.push_back(std::to_string(redundant) + " of " + std::to_string(rows) +
                       " closure equations are redundant at the start" + holding_joints(r) +
                       taken_text(way));
}

// Replacement joints have no multipliers: only cut joints can be redundant.
void warn_of_redundancy(const Linkage& linkage, RedundantReactions way,
                        const std::vector<unsigned>& idle, Preparation& p) {
  const int held = p.model.mechanism.cut_row_count();
  int rows = held;
  for (const unsigned directions : idle) rows += std::popcount(directions);
  const int rank = closure_rank(p.model.mechanism, p.model.parameters, p.model.start);
  if (rank == rows) return;
  describe_redundancy(linkage, way, rows - rank, rows, p);
  const auto& closures = p.model.mechanism.closures;
  const bool drifts = std::any_of(closures.begin(), closures.end(), [](const auto& c) {
    return c.model == ClosureModel::cut && c.stabilization == Stabilization::none;
  });
  if (rank == held || !drifts) return;
  p.warnings.push_back(
      "redundant cut joints without stabilization drift apart, which may change how many equations "
      "are redundant: use stabilization = \"baumgarte\" or \"projection\"");
}

const std::string& joint_of(const Mechanism& m, VelocityIndex velocity) {
  return m.joint_names[m.velocities[velocity].body];
}

// Joints with hold = true, and those of prescribed motions, "A, B".
std::string held_joints(const Model& model) {
  std::vector<std::string> names;
  for (const VelocityIndex k : model.held) {
    const std::string name = joint_of(model.mechanism, k);
    if (names.empty() || names.back() != name) names.push_back(name);
  }
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text;
}

bool accept_velocities(const AssemblyReport& a, Preparation& p) {
  if (a.velocity_residual <= kVelocityTolerance) return true;
  fail(p, Cause::assembly_failed,
       "the velocities of the held or driven joints (" + held_joints(p.model) +
           ") do not fit the closures: residual " + number(a.velocity_residual) +
           "; let one of them go, or give them velocities that belong together");
  return false;
}

std::string held_advice(const Model& model) {
  const std::string held = held_joints(model);
  if (held.empty()) return {};
  return "; held where they are: " + held + " (hold = true, or a motion)";
}

// The pose that was found, to be written into the model. All digits: a start that is closed is
// taken as it is.
std::string pose_text(const Model& model) {
  std::string text;
  for (const BodyIndex b : bodies_outwards(model.mechanism)) {
    const Body& body = model.mechanism.bodies[b];
    if (body.q_count == 0) continue;
    text += "\n    initial.position = [";
    for (int i = 0; i < body.q_count; ++i) {
      char value[32];
      std::snprintf(value, sizeof value, "%.17g", model.start.q[body.q_begin + i]);
      text += (i > 0 ? ", " : "") + std::string(value);
      if (text.find_first_of(".en", text.size() - std::string(value).size()) == std::string::npos) {
        text += ".0";
      }
    }
    text += "]  # of joint " + model.mechanism.joint_names[b];
  }
  return text;
}

// Closed but for the clearances, the journals within their bearings: then that is what is meant.
// Otherwise a run begins with journals in the middle.
bool keep_loose_journals(const Linkage& linkage, const std::vector<unsigned>& idle,
                         const State<double>& given, Preparation& p) {
  if (p.model.mechanism.clearances.empty()) return false;
  State<double> start = given;
  const AssemblyReport a = assemble_start(compile_start(linkage, idle), start);
  if (!a.closed || a.restarts > 0 || a.velocity_residual > kVelocityTolerance) return false;
  const Mechanism& m = p.model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  compute_motion(m, p.model.parameters, start, w);
  for (const ContactIndex i : indices_of(m.contacts)) {
    const ClearanceIndex c = m.contacts[i].clearance;
    if (!c.exists()) continue;
    if (w.contacts[i].depth > kPressed * p.model.parameters.clearances[c].radial) return false;
  }
  p.model.start = start;
  if (!p.assembly.closed) p.assembly = a;
  return true;
}

// The smallest change that fits the closures may leave little of a velocity that was asked for.
void warn_of_changed_velocities(const Linkage& linkage, const State<double>& given,
                                Preparation& p) {
  const Mechanism& m = p.model.mechanism;
  double largest = 0.0;
  for (const double v : given.v) largest = std::max(largest, std::abs(v));
  const bool elastic = std::any_of(linkage.closures.begin(), linkage.closures.end(), [](auto& c) {
    return c.model == ClosureModel::sde && c.sde.start == SdeStart::closed;
  });
  for (const VelocityIndex k : velocities(m)) {
    const double asked = given.v[k], got = p.model.start.v[k];
    if (asked == 0.0 && std::abs(got) > kFoundVelocity * largest) p.found_velocities.push_back(k);
    if (asked == 0.0 || std::abs(got - asked) <= kStatedVelocity * largest) continue;
    p.warnings.push_back(velocity_name(m, k) + ": its initial velocity is " + number(got) +
                         " instead of the given " + number(asked) +
                         ", so that the closures stay shut: hold = true keeps it" +
                         (elastic ? "; closure.*.sde.start = \"given\" lets an sde begin deflected "
                                    "and moving"
                                  : ""));
  }
}

bool assemble(const Linkage& linkage, const std::vector<unsigned>& idle, const Model& closed,
              RedundantReactions way, Preparation& p) {
  const State<double> given = p.model.start;
  p.assembly = assemble_start(closed, p.model.start);
  const bool loose = keep_loose_journals(linkage, idle, given, p);
  const AssemblyReport& a = p.assembly;
  if (!a.closed) {
    fail(p, Cause::assembly_failed,
         "the given start cannot be closed: " + open_text(a) + ", after " +
             std::to_string(a.restarts) + " restarts" + held_advice(p.model));
    return false;
  }
  if (!loose && !accept_velocities(a, p)) return false;
  const std::string overdriven = overdriven_text(p.model);
  if (!overdriven.empty()) {
    fail(p, Cause::assembly_failed, overdriven);
    return false;
  }
  for (std::string& text : motion_warnings(linkage, p.model)) p.warnings.push_back(std::move(text));
  warn_of_changed_velocities(linkage, given, p);
  if (!loose && a.restarts > 0) {
    p.warnings.push_back("the given start did not lead to a closed pose; used restart " +
                         std::to_string(a.restarts) + ", " + number(a.displacement) +
                         " away. To begin there:" + pose_text(p.model));
  }
  for (std::string& text : flipped_texts(a)) p.warnings.push_back(std::move(text));
  warn_of_redundancy(linkage, way, idle, p);
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

Linkage with_deflected_sdes(Linkage linkage) {
  for (Closure& c : linkage.closures) c.sde.start = SdeStart::given;
  return linkage;
}

// A run lets go of what statics holds.
void warn_of_holding(const Model& at_rest, const StaticsReport& statics, Preparation& p) {
  const double slight = kSlightEffort * force_scale(at_rest, statics.time);
  for (const VelocityIndex k : at_rest.held) {
    const double effort = is_driven(at_rest.mechanism, k) ? 0.0 : statics.holding[k.value()];
    if (std::abs(effort) <= slight) continue;
    p.warnings.push_back("the equilibrium holds " + velocity_name(at_rest.mechanism, k) + " with " +
                         number(effort) + " " + effort_unit(at_rest.mechanism, k) +
                         " (hold = true); a run lets it go");
  }
}

bool find_equilibrium(const Linkage& linkage, double time, Preparation& p) {
  const Linkage ideal = with_resting_motions(with_ideal_bearings(linkage));
  const Model at_rest = compile(ideal, find_idle_directions(ideal));
  State<double> s = at_rest.start;  // with bristles of its own
  s.t = time;
  s.q = p.model.start.q;
  p.statics = solve_statics(at_rest, s);
  p.model.start.q = s.q;
  if (!p.statics->converged) {
    const std::string& reason = p.statics->reason;
    const std::string angles =
        singular_angles_text(singular_angles(p.model.mechanism, p.model.start.q));
    fail(p, Cause::statics_failed,
         "no static equilibrium after " + std::to_string(p.statics->iterations) +
             " iterations, force residual " + number(p.statics->force_residual) +
             (reason.empty() ? "" : ": " + reason) + (angles.empty() ? "" : "; " + angles));
    return false;
  }
  if (p.statics->descended) {
    p.warnings.push_back(
        "there is no equilibrium near the given pose (a limit load is passed): the "
        "one found downhill from there is " +
        number(p.statics->displacement) + " rad or m away");
  }
  warn_of_holding(at_rest, *p.statics, p);
  if (p.statics->stability == Stability::unstable) {
    p.warnings.push_back("the static equilibrium at the start is unstable");
  }
  return true;
}

template <std::size_t Count>
void slide_steadily(const LugreParameters<double>& law, const std::array<double, Count>& u,
                    double* z) {
  const double speed = lugre_speed(u);
  if (speed == 0.0) return;
  const double deflection = lugre_sliding(law, speed) / (law.sigma0 * speed);
  for (std::size_t k = 0; k < Count; ++k) z[k] = deflection * u[k];
}

void slide_constant_frictions(Model& model) {
  const Mechanism& m = model.mechanism;
  if (m.constant_frictions.empty()) return;
  State<double>& start = model.start;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, start.q.data(), start.v.data(), w);
  for (const ConstantFrictionIndex i : indices_of(m.constant_frictions)) {
    const ConstantFrictionStructure& s = m.constant_frictions[i];
    const ConstantFrictionParameters<double>& n = model.parameters.constant_frictions[i];
    const auto slide = [&]<std::size_t Count>() {
      slide_steadily(n.law, sliding_speeds<Count>(s, n, start.v.data(), w), &start.z[s.z]);
    };
    if (s.count == 1) slide.template operator()<1>();
    if (s.count == 2) slide.template operator()<2>();
    if (s.count == 3) slide.template operator()<3>();
  }
}

// A joint that slides at the start has done so before: its bristles are those of steady sliding.
void slide_bristles(Model& model) {
  slide_constant_frictions(model);
  for (const FrictionIndex i : indices_of(model.mechanism.frictions)) {
    const JointFrictionStructure& f = model.mechanism.frictions[i];
    const JointFrictionParameters<double>& n = model.parameters.frictions[i];
    const auto rate = [&](VelocityIndex v, double factor) {
      return v.exists() ? factor * model.start.v[v] : 0.0;
    };
    const double turning = rate(f.turn, n.radius), sliding = rate(f.slide, 1.0);
    const double speed = std::hypot(turning, sliding);
    if (speed == 0.0) continue;
    const double deflection = lugre_sliding(n.law, speed) / (n.law.sigma0 * speed);
    double* z = &model.start.z[f.z];
    if (f.turn.exists()) *z++ = deflection * turning;
    if (f.slide.exists()) *z = deflection * sliding;
  }
}

void warn_of_step(const SimulationOptions& options, Preparation& p) {
  if (options.integrator != Integrator::rk4) return;  // they choose their own
  const double h = make_step_grid(options).h;
  const double product = h * p.spectrum.omega_max;
  if (h > p.spectrum.step_limit) {
    p.step_warning = "simulation.step = " + number(h) + " s is past the stability limit " +
                     number(p.spectrum.step_limit) +
                     " s of RK4 (omega_max = " + number(p.spectrum.omega_max) + " rad/s)";
  } else if (product > kAccuracyLimit) {
    p.step_warning = "h omega_max = " + number(product) +
                     ": stable, but the stiffest motion is not resolved; a step below " +
                     number(kAccuracyLimit / p.spectrum.omega_max) + " s is";
  }
}

// Turn of the second frame about the common x axis of closure i at a state, rad.
double turn_of(const Model& model, const State<double>& s, ClosureIndex i) {
  Workspace<double> w = make_workspace<double>(model.mechanism);
  compute_motion(model.mechanism, model.parameters, s, w);
  const ClosureState<double>& x = w.closures[i];
  return std::atan2(dot(x.R_WS.y, x.R_WF.z), dot(x.R_WS.y, x.R_WF.y));
}

// Half a turn ends the law of the rotation vector.
void warn_of_large_turn(const Linkage& linkage, Preparation& p) {
  const Mechanism& m = p.model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  compute_motion(m, p.model.parameters, p.model.start, w);
  for (std::size_t i = 0; i < linkage.closures.size(); ++i) {
    const Closure& c = linkage.closures[i];
    const bool measured = c.model == ClosureModel::sde && c.sde.tilt == TiltMeasure::angle;
    if (!measured || !m.closures[ClosureIndex(i)].needs_frames) continue;
    const ClosureState<double>& x = w.closures[ClosureIndex(i)];
    const Vec3<double> phi = rotation_vector(x.R_WF, x.R_WS).phi;
    const double turn = std::sqrt(dot(phi, phi)) * 180.0 / std::numbers::pi;
    if (turn <= kLargeTurn) continue;
    p.warnings.push_back("closure '" + c.name + "': its ends are turned by " + number(turn) +
                         " deg at the start; the moment of tilt = \"angle\" changes sign at 180 "
                         "deg: turn one of the closure's frames nearer to the pose without moment");
  }
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
    const double turn =
        std::abs(turn_of(p.model, p.model.start, ClosureIndex(i))) * 180.0 / std::numbers::pi;
    if (turn <= kLinearTurn) continue;
    p.warnings.push_back("closure '" + c.name + "': its ends are turned by " + number(turn) +
                         " deg at the start; tilt = \"linearized\" is meant for up to 45 deg and "
                         "holds no tilt in one direction at 90 deg: use tilt = \"axis\"");
  }
}

// Its direction is not known where it begins.
void warn_of_shut_springs(const Linkage& linkage, Preparation& p) {
  const Mechanism& m = p.model.mechanism;
  if (m.point_springs.empty()) return;
  Workspace<double> w = make_workspace<double>(m);
  compute_motion(m, p.model.parameters, p.model.start, w);
  for (std::size_t i = 0; i < linkage.springs.size(); ++i) {
    const PointSpringState<double>& x = w.point_springs[PointSpringIndex(i)];
    if (x.length > kClosedTolerance || std::abs(x.force) <= kSlightForce) continue;
    p.warnings.push_back("spring '" + linkage.springs[i].name +
                         "': its points coincide at the start, where its force of " +
                         number(x.force) +
                         " N has no direction; where they coincide exactly, "
                         "none acts: place its ends apart");
  }
}

}  // namespace

Preparation prepare(const Linkage& linkage, const SimulationOptions& options) {
  Preparation p;
  const std::vector<unsigned> idle = find_idle_directions(linkage);
  p.model = compile(linkage, idle);
  const Model closed = compile_start(with_ideal_bearings(linkage));
  const RedundantReactions way = options.redundant_reactions;
  if (way == RedundantReactions::loops) add_loop_joints(linkage, p.model.mechanism);
  if (!assemble(linkage, idle, closed, way, p)) return p;
  resolve_damping(linkage, p.model.start, p.model);
  const IndexedVector<VelocityIndex, double> velocities = p.model.start.v;
  if (options.start == Start::equilibrium) {
    if (!find_equilibrium(linkage, options.statics_time, p)) return p;
    p.model.start.v = velocities;
    // Statics moved the pose, still closed; velocities must fit the cut joints there.
    const Model exact = compile_start(with_deflected_sdes(with_ideal_bearings(linkage)));
    if (!accept_velocities(assemble_start(exact, p.model.start), p)) return p;
  }
  slide_bristles(p.model);
  p.spectrum = compute_spectrum(p.model, p.model.start);
  warn_of_step(options, p);
  warn_of_tilt(linkage, p);
  warn_of_large_turn(linkage, p);
  warn_of_shut_springs(linkage, p);
  return p;
}

}  // namespace linkstudy

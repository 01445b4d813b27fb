// Everything an evaluation of the equations of motion writes. Made once per run; the step loop
// allocates nothing.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "core/base/indices.h"
#include "core/laws/prescribed_motion.h"
#include "core/model/mechanism.h"
#include "core/numerics/null_space_fit.h"
#include "core/numerics/redundant_system.h"
#include "core/spatial/spatial.h"

namespace linkstudy {

// Monogram notation (core/README.md): W is the ground, B the body's internal frame, P its parent's.
// Vectors in ground axes; moments about the body's own internal origin.
template <class Real>
struct BodyState {
  Mat3<Real> R_WB;
  Vec3<Real> p_WB;          // m
  Vec3<Real> p_PB_W;        // p_WB less that of the parent
  Vec3<Real> w_WB;          // angular velocity
  Vec3<Real> v_WB;          // velocity of the origin
  Vec3<Real> alpha_WB;      // angular acceleration for qdd = 0, prescribed ones aside
  Vec3<Real> a_WB;          // acceleration of the origin then, less gravity
  Inertia<Real> inertia;    // of the body and, in `composite`, of all bodies outboard
  Inertia<Real> composite;  // of bodies that carry others; else `inertia` is meant
  Wrench<Real> wrench;      // that moves the body (then: and all outboard) with qdd = 0
};

// Closure points and frames.
template <class Real>
struct ClosureState {
  Vec3<Real> p_WF, p_WS;      // of the frames F on the first body and S on the second, m
  Vec3<Real> p_BF_W, p_BS_W;  // from the origin of its own body each
  Vec3<Real> v_WF, v_WS;      // m/s
  Mat3<Real> R_WF, R_WS;      // where rows need them
  // Closure force on chain 1: acting at F there and at S on chain 2, acting at S on both,
  // couple.
  Vec3<Real> force_points;
  Vec3<Real> force_second;
  Vec3<Real> couple;
  // Forces of the contacts of a clearance on chain 1, and their moment about F.
  Vec3<Real> contact_force;
  Vec3<Real> contact_moment;
  // Couple on the second body by which it feels more than the opposite of these.
  Vec3<Real> contact_surplus;
};

// One place where a journal can touch its bearing.
template <class Real>
struct ContactState {
  Vec3<Real> eccentricity;  // from the journal's axis to the bearing's, across the latter, m
  Real depth, rate;         // penetration (negative: gap left), m, and its rate, m/s
  Real normal, elastic;     // normal force and its elastic part, N
  Real speed;               // of the journal against the bearing along a x u, m/s
  Real friction;            // against this speed, N
  Real approach;            // speed at which this contact began, m/s
  Real relaxation;          // of the bristle, 1/s; 0 where it does not touch
};

// What a contact remembers of the accepted states; constant during a step. As made here it is a
// contact without a past: elastic.
template <class Real>
struct ContactMemory {
  Real depth = Real(0.0), rate = Real(0.0);                       // at the last accepted state
  Real touching = Real(1.0);                                      // 1 in contact, 0 not
  Real approach = Real(std::numeric_limits<double>::infinity());  // speed of this contact, m/s
  Real least_depth = Real(0.0);  // no force below: infinity where a located run holds it open
};

// The line of a spring between two points, and its force.
template <class Real>
struct PointSpringState {
  Vec3<Real> arm_1, arm_2;  // from the origins of the bodies to the points
  Real length, rate;        // m, m/s
  Real elastic, force;      // f_e, and all with the actuator's, N: positive together
  Vec3<Real> pull;          // on the first body, its opposite on the second
};

// Friction in a tree joint: normal load, sliding velocity, coefficient and generalised force, each
// along the turn and along the slide.
template <class Real>
struct JointFrictionState {
  Real load;               // N
  Real mu_turn, mu_slide;  // along the sliding velocity
  Real on_turn, on_slide;  // N m, N: against the motion
  Real relaxation;         // of its bristles, 1/s
  // Scratch of the search for loads: gaps to what the reactions ask for, last change, products.
  Real gap, next_gap, change, missed, row;
};

// Of friction under a constant load: generalised forces against the rates, of a ball about the
// child's axes.
template <class Real>
struct ConstantFrictionState {
  std::array<Real, 3> effort{Real(0.0), Real(0.0), Real(0.0)};  // N or N m
  Real relaxation = Real(0.0);                                  // of its bristles, 1/s
};

template <class Real>
using BodyStates = IndexedVector<BodyIndex, BodyState<Real>>;

// Scratch and result of reactions in tree joints (core/dynamics/reactions.h).
template <class Real>
struct Reactions {
  BodyStates<Real> moving;                          // with their true accelerations
  IndexedVector<BodyIndex, Wrench<Real>> on_child;  // [0] the sum on ground, about its origin
};

// One direction of a closure. Unit wrench: `force` on the line of action and `couple`.
template <class Real>
struct RowState {
  Real d;             // displacement, m or 1
  Real rate;          // of d
  Real bias;          // second derivative of d for qdd = 0
  Real value;         // multiplier or sde force, on chain 1, N or N m
  Vec3<Real> force;   // direction of the force at the point, or zero
  Vec3<Real> couple;  // direction of the torque, or zero
};

// Scratch and result of core/dynamics/shared_reactions.h.
template <class Real>
struct SharedReactions {
  unsigned redundant = 0;  // lanes with something to share, one bit each
  IndexedVector<LoopJointIndex, Wrench<Real>> change;
  IndexedVector<LoopJointIndex, Wrench<Real>> borne;  // by the multipliers
  IndexedVector<LoopJointIndex, Real> length;         // l, m
  IndexedVector<LoopRowIndex, RowState<Real>> rows;
  IndexedVector<LoopRowIndex, Real> row_scale;  // l or 1
  IndexedMatrix<LoopRowIndex, VelocityIndex, Real> jacobian;
  // Of a multiplier 1 on the reactions.
  IndexedMatrix<LoopRowIndex, LoopJointIndex, Wrench<Real>> effect;
  std::array<NullSpaceFit, RealTraits<Real>::lanes> fits;
};

template <class Real>
struct Workspace {
  BodyStates<Real> bodies;
  IndexedVector<VelocityIndex, Vec3<Real>> axes;  // of each velocity, ground axes
  IndexedVector<ClosureIndex, ClosureState<Real>> closures;
  // (nv, nv) lower triangle: mass matrix, then its factor L
  IndexedMatrix<VelocityIndex, VelocityIndex, Real> mass;
  IndexedVector<VelocityIndex, Real> inverse_pivot;    // 1 / D
  IndexedVector<VelocityIndex, Real> tau;              // generalised forces less bias
  IndexedVector<VelocityIndex, Real> y;                // L^-T tau
  IndexedVector<VelocityIndex, Real> qdd;              // 0 where the motion is prescribed
  IndexedVector<LoadIndex, Wrench<Real>> link_loads;   // about the body's origin
  IndexedVector<RowIndex, RowState<Real>> cut_rows;    // (nc)
  IndexedVector<RowIndex, RowState<Real>> sde_rows;    // (ns)
  IndexedMatrix<RowIndex, VelocityIndex, Real> cut_y;  // (nc, nv) L^-T J^T, by row
  IndexedMatrix<RowIndex, RowIndex, Real> schur;       // (nc, nc) J M^-1 J^T, then its factor
  IndexedVector<RowIndex, Real> schur_rhs;             // (nc)
  IndexedVector<RowIndex, Real> row_inverse;           // (nc) 1 / pivot of the factor
  IndexedVector<ContactIndex, ContactState<Real>> contacts;
  IndexedVector<ContactIndex, ContactMemory<Real>> memory;
  IndexedVector<PointSpringIndex, PointSpringState<Real>> point_springs;
  // |slope| + damping, whatever their units: at which states they limit the step.
  IndexedVector<BendIndex, Real> spring_weights;
  IndexedVector<FrictionIndex, JointFrictionState<Real>> frictions;
  IndexedVector<ConstantFrictionIndex, ConstantFrictionState<Real>> constant_frictions;
  IndexedVector<VelocityIndex, Real> friction_tau;  // of joints with friction
  // Of d gap / d load, negative.
  IndexedMatrix<FrictionIndex, FrictionIndex, Real> friction_inverse;
  IndexedVector<BristleIndex, Real> z;  // set before an evaluation
  IndexedVector<BristleIndex, Real> z_rate;
  Reactions<Real> reactions;  // where joints have friction
  IndexedVector<MotionIndex, CoordinateMotion<Real>>
      motions;  // prescribed ones, at the time of the evaluation
  // Of M: prescribed coordinates beside their motion_support.
  IndexedVector<MotionSupportIndex, Real> motion_mass;
  IndexedMatrix<MotionIndex, RowIndex, Real> motion_rows;  // their columns of J
  IndexedVector<MotionIndex, Real> efforts;                // that they take, N or N m
  Real supplied_power = Real(0.0);                         // W
  Real dissipated_power = Real(0.0);                       // W
  Real contact_power = Real(0.0);                          // of it, in contacts
  // Lanes whose cut rows depend on each other or nearly, so that `schur` holds no factor of theirs;
  // and the number of independent rows, in each lane its own.
  typename RealTraits<Real>::Mask redundant{};
  Real kept_rows = Real(0.0);
  unsigned jammed = 0;  // lanes whose joint friction found no balance with the reactions
  // For these lanes (core/closures/redundant_rows.h).
  IndexedMatrix<RowIndex, VelocityIndex, Real> cut_jacobian;  // (nc, nv) J
  IndexedVector<RowIndex, Real> row_scale;                    // (nc) m or 1
  // Scratch of core/closures/clear_rows.h.
  IndexedMatrix<RowIndex, RowIndex, Real> independence;  // (nc, nc)
  IndexedVector<RowIndex, Real> independence_inverse;    // (nc)
  IndexedVector<VelocityIndex, Real> velocity_scale;     // 1 or 1/m
  bool rows_may_depend = true;  // false in a trace that is to hold where they do not
  RedundantSystem<Real> redundant_system;
  std::vector<SharedReactions<Real>> shared;  // one, where joint friction needs it
};

// Ground axes are constant: their unit forces are set here and never written again.
template <class Real>
inline void set_ground_axis(const Row& row, RowState<Real>& state) {
  state.force = state.couple = zero3<Real>();
  if (row.kind != RowKind::translation_ground) return;
  const Mat3<Real> e = identity3<Real>();
  state.force = row.axis == 0 ? e.x : row.axis == 1 ? e.y : e.z;
}

template <class Real, class Index>
IndexedVector<Index, RowState<Real>> make_rows(const IndexedVector<Index, Row>& rows) {
  IndexedVector<Index, RowState<Real>> states(rows.size());
  for (const Index r : indices_of(rows)) set_ground_axis(rows[r], states[r]);
  return states;
}

// One where the mechanism has loop_joints.
template <class Real>
std::vector<SharedReactions<Real>> make_shared_reactions(const Mechanism& m) {
  std::vector<SharedReactions<Real>> one;
  if (m.loop_joints.empty()) return one;
  SharedReactions<Real>& s = one.emplace_back();
  const auto joints = m.loop_joints.size(), rows = m.loop_rows.size();
  s.change.resize(joints);
  s.borne.resize(joints);
  s.length.resize(joints);
  s.rows = make_rows<Real>(m.loop_rows);
  s.row_scale.resize(rows);
  s.jacobian = {rows, static_cast<std::size_t>(m.nv), Real(0.0)};
  s.effect = {rows, joints, {}};
  int counted = 0;
  for (const LoopJoint& joint : m.loop_joints) counted += joint.counts ? 6 : 0;
  for (NullSpaceFit& fit : s.fits) {
    fit = NullSpaceFit(static_cast<int>(rows), m.nv, 6 * static_cast<int>(joints), counted);
  }
  return one;
}

// Everything zero, and the ground axes set.
template <class Real>
Workspace<Real> make_workspace(const Mechanism& m) {
  const auto nv = static_cast<std::size_t>(m.nv);
  const auto nc = m.cut_rows.size();
  Workspace<Real> w;
  w.bodies.resize(m.bodies.size());
  w.axes.resize(nv);
  w.closures.resize(m.closures.size());
  w.mass = {nv, nv, Real(0.0)};
  for (auto* x : {&w.inverse_pivot, &w.tau, &w.y, &w.qdd}) x->assign(nv, Real(0.0));
  w.link_loads.resize(m.loads.size());
  w.contacts.resize(m.contacts.size());
  w.memory.resize(m.contacts.size());
  w.point_springs.resize(m.point_springs.size());
  w.spring_weights.assign(static_cast<std::size_t>(m.bent_springs), Real(0.0));
  w.frictions.resize(m.frictions.size());
  w.constant_frictions.resize(m.constant_frictions.size());
  w.friction_inverse = {m.frictions.size(), m.frictions.size(), Real(0.0)};
  w.friction_tau.assign(m.frictions.empty() ? 0 : nv, Real(0.0));
  for (auto* x : {&w.z, &w.z_rate}) x->assign(static_cast<std::size_t>(m.nz), Real(0.0));
  if (!m.frictions.empty()) {
    w.reactions.moving.resize(m.bodies.size());
    w.reactions.on_child.resize(m.bodies.size());
  }
  w.cut_rows = make_rows<Real>(m.cut_rows);
  w.sde_rows = make_rows<Real>(m.sde_rows);
  w.motions.resize(m.motions.size());
  w.motion_mass.assign(m.motion_support.size(), Real(0.0));
  w.motion_rows = {m.motions.size(), nc, Real(0.0)};
  w.efforts.assign(m.motions.size(), Real(0.0));
  w.cut_y = {nc, nv, Real(0.0)};
  w.schur = {nc, nc, Real(0.0)};
  w.cut_jacobian = {nc, nv, Real(0.0)};
  w.independence = {nc, nc, Real(0.0)};
  w.independence_inverse.assign(nc, Real(0.0));
  w.schur_rhs.assign(nc, Real(0.0));
  w.row_inverse.assign(nc, Real(1.0));
  w.row_scale.assign(nc, Real(1.0));
  w.velocity_scale.assign(nv, Real(1.0));
  w.redundant_system = RedundantSystem<Real>(m.cut_row_count(), m.nv);
  if (!m.frictions.empty()) w.shared = make_shared_reactions<Real>(m);
  return w;
}

}  // namespace linkstudy

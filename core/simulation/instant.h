// Values of channels at one instant of a run, read from what the evaluation left in the Workspace.
#pragma once

#include "core/closures/closure_wrench.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/reactions.h"
#include "core/dynamics/shared_reactions.h"
#include "core/forces/end_stops.h"
#include "core/kinematics/point_motion.h"
#include "core/simulation/channels.h"

namespace linkstudy {

// Values of one instant from which channels are read. Reactions, accelerations of bodies and
// energies are computed when a channel first asks for them. Reactions are shared where the
// mechanism has loop_joints.
template <class Real>
class Instant {
 public:
  Instant(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w)
      : m_(m),
        p_(p),
        w_(w),
        reactions_(make_reactions<Real>(m)),
        shared_(make_shared_reactions<Real>(m)) {}

  // y: core/simulation/run_state.h; w must hold the evaluation at (t, y).
  void move_to(Real t, const Real* y) {
    t_ = t;
    y_ = y;
    has_reactions_ = has_accelerations_ = has_energy_ = false;
  }
  void set_initial_energy(Real e) { initial_energy_ = e; }
  Real initial_energy() const { return initial_energy_; }

  Real sample(const Channel& c) {
    switch (c.quantity) {
      case Quantity::time:
        return t_;
      case Quantity::q:
        return y_[c.index];
      case Quantity::v:
        return y_[m_.nq + c.index];
      case Quantity::a:
        return acceleration(VelocityIndex(c.index));
      case Quantity::joint_force:
      case Quantity::joint_torque:
      case Quantity::joint_force_local:
      case Quantity::joint_torque_local:
        return reaction(c);
      case Quantity::closure_force:
        return component(closure_wrench(ClosureIndex(c.index)).force, c.component);
      case Quantity::closure_torque:
        return component(closure_wrench(ClosureIndex(c.index)).torque, c.component);
      case Quantity::closure_gap:
        return component(gap(ClosureIndex(c.index)), c.component);
      case Quantity::eccentricity:
        return eccentricity(c);
      case Quantity::penetration:
        return max(w_.contacts[ContactIndex(c.index)].depth, Real(0.0));
      case Quantity::normal_force:
        return w_.contacts[ContactIndex(c.index)].normal;
      case Quantity::friction_force:
        return w_.contacts[ContactIndex(c.index)].friction;
      case Quantity::bristle:
        return y_[m_.nq + m_.nv + c.index];
      case Quantity::contact_state:
        return contact_state(ClearanceIndex(c.index));
      case Quantity::friction_load:
        return w_.frictions[FrictionIndex(c.index)].load;
      case Quantity::joint_friction:
        return friction(c);
      case Quantity::motion_effort:
        return w_.efforts[MotionIndex(c.index)];
      case Quantity::coupling_effort:
        return -w_.cut_rows[m_.couplings[CouplingIndex(c.index)].row].value;
      case Quantity::motion_power:
        return w_.efforts[MotionIndex(c.index)] * w_.motions[MotionIndex(c.index)].v;
      case Quantity::stop_force:
        return stop_force_on(VelocityIndex(c.index));
      case Quantity::spring_length:
        return w_.point_springs[PointSpringIndex(c.index)].length;
      case Quantity::spring_rate:
        return w_.point_springs[PointSpringIndex(c.index)].rate;
      case Quantity::spring_force:
        return w_.point_springs[PointSpringIndex(c.index)].force;
      case Quantity::point_position:
      case Quantity::point_velocity:
      case Quantity::point_acceleration:
        return component(point(c), c.component);
      default:
        return energy(c.quantity);
    }
  }

  Energy<Real> energy() {
    if (!has_energy_) energy_ = compute_energy(m_, p_, y_, w_);
    has_energy_ = true;
    return energy_;
  }
  Real supplied() const { return y_[m_.nq + m_.nv + m_.nz]; }
  Real dissipated() const { return y_[m_.nq + m_.nv + m_.nz + 1]; }
  Real dissipated_in_contacts() const { return y_[m_.nq + m_.nv + m_.nz + 2]; }
  Real residual() {
    const Energy<Real> e = energy();
    return e.kinetic + e.potential() - initial_energy_ - supplied() + dissipated();
  }

 private:
  Real acceleration(VelocityIndex k) const {
    const MotionIndex motion = m_.velocities[k].motion;
    return motion.exists() ? w_.motions[motion].a : w_.qdd[k];
  }

  ClosureWrench<Real> own_closure_wrench(ClosureIndex c) const {
    return compute_closure_wrench(m_.closures[c], w_.closures[c]);
  }

  // Those under a constant load come behind the others.
  Real friction(const Channel& c) const {
    const int constant = c.index - m_.friction_count();
    if (constant >= 0) {
      return w_.constant_frictions[ConstantFrictionIndex(constant)]
          .effort[static_cast<std::size_t>(c.component)];
    }
    const JointFrictionState<Real>& x = w_.frictions[FrictionIndex(c.index)];
    return c.component == 0 ? x.on_turn : x.on_slide;
  }

  Vec3<Real> gap(ClosureIndex c) const {
    return closure_gap(m_.closures[c], p_.closures[c], w_.closures[c]);
  }

  ClosureWrench<Real> closure_wrench(ClosureIndex c) {
    ClosureWrench<Real> f = own_closure_wrench(c);
    if (shared_.empty()) return f;
    update_all_reactions();
    add_shared(m_, c, shared_.front(), f);
    return f;
  }

  // Along y or z of the bearing's frame, in the middle of the bearing.
  Real eccentricity(const Channel& c) const {
    const ClearanceStructure& s = m_.clearances[ClearanceIndex(c.index)];
    const ClosureState<Real>& x = w_.closures[s.closure];
    const Mat3<Real>& frame = s.bearing_first ? x.R_WF : x.R_WS;
    Vec3<Real> e = w_.contacts[s.contact_begin].eccentricity;
    const ContactIndex last = s.contact_end - 1;
    if (last > s.contact_begin) e = Real(0.5) * (e + w_.contacts[last].eccentricity);
    return dot(c.component == 0 ? frame.y : frame.z, e);
  }

  // 0 free flight, 1 one point, 2 two points on opposite sides, 3 a line (parallel axes: always).
  Real contact_state(ClearanceIndex clearance) const {
    const ClearanceStructure& s = m_.clearances[clearance];
    const ContactState<Real>& a = w_.contacts[s.contact_begin];
    const ContactState<Real>& b = w_.contacts[s.contact_end - 1];
    const Real none(0.0), one(1.0), two(2.0), line(3.0);
    const auto touches_a = a.depth > none, touches_b = b.depth > none;
    const auto same_side = dot(a.eccentricity, b.eccentricity) > none;
    const Real both = select(same_side, line, two);
    return select(touches_a && touches_b, both, select(touches_a || touches_b, one, none));
  }

  // Of both ends of a coordinate.
  Real stop_force_on(VelocityIndex v) const {
    Real force(0.0);
    for (const StopStructure& s : m_.stops) {
      if (s.v == v) force = force - towards_stop(s, w_.contacts[s.contact].normal);
    }
    return force;
  }

  Real energy(Quantity quantity) {
    switch (quantity) {
      case Quantity::kinetic:
        return energy().kinetic;
      case Quantity::potential:
        return energy().potential();
      case Quantity::supplied:
        return supplied();
      case Quantity::dissipated:
        return dissipated();
      case Quantity::dissipated_in_contacts:
        return dissipated_in_contacts();
      default:
        return residual();
    }
  }

  Vec3<Real> point(const Channel& c) {
    const Vec3<Real>& at_body = p_.points[PointIndex(c.index)];
    const BodyState<Real>& body = w_.bodies[c.body];
    if (c.quantity == Quantity::point_position) return point_position(body, at_body);
    if (c.quantity == Quantity::point_velocity) return point_velocity(body, at_body);
    if (!has_accelerations_) update_body_accelerations(m_, p_, w_, reactions_.moving);
    has_accelerations_ = true;
    return point_acceleration(reactions_.moving[c.body], p_.gravity, at_body);
  }

  void update_all_reactions() {
    if (has_reactions_) return;
    update_reactions(m_, p_, w_, reactions_);
    if (!shared_.empty()) {
      update_self_stresses(m_, p_, w_, shared_.front());
      share_reactions(m_, w_, reactions_, shared_.front());
    }
    has_reactions_ = has_accelerations_ = true;
  }

  Real reaction(const Channel& c) {
    update_all_reactions();
    const BodyState<Real>& b = w_.bodies[BodyIndex(c.index)];
    const Wrench<Real>& f = reactions_.on_child[BodyIndex(c.index)];
    const bool force =
        c.quantity == Quantity::joint_force || c.quantity == Quantity::joint_force_local;
    const bool local =
        c.quantity == Quantity::joint_force_local || c.quantity == Quantity::joint_torque_local;
    const Vec3<Real>& ground = force ? f.force : f.moment;
    return component(local ? transpose_times(b.R_WB, ground) : ground, c.component);
  }

  const Mechanism& m_;
  const Parameters<Real>& p_;
  const Workspace<Real>& w_;
  Real t_ = Real(0.0);
  const Real* y_ = nullptr;
  Reactions<Real> reactions_;
  std::vector<SharedReactions<Real>> shared_;  // one, or none
  Energy<Real> energy_{};
  Real initial_energy_ = Real(0.0);
  bool has_reactions_ = false;
  bool has_accelerations_ = false;  // in reactions_.moving
  bool has_energy_ = false;
};

}  // namespace linkstudy

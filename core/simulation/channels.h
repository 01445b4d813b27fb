// Channels: every scalar of a run that has a name (interface: "joint.A.q", "closure.S.force.x",
// "energy.residual", ...). Units SI. Frames, signs and points:
//   joint.N.q|v|a[.i]            coordinates in the order of the joint, their rates; for a joint
//                                with a quaternion v and a are angular velocity and acceleration
//   joint.N.force|torque.x|y|z   reaction on the child link at the joint origin, ground axes
//   joint.N.force_local|...      the same in the child's joint frame
//   closure.N.force|torque.x..   on chain 1 (`first`) at the closure point, ground axes
//   closure.N.gap.x|y|z          second minus first closure point, ground axes
//   energy.kinetic|potential|supplied|dissipated|residual
#pragma once

#include <string>
#include <vector>

#include "core/closures/closure_wrench.h"
#include "core/dynamics/energy.h"
#include "core/dynamics/reactions.h"
#include "core/model/state.h"

namespace linkstudy {

enum class Quantity : std::uint8_t {
  time,
  q,
  v,
  a,
  joint_force,
  joint_torque,
  joint_force_local,
  joint_torque_local,
  closure_force,
  closure_torque,
  closure_gap,
  kinetic,
  potential,
  supplied,
  dissipated,
  residual
};

struct Channel {
  std::string name;
  std::string unit;
  Quantity quantity;
  int index = 0;      // coordinate, body or closure
  int component = 0;  // 0 1 2 for x y z
};

// All channels of a mechanism in a fixed order, time first.
std::vector<Channel> list_channels(const Mechanism& mechanism);

// Channels that a signal names: one channel, or a group such as "closure.S.force" (x y z).
// Empty if there is none.
std::vector<Channel> find_channels(const std::vector<Channel>& all, const std::string& signal);

// Names a signal may have: every channel or its group.
std::vector<std::string> signal_names(const std::vector<Channel>& all);

// Values of one instant from which channels are read. Reactions and energies are computed when a
// channel first asks for them.
template <class Real>
class Instant {
 public:
  Instant(const Mechanism& m, const Parameters<Real>& p, const Workspace<Real>& w)
      : m_(m), p_(p), w_(w), accelerations_(m.bodies.size()), reactions_(m.bodies.size()) {}

  // y: q (nq), v (nv), supplied, dissipated; w must hold the evaluation at (t, y).
  void move_to(double t, const Real* y) {
    t_ = t;
    y_ = y;
    has_reactions_ = has_energy_ = false;
  }
  void set_initial_energy(Real e) { initial_energy_ = e; }

  Real sample(const Channel& c) {
    const auto i = static_cast<std::size_t>(c.index);
    switch (c.quantity) {
      case Quantity::time:
        return Real(t_);
      case Quantity::q:
        return y_[c.index];
      case Quantity::v:
        return y_[m_.nq + c.index];
      case Quantity::a:
        return w_.qdd[i];
      case Quantity::joint_force:
      case Quantity::joint_torque:
      case Quantity::joint_force_local:
      case Quantity::joint_torque_local:
        return reaction(c);
      case Quantity::closure_force:
        return component(compute_closure_wrench(w_, c.index).force, c.component);
      case Quantity::closure_torque:
        return component(compute_closure_wrench(w_, c.index).torque, c.component);
      case Quantity::closure_gap:
        return component(compute_closure_wrench(w_, c.index).gap, c.component);
      default:
        return energy(c.quantity);
    }
  }

  Energy<Real> energy() {
    if (!has_energy_) energy_ = compute_energy(m_, p_, w_);
    has_energy_ = true;
    return energy_;
  }
  Real supplied() const { return y_[m_.nq + m_.nv]; }
  Real dissipated() const { return y_[m_.nq + m_.nv + 1]; }
  Real residual() {
    const Energy<Real> e = energy();
    return e.kinetic + e.potential - initial_energy_ - supplied() + dissipated();
  }

 private:
  Real energy(Quantity quantity) {
    switch (quantity) {
      case Quantity::kinetic:
        return energy().kinetic;
      case Quantity::potential:
        return energy().potential;
      case Quantity::supplied:
        return supplied();
      case Quantity::dissipated:
        return dissipated();
      default:
        return residual();
    }
  }

  Real reaction(const Channel& c) {
    if (!has_reactions_) update_reactions(m_, p_, w_, accelerations_, reactions_);
    has_reactions_ = true;
    const BodyState<Real>& b = w_.bodies[static_cast<std::size_t>(c.index)];
    const Wrench<Real>& f = reactions_[static_cast<std::size_t>(c.index)];
    const bool force =
        c.quantity == Quantity::joint_force || c.quantity == Quantity::joint_force_local;
    const bool local =
        c.quantity == Quantity::joint_force_local || c.quantity == Quantity::joint_torque_local;
    const Vec3<Real>& ground = force ? f.force : f.moment;
    return component(local ? transpose_times(b.r, ground) : ground, c.component);
  }

  const Mechanism& m_;
  const Parameters<Real>& p_;
  const Workspace<Real>& w_;
  double t_ = 0.0;
  const Real* y_ = nullptr;
  std::vector<BodyState<Real>> accelerations_;  // (nb)
  std::vector<Wrench<Real>> reactions_;         // (nb)
  Energy<Real> energy_{};
  Real initial_energy_ = Real(0.0);
  bool has_reactions_ = false;
  bool has_energy_ = false;
};

}  // namespace linkstudy

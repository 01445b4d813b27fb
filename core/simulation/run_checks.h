// What every state of a run is held to, and what the run tells of it: velocities that are numbers
// and below kFastest, cut joints closed to a limit, and the energy ledger, whose residual may not
// exceed
//   kEnergyFactor * energy that has entered (work, start, swing of weights) + kEnergyFloor * mass.
// Checks answer with a mask, true in the lanes that pass.
#pragma once

#include "core/simulation/instant.h"
#include "core/simulation/kernel.h"

namespace linkstudy {

// Beyond these a run is no longer a motion: it has diverged, or its energy has left the ledger.
inline constexpr double kFastest = 1e9;       // rad/s or m/s
inline constexpr double kEnergyFactor = 1e3;  // times the energy that entered, plus
inline constexpr double kEnergyFloor = 1e-3;  // J/kg of the whole linkage

// Of the gaps in the cut rows of w: the norm.
template <class Real>
inline Real drift_of(const Mechanism& m, const Workspace<Real>& w) {
  Real square(0.0);
  for (const RowIndex r : indices_of(m.cut_rows)) {
    square = madd(w.cut_rows[r].d, w.cut_rows[r].d, square);
  }
  return sqrt(square);
}

inline constexpr double kAnyRank = 1e9;  // more rows than there are

template <class Real>
class RunChecks {
 public:
  using Mask = typename RealTraits<Real>::Mask;

  RunChecks(const Mechanism& m, const Parameters<Real>& p) {
    for (const BodyIndex b : bodies_outwards(m)) mass_ = mass_ + p.bodies[b].mass;
  }

  // Of the state y (run_state.h) and the accelerations in w.
  Mask moves(const Mechanism& m, const Real* y, const Workspace<Real>& w) const {
    const Velocities<const Real> v(y + m.nq);
    const Real* z = y + m.nq + m.nv;
    Real fastest(0.0), sum(0.0);
    for (const VelocityIndex k : velocities(m)) {
      fastest = max(fastest, abs(v[k]));
      sum = sum + (abs(v[k]) + abs(w.qdd[k]));
    }
    for (const int i : indices(m.nz)) sum = sum + abs(z[i]);
    // A lost velocity is not a number, which is not below anything.
    return fastest < Real(kFastest) && is_finite(sum);
  }

  // Of the gaps in the cut rows of w.
  Mask is_closed(const Mechanism& m, const Workspace<Real>& w, Real limit) {
    return is_closed(drift_of(m, w), limit);
  }
  Mask is_closed(Real drift, Real limit) {
    drift_max_ = select(drift > drift_max_, drift, drift_max_);
    return drift <= limit;
  }

  // The largest gap seen so far.
  Real& drift_max() { return drift_max_; }

  // Independent cut rows at a state, in the lanes where they count.
  void see_rank(const Mask& counts, Real rank) {
    least_rank_ = select(counts && rank < least_rank_, rank, least_rank_);
    greatest_rank_ = select(counts && rank > greatest_rank_, rank, greatest_rank_);
  }

  void start_ledger(Instant<Real>& now) {
    initial_ = now.energy();
    initial_supplied_ = now.supplied();
    now.set_initial_energy(initial_.kinetic + initial_.potential() - now.supplied() +
                           now.dissipated());
  }

  // now: Instant, or what has the same ledger.
  template <class Ledger>
  Mask balances(Ledger& now) {
    const Energy<Real> e = now.energy();
    const Real residual = abs(now.residual());
    const Real supplied = abs(now.supplied() - initial_supplied_);
    residual_max_ = select(residual > residual_max_, residual, residual_max_);
    for (const Real& x : {e.kinetic, supplied + abs(now.dissipated())}) {
      scale_ = select(x > scale_, x, scale_);
    }
    const Real entered =
        supplied + initial_.kinetic + initial_.elastic + abs(e.height - initial_.height);
    return residual <= madd(Real(kEnergyFactor), entered, Real(kEnergyFloor) * mass_);
  }

  // Hands over what lane i has shown so far; `rows` is the number of cut rows.
  void store(int i, int rows, LaneEnd& end) const {
    end.least_rank = static_cast<int>(lane(least_rank_, i));
    end.greatest_rank = static_cast<int>(lane(greatest_rank_, i));
    end.redundant = end.least_rank < rows;
    end.drift_max = lane(drift_max_, i);
    end.energy_residual_max = lane(residual_max_, i);
    end.energy_scale = lane(scale_, i);
  }

 private:
  Real least_rank_ = Real(kAnyRank), greatest_rank_ = Real(-1.0);
  Energy<Real> initial_{};
  Real initial_supplied_ = Real(0.0);
  Real mass_ = Real(0.0);
  Real drift_max_ = Real(0.0);
  Real residual_max_ = Real(0.0);
  Real scale_ = Real(0.0);
};

}  // namespace linkstudy

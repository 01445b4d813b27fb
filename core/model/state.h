// State of a linkage: joint positions, velocities, bristles, and the work done so far.
#pragma once

#include <vector>

#include "core/model/mechanism.h"

namespace linkstudy {

template <class Real>
struct State {
  double t = 0.0;  // s
  IndexedVector<PositionIndex, Real> q;
  IndexedVector<VelocityIndex, Real> v;
  IndexedVector<BristleIndex, Real> z;  // deflections of bristles, m
  Real supplied = Real(0.0);            // work of drives since the start, J
  Real dissipated = Real(0.0);          // work against resistance and damping since the start, J
  Real dissipated_in_contacts = Real(0.0);  // of it
};

template <class Real>
State<Real> make_state(const Mechanism& m) {
  State<Real> s;
  s.q.assign(static_cast<std::size_t>(m.nq), Real(0.0));
  s.v.assign(static_cast<std::size_t>(m.nv), Real(0.0));
  s.z.assign(static_cast<std::size_t>(m.nz), Real(0.0));
  for (const PositionIndex i : m.ball_q) s.q[i] = Real(1.0);
  return s;
}

}  // namespace linkstudy

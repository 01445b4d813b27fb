// Reactions in the tree joints by recursive Newton-Euler, tips to ground ([Urbas16] sec. 4,
// [Craig, ch. 6]), after `evaluate`. The reaction of a joint is the whole wrench that its parent
// puts on its child through it, drive and resistance of the joint included, about O in ground axes.
// Closure forces of both kinds are external loads here. Where cut rows are redundant the reactions
// are those of the least-norm multipliers.
#pragma once

#include "core/closures/closure_wrench.h"

namespace linkstudy {

// reactions: (nb), [0] unused; accelerations: (nb) scratch, left with the spatial accelerations
// less gravity.
template <class Real>
inline void update_reactions(const Mechanism& m, const Workspace<Real>& w,
                             std::vector<Motion<Real>>& accelerations,
                             std::vector<Force<Real>>& reactions) {
  const auto nb = m.bodies.size();
  const BodyState<Real>* bodies = w.bodies.data();
  // The part of the acceleration that qdd adds is the sum of s_k qdd_k along the path.
  accelerations[0] = {zero3<Real>(), zero3<Real>()};
  for (std::size_t b = 1; b < nb; ++b) {
    const Body& body = m.bodies[b];
    Motion<Real> a = accelerations[static_cast<std::size_t>(body.parent)];
    for (int k = body.v_begin; k < body.v_begin + body.v_count; ++k) {
      a = madd(w.qdd[static_cast<std::size_t>(k)], w.axes[static_cast<std::size_t>(k)], a);
    }
    accelerations[b] = a;
  }
  for (std::size_t b = 0; b < nb; ++b) {
    const BodyState<Real>& s = bodies[b];
    accelerations[b] = accelerations[b] + s.a;
    if (b == 0) continue;
    const Force<Real> momentum = s.inertia * s.v;
    reactions[b] = s.inertia * accelerations[b] + cross(s.v, momentum) - s.external;
  }
  reactions[0] = {zero3<Real>(), zero3<Real>()};
  for (const ClosureStructure& c : m.closures) {
    if (c.model != ClosureModel::cut) continue;
    for (int r = c.row_begin; r < c.row_end; ++r) {
      const RowState<Real>& row = w.cut_rows[static_cast<std::size_t>(r)];
      auto& first = reactions[static_cast<std::size_t>(c.first)];
      auto& second = reactions[static_cast<std::size_t>(c.second)];
      first = madd(Real(-row.value), row.w1, first);
      second = madd(row.value, row.w2, second);
    }
  }
  for (std::size_t b = nb - 1; b > 0; --b) {
    auto& parent = reactions[static_cast<std::size_t>(m.bodies[b].parent)];
    parent = parent + reactions[b];
  }
}

}  // namespace linkstudy

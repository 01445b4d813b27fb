// Where translations and rotations close a linkage together, which of their rows are independent is
// judged by J alone, with the scales of core/closures/redundant_rows.h: rows by the lever of their
// closure, or 1, and velocities that slide by the shortest of these levers. The pivots of
// J~ J~^T = L D L^T are the squares of what each scaled row has beyond the rows before it; where
// all of them are longer than kClearPart, far longer than what can be drift, the rows are
// independent. Elsewhere nothing is said, and the slower way decides. Masses have no part in it: a
// light link would make much of a little drift.
#pragma once

#include "core/closures/redundant_rows.h"
#include "core/numerics/definite.h"

namespace linkstudy {

// Three times the longest part that counts as drift.
inline constexpr double kClearPart = 3.0 * DriftTolerance::most;

// Cut rows of translations beside rotations.
[[gnu::always_inline]] inline bool has_rows_of_two_units(const Mechanism& m) {
  int turning = 0;
  for (const Row& row : m.cut_rows) turning += measures_turn(row.kind) ? 1 : 0;
  return turning > 0 && turning < m.cut_row_count();
}

// J C^-2 J^T in Workspace::independence, C = 1 / shortest for velocities that slide, else 1.
template <class Real>
inline void sum_independence(const Mechanism& m, Real shortest, Workspace<Real>& w) {
  const auto j = w.cut_jacobian.view();
  const Real slide = shortest * shortest;
  for (const RowIndex r : indices_of(m.cut_rows)) {
    for (const RowIndex s : indices(r + 1)) {
      Real turns(0.0), slides(0.0);
      for (const VelocityIndex k : support_of_row(m, r)) {
        Real& sum = m.velocities[k].kind == VelocityKind::translation ? slides : turns;
        sum = madd(j(r, k), j(s, k), sum);
      }
      w.independence(r, s) = madd(slide, slides, turns);
    }
  }
}

// True in the lanes whose rows are clearly independent. From Workspace::cut_jacobian.
template <class Real>
inline auto rows_are_clear(const Mechanism& m, const Parameters<Real>& p, Workspace<Real>& w) {
  update_row_scales(m, p, w);
  Real shortest(std::numeric_limits<double>::infinity());
  for (const RowIndex r : indices_of(m.cut_rows)) {
    if (!measures_turn(m.cut_rows[r].kind)) shortest = min(shortest, w.row_scale[r]);
  }
  sum_independence(m, shortest, w);
  const auto limit = [&w](int number) {
    const RowIndex r(number);
    return Real(kClearPart * kClearPart) * w.row_scale[r] * w.row_scale[r];
  };
  return factorize_above(m.cut_row_count(), limit, w.independence.data(),
                         w.independence_inverse.data());
}

}  // namespace linkstudy

// What the step loop goes through of a mechanism, as ranges of indices (core/base/indices.h).
#pragma once

#include <span>

#include "core/base/indices.h"
#include "core/model/mechanism.h"

namespace linkstudy {

// Bodies other than ground, parents first or last.
[[gnu::always_inline]] inline auto bodies_outwards(const Mechanism& m) {
  return indices(BodyIndex(1), m.bodies.end_index());
}
[[gnu::always_inline]] inline auto bodies_inwards(const Mechanism& m) {
  return indices_down(BodyIndex(1), m.bodies.end_index());
}

// The body and all bodies between it and ground.
[[gnu::always_inline]] inline auto bodies_to_ground(const Mechanism& m, BodyIndex body) {
  return PathRange(body, BodyIndex(1),
                   [bodies = m.bodies.data()](BodyIndex i) { return bodies[i.value()].parent; });
}

// True if `end` is the body or lies outboard of it.
[[gnu::always_inline]] inline bool carries(const Mechanism& m, BodyIndex body, BodyIndex end) {
  while (end > body) end = m.bodies[end].parent;
  return end == body;
}

// Basic motions and velocities of the joint of a body.
[[gnu::always_inline]] inline auto stages_of(const Body& body) {
  return indices(body.stage_begin, body.stage_end);
}
[[gnu::always_inline]] inline auto velocities_of(const Body& body) {
  return indices(body.v_begin, body.v_begin + body.v_count);
}

// Rows of a closure; `other_rows_of` leaves out the three ground axes treated together.
[[gnu::always_inline]] inline auto rows_of(const ClosureStructure& c) {
  return indices(c.row_begin, c.row_end);
}
[[gnu::always_inline]] inline auto other_rows_of(const ClosureStructure& c) {
  return indices(c.row_begin + (c.point_rows ? 3 : 0), c.row_end);
}

// Velocities of both paths of a closure, or of those of a coupling, each once, last first.
[[gnu::always_inline]] inline std::span<const VelocityIndex> support_of(const Mechanism& m,
                                                                        const ClosureStructure& c) {
  return {m.support.data() + c.support_begin, m.support.data() + c.support_end};
}
[[gnu::always_inline]] inline std::span<const VelocityIndex> support_of(
    const Mechanism& m, const CouplingStructure& c) {
  return {m.support.data() + c.support_begin, m.support.data() + c.support_end};
}
[[gnu::always_inline]] inline std::span<const VelocityIndex> support_of_row(const Mechanism& m,
                                                                            RowIndex cut_row) {
  const Row& row = m.cut_rows[cut_row];
  return is_of_coupling(row.kind) ? support_of(m, m.couplings[row.coupling])
                                  : support_of(m, m.closures[row.closure]);
}

// Terms of a coupling.
[[gnu::always_inline]] inline auto terms_of(const CouplingStructure& c) {
  return indices(c.term_begin, c.term_end);
}

// Velocities whose accelerations go with that of a prescribed one.
[[gnu::always_inline]] inline std::span<const VelocityIndex> support_of(const Mechanism& m,
                                                                        const MotionStructure& s) {
  return {m.motion_support.data() + s.support_begin.value(),
          m.motion_support.data() + s.support_end.value()};
}

// Contacts of a clearance.
[[gnu::always_inline]] inline auto contacts_of(const ClearanceStructure& c) {
  return indices(c.contact_begin, c.contact_end);
}

}  // namespace linkstudy

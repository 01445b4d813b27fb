#include "core/model/closure_rows.h"

namespace linkstudy {
namespace {

constexpr unsigned kTranslations = 1u << kX | 1u << kY | 1u << kZ;

bool holds_point(unsigned directions) {
  return (directions & kTranslations) == kTranslations;
}

unsigned held_directions(const Closure& closure) {
  if (closure.model == ClosureModel::sde) return shut_directions(closure);
  if (closure.model == ClosureModel::cut) return blocked_directions(closure.type);
  const bool planar = closure.clearance.kind == ClearanceKind::planar;
  return planar ? 1u << kX | 1u << kTheta | 1u << kPsi : 1u << kX;
}

// Measures of turns: the rotation vector, or of small ones axis (tilt of the second x axis seen in
// {1,e}) or linearized ([Urbas16] eq. (12)); a universal joint turns about x of the first and y of
// the second.
Row rotation_row(const Closure& closure, TiltMeasure tilt, ClosureIndex index, int d) {
  constexpr auto kind = RowKind::rotation;
  if (tilt == TiltMeasure::angle) return {RowKind::rotation_vector, index, d - kPhi, 0, 1.0, d};
  if (d == kPhi) return {kind, index, 2, 1, 1.0, d};
  if (d == kTheta) {
    return tilt == TiltMeasure::axis ? Row{kind, index, 2, 0, -1.0, d}
                                     : Row{kind, index, 0, 2, 1.0, d};
  }
  const bool universal = closure.type == JointType::universal && tilt == TiltMeasure::axis;
  return universal ? Row{kind, index, 0, 1, -1.0, d} : Row{kind, index, 1, 0, 1.0, d};
}

// Element d of an sde: along an axis of ground or of {1,e}, or one of three directions.
Row translation_row(const Sde& sde, ClosureIndex index, int d) {
  const bool ground = sde.axes == SdeAxes::ground;
  if (sde.form == SdeForm::three_springs) {
    return {ground ? RowKind::spring_ground : RowKind::spring_first, index, d, 0, 1.0, d};
  }
  return {ground ? RowKind::translation_ground : RowKind::translation_first, index, d, 0, 1.0, d};
}

// The one row of a rod.
std::vector<Row> rod_row(ClosureIndex index) {
  return {{RowKind::line_of_centres, index, 0, 0, 1.0, kX}};
}

}  // namespace

std::vector<Row> make_cut_rows(const Closure& closure, ClosureIndex index, unsigned idle) {
  const unsigned held = held_directions(closure);
  if (closure.type == JointType::rod) {
    return (held & ~idle) != 0u ? rod_row(index) : std::vector<Row>{};
  }
  const bool whole = holds_point(held);
  // An sde that holds a point in some directions only does so along its own.
  const bool partly =
      closure.model == ClosureModel::sde && holds_point(blocked_directions(closure.type)) && !whole;
  const RowKind kind = whole ? RowKind::translation_ground : RowKind::translation_first;
  std::vector<Row> rows;
  for (int d = kX; d < kDirections; ++d) {
    if ((held & ~idle) >> d & 1u) {
      rows.push_back(d >= kPhi ? rotation_row(closure, TiltMeasure::axis, index, d)
                     : partly  ? translation_row(closure.sde, index, d)
                               : Row{kind, index, d, 0, 1.0, d});
    }
  }
  return rows;
}

std::vector<Row> make_sde_rows(const Closure& closure, ClosureIndex index) {
  const Sde& sde = closure.sde;
  if (closure.type == JointType::rod) return rod_row(index);
  const bool line = sde.form == SdeForm::line_of_centres;
  std::vector<Row> rows;
  for (int d = kX; d < kDirections; ++d) {
    const auto i = static_cast<std::size_t>(d);
    const bool rotation = d >= kPhi;
    if (line && d != kX && !rotation) continue;  // one element, coefficients of x
    if (sde.stiffness[i] == 0.0 && sde.damping[i] == 0.0) continue;
    rows.push_back(rotation ? rotation_row(closure, sde.tilt, index, d)
                   : line   ? Row{RowKind::line_of_centres, index, 0, 0, 1.0, d}
                            : translation_row(sde, index, d));
  }
  return rows;
}

}  // namespace linkstudy

#include "tests/support/trace_closures.h"

#include <cmath>
#include <stdexcept>

#include "tests/support/trace_dynamics.h"

namespace linkstudy::testing {
namespace {

// A vector that depends on the coordinates: value, derivatives, rates (see CarriedFrame).
struct Varied {
  Eigen::Vector3d x;
  Matrix x_q;  // (3 x dof)
  Eigen::Vector3d x_dot;
  Eigen::Vector3d x_vv;
};

// Column of a carried frame: an axis (0, 1, 2) or the origin (3).
Varied column(const CarriedFrame& frame, int c) {
  Varied varied;
  varied.x = frame.T.col(c).head(3);
  varied.x_dot = frame.T_dot.col(c).head(3);
  varied.x_vv = frame.T_vv.col(c).head(3);
  varied.x_q.resize(3, static_cast<int>(frame.T_i.size()));
  for (std::size_t i = 0; i < frame.T_i.size(); ++i) {
    varied.x_q.col(static_cast<int>(i)) = frame.T_i[i].col(c).head(3);
  }
  return varied;
}

Varied difference(const Varied& a, const Varied& b) {
  return {a.x - b.x, a.x_q - b.x_q, a.x_dot - b.x_dot, a.x_vv - b.x_vv};
}

// sign * (a . b) by the product rule.
ClosureRow product_row(const Varied& a, const Varied& b, double sign) {
  ClosureRow row;
  row.d = sign * a.x.dot(b.x);
  row.d_q = sign * (a.x_q.transpose() * b.x + b.x_q.transpose() * a.x);
  row.d_dot = sign * (a.x_dot.dot(b.x) + a.x.dot(b.x_dot));
  row.d_vv = sign * (a.x_vv.dot(b.x) + 2.0 * a.x_dot.dot(b.x_dot) + a.x.dot(b.x_vv));
  return row;
}

// sign * (R1^T R2)_ab. Its rate is (omega2 - omega1) . (b x a), hence the arm.
ClosureRow cosine_row(const ClosureFrames& frames, int a, int b, double sign) {
  const Varied axis_a = column(frames.first, a);
  const Varied axis_b = column(frames.second, b);
  ClosureRow row = product_row(axis_a, axis_b, sign);
  row.arm = sign * axis_b.x.cross(axis_a.x);
  row.rotation = true;
  return row;
}

std::vector<Direction> blocked(JointType type) {
  switch (type) {
    case JointType::spherical:
      return {kX, kY, kZ};
    case JointType::revolute:
      return {kX, kY, kZ, kTheta, kPsi};
    case JointType::universal:
      return {kX, kY, kZ, kPsi};
    case JointType::prismatic:
      return {kY, kZ, kPhi, kTheta, kPsi};
    case JointType::cylindrical:
      return {kY, kZ, kTheta, kPsi};
    case JointType::planar:
      return {kX, kTheta, kPsi};
    case JointType::fixed:
      return {kX, kY, kZ, kPhi, kTheta, kPsi};
    default:
      throw std::invalid_argument("oracle: this joint type cannot be a closure");
  }
}

struct Deformation {
  Eigen::Vector3d d, d_dot;
  Matrix d_q;  // (3 x dof)
  std::array<Eigen::Vector3d, 3> arms;
};

Deformation deformation(const std::array<ClosureRow, 3>& rows) {
  Deformation result;
  result.d_q.resize(3, rows[0].d_q.size());
  for (int i = 0; i < 3; ++i) {
    result.d[i] = rows[i].d;
    result.d_dot[i] = rows[i].d_dot;
    result.d_q.row(i) = rows[i].d_q.transpose();
    result.arms[i] = rows[i].arm;
  }
  return result;
}

struct SpringMatrices {
  Eigen::Matrix3d C, B;
};

SpringMatrices translational_matrices(const TraceClosure& closure, const Deformation& deformed) {
  const auto& c = closure.closure.sde.stiffness;
  const auto& b = closure.damping;
  SpringMatrices m{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  if (closure.closure.sde.form == SdeForm::directional) {
    m.C.diagonal() << c[kX], c[kY], c[kZ];
    m.B.diagonal() << b[kX], b[kY], b[kZ];
  } else if (closure.closure.sde.form == SdeForm::three_springs) {
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d n = closure.closure.sde.directions.row(i).transpose();
      m.C += c[i] * n * n.transpose();
      m.B += b[i] * n * n.transpose();
    }
  } else {  // one element along the line of centres; where they meet, along their relative motion
    m.C = c[kX] * Eigen::Matrix3d::Identity();
    const Eigen::Vector3d line = deformed.d.norm() > 0.0 ? deformed.d : deformed.d_dot;
    if (line.norm() > 0.0) m.B = b[kX] * line * line.transpose() / line.squaredNorm();
  }
  return m;
}

// Adds -(dE/dq + dR/dqd) of eq. (14) for three rows; returns the resultant on first.
Eigen::Vector3d add_spring(const Deformation& x, const SpringMatrices& m, ClosureResult& result) {
  const Eigen::Vector3d s = m.C * x.d + m.B * x.d_dot;
  result.generalised -= x.d_q.transpose() * s;
  result.energy += 0.5 * x.d.dot(m.C * x.d);
  result.dissipated_power += x.d_dot.dot(m.B * x.d_dot);
  return x.arms[0] * s[0] + x.arms[1] * s[1] + x.arms[2] * s[2];
}

ClosureResult empty_result(const TraceClosure& closure, const ClosureFrames& frames) {
  ClosureResult result;
  result.name = closure.closure.name;
  result.generalised = Vector::Zero(static_cast<int>(frames.first.T_i.size()));
  result.point_first = frames.first.T.col(3).head(3);
  result.point_second = frames.second.T.col(3).head(3);
  result.gap = result.point_second - result.point_first;
  return result;
}

// Largest eigenvalue of J M^-1 J^T, zero without rows.
double largest_mobility(const std::vector<Vector>& rows, const Matrix& mass_matrix) {
  if (rows.empty()) return 0.0;
  Matrix J(static_cast<int>(rows.size()), mass_matrix.rows());
  for (std::size_t i = 0; i < rows.size(); ++i) J.row(static_cast<int>(i)) = rows[i].transpose();
  const Matrix A = J * mass_matrix.ldlt().solve(J.transpose());
  return Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues().maxCoeff();
}

}  // namespace

ClosureFrames closure_frames(const TraceModel& model, const TraceClosure& closure,
                             const std::vector<LinkTransform>& transforms, const Vector& v) {
  return {carried_frame(model, transforms, closure.first.link, closure.first.frame, v),
          carried_frame(model, transforms, closure.second.link, closure.second.frame, v)};
}

ClosureRow translation_row(const ClosureFrames& frames, Direction direction, SdeAxes axes) {
  const Varied gap = difference(column(frames.second, 3), column(frames.first, 3));
  if (axes == SdeAxes::first) {
    const Varied axis = column(frames.first, direction);
    ClosureRow row = product_row(axis, gap, 1.0);
    row.arm = axis.x;
    return row;
  }
  ClosureRow row;
  row.d = gap.x[direction];
  row.d_q = gap.x_q.row(direction).transpose();
  row.d_dot = gap.x_dot[direction];
  row.d_vv = gap.x_vv[direction];
  row.arm = Eigen::Vector3d::Unit(direction);
  return row;
}

ClosureRow rotation_row(const ClosureFrames& frames, Direction direction, TiltMeasure tilt,
                        JointType type) {
  const bool axis = tilt == TiltMeasure::axis;
  if (direction == kPhi) return cosine_row(frames, 2, 1, 1.0);
  if (direction == kTheta) {
    return axis ? cosine_row(frames, 2, 0, -1.0) : cosine_row(frames, 0, 2, 1.0);
  }
  if (axis && type == JointType::universal) return cosine_row(frames, 0, 1, -1.0);
  return cosine_row(frames, 1, 0, 1.0);
}

std::vector<ClosureRow> cut_rows(const ClosureFrames& frames, JointType type) {
  const std::vector<Direction> directions = blocked(type);
  const bool point = directions[0] == kX && directions.size() > 2 && directions[2] == kZ;
  std::vector<ClosureRow> rows;
  for (const Direction direction : directions) {
    rows.push_back(direction <= kZ ? translation_row(frames, direction,
                                                     point ? SdeAxes::ground : SdeAxes::first)
                                   : rotation_row(frames, direction, TiltMeasure::axis, type));
  }
  return rows;
}

ClosureResult sde_result(const TraceClosure& closure, const ClosureFrames& frames) {
  const Sde& sde = closure.closure.sde;
  ClosureResult result = empty_result(closure, frames);
  const auto slide = [&](Direction d) { return translation_row(frames, d, sde.axes); };
  const auto tilt = [&](Direction d) {
    return rotation_row(frames, d, sde.tilt, closure.closure.type);
  };
  const Deformation translation = deformation({slide(kX), slide(kY), slide(kZ)});
  result.force = add_spring(translation, translational_matrices(closure, translation), result);
  if (sde.axes == SdeAxes::first) result.point_first = result.point_second;

  SpringMatrices turning{Eigen::Matrix3d::Zero(), Eigen::Matrix3d::Zero()};
  turning.C.diagonal() << sde.stiffness[kPhi], sde.stiffness[kTheta], sde.stiffness[kPsi];
  turning.B.diagonal() << closure.damping[kPhi], closure.damping[kTheta], closure.damping[kPsi];
  if (!turning.C.isZero(0.0) || !turning.B.isZero(0.0)) {
    result.torque =
        add_spring(deformation({tilt(kPhi), tilt(kTheta), tilt(kPsi)}), turning, result);
  }
  return result;
}

ClosureResult cut_result(const TraceClosure& closure, const ClosureFrames& frames,
                         const std::vector<ClosureRow>& rows, const Vector& multipliers) {
  ClosureResult result = empty_result(closure, frames);
  result.multipliers = multipliers;
  const bool point = rows.size() > 2 && !rows[2].rotation;
  if (!point) result.point_first = result.point_second;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double s = multipliers[static_cast<int>(i)];
    result.generalised -= rows[i].d_q * s;
    (rows[i].rotation ? result.torque : result.force) += rows[i].arm * s;
  }
  return result;
}

std::array<double, kDirections> damping_of_ratio(const TraceModel& model,
                                                 const TraceClosure& closure, const Vector& q) {
  const Sde& sde = closure.closure.sde;
  const Vector rest = Vector::Zero(model.dof);
  const auto transforms = link_transforms(model, q);
  const ClosureFrames frames = closure_frames(model, closure, transforms, rest);
  const Matrix mass_matrix = tree_equations(model, transforms, rest).mass_matrix;
  std::vector<Vector> translations, rotations;
  for (int d = kX; d <= kZ; ++d) {
    if (sde.form == SdeForm::directional && sde.stiffness[d] <= 0.0) continue;
    translations.push_back(translation_row(frames, Direction(d), sde.axes).d_q);
  }
  for (int d = kPhi; d <= kPsi; ++d) {
    if (sde.stiffness[d] <= 0.0) continue;
    rotations.push_back(rotation_row(frames, Direction(d), sde.tilt, closure.closure.type).d_q);
  }
  const double mobility_t = largest_mobility(translations, mass_matrix);
  const double mobility_r = largest_mobility(rotations, mass_matrix);
  std::array<double, kDirections> damping{};
  for (int d = 0; d < kDirections; ++d) {
    const double mobility = d <= kZ ? mobility_t : mobility_r;
    const double c = sde.stiffness[d];
    if (c > 0.0) damping[d] = 2.0 * *sde.damping_ratio * std::sqrt(c / mobility);
  }
  return damping;
}

}  // namespace linkstudy::testing

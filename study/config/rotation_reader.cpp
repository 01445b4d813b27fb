#include "study/config/rotation_reader.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "core/topology/check_values.h"
#include "study/config/fields.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;
using Eigen::Matrix3d;
using Eigen::Vector3d;

// Entries below the rounding of the angles, such as cos(90 deg) = 6e-17, are zero.
Matrix3d without_dust(const Matrix3d& rotation) {
  const auto clean = [](double entry) {
    return std::abs(entry) < 4.0 * std::numeric_limits<double>::epsilon() ? 0.0 : entry;
  };
  return rotation.unaryExpr(clean);
}

// Newton's iteration for the nearest rotation; it leaves an exact rotation as it is.
Matrix3d orthonormalised(Matrix3d r) {
  for (int i = 0; i < 3; ++i) r = 0.5 * r * (3.0 * Matrix3d::Identity() - r.transpose() * r);
  return r;
}

class RotationReader {
 public:
  RotationReader(const std::string& subject, Diagnostics& diagnostics)
      : subject_(subject), diagnostics_(diagnostics) {}

  Matrix3d read(const Tree& table) {
    const Tree* angle = table.find("angle");
    const Tree* axis = table.find("axis");
    if (angle != nullptr && angle->is_valid() && axis == nullptr) {
      diagnostics_.add(angle->at, fmt::format("{}angle goes with axis only", subject_),
                       "write rotation = { axis = [0, 0, 1], angle = \"30 deg\" }");
    }
    if (axis != nullptr) return from_axis(table, *axis, angle);
    if (const Tree* value = table.find("euler_zyx")) return from_euler(*value);
    if (const Tree* value = table.find("quaternion")) return from_quaternion(*value);
    if (const Tree* value = table.find("matrix")) return from_matrix(*value);
    return Matrix3d::Identity();
  }

 private:
  Matrix3d from_axis(const Tree& table, const Tree& axis, const Tree* angle) {
    if (!axis.is_valid()) return Matrix3d::Identity();
    const Vector3d u = read_vector(&axis, Vector3d::UnitZ());
    const double length = u.stableNorm();
    if (!(length > 0.0)) {
      diagnostics_.add(
          axis.at,
          fmt::format("{}axis of rotation must not be zero, got {}", subject_, shown(axis)),
          "give a direction, of any length");
    }
    if (angle == nullptr) {
      diagnostics_.add(table.at, fmt::format("{}the rotation has an axis but no angle", subject_),
                       "add angle = \"30 deg\"");
      return Matrix3d::Identity();
    }
    if (!angle->is_numeric() || !(length > 0.0)) return Matrix3d::Identity();
    return without_dust(
        Eigen::AngleAxisd(angle->as_number(), length == 1.0 ? u : Vector3d(u / length))
            .toRotationMatrix());
  }

  Matrix3d from_euler(const Tree& value) {
    const Vector3d angles = read_vector(&value, Vector3d::Zero());
    using Eigen::AngleAxisd;
    const Matrix3d z = AngleAxisd(angles[0], Vector3d::UnitZ()).toRotationMatrix();
    const Matrix3d y = AngleAxisd(angles[1], Vector3d::UnitY()).toRotationMatrix();
    const Matrix3d x = AngleAxisd(angles[2], Vector3d::UnitX()).toRotationMatrix();
    return without_dust(z * y * x);
  }

  Matrix3d from_quaternion(const Tree& value) {
    if (!value.is(Kind::array)) return Matrix3d::Identity();
    const Eigen::Quaterniond q(value.items[0].as_number(), value.items[1].as_number(),
                               value.items[2].as_number(), value.items[3].as_number());
    if (!(std::abs(q.norm() - 1.0) <= kQuaternionTolerance)) {
      diagnostics_.add(value.at,
                       fmt::format("{}quaternion must have length 1, got {} of length {:.6g}",
                                   subject_, shown(value), q.norm()),
                       "order w, x, y, z; divide by the length");
      return Matrix3d::Identity();
    }
    return without_dust(q.normalized().toRotationMatrix());
  }

  Matrix3d from_matrix(const Tree& value) {
    if (!value.is(Kind::array)) return Matrix3d::Identity();
    Matrix3d r;
    fill_member(r, value);
    const std::string fault = rotation_fault(r);
    if (fault.empty()) return orthonormalised(r);
    const bool mirrored = fault.find("reflection") != std::string::npos;
    diagnostics_.add(value.at, fmt::format("{}matrix {}", subject_, fault),
                     mirrored ? "turn the sign of one axis: a frame is right-handed"
                              : "rows and columns have length 1 and are perpendicular");
    return Matrix3d::Identity();
  }

  const std::string& subject_;
  Diagnostics& diagnostics_;
};

}  // namespace

Vector3d read_vector(const Tree* value, const Vector3d& otherwise) {
  Vector3d vector = otherwise;
  if (value != nullptr && value->is(Kind::array)) fill_member(vector, *value);
  return vector;
}

void normalise_direction(Vector3d& direction, Tree& value, const Reading& reading) {
  const double length = direction.stableNorm();
  if (length == 1.0) return;
  if (length > 0.0) {
    direction /= length;
    return;
  }
  reading.report(
      value, fmt::format("{} must not be zero, got {}", subject_of(reading.scope), shown(value)),
      "give a direction, of any length");
}

void read_rotation(Frame& frame, Tree& owner, const Reading& reading) {
  std::string subject = subject_of(reading.scope);
  if (!subject.ends_with(": ")) subject += ": ";
  RotationReader reader(subject, reading.diagnostics);
  const Tree* rotation = owner.find("rotation");
  const bool has_table = rotation != nullptr && rotation->is(Kind::table);
  frame.rotation = reader.read(has_table ? *rotation : owner);
}

}  // namespace linkstudy

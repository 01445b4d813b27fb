#include "core/topology/check_values.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/topology/check_contact.h"
#include "core/topology/check_course.h"
#include "core/topology/check_flexible.h"
#include "core/topology/linkage_words.h"
#include "core/topology/record_check.h"

namespace linkstudy {
namespace {

constexpr double kRotationTolerance = 1.0e-6;
constexpr double kTriangleTolerance = 1.0e-3;
constexpr unsigned kTranslations = 1u << kX | 1u << kY | 1u << kZ;

// Nothing, or one entry for each coordinate.
void require_count(const std::string& key, std::size_t count, std::size_t expected,
                   RecordCheck& record) {
  if (count == 0 || count == expected) return;
  record.report(key,
                key + " must have " + std::to_string(expected) +
                    (expected == 1 ? " entry" : " entries") + " for this joint, got " +
                    std::to_string(count),
                expected == 0 ? "leave it out" : "give one entry for each coordinate");
}

void check_start(const Joint& joint, RecordCheck& record) {
  const auto nq = static_cast<std::size_t>(position_count(joint.type, joint.coordinates));
  const auto nv = static_cast<std::size_t>(velocity_count(joint.type));
  require_count("initial.position", joint.position.size(), nq, record);
  require_count("initial.velocity", joint.velocity.size(), nv, record);
  record.require_finite("initial.position", all_finite(joint.position));
  record.require_finite("initial.velocity", all_finite(joint.velocity));
  if (nq == nv || joint.position.size() != nq) return;
  const Eigen::Map<const Eigen::Vector4d> quaternion(joint.position.data() + nq - 4);
  record.require_unit("initial.position", quaternion.norm());
}

void check_spring(const Joint& joint, RecordCheck& record) {
  const bool is_linear = joint.stiffness.empty() && joint.damping.empty() && joint.rest.empty();
  if (is_linear && !joint.spring_curve) return;
  const int nv = velocity_count(joint.type);
  if (position_count(joint.type, joint.coordinates) != nv) {
    record.report("spring", "a spring acts on coordinates, which a quaternion has not",
                  "use coordinates = \"zyx\"");
    return;
  }
  const auto check_entries = [&](const std::string& key, const std::vector<double>& values) {
    require_count(key, values.size(), static_cast<std::size_t>(nv), record);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::string entry = values.size() > 1 ? key + "." + std::to_string(i) : key;
      record.require_not_negative(entry, values[i]);
    }
  };
  check_entries("spring.stiffness", joint.stiffness);
  check_entries("spring.damping", joint.damping);
  require_count("spring.rest", joint.rest.size(), static_cast<std::size_t>(nv), record);
  record.require_finite("spring.rest", all_finite(joint.rest));
  if (!joint.spring_curve) return;
  check_curve(joint.spring_curve->curve, {"spring.table.positions", "spring.table.efforts"},
              record);
  const int coordinate = joint.spring_curve->coordinate;
  if (coordinate >= 0 && coordinate < nv) return;
  record.report("spring.table.coordinate",
                "this joint has " + std::to_string(nv) + " coordinates, counted from 0, got " +
                    std::to_string(coordinate),
                nv == 0 ? "take the spring off" : "choose a coordinate from 0 on");
}

// Directions that a closure leaves free turn with its first end. Elements along ground axes can
// stand for that only if they hold every translation alike.
void check_axes(const Closure& closure, RecordCheck& record) {
  const Sde& sde = closure.sde;
  const auto alike = [](const std::array<double, kDirections>& a) {
    return a[kX] == a[kY] && a[kY] == a[kZ];
  };
  const bool isotropic = alike(sde.stiffness) && (sde.damping_ratio || alike(sde.damping));
  const bool slides = (blocked_directions(closure.type) & kTranslations) != kTranslations;
  if (!slides || isotropic || sde.axes == SdeAxes::first) return;
  record.report("sde.axes",
                "axes = \"ground\" stiffens directions of the ground, but those this closure type "
                "leaves free turn with its first end",
                "use axes = \"first\", or stiffness (and damping) alike along x, y and z");
}

// The rotation vector of a joint that turns freely is no tilt.
void check_tilt(const Closure& closure, RecordCheck& record) {
  constexpr unsigned rotations = 1u << kPhi | 1u << kTheta | 1u << kPsi;
  const unsigned blocked = blocked_directions(closure.type) & rotations;
  if (closure.sde.tilt != TiltMeasure::angle || blocked == 0 || blocked == rotations) return;
  record.report(
      "sde.tilt",
      "tilt = \"angle\" measures the whole turn between the ends, which this closure type "
      "leaves free in part",
      "use tilt = \"axis\", or give the closure the type fixed, prismatic or spherical");
}

// Across a rod there are no directions that an element could hold.
void check_rod(const Closure& closure, RecordCheck& record) {
  if (closure.type != JointType::rod) return;
  const auto refuse = [&](const std::string& key, double value, std::size_t d) {
    if (value == 0.0) return;
    record.report(
        "sde." + key + "." + kDirectionNames[d],
        "a rod acts along its line only, got " + text_of(value) + " for " + kDirectionNames[d],
        "give one number, or x alone");
  };
  for (std::size_t d = 1; d < kDirections; ++d) {
    refuse("stiffness", closure.sde.stiffness[d], d);
    refuse("damping", closure.sde.damping[d], d);
  }
}

void check_sde(const Closure& closure, RecordCheck& record) {
  const Sde& sde = closure.sde;
  bool any = false;
  for (std::size_t d = 0; d < kDirections; ++d) {
    record.require_not_negative(std::string("sde.stiffness.") + kDirectionNames[d],
                                sde.stiffness[d]);
    record.require_not_negative(std::string("sde.damping.") + kDirectionNames[d], sde.damping[d]);
    any = any || sde.stiffness[d] > 0.0;
  }
  if (!any) {
    record.report("sde.stiffness", "no direction of the spring-damping element is stiff",
                  "give a positive stiffness in at least one direction");
  }
  if (sde.damping_ratio) record.require_not_negative("sde.damping_ratio", *sde.damping_ratio);
  check_rod(closure, record);
  const bool point = (blocked_directions(closure.type) & kTranslations) == kTranslations;
  if (sde.form != SdeForm::directional && !point) {
    record.report("sde.form",
                  "line_of_centres and three_springs hold a point in all directions, "
                  "which this closure type leaves free in some",
                  "use form = \"directional\"");
  }
  check_axes(closure, record);
  check_tilt(closure, record);
  if (sde.form != SdeForm::three_springs) return;
  for (int i = 0; i < 3; ++i) record.require_unit("sde.directions", sde.directions.row(i).norm());
  if (!(std::abs(sde.directions.determinant()) > kRotationTolerance)) {
    record.report("sde.directions", "the three directions lie in one plane",
                  "give three independent directions");
  }
}

void check_solid(const Solid& solid, RecordCheck record) {
  if (solid.kind != SolidKind::box) record.require_positive("diameter", solid.diameter);
  if (solid.kind == SolidKind::cylinder) {
    record.require_finite("begin", solid.begin.allFinite());
    record.require_finite("end", solid.end.allFinite());
    if (solid.begin != solid.end) return;
    record.report("end", "begin and end are the same point " + text_of(solid.end),
                  "give the middles of the two faces");
    return;
  }
  record.require_finite("position", solid.frame.position.allFinite());
  if (solid.kind == SolidKind::sphere) return;
  for (Eigen::Index i = 0; i < 3; ++i) {
    record.require_positive("sides." + std::to_string(i), solid.sides[i]);
  }
  const std::string fault = rotation_fault(solid.frame.rotation);
  if (!fault.empty()) record.report("rotation", "rotation " + fault, "give a right-handed frame");
}

}  // namespace

std::string inertia_fault(const Eigen::Matrix3d& inertia) {
  if (!inertia.allFinite()) return "must be finite";
  const double size = inertia.cwiseAbs().maxCoeff();
  if ((inertia - inertia.transpose()).cwiseAbs().maxCoeff() > 1.0e-12 * size) {
    return "must be symmetric";
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia, Eigen::EigenvaluesOnly);
  const Eigen::Vector3d moments = solver.eigenvalues();  // ascending
  const std::string got = ", got principal moments " + text_of(moments[0]) + ", " +
                          text_of(moments[1]) + ", " + text_of(moments[2]) + " kg m^2";
  if (!(moments[0] > 0.0)) return "must be positive definite" + got;
  if (moments[2] > moments[0] + moments[1] + kTriangleTolerance * moments[2]) {
    return "belongs to no body: a principal moment exceeds the sum of the other two" + got;
  }
  return {};
}

std::string rotation_fault(const Eigen::Matrix3d& rotation) {
  if (!rotation.allFinite()) return "must be finite";
  const Eigen::Matrix3d product = rotation.transpose() * rotation;
  const double off = (product - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (off > kRotationTolerance) {
    return "must be orthonormal to 1e-6, got an error of " + text_of(off);
  }
  if (rotation.determinant() < 0.0) return "must be a rotation, got a reflection (determinant -1)";
  return {};
}

void check_link(const Link& link, const std::string& path, std::vector<Problem>& problems) {
  RecordCheck record{path, "link '" + link.name + "'", problems};
  record.require_positive("mass", link.mass);
  record.require_finite("center_of_mass", link.center_of_mass.allFinite());
  const std::string fault = inertia_fault(link.inertia);
  if (!fault.empty()) {
    record.report("inertia", "inertia " + fault,
                  "give moments about the centre of mass; a thin rod or a point mass needs small "
                  "positive ones");
  }
  if (link.flexible) check_flexible(link, path, problems);
  for (std::size_t i = 0; i < link.shape.size(); ++i) {
    const std::string number = std::to_string(i);
    check_solid(link.shape[i],
                {path + ".shape." + number, record.title + ": shape " + number, problems});
  }
}

void check_joint(const Joint& joint, const std::string& path, std::vector<Problem>& problems) {
  RecordCheck record{path, "joint '" + joint.name + "'", problems};
  record.require_frame("frame", joint.frame);
  record.require_frame("child_frame", joint.child_frame);
  const bool advances = std::isfinite(joint.pitch) && joint.pitch != 0.0;
  if (joint.type == JointType::screw && !advances) {
    record.report("pitch", "pitch of a screw joint must not be zero, got " + text_of(joint.pitch),
                  "give the advance per turn, or use a revolute joint");
  }
  const bool is_of_tree = std::ranges::find(kTreeJointTypes, joint.type) != kTreeJointTypes.end();
  if (!is_of_tree) {
    record.report("type",
                  "type = \"" + std::string(name_of(joint.type)) +
                      "\" is of closures, not of joints of the tree",
                  "make it a [[closure]], or use a joint with coordinates of its own");
  }
  check_start(joint, record);
  check_spring(joint, record);
  if (joint.stop) check_stops(joint, record);
  if (joint.friction) check_joint_friction(joint, record);
}

void check_closure(const Closure& closure, const std::string& path,
                   std::vector<Problem>& problems) {
  RecordCheck record{path, "closure '" + closure.name + "'", problems};
  if (blocked_directions(closure.type) == 0) {
    record.report("type", "type of a closure cannot be " + std::string(name_of(closure.type)),
                  "use spherical, revolute, universal, prismatic, cylindrical, planar or fixed");
  }
  record.require_frame("first", closure.first.frame);
  record.require_frame("second", closure.second.frame);
  if (closure.type == JointType::rod) record.require_positive("length", closure.length);
  record.require_not_negative("cut.alpha", closure.alpha);
  record.require_not_negative("cut.beta", closure.beta);
  if (closure.model == ClosureModel::sde) check_sde(closure, record);
  if (closure.model == ClosureModel::clearance) check_clearance(closure, record);
}

void check_load(const Load& load, const std::string& path, std::vector<Problem>& problems) {
  RecordCheck record{path, "load '" + load.name + "'", problems};
  if (load.type == LoadType::resistance) {
    record.require_positive("law.at_speed", load.law.at_speed);
    record.require_finite("law.value", std::isfinite(load.law.value));
    return;
  }
  if (load.type != LoadType::drive) {
    record.require_unit("direction", load.direction.norm());
    record.require_finite("point", load.point.allFinite());
  }
  check_course(load.course, record);
}

void check_point(const ChosenPoint& point, const std::string& path,
                 std::vector<Problem>& problems) {
  RecordCheck record{path, "point '" + point.name + "'", problems};
  record.require_finite("position", point.position.allFinite());
}

}  // namespace linkstudy

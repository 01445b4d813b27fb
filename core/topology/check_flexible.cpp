#include "core/topology/check_flexible.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/base/ensure.h"
#include "core/topology/check_values.h"
#include "core/topology/flexible_beam.h"
#include "core/topology/record_check.h"

namespace linkstudy {
namespace {

constexpr double kCenterTolerance = 1.0e-6;
constexpr double kAxisTolerance = 1.0e-6;
constexpr double kMomentTolerance = 1.0e-8;
constexpr double kAlong = 1.0e-6;  // sine of the least angle between `across` and the beam

bool check_axes(const FlexibleBeam& beam, RecordCheck& record) {
  if (!beam.begin.allFinite() || !beam.end.allFinite() || !beam.across.allFinite()) {
    record.require_finite("flexible.begin", beam.begin.allFinite());
    record.require_finite("flexible.end", beam.end.allFinite());
    record.require_finite("flexible.across", beam.across.allFinite());
    return false;
  }
  const Eigen::Vector3d along = beam.end - beam.begin;
  if (!(along.norm() > 0.0)) {
    record.report("flexible.end",
                  "flexible.begin and flexible.end are the same point " + text_of(beam.end),
                  "give the two ends of the beam");
    return false;
  }
  const double sine = along.cross(beam.across).norm();
  if (!(sine > kAlong * along.norm() * beam.across.norm())) {
    record.report("flexible.across",
                  "flexible.across must point across the beam, got " + text_of(beam.across) +
                      " for a beam along " + text_of(Eigen::Vector3d(along.normalized())),
                  "give the direction of the section's y axis");
    return false;
  }
  return true;
}

void check_section(const FlexibleBeam& beam, RecordCheck& record) {
  if (beam.segments < 1 || beam.segments > kMostSegments) {
    record.report("flexible.segments",
                  "flexible.segments must lie between 1 and " + std::to_string(kMostSegments) +
                      ", got " + std::to_string(beam.segments),
                  "4 segments give the first bending frequency to 1.5 %, 10 to 0.25 %");
  }
  record.require_positive("flexible.young", beam.young);
  record.require_positive("flexible.shear", beam.shear);
  record.require_positive("flexible.section.second_moment_y", beam.second_moment_y);
  record.require_positive("flexible.section.second_moment_z", beam.second_moment_z);
  record.require_positive("flexible.section.torsion_constant", beam.torsion_constant);
  record.require_not_negative("flexible.retardation", beam.retardation);
}

void check_start(const FlexibleBeam& beam, RecordCheck& record) {
  const auto count = 3 * static_cast<std::size_t>(std::max(beam.segments, 0));
  const auto check_list = [&](const std::string& key, const std::vector<double>& list) {
    record.require_finite(key, all_finite(list));
    if (list.empty() || list.size() == count) return;
    record.report(key,
                  key + " must have 3 numbers for each of the " + std::to_string(beam.segments) +
                      " segments, got " + std::to_string(list.size()),
                  "give psi, theta, phi of every element from begin to end");
  };
  check_list("flexible.initial.position", beam.position);
  check_list("flexible.initial.velocity", beam.velocity);
}

void check_center(const Link& link, RecordCheck& record) {
  const FlexibleBeam& beam = *link.flexible;
  const Eigen::Vector3d middle = 0.5 * (beam.begin + beam.end);
  const double length = (beam.end - beam.begin).norm();
  if ((link.center_of_mass - middle).norm() <= kCenterTolerance * length) return;
  record.report("center_of_mass",
                "a flexible link is a uniform beam with its center_of_mass in the middle " +
                    text_of(middle) + " of flexible.begin and flexible.end, got " +
                    text_of(link.center_of_mass),
                "move the centre of mass or the ends of the beam, or leave the link rigid");
}

void check_moments(const Link& link, RecordCheck& record) {
  const FlexibleBeam& beam = *link.flexible;
  const Eigen::Matrix3d axes = beam_axes(beam);
  const Eigen::Matrix3d inertia = axes.transpose() * link.inertia * axes;
  const double off = std::max(std::abs(inertia(0, 1)), std::abs(inertia(0, 2)));
  if (off > kAxisTolerance * inertia.diagonal().maxCoeff()) {
    record.report("inertia",
                  "the axis of a flexible link, a uniform beam, must be a principal axis of its "
                  "inertia, got a product of " +
                      text_of(off) + " kg m^2 with it",
                  "give the inertia about the centre of mass in the axes of the link frame");
    return;
  }
  const double rod = link.mass * (beam.end - beam.begin).squaredNorm() / 12.0;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> across(inertia.bottomRightCorner<2, 2>(),
                                                              Eigen::EigenvaluesOnly);
  const double least = across.eigenvalues()[0];
  if (least >= rod * (1.0 - kMomentTolerance)) return;
  record.report("inertia",
                "a flexible link is a uniform beam with at least mass * length^2 / 12 = " +
                    text_of(rod) + " kg m^2 across its axis, got " + text_of(least),
                "give the moments of the uniform beam with all digits, or leave the link rigid");
}

}  // namespace

void check_flexible(const Link& link, const std::string& path, std::vector<Problem>& problems) {
  ensure(link.flexible.has_value(), "the link is flexible");
  RecordCheck record{path, "link '" + link.name + "'", problems};
  check_section(*link.flexible, record);
  check_start(*link.flexible, record);
  if (!check_axes(*link.flexible, record)) return;
  if (link.center_of_mass.allFinite()) check_center(link, record);
  const bool is_body = std::isfinite(link.mass) && link.mass > 0.0;
  if (is_body && inertia_fault(link.inertia).empty()) check_moments(link, record);
}

}  // namespace linkstudy

#include "core/topology/check_spring.h"

#include <algorithm>

#include "core/topology/check_course.h"

namespace linkstudy {
namespace {

void check_spring_table(const PointSpring& spring, RecordCheck& record) {
  const ForceCurve& curve = *spring.force;
  check_curve(curve, {"force.lengths", "force.forces"}, record);
  if (!curve.at.empty()) record.require_not_negative("force.lengths.0", curve.at.front());
  const auto acts = [&](double force) {
    return spring.acts == SpringActs::both ||
           (spring.acts == SpringActs::tension ? force > 0.0 : force < 0.0);
  };
  if (curve.force.empty() || std::ranges::any_of(curve.force, acts)) return;
  record.report(
      "force.forces",
      "no force of the table acts with acts = \"" + std::string(name_of(spring.acts)) + "\"",
      "forces are positive where the spring pulls its points together");
}

}  // namespace

void check_point_spring(const PointSpring& spring, const std::string& path,
                        std::vector<Problem>& problems) {
  RecordCheck record{path, "spring '" + spring.name + "'", problems};
  record.require_finite("first.position", spring.first.position.allFinite());
  record.require_finite("second.position", spring.second.position.allFinite());
  record.require_not_negative("stiffness", spring.stiffness);
  record.require_not_negative("damping", spring.damping);
  if (spring.free_length) record.require_not_negative("free_length", *spring.free_length);
  if (spring.course) check_course(*spring.course, record);
  if (spring.force) {
    check_spring_table(spring, record);
    return;
  }
  const bool one_sided = spring.acts != SpringActs::both && spring.damping > 0.0;
  if (spring.free_length || (!(spring.stiffness > 0.0) && !one_sided)) return;
  record.report("free_length", "free_length is missing, the length without force",
                "give it in m; 0 is that of a spring whose force is stiffness times length");
}

}  // namespace linkstudy

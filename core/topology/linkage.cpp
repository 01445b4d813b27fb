#include "core/topology/linkage.h"

namespace linkstudy {

int velocity_count(JointType type) {
  switch (type) {
    case JointType::fixed:
      return 0;
    case JointType::revolute:
    case JointType::prismatic:
    case JointType::screw:
      return 1;
    case JointType::cylindrical:
    case JointType::universal:
      return 2;
    case JointType::spherical:
    case JointType::planar:
      return 3;
    case JointType::free:
      return 6;
    case JointType::pin_in_slot:
      return 4;
    case JointType::rod:
      return 5;
  }
  return 0;
}

int position_count(JointType type, RotationCoordinates coordinates) {
  const bool ball = type == JointType::spherical || type == JointType::free;
  const bool quaternion = ball && coordinates == RotationCoordinates::quaternion;
  return velocity_count(type) + (quaternion ? 1 : 0);
}

unsigned blocked_directions(JointType type) {
  constexpr unsigned x = 1u << kX, y = 1u << kY, z = 1u << kZ;
  constexpr unsigned phi = 1u << kPhi, theta = 1u << kTheta, psi = 1u << kPsi;
  switch (type) {
    case JointType::spherical:
      return x | y | z;
    case JointType::revolute:
      return x | y | z | theta | psi;
    case JointType::universal:
      return x | y | z | psi;
    case JointType::prismatic:
      return y | z | phi | theta | psi;
    case JointType::cylindrical:
      return y | z | theta | psi;
    case JointType::pin_in_slot:
      return y | z;
    case JointType::rod:
      return x;  // along the line
    case JointType::planar:
      return x | theta | psi;
    case JointType::fixed:
      return x | y | z | phi | theta | psi;
    case JointType::free:
    case JointType::screw:
      return 0;
  }
  return 0;
}

unsigned shut_directions(const Closure& closure) {
  const Sde& sde = closure.sde;
  if (sde.start == SdeStart::given) return 0;
  unsigned stiff = 0;
  for (unsigned d = 0; d < kDirections; ++d)
    if (sde.stiffness[d] > 0.0) stiff |= 1u << d;
  constexpr unsigned translations = 1u << kX | 1u << kY | 1u << kZ;
  if (sde.form == SdeForm::line_of_centres && (stiff & 1u << kX)) stiff |= translations;
  return stiff & blocked_directions(closure.type);
}

}  // namespace linkstudy

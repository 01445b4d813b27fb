#include "tests/mechanisms/joint_at.h"

namespace linkstudy::testing {

Frame along_x(double distance) {
  return {Eigen::Matrix3d::Identity(), {distance, 0, 0}};
}

Joint joint_at(const std::string& name, JointType type, const std::string& parent,
               const std::string& child, const Frame& frame) {
  Joint made;
  made.name = name;
  made.type = type;
  made.parent = parent;
  made.child = child;
  made.frame = frame;
  return made;
}

Joint pivot_at(const std::string& name, const std::string& parent, const std::string& child,
               const Frame& frame, double angle, double rate) {
  Joint made = joint_at(name, JointType::revolute, parent, child, frame);
  made.position = {angle};
  made.velocity = {rate};
  return made;
}

}  // namespace linkstudy::testing

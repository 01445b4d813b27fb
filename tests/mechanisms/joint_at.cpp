#include "tests/mechanisms/joint_at.h"

namespace linkstudy::testing {

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

}  // namespace linkstudy::testing

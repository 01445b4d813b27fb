#include "core/kinematics/link_poses.h"

#include <algorithm>

#include "core/kinematics/forward_kinematics.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

// The joint frame in the child: a body's frame in its link.
ShortenedDualQuaternion body_in_link(const Linkage& linkage, const std::string& joint) {
  const auto at = std::find_if(linkage.joints.begin(), linkage.joints.end(),
                               [&](const Joint& j) { return j.name == joint; });
  return {euler_parameters(at->child_frame.rotation), at->child_frame.position};
}

ShortenedDualQuaternion pose_of(const BodyState<double>& body) {
  return {euler_parameters(to_eigen(body.R_WB)), to_eigen(body.p_WB)};
}

}  // namespace

std::vector<ShortenedDualQuaternion> link_poses(const Linkage& linkage, const Model& model,
                                                const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, s.q.data(), s.v.data(), w);
  std::vector<ShortenedDualQuaternion> poses(1);
  for (const BodyIndex b : bodies_outwards(m)) {
    poses.push_back(
        compose(pose_of(w.bodies[b]), inverse(body_in_link(linkage, m.joint_names[b]))));
  }
  return poses;
}

}  // namespace linkstudy

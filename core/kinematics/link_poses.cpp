#include "core/kinematics/link_poses.h"

#include <algorithm>

#include "core/kinematics/forward_kinematics.h"

namespace linkstudy {
namespace {

// The joint frame in the child: a body's frame in its link.
ShortenedDualQuaternion body_in_link(const Linkage& linkage, const std::string& joint) {
  const auto at = std::find_if(linkage.joints.begin(), linkage.joints.end(),
                               [&](const Joint& j) { return j.name == joint; });
  return {euler_parameters(at->child_frame.rotation), at->child_frame.position};
}

ShortenedDualQuaternion pose_of(const BodyState<double>& body) {
  Eigen::Matrix3d r;
  r << body.r.x.x, body.r.y.x, body.r.z.x,  //
      body.r.x.y, body.r.y.y, body.r.z.y,   //
      body.r.x.z, body.r.y.z, body.r.z.z;
  return {euler_parameters(r), {body.p.x, body.p.y, body.p.z}};
}

}  // namespace

std::vector<ShortenedDualQuaternion> link_poses(const Linkage& linkage, const Model& model,
                                                const State<double>& s) {
  const Mechanism& m = model.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, model.parameters, s.q.data(), s.v.data(), w);
  std::vector<ShortenedDualQuaternion> poses(1);
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    poses.push_back(
        compose(pose_of(w.bodies[b]), inverse(body_in_link(linkage, m.joint_names[b]))));
  }
  return poses;
}

}  // namespace linkstudy

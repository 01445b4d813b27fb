#include "core/kinematics/point_motion.h"

#include <algorithm>

#include "core/kinematics/forward_kinematics.h"

namespace linkstudy {

std::vector<PointMotion> point_motions(const Mechanism& m, const Parameters<double>& p,
                                       const double* q, const double* v, const double* qdd) {
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, p, q, v, w);
  std::copy(qdd, qdd + m.nv, w.qdd.begin());
  decltype(w.bodies) moving;
  update_body_accelerations(m, p, w, moving);
  std::vector<PointMotion> motions;
  for (const PointIndex i : indices_of(m.point_bodies)) {
    const BodyState<double>& body = moving[m.point_bodies[i]];
    const Vec3<double>& point = p.points[i];
    motions.push_back({point_position(body, point), point_velocity(body, point),
                       point_acceleration(body, p.gravity, point)});
  }
  return motions;
}

}  // namespace linkstudy

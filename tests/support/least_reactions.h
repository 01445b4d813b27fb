// Reactions of a linkage whose joints hold some motion twice, by cutting all of them: every link is
// free, Newton and Euler hold for each, all components that the joints block are unknown,
//   A r = b,   r = (l F, M) of every joint in its own axes,
// and of the many r the pseudo-inverse takes the one of least norm. l is the root mean square
// distance of the joints on loops from their middle.
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>
#include <string>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// In the coordinates of the tree joints, stacked in tree order.
struct InstantOfMotion {
  Eigen::VectorXd q, v, a;
};

// Force and moment by joint and closure: on the child, or on `first`, about the joint's origin
// there, ground axes.
using Vector6 = Eigen::Matrix<double, 6, 1>;
using JointWrenches = std::map<std::string, Vector6>;

// `bridges`: joints on no loop, which have no choice. Joints are revolute, prismatic, spherical or
// fixed, closures cut; of what acts along free directions only damping of revolute tree joints.
JointWrenches least_reactions(const Linkage& linkage, const InstantOfMotion& s,
                              const std::set<std::string>& bridges);

}  // namespace linkstudy::testing

// Linkages given by where their joints are: points and axes in ground coordinates. The frames of
// all links coincide with the ground's at the start, and all coordinates are zero there.
#pragma once

#include <Eigen/Core>
#include <string>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

// A point and an axis of a joint, and the direction of its second axis (of a universal joint), all
// in ground coordinates.
struct JointPlace {
  Eigen::Vector3d point;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d second = Eigen::Vector3d::Zero();  // zero: any
};

class PlacedLinkage {
 public:
  explicit PlacedLinkage(const std::string& name) { linkage_.name = name; }

  // A tree joint and the link that it carries (1 kg, centre of mass at the joint).
  PlacedLinkage& add(const std::string& joint, JointType type, const std::string& parent,
                     const std::string& child, const JointPlace& place);
  PlacedLinkage& close(const std::string& closure, JointType type, const std::string& first,
                       const std::string& second, const JointPlace& place);
  const Linkage& linkage() const { return linkage_; }

 private:
  Linkage linkage_;
};

Linkage planar_4r();
// Two cranks A and E on ground, each with a rod, joined at C: two freedoms. In ground coordinates
// A (0, 0), B (-0.05, 0.25), C (0.2, 0.5), D (0.5, 0.28), E (0.45, 0).
Linkage five_bar();
Linkage spherical_4r();
// Two triples of parallel axes between ground and a platform that moves straight up.
Linkage sarrus();
// Bricard's orthogonal (threefold symmetric) loop of six revolutes at right angles.
Linkage bricard();
Linkage rssr();
Linkage rccc();
// Three links pinned to a triangle, one of them ground.
Linkage triangle();
// A parallelogram that lies flat: its change point.
Linkage flat_parallelogram();
// Platform on six legs, each universal on ground, prismatic, spherical at the platform.
Linkage stewart_platform();

}  // namespace linkstudy::testing

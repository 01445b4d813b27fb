// Transmission angle of a loop of four links on ground that one drive moves: how well the coupler
// can move the output. With e along the coupler's line of force and u the direction in which the
// point where it acts on the output moves,
//   mu = arcsin |e . u|,   0 <= mu <= 90 deg:
// 90 deg presses along the motion, 0 across it, where no force of the coupler moves the output. Of
// a planar four-bar it is the angle between coupler and rocker (or 180 deg less that), of a
// slider-crank that between the rod and the normal of the rail (S. S. Balli, S. Chand,
// "Transmission angle in mechanisms", Mechanism and Machine Theory 37 (2002), 175-195).
//
// It is told where the line of force is that through both joints of the coupler, whatever moves:
//   planar loops   the coupler turns in both its joints, all axes are parallel and rails across
//                  them (freedoms out of the plane do not matter)
//   spatial loops  the coupler has spherical joints at both ends, or one and a universal joint
// Elsewhere (a coupler that slides, more links, a frame that moves) there is none.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "core/kinematics/basic_loops.h"
#include "core/kinematics/driven_motion.h"

namespace linkstudy {

class TransmissionLoop {
 public:
  // Nothing where it has no transmission angle. `start`: a closed pose. Keeps a reference.
  static std::optional<TransmissionLoop> find(const Model& closed, const BasicLoop& loop,
                                              const Drive& drive, const State<double>& start);

  const std::string& output() const { return output_.name; }  // joint on ground

  // rad, at a closed pose.
  double angle(const State<double>& s) const;

 private:
  // A joint of the loop: a tree joint with its body, or a closure.
  struct Member {
    std::string name;
    BodyIndex body{};
    ClosureIndex closure{};
    BodyIndex parent, child;  // that it joins
    int turns = 0;            // freedoms
    std::vector<int> shifts;  // 0 1 2 along x y z of its frame
    int axis = 2;             // of its frame, about which it turns
    bool is_screw = false;
  };
  struct Place {
    Eigen::Vector3d centre;
    Eigen::Matrix3d frame;
  };

  explicit TransmissionLoop(const Model& closed) : closed_(&closed) {}
  static Member member_of(const Mechanism& m, const std::string& name);
  static bool is_hinge(const Member& one);  // turns about one axis, and slides along it at most
  static bool is_rail(const Member& one);
  static bool is_centred(const Member& one);  // spherical or universal
  bool is_planar(const Member& drive, const std::vector<Place>& places);
  bool has_line(const Member& drive, const State<double>& start);
  std::vector<Place> places_at(const State<double>& s, const std::vector<const Member*>& of) const;
  static Eigen::Vector3d direction_of(const Member& one, const Place& place);

  const Model* closed_;
  Member inner_, outer_, output_;  // of the coupler at the input and at the output; on ground
  bool planar_ = false;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();  // of the plane
};

}  // namespace linkstudy

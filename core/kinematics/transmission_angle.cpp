#include "core/kinematics/transmission_angle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/kinematics/closure_kinematics.h"
#include "core/kinematics/cut_joint.h"
#include "core/kinematics/forward_kinematics.h"
#include "core/spatial/to_eigen.h"

namespace linkstudy {
namespace {

using Eigen::Vector3d;

constexpr double kParallel = 1e-7;  // sine of the angle between axes that count as parallel

bool are_parallel(const Vector3d& a, const Vector3d& b) {
  return a.cross(b).norm() <= kParallel;
}

template <class Index>
Index index_of(const IndexedVector<Index, std::string>& names, const std::string& name) {
  return Index(static_cast<int>(std::ranges::find(names, name) - names.begin()));
}

}  // namespace

TransmissionLoop::Member TransmissionLoop::member_of(const Mechanism& m, const std::string& name) {
  Member one;
  one.name = name;
  const std::string own = name.substr(name.find('.') + 1);
  if (name.starts_with("closure.")) {
    one.closure = index_of(m.closure_names, own);
    const ClosureStructure& c = m.closures[one.closure];
    const CutJoint joint = cut_joint_of(m, one.closure);
    one.parent = c.first;
    one.child = c.second;
    one.turns = joint.turns;
    one.shifts = joint.shifts;
    one.axis = 0;
    return one;
  }
  one.body = index_of(m.joint_names, own);
  const Body& body = m.bodies[one.body];
  one.parent = body.parent;
  one.child = one.body;
  for (const StageIndex i : stages_of(body)) {
    const BasicMotion motion = m.stages[i].motion;
    if (motion == BasicMotion::ball) one.turns += 3;
    if (motion == BasicMotion::screw) one.is_screw = true;
    if (motion >= BasicMotion::rx && motion <= BasicMotion::rz) {
      ++one.turns;
      one.axis = static_cast<int>(motion) - static_cast<int>(BasicMotion::rx);
    }
    if (motion <= BasicMotion::tz) one.shifts.push_back(static_cast<int>(motion));
  }
  return one;
}

bool TransmissionLoop::is_hinge(const Member& one) {
  const bool stays = one.shifts.empty() || one.shifts == std::vector<int>{one.axis};
  return one.turns == 1 && stays && !one.is_screw;
}

bool TransmissionLoop::is_rail(const Member& one) {
  return one.turns == 0 && one.shifts.size() == 1 && !one.is_screw;
}

bool TransmissionLoop::is_centred(const Member& one) {
  return one.turns >= 2 && one.shifts.empty() && !one.is_screw;
}

std::optional<TransmissionLoop> TransmissionLoop::find(const Model& closed, const BasicLoop& loop,
                                                       const Drive& drive,
                                                       const State<double>& start) {
  const auto found = std::ranges::find(loop.joints, "joint." + drive.joint);
  if (loop.joints.size() != 4 || found == loop.joints.end()) return std::nullopt;
  const auto place = static_cast<std::size_t>(found - loop.joints.begin());
  const auto member = [&](std::size_t after) {
    return member_of(closed.mechanism, loop.joints[(place + after) % 4]);
  };
  const Member input = member(0);
  const auto on_ground = [](const Member& one) {
    return one.parent == kGroundBody || one.child == kGroundBody;
  };
  const bool is_first = on_ground(member(1));  // round the loop the other way
  TransmissionLoop result(closed);
  result.output_ = member(is_first ? 1 : 3);
  result.outer_ = member(2);
  result.inner_ = member(is_first ? 3 : 1);
  const auto moves_once = [](const Member& one) {
    return (is_hinge(one) && one.shifts.empty()) || is_rail(one);
  };
  const bool is_four_bar = on_ground(input) && on_ground(result.output_) &&
                           !on_ground(result.inner_) && !on_ground(result.outer_) &&
                           moves_once(input) && moves_once(result.output_);
  if (!is_four_bar || !result.has_line(input, start)) return std::nullopt;
  return result;
}

bool TransmissionLoop::has_line(const Member& drive, const State<double>& start) {
  const auto turns = [](const Member& one) { return is_hinge(one) || is_centred(one); };
  if (!turns(inner_) || !turns(outer_)) return false;
  if (is_planar(drive, places_at(start, {&drive, &inner_, &outer_, &output_}))) return true;
  const auto is_ball = [](const Member& one) { return is_centred(one) && one.turns == 3; };
  return is_centred(inner_) && is_centred(outer_) && (is_ball(inner_) || is_ball(outer_));
}

// The axis of a hinge of the coupler keeps it in the plane.
bool TransmissionLoop::is_planar(const Member& drive, const std::vector<Place>& places) {
  const std::array<const Member*, 4> members = {&drive, &inner_, &outer_, &output_};
  if (!is_hinge(inner_) && !is_hinge(outer_)) return false;
  const std::size_t hinge = is_hinge(inner_) ? 1 : 2;
  normal_ = direction_of(*members[hinge], places[hinge]);
  planar_ = true;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (is_centred(*members[i])) continue;
    const Vector3d own = direction_of(*members[i], places[i]);
    const bool fits =
        is_rail(*members[i]) ? std::abs(own.dot(normal_)) <= kParallel : are_parallel(own, normal_);
    planar_ = planar_ && fits;
  }
  return planar_;
}

std::vector<TransmissionLoop::Place> TransmissionLoop::places_at(
    const State<double>& s, const std::vector<const Member*>& of) const {
  const Mechanism& m = closed_->mechanism;
  Workspace<double> w = make_workspace<double>(m);
  const std::vector<double> rest(static_cast<std::size_t>(m.nv), 0.0);
  update_kinematics(m, closed_->parameters, s.q.data(), rest.data(), w);
  std::vector<Place> places;
  for (const Member* one : of) {
    if (one->closure.exists()) {
      ClosureStructure closure = m.closures[one->closure];
      closure.needs_frames = true;
      ClosureState<double> x{};
      update_closure_pose(m, closure, closed_->parameters.closures[one->closure], w.bodies, x);
      const ClosureFrame frame = first_frame(x);
      places.push_back({frame.position, frame.rotation});
    } else {
      const BodyState<double>& body = w.bodies[one->body];
      places.push_back({to_eigen(body.p_WB), to_eigen(body.R_WB)});
    }
  }
  return places;
}

Vector3d TransmissionLoop::direction_of(const Member& one, const Place& place) {
  return place.frame.col(is_rail(one) ? one.shifts.front() : one.axis);
}

double TransmissionLoop::angle(const State<double>& s) const {
  const std::vector<Place> places = places_at(s, {&inner_, &outer_, &output_});
  Vector3d line = places[1].centre - places[0].centre;
  Vector3d way = direction_of(output_, places[2]);
  if (!is_rail(output_)) way = way.cross(places[1].centre - places[2].centre).eval();
  if (planar_) line -= line.dot(normal_) * normal_;
  return std::asin(std::min(1.0, std::abs(line.normalized().dot(way.normalized()))));
}

}  // namespace linkstudy

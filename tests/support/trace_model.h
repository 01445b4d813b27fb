// A Linkage as the trace formulas read it: chains of constant transforms and basic motions, one
// pseudo-inertia a link. Links are numbered in the order in which the tree places them.
//   H = [ 1/2 tr(J) I - J,  m r_C ; m r_C^T,  m ],  J about the link origin  (physics.md section 2)
#pragma once

#include <array>
#include <string>
#include <vector>

#include "tests/support/basic_motion.h"

namespace linkstudy::testing {

inline constexpr int kGroundIndex = -1;

struct TraceLink {
  std::string name;
  std::string joint;          // the joint whose child this link is
  int parent = kGroundIndex;  // index of a TraceLink
  int first_coordinate = 0;   // of its own joint
  std::vector<BasicMotion> motions;
  std::vector<Transform> operators;  // D of every motion, (4 x 4)
  Transform before;                  // parent -> joint frame, (4 x 4)
  Transform after;                   // joint frame -> child, (4 x 4)
  bool child_frame_is_identity = true;
  std::vector<int> path;  // coordinates that move this link, from the ground on
  Transform H;            // pseudo-inertia, (4 x 4)
  double mass = 0.0;
  Vector r_C;  // homogeneous, (4)
};

struct TraceClosureEnd {
  int link = kGroundIndex;
  Transform frame;  // T~(c,e), (4 x 4)
};

struct TraceClosure {
  Closure closure;
  TraceClosureEnd first;
  TraceClosureEnd second;
  std::array<double, kDirections> damping{};  // with damping_ratio already turned into numbers
};

struct TraceLoad {
  Load load;
  int coordinate = -1;  // drive, resistance
  int link = -1;        // link_force, link_torque
};

struct TraceModel {
  Linkage linkage;
  int dof = 0;
  std::vector<TraceLink> links;
  std::vector<TraceClosure> closures;
  std::vector<TraceLoad> loads;
  Vector q0;  // start, (dof)
  Vector v0;  // start, (dof)
};

// Order in which the joints are placed: repeatedly the first listed joint whose parent is placed.
// Velocities are stacked in this order. Throws when a joint never finds its parent.
std::vector<int> tree_order(const Linkage& linkage);

// Throws for quaternion coordinates (see zyx_equivalent.h), spatial clearance, unknown names.
// A damping_ratio becomes damping coefficients at the start pose.
TraceModel make_trace_model(const Linkage& linkage);

int link_index(const TraceModel& model, const std::string& link);         // kGroundIndex for ground
int coordinate_index(const TraceModel& model, const std::string& joint);  // its first coordinate

}  // namespace linkstudy::testing

#include "study/kinematics/result.h"

#include <algorithm>
#include <numeric>

#include "core/kinematics/three_turns.h"
#include "core/numerics/rank.h"
#include "core/simulation/channels.h"
#include "study/kinematics/table.h"

namespace linkstudy {
namespace {

// Columns of the coordinates to be found: those the drives do not prescribe, and the cut joint's.
Eigen::MatrixXd dependent_columns(const Eigen::MatrixXd& jacobian, const KinematicsResult& result,
                                  int nv) {
  std::vector<int> columns;
  if (result.driven) {
    columns = result.driven->dependent();
  } else {
    columns.resize(static_cast<std::size_t>(nv));
    std::iota(columns.begin(), columns.end(), 0);
  }
  for (int k = nv; k < jacobian.cols(); ++k) columns.push_back(k);
  return take_columns(jacobian, columns);
}

LoopResult analyse_loop(const Model& closed, const ClosureScale& scale, const BasicLoop& loop,
                        const State<double>& start, const KinematicsResult& result) {
  const LoopEquations equations(closed, scale, loop);
  const auto dependent = [&](const State<double>& s) {
    return dependent_columns(equations.jacobian(s, equations.cut_position(s)), result,
                             closed.mechanism.nv);
  };
  LoopResult found{loop, choose_proper_elements(dependent(start)), 0.0, {}};
  found.least_conditioning = found.proper.conditioning;
  for (const DrivenPose& pose : result.cycle.poses) {
    const double here = conditioning_of(dependent(pose.s), found.proper.elements);
    found.least_conditioning = std::min(found.least_conditioning, here);
    found.conditioning.push_back(here);
  }
  return found;
}

int freedoms_at(const Model& closed, const ClosureScale& scale, const State<double>& s) {
  const Eigen::MatrixXd jacobian = compute_scaled_closures(closed, scale, s).jacobian;
  return closed.mechanism.nv - numerical_rank(jacobian, kMobilityTolerance, kLeastRowSize).rank;
}

}  // namespace

std::vector<std::string> driven_channels(const DrivenLinkage& driven) {
  std::vector<std::string> names;
  const std::vector<Channel> all = list_channels(driven.model().mechanism);
  for (const Drive& drive : driven.drives()) {
    const auto channel = std::ranges::find_if(all, [&](const Channel& one) {
      return one.quantity == Quantity::q && one.index == drive.position.value();
    });
    names.push_back(channel->name);
  }
  return names;
}

bool contradicts(const KinematicsResult& result) {
  return result.driven && result.driven->is_overdriven() && !result.cycle.is_complete &&
         result.driven->drives().size() > 1;
}

bool ends_at_singular_angles(const KinematicsResult& result) {
  const auto& singular = result.cycle.singular;
  return result.driven && !result.cycle.is_complete && !singular.empty() &&
         !singular.back().angles.empty();
}

bool is_followed(const KinematicsResult& result) {
  return result.assembly.closed && (!result.driven || !result.cycle.poses.empty()) &&
         !contradicts(result) && !ends_at_singular_angles(result);
}

std::string blocked_text(const KinematicsResult& result) {
  if (is_followed(result)) return "";
  if (!result.assembly.closed) return open_text(result.assembly);
  if (contradicts(result)) return "the drives contradict each other or the closures";
  if (!result.cycle.is_reached) return "the begin of the course cannot be reached";
  return "the course ends where " + singular_angles_text(result.cycle.singular.back().angles);
}

KinematicsResult analyse_kinematics(const CourseRequest& request, const KinematicsOptions& declared,
                                    const Model& closed) {
  KinematicsResult result;
  State<double> start = closed.start;
  result.assembly = assemble_start(closed, start);
  result.mobility = analyse_mobility(closed, start);
  const ClosureScale scale = find_closure_scale(closed, start);
  result.course = choose_course(request, declared, closed.mechanism, start, scale.extent);
  if (!result.assembly.closed) return result;
  if (result.mobility.mobility > 0 && result.course) {
    result.driven.emplace(closed, start, result.mobility, result.course->drives);
    result.ranks = result.driven->ranks(start, kMobilityTolerance);
    result.branch = result.driven->branch(start);
    result.cycle = follow_drives(*result.driven, start, result.mobility, result.course->path,
                                 result.course->options);
    for (const DrivenPose& pose : result.cycle.poses) {
      result.freedoms.push_back(freedoms_at(closed, scale, pose.s));
    }
  }
  for (const BasicLoop& loop : find_basic_loops(closed.mechanism)) {
    result.loops.push_back(analyse_loop(closed, scale, loop, start, result));
  }
  if (!result.driven || result.cycle.poses.empty()) return result;
  result.swings = find_swings(closed.mechanism, *result.course, driven_channels(*result.driven),
                              kinematics_table(closed, result));
  result.transmission = find_transmission_angles(closed, *result.course, result.cycle, start);
  return result;
}

}  // namespace linkstudy

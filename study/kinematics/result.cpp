#include "study/kinematics/result.h"

#include <algorithm>
#include <numeric>

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
  LoopResult found{loop, choose_proper_elements(dependent(start))};
  found.least_conditioning = found.proper.conditioning;
  for (const DrivenPose& pose : result.cycle.poses) {
    const double here = conditioning_of(dependent(pose.s), found.proper.elements);
    found.least_conditioning = std::min(found.least_conditioning, here);
  }
  return found;
}

}  // namespace

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
  }
  for (const BasicLoop& loop : find_basic_loops(closed.mechanism)) {
    result.loops.push_back(analyse_loop(closed, scale, loop, start, result));
  }
  return result;
}

}  // namespace linkstudy

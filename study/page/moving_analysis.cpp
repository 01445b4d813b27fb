#include <fmt/format.h>

#include "core/kinematics/link_poses.h"
#include "study/kinematics/table.h"
#include "study/page/moving_run.h"
#include "study/page/thin.h"
#include "study/session/model_results.h"

namespace linkstudy {
namespace {

void add_pose(MovingRun& run, const Model& model, const State<double>& state, double time) {
  run.times.push_back(time);
  const auto poses = link_poses(run.linkage, model, state);
  run.poses.insert(run.poses.end(), poses.begin(), poses.end());
}

MovingRun begin_run(const std::string& title, const Linkage& linkage, const Model& model) {
  MovingRun run;
  run.title = title;
  run.linkage = linkage;
  // Every closure is the exact joint of its type.
  for (Closure& closure : run.linkage.closures) closure.model = ClosureModel::cut;
  run.links = model.mechanism.link_names;
  run.histories.name = "evaluation_0";
  run.histories.evaluation = 0;
  return run;
}

MovingRun at_equilibrium(const StaticsAnalysis& found) {
  const Model& model = found.preparation.model;
  MovingRun run = begin_run("equilibrium", found.input.linkage, model);
  const double time = found.preparation.statics->time;
  run.histories.traces.push_back({"time", "s", {time}});
  for (const StaticValue& value : found.values) {
    run.histories.traces.push_back({value.name, value.unit, {value.value}});
  }
  add_pose(run, model, model.start, time);
  return run;
}

MovingRun along_course(const KinematicsAnalysis& found) {
  const Model& closed = *found.closed;
  const std::vector<DrivenPose>& poses = found.result.cycle.poses;
  MovingRun run = begin_run("course", found.input.rigid, closed);
  if (poses.empty()) {
    run.title = "start";
    State<double> start = closed.start;
    assemble_start(closed, start);
    add_pose(run, closed, start, 0.0);
    return run;
  }
  run.driven = driven_channels(*found.result.driven);
  const Table table = kinematics_table(closed, found.result);
  for (const Column& column : pick_rows(table, even_rows(poses.size(), kMostRows)).columns) {
    run.histories.traces.push_back(
        {column.name, column.unit, std::get<std::vector<double>>(column.values)});
  }
  for (const std::size_t i : even_rows(poses.size(), kMostPoses)) {
    add_pose(run, closed, poses[i].s, poses[i].time);
  }
  return run;
}

MovingRuns found_again(const StudyResults& results, AnswerKind kind) {
  if (kind == AnswerKind::statics) {
    const StaticsAnalysis found = statics_again(results);
    if (found.values.empty()) return {{}, {"there is no equilibrium to show"}};
    return {{at_equilibrium(found)}, {}};
  }
  const KinematicsAnalysis found = course_again(results);
  if (!found.result.assembly.closed) return {{}, {"it cannot be assembled: nothing to show"}};
  return {{along_course(found)}, {}};
}

}  // namespace

MovingRuns show_analysis(const StudyResults& results, AnswerKind kind) {
  try {
    return found_again(results, kind);
  } catch (const std::exception& error) {
    return {{}, {fmt::format("the analysis could not be made again: {}", error.what())}};
  }
}

}  // namespace linkstudy

#include "study/kinematics/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "study/config/toml_writer.h"
#include "study/kinematics/report.h"
#include "study/kinematics/swing_tables.h"
#include "study/kinematics/table.h"
#include "study/record/version.h"

namespace linkstudy {
namespace {

// A table of numbers over its first column, as a group.
Table group_of(const std::string& name, Table table) {
  table.name = name;
  table.compressed = true;
  for (Column& column : table.columns) {
    column.meaning = column.name;
    column.role = &column == &table.columns.front() ? "axis" : "channel";
  }
  return table;
}

// A column with one value a row.
template <class Type, class Rows, class Field>
void add_column(Table& group, const Rows& rows, const std::string& name, const char* unit,
                const char* meaning, Field field) {
  std::vector<Type> values;
  for (const auto& row : rows) values.push_back(field(row));
  group.columns.push_back({name, unit, meaning, "response", std::move(values)});
}

Table singular_group(const KinematicsResult& result) {
  const std::vector<SingularPosition>& rows = result.cycle.singular;
  using Row = SingularPosition;
  Table group;
  group.name = "singular";
  const std::vector<std::string> channels = driven_channels(*result.driven);
  std::vector<std::uint8_t> kinds;
  for (const Row& p : rows) kinds.push_back(static_cast<std::uint8_t>(p.kind));
  group.columns.push_back(
      {"kind", "", "what the linkage does there", "response", kinds, {"lock", "branch", "stop"}});
  add_column<double>(group, rows, "time", "s", "time of the course",
                     [](const Row& p) { return p.time; });
  for (std::size_t i = 0; i < result.course->drives.size(); ++i) {
    const Drive& drive = result.course->drives[i];
    add_column<double>(group, rows, channels[i], drive.turns ? "rad" : "m", "position of the drive",
                       [i](const Row& p) { return p.drive[static_cast<Eigen::Index>(i)]; });
  }
  add_column<double>(group, rows, "quality", "1", "transmission quality",
                     [](const Row& p) { return p.quality; });
  using Count = std::int64_t;
  add_column<Count>(group, rows, "z", "", "dependent coordinates",
                    [](const Row& p) { return Count{p.ranks.dependent}; });
  add_column<Count>(group, rows, "h", "", "rank of M",
                    [](const Row& p) { return Count{p.ranks.h}; });
  add_column<Count>(group, rows, "h_R", "", "rank of (M, N)",
                    [](const Row& p) { return Count{p.ranks.h_r}; });
  add_column<std::string>(group, rows, "joints", "", "joints that may move while the drives rest",
                          [](const Row& p) { return fmt::format("{}", fmt::join(p.joints, " ")); });
  return group;
}

Table loop_group(const KinematicsResult& result) {
  using Row = LoopResult;
  Table group;
  group.name = "loops";
  const auto& rows = result.loops;
  add_column<std::string>(group, rows, "cut", "", "closure where the loop is cut",
                          [](const Row& r) { return cut_of(r.loop); });
  add_column<std::string>(group, rows, "joints", "", "joints round the loop", [](const Row& r) {
    return fmt::format("{}", fmt::join(r.loop.joints, " "));
  });
  add_column<std::string>(group, rows, "elements", "", "proper elements of the matrix equation",
                          [](const Row& r) { return elements_text(r.proper); });
  add_column<double>(group, rows, "conditioning", "1",
                     "smallest over largest singular value of these equations at the start",
                     [](const Row& r) { return r.proper.conditioning; });
  add_column<double>(group, rows, "least_conditioning", "1", "the same, least along the course",
                     [](const Row& r) { return r.least_conditioning; });
  return group;
}

}  // namespace

std::vector<Table> kinematics_tables(const ModelInput& input, const Model& closed,
                                     const KinematicsResult& result) {
  std::vector<Table> tables;
  if (result.driven) {
    tables.push_back(group_of("poses", pose_table(input.rigid, closed, result)));
    tables.push_back(singular_group(result));
    if (!result.swings.empty()) tables.push_back(swings_table(result));
    if (!result.transmission.empty()) tables.push_back(transmission_table(result));
  }
  if (!result.loops.empty()) tables.push_back(loop_group(result));
  return tables;
}

std::vector<FoundNumber> kinematics_numbers(const KinematicsResult& result) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const MobilityReport& r = result.mobility;
  const DriveCycle& cycle = result.cycle;
  const double residual =
      cycle.poses.empty()
          ? kNan
          : std::ranges::max_element(cycle.poses, {}, &DrivenPose::residual)->residual;
  const auto end = [&](int i) {
    return cycle.poses.empty() ? kNan : (i == 0 ? cycle.poses.front() : cycle.poses.back()).time;
  };
  return {
      {{"mobility", "", "freedoms that really move"}, 1.0 * r.mobility},
      {{"instantaneous_mobility", "", "freedoms at the start to first order"},
       1.0 * r.instantaneous_mobility},
      {{"kutzbach", "", "freedoms by counting joints"}, 1.0 * r.kutzbach},
      {{"redundant_constraints", "", "closure equations that say what others say"},
       1.0 * r.redundant},
      {{"links", "", "ground included"}, 1.0 * r.links},
      {{"joints", "", "closures included"}, 1.0 * r.joints},
      {{"loops", "", "independent ones"}, 1.0 * r.loops},
      {{"coordinates", "", "freedoms of all joints"}, 1.0 * r.coordinates},
      {{"closure_rank", "", "of the closure equations at the start"}, 1.0 * r.rank.rank},
      {{"start_displacement", "", "of joints to close the start, rad or m"},
       result.assembly.displacement},
      {{"positions", "", "that the course reaches"}, static_cast<double>(cycle.poses.size())},
      {{"time_begin", "s", "of the first of them"}, end(0)},
      {{"time_end", "s", "of the last"}, end(1)},
      {{"singular_positions", "", "along the course"}, static_cast<double>(cycle.singular.size())},
      {{"least_quality", "1", "transmission quality, between positions as well"},
       cycle.poses.empty() ? kNan : cycle.worst.quality},
      {{"greatest_residual", "1", "of the closure equations"}, residual}};
}

Table kinematics_group(const ModelInput& input, const Model& closed, const KinematicsResult& result,
                       const std::string& command) {
  const MobilityReport& r = result.mobility;
  Table root;
  root.attributes = {{"format", "linkstudy kinematics"},
                     {"format_version", std::int64_t{1}},
                     {"model", input.name},
                     {"mobility", std::int64_t{r.mobility}},
                     {"kutzbach", std::int64_t{r.kutzbach}},
                     {"redundant_constraints", std::int64_t{r.redundant}},
                     {"summary", kinematics_json(result)},
                     {"program_version", program_version()},
                     {"git_revision", git_revision()},
                     {"command", command},
                     {"input_resolved", write_toml(input.resolved)}};
  if (result.driven) root.parts.push_back(group_of("kinematics", kinematics_table(closed, result)));
  for (const Table& table : kinematics_tables(input, closed, result)) root.parts.push_back(table);
  return root;
}

}  // namespace linkstudy

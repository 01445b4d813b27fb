#include "study/kinematics/file.h"

#include <fmt/format.h>

#include "study/config/toml_writer.h"
#include "study/kinematics/report.h"
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
  std::vector<std::uint8_t> kinds;
  for (const Row& p : rows) kinds.push_back(static_cast<std::uint8_t>(p.kind));
  group.columns.push_back(
      {"kind", "", "what the linkage does there", "response", kinds, {"lock", "branch", "stop"}});
  add_column<double>(group, rows, "time", "s", "time of the course",
                     [](const Row& p) { return p.time; });
  for (std::size_t i = 0; i < result.course->drives.size(); ++i) {
    const Drive& drive = result.course->drives[i];
    add_column<double>(group, rows, drive.name + ".q", drive.turns ? "rad" : "m",
                       "position of the drive",
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
  if (result.driven) {
    root.parts.push_back(group_of("kinematics", kinematics_table(closed, result)));
    root.parts.push_back(group_of("poses", pose_table(input.rigid, closed, result)));
    root.parts.push_back(singular_group(result));
  }
  if (!result.loops.empty()) root.parts.push_back(loop_group(result));
  return root;
}

}  // namespace linkstudy

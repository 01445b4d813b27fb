#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "core/topology/nearest_name.h"
#include "study/cli/exit_code.h"
#include "study/cli/input.h"
#include "study/cli/kinematics_report.h"
#include "study/cli/output.h"
#include "study/cli/verbs.h"
#include "study/config/unit.h"
#include "study/store/file.h"

namespace linkstudy {
namespace {

// The joint coordinate of --drive; else the one that a drive load turns, else one of ground's.
std::optional<Drive> choose_drive(const CommandLine& line, const Mechanism& m) {
  const std::vector<Drive> drives = list_drives(m);
  if (line.drive) {
    std::vector<std::string> names;
    for (const Drive& drive : drives) {
      if (drive.name == *line.drive) return drive;
      names.push_back(drive.name);
    }
    throw UsageError(fmt::format("--drive: there is no coordinate '{}'; nearest: {}", *line.drive,
                                 fmt::join(nearest_names(*line.drive, names, 3), ", ")));
  }
  for (const LoadStructure& load : m.loads) {
    if (load.type != LoadType::drive) continue;
    for (const Drive& drive : drives) {
      if (drive.velocity == load.v) return drive;
    }
  }
  const auto on_ground = std::ranges::find_if(drives, [&](const Drive& drive) {
    const Velocity& v = m.velocities[static_cast<std::size_t>(drive.velocity)];
    return m.bodies[static_cast<std::size_t>(v.body)].parent == 0;
  });
  return on_ground == drives.end() ? std::nullopt : std::optional(*on_ground);
}

// "90 deg", "0.1 m" or a number in SI.
double read_quantity(const std::string& option, const std::string& text, const char* unit) {
  const std::optional<WrittenQuantity> written = split_quantity(text);
  if (written && written->unit.empty()) return written->value;
  const std::optional<Unit> from = written ? parse_unit(written->unit) : std::nullopt;
  const std::optional<double> value =
      from ? convert_unit(written->value, *from, *parse_unit(unit)) : std::nullopt;
  if (value) return *value;
  throw UsageError(
      fmt::format("{} must be a number in {}, or one with a unit, got '{}'", option, unit, text));
}

// A full turn from the start; of a joint that shifts, a tenth of the mechanism's extent.
CourseOptions choose_course(const CommandLine& line, const DrivenLinkage& driven,
                            const State<double>& start) {
  const Drive& drive = driven.drive();
  const char* unit = drive.turns ? "rad" : "m";
  CourseOptions course;
  course.from = start.q[static_cast<std::size_t>(drive.position)];
  if (line.from) course.from = read_quantity("--from", *line.from, unit);
  course.to = course.from + (drive.turns ? 2.0 * std::numbers::pi : 0.1 * driven.scale().extent);
  if (line.to) course.to = read_quantity("--to", *line.to, unit);
  course.both_ways = !line.from && !line.to;
  course.positions = line.positions.value_or(73);
  return course;
}

KinematicsResult analyse(const CommandLine& line, const Model& closed) {
  KinematicsResult result;
  State<double> start = closed.start;
  result.assembly = assemble_start(closed, start);
  result.mobility = analyse_mobility(closed, start);
  const std::optional<Drive> drive = choose_drive(line, closed.mechanism);
  if (!result.assembly.closed || result.mobility.mobility == 0 || !drive) return result;
  result.driven.emplace(closed, start, result.mobility, *drive);
  result.course = choose_course(line, *result.driven, start);
  const char* unit = drive->turns ? "rad/s" : "m/s";
  if (line.speed) result.speed = read_quantity("--speed", *line.speed, unit);
  result.cycle = follow_drive(*result.driven, start, result.mobility, result.course);
  return result;
}

}  // namespace

int run_kinematics(const CommandLine& line) {
  if (line.csv) require_writable(*line.csv);
  const ModelInput input = read_model_input(line);
  const Model closed = compile_closed(input.rigid);
  const KinematicsResult result = analyse(line, closed);
  const std::string text = kinematics_text(line.inputs.front(), input.name, result);
  if (line.csv) {
    const std::string csv = csv_of(kinematics_table(closed.mechanism, result));
    line.csv == "-" ? print_out(csv) : write_file_atomically(*line.csv, csv);
  }
  if (line.json || line.csv == "-") {
    fmt::print(stderr, "{}", text);
  } else {
    print_out(text);
  }
  if (line.json) print_out(kinematics_json(result) + "\n");
  return result.assembly.closed ? kDone : kTooManyFailed;
}

}  // namespace linkstudy

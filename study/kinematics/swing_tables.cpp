#include "study/kinematics/swing_tables.h"

#include <fmt/format.h>

#include <numbers>

#include "study/record/json_number.h"

namespace linkstudy {
namespace {

using SwingJson = nlohmann::ordered_json;

const char* name_of(JointMotion motion) {
  return motion == JointMotion::rests ? "rests" : motion == JointMotion::turns ? "turns" : "swings";
}

const char* shown_unit(bool is_angle) {
  return is_angle ? "deg" : "m";
}

double shown_value(double value, bool is_angle) {
  return is_angle ? value * 180.0 / std::numbers::pi : value;
}

// Of the first drive.
double drive_at(const KinematicsResult& result, const SwingEnd& end) {
  return shown_value(end.drive[0], result.course->drives.front().turns);
}

std::string end_text(const KinematicsResult& result, const SwingEnd& end, bool is_angle) {
  const Drive& drive = result.course->drives.front();
  return fmt::format("{:.6g} {} at {} = {:.6g} {}", shown_value(end.value, is_angle),
                     shown_unit(is_angle), drive.name, drive_at(result, end),
                     shown_unit(drive.turns));
}

std::string swing_text(const KinematicsResult& result, const Swing& swing) {
  if (swing.motion == JointMotion::turns) return fmt::format("{} turns through", swing.coordinate);
  const Drive& drive = result.course->drives.front();
  const auto shown = [&](double value) { return shown_value(value, swing.is_angle); };
  return fmt::format("{} by {:.6g}, {:.6g} to {:.6g} {} at {} = {:.6g} and {:.6g} {}",
                     swing.coordinate, shown(swing.greatest.value - swing.least.value),
                     shown(swing.least.value), shown(swing.greatest.value),
                     shown_unit(swing.is_angle), drive.name, drive_at(result, swing.least),
                     drive_at(result, swing.greatest), shown_unit(drive.turns));
}

SwingJson end_json(const KinematicsResult& result, const SwingEnd& end, bool is_angle) {
  return {{"value", json_number(shown_value(end.value, is_angle))},
          {"drive", json_number(drive_at(result, end))},
          {"time", json_number(end.time)}};
}

}  // namespace

std::vector<Finding> swing_findings(const KinematicsResult& result) {
  std::vector<Finding> findings;
  for (const Swing& swing : result.swings) {
    const bool is_told =
        swing.is_on_ground && !swing.is_driven && swing.motion != JointMotion::rests;
    if (is_told) findings.push_back({"swing", swing_text(result, swing)});
  }
  for (const TransmissionAngles& one : result.transmission) {
    findings.push_back({"angle", fmt::format("transmission angle to {} at least {}", one.output,
                                             end_text(result, one.least, true))});
  }
  return findings;
}

Table swings_table(const KinematicsResult& result) {
  TableOf<Swing> table("swings", "response", result.swings);
  const auto shown = [](const Swing& s, double value) { return shown_value(value, s.is_angle); };
  const auto at = [&](const SwingEnd& end) { return drive_at(result, end); };
  const char* drive_unit = shown_unit(result.course->drives.front().turns);
  table.add("coordinate", "", "of a joint or of a closure",
            [](const Swing& s) { return s.coordinate; });
  table.add("motion", "", "what it does: turns through, swings or rests",
            [](const Swing& s) { return std::string(name_of(s.motion)); });
  table.add("unit", "", "of the coordinate here",
            [](const Swing& s) { return std::string(shown_unit(s.is_angle)); });
  table.add("swing", "", "from the least to the greatest",
            [&](const Swing& s) { return shown(s, s.greatest.value - s.least.value); });
  table.add("least", "", "", [&](const Swing& s) { return shown(s, s.least.value); });
  table.add("least_at", drive_unit, "first drive at the least",
            [&](const Swing& s) { return at(s.least); });
  table.add("least_time", "s", "time of the course at the least",
            [](const Swing& s) { return s.least.time; });
  table.add("greatest", "", "", [&](const Swing& s) { return shown(s, s.greatest.value); });
  table.add("greatest_at", drive_unit, "first drive at the greatest",
            [&](const Swing& s) { return at(s.greatest); });
  table.add("greatest_time", "s", "time of the course at the greatest",
            [](const Swing& s) { return s.greatest.time; });
  table.add("on_ground", "", "1 of joints on ground",
            [](const Swing& s) { return std::int64_t{s.is_on_ground}; });
  return table.take();
}

Table transmission_table(const KinematicsResult& result) {
  const Drive& drive = result.course->drives.front();
  std::vector<double> times, drives;
  for (const DrivenPose& pose : result.cycle.poses) {
    times.push_back(pose.time);
    drives.push_back(shown_value(pose.drive[0], drive.turns));
  }
  Table table{"transmission"};
  table.columns.push_back({"time", "s", "time of the course", "axis", times});
  table.columns.push_back(
      {drive.name, shown_unit(drive.turns), "position of the drive", "response", drives});
  for (const TransmissionAngles& one : result.transmission) {
    std::vector<double> angles;
    for (const double angle : one.angle) angles.push_back(shown_value(angle, true));
    table.columns.push_back({one.output + ".transmission_angle", "deg",
                             "between the coupler's force and the normal of the output's motion",
                             "response", angles});
  }
  return table;
}

SwingJson swings_json(const KinematicsResult& result) {
  SwingJson all = SwingJson::array();
  for (const Swing& s : result.swings) {
    all.push_back(
        {{"coordinate", s.coordinate},
         {"motion", name_of(s.motion)},
         {"unit", shown_unit(s.is_angle)},
         {"swing", json_number(shown_value(s.greatest.value - s.least.value, s.is_angle))},
         {"least", end_json(result, s.least, s.is_angle)},
         {"greatest", end_json(result, s.greatest, s.is_angle)},
         {"on_ground", s.is_on_ground},
         {"driven", s.is_driven}});
  }
  return all;
}

SwingJson transmission_json(const KinematicsResult& result) {
  SwingJson all = SwingJson::array();
  for (const TransmissionAngles& one : result.transmission) {
    all.push_back({{"output", one.output}, {"least", end_json(result, one.least, true)}});
  }
  return all;
}

}  // namespace linkstudy

#include "study/kinematics/course.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/topology/nearest_name.h"
#include "study/config/input_error.h"
#include "study/config/unit.h"

namespace linkstudy {
namespace {

struct Driven {
  Drive drive;
  DriveCourse course;
};

// "90 deg", "0.1 m" or a number in SI.
double read_quantity(const std::string& option, const std::string& text, const char* unit) {
  const std::optional<WrittenQuantity> written = split_quantity(text);
  if (written && written->unit.empty()) return written->value;
  UnitFault fault;
  const std::optional<Unit> from = written ? parse_unit(written->unit, &fault) : std::nullopt;
  const std::optional<double> value =
      from ? convert_unit(written->value, *from, *parse_unit(unit)) : std::nullopt;
  if (value) return *value;
  std::string hint = from ? explain_angle(*from, *parse_unit(unit)) : fault.hint;
  if (!hint.empty()) hint = "; " + hint;
  throw UsageError(fmt::format("{} must be a number in {}, or one with a unit, got '{}'{}", option,
                               unit, text, hint));
}

const char* unit_of(const Drive& drive) {
  return drive.turns ? "rad" : "m";
}

Drive find_drive(const std::string& name, const std::vector<Drive>& all) {
  std::vector<std::string> names;
  for (const Drive& drive : all) {
    if (drive.name == name) return drive;
    names.push_back(drive.name);
  }
  throw UsageError(fmt::format("--drive: there is no coordinate '{}'; nearest: {}", name,
                               fmt::join(nearest_names(name, names, 3), ", ")));
}

// joint.NAME or joint.NAME=FROM:TO
Driven read_drive(const std::string& text, const std::vector<Drive>& all) {
  const std::size_t equals = text.find('=');
  Driven driven{find_drive(text.substr(0, equals), all), {}};
  if (equals == std::string::npos) return driven;
  const std::string range = text.substr(equals + 1);
  const std::size_t colon = range.find(':');
  if (colon == std::string::npos) {
    throw UsageError(fmt::format("--drive: a range is written FROM:TO, got '{}'", range));
  }
  const char* unit = unit_of(driven.drive);
  driven.course.from = read_quantity("--drive: FROM", range.substr(0, colon), unit);
  driven.course.to = read_quantity("--drive: TO", range.substr(colon + 1), unit);
  return driven;
}

// The joint coordinate that a drive load turns, else one of ground's.
std::optional<Driven> usual_drive(const Mechanism& m, const std::vector<Drive>& all) {
  for (const LoadStructure& load : m.loads) {
    if (load.type != LoadType::drive) continue;
    for (const Drive& drive : all) {
      if (drive.velocity == load.v) return Driven{drive, {}};
    }
  }
  const auto on_ground = std::ranges::find_if(all, [&](const Drive& drive) {
    const Velocity& v = m.velocities[drive.velocity];
    return m.bodies[v.body].parent == kGroundBody;
  });
  return on_ground == all.end() ? std::nullopt : std::optional(Driven{*on_ground, {}});
}

std::vector<Driven> choose_drives(const CourseRequest& request, const KinematicsOptions& declared,
                                  const Mechanism& m) {
  const std::vector<Drive> all = list_drives(m);
  std::vector<Driven> chosen;
  for (const std::string& text : request.drives) {
    chosen.push_back(read_drive(text, all));
    const auto is_same = [&](const Driven& d) {
      return d.drive.velocity == chosen.back().drive.velocity;
    };
    if (std::ranges::count_if(chosen, is_same) > 1) {
      throw UsageError(fmt::format("--drive: {} is given twice", chosen.back().drive.name));
    }
  }
  if (!chosen.empty()) return chosen;
  for (const DriveCourse& course : declared.drives) {
    const auto drive = std::ranges::find_if(all, [&](const Drive& d) {
      return d.joint == course.joint && d.coordinate == course.coordinate;
    });
    chosen.push_back({*drive, course});
  }
  if (!chosen.empty()) return chosen;
  if (const auto usual = usual_drive(m, all)) chosen.push_back(*usual);
  return chosen;
}

// --from and --to belong to a single drive.
void set_range(const CourseRequest& request, std::vector<Driven>& chosen) {
  if (!request.from && !request.to) return;
  const char* option = request.from ? "--from" : "--to";
  if (chosen.size() > 1) {
    throw UsageError(
        fmt::format("{} is for one drive, there are {}: give --drive {}=FROM:TO for "
                    "each",
                    option, chosen.size(), chosen.front().drive.name));
  }
  Driven& driven = chosen.front();
  const bool is_given = !request.drives.empty() && driven.course.from;
  if (is_given) {
    throw UsageError(fmt::format("{} and a range in --drive contradict each other", option));
  }
  if (driven.course.has_own_time()) {
    throw UsageError(fmt::format("{} cannot change a table or a motion: give --drive {}=FROM:TO",
                                 option, driven.drive.name));
  }
  if (request.from) {
    driven.course.from = read_quantity("--from", *request.from, unit_of(driven.drive));
  }
  if (request.to) driven.course.to = read_quantity("--to", *request.to, unit_of(driven.drive));
}

// A single drive without an end goes once around, or by a tenth of the extent; one of several
// stays where it is.
void fill_in(std::vector<Driven>& chosen, const State<double>& start, double extent) {
  for (Driven& driven : chosen) {
    DriveCourse& course = driven.course;
    if (course.law == MotionLaw::table) continue;
    if (!course.from) course.from = start.q[driven.drive.position];
    if (course.to || course.motion) continue;
    const double whole = driven.drive.turns ? 2.0 * std::numbers::pi : 0.1 * extent;
    course.to = *course.from + (chosen.size() == 1 ? whole : 0.0);
  }
}

// The longest way of the drives that turn, or of those that shift.
double longest_way(const std::vector<Driven>& chosen, bool turns) {
  double longest = 0.0;
  for (const Driven& driven : chosen) {
    if (driven.drive.turns != turns || driven.course.has_own_time()) continue;
    longest = std::max(longest, std::abs(*driven.course.to - *driven.course.from));
  }
  return longest;
}

// At one rad/s, or one m/s where nothing turns.
double time_at_unit_speed(const std::vector<Driven>& chosen) {
  const double turned = longest_way(chosen, true);
  const double way = turned > 0.0 ? turned : longest_way(chosen, false);
  return way > 0.0 ? way : 1.0;
}

// The longest of the ways, swings and tables of motions; of a speed once around, or over a tenth of
// the extent.
double time_of_motions(const std::vector<Driven>& chosen, double extent) {
  double longest = 0.0;
  for (const Driven& driven : chosen) {
    const Motion& motion = *driven.course.motion;
    const double whole = driven.drive.turns ? 2.0 * std::numbers::pi : 0.1 * extent;
    double time = motion.duration;
    if (motion.law == MotionLaw::sine) time = 1.0 / motion.frequency;
    if (motion.law == MotionLaw::table) time = motion.times.back();
    if (motion.law == MotionLaw::speed && motion.speed != 0.0) {
      time = motion.rise + whole / std::abs(motion.speed);
    }
    longest = std::max(longest, time);
  }
  return longest > 0.0 ? longest : 1.0;
}

double choose_duration(const CourseRequest& request, const KinematicsOptions& declared,
                       const std::vector<Driven>& chosen, double extent) {
  const auto table =
      std::ranges::find_if(chosen, [](const Driven& d) { return d.course.has_own_time(); });
  if (request.speed) {
    const Driven& first = chosen.front();
    const std::string unit = first.drive.turns ? "rad/s" : "m/s";
    const double speed = read_quantity("--speed", *request.speed, unit.c_str());
    if (chosen.size() > 1 || table != chosen.end()) {
      throw UsageError("--speed is for one drive that goes from one position to another");
    }
    if (!(speed > 0.0)) {
      throw UsageError("--speed must be positive: the sense is that from --from to --to");
    }
    return time_at_unit_speed(chosen) / speed;
  }
  const bool is_declared = declared.duration && request.drives.empty();
  if (table != chosen.end() && table->course.motion) {
    return is_declared ? *declared.duration : time_of_motions(chosen, extent);
  }
  if (table != chosen.end()) return table->course.times.back();
  if (is_declared) return *declared.duration;
  return time_at_unit_speed(chosen);
}

}  // namespace

std::optional<KinematicsCourse> choose_course(const CourseRequest& request,
                                              const KinematicsOptions& declared, const Mechanism& m,
                                              const State<double>& start, double extent) {
  std::vector<Driven> chosen = choose_drives(request, declared, m);
  if (chosen.empty()) return std::nullopt;
  set_range(request, chosen);
  CourseOptions options;
  options.positions = request.positions.value_or(declared.positions);
  const DriveCourse& first = chosen.front().course;
  options.both_ways = chosen.size() == 1 && first.law == MotionLaw::linear && !first.motion &&
                      !first.from && !first.to;
  fill_in(chosen, start, extent);
  const double duration = choose_duration(request, declared, chosen, extent);
  std::vector<Drive> drives;
  std::vector<DriveCourse> courses;
  for (const Driven& driven : chosen) {
    drives.push_back(driven.drive);
    courses.push_back(driven.course);
  }
  return KinematicsCourse{drives, DrivePath(courses, duration), options};
}

}  // namespace linkstudy

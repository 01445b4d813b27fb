#include "study/config/course_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/topology/nearest_name.h"
#include "study/config/joint_units.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using Kind = Tree::Kind;

constexpr double kSameTime = 1.0e-12;  // relative: "2000 ms" is 2 s

bool is_same_time(double a, double b) {
  return std::abs(a - b) <= kSameTime * std::max(std::abs(a), std::abs(b));
}

// One [[kinematics.drive]].
class DriveCheck {
 public:
  DriveCheck(const DriveCourse& drive, Tree& tree, const Reading& reading)
      : drive_(drive), tree_(tree), reading_(reading) {}

  void run() {
    if (is_known("joint") && is_known("coordinate")) check_coordinate();
    check_ends();
    if (drive_.law == MotionLaw::table) check_table();
  }

 private:
  // A value that is written and has no report.
  bool is_known(const char* key) const {
    const Tree* value = tree_.find(key);
    return value != nullptr && value->is_valid();
  }

  void fail(const Tree& value, const std::string& message, std::string remedy) {
    reading_.diagnostics.add(value.at, subject_of(reading_.scope) + message, std::move(remedy));
  }

  void check_coordinate() {
    const Tree* joints = reading_.document.find("joint");
    if (joints == nullptr || !joints->is(Kind::array)) return;
    std::vector<std::string> names;
    for (const Tree& joint : joints->items) {
      const Tree* name = joint.find("name");
      if (name == nullptr || !name->is_valid()) return;
      names.push_back(name->text);
      if (name->text == drive_.joint) return check_coordinate_of(joint_kind_of(joint));
    }
    const bool is_closure = find_named(reading_.document, "closure", drive_.joint) != nullptr;
    fail(*tree_.find("joint"), fmt::format("joint does not exist, got '{}'", drive_.joint),
         is_closure ? "a closure cannot be driven; choose a joint of the tree"
                    : suggest_name(drive_.joint, names));
  }

  void check_coordinate_of(const JointKind& kind) {
    if (!kind.is_known) return;
    const Tree& value = *tree_.find("coordinate");
    const std::vector<std::string> units = position_units(kind);
    const auto count = units.size();
    const auto index = static_cast<std::size_t>(drive_.coordinate);
    if (index >= count) {
      fail(value,
           fmt::format("joint '{}' has {} coordinates, counted from 0, got {}", drive_.joint, count,
                       index),
           count == 0 ? "a fixed joint cannot be driven; choose another joint"
                      : fmt::format("choose a coordinate from 0 to {}", count - 1));
    } else if (units[index] == "1") {
      fail(value,
           fmt::format("coordinate {} of joint '{}' is of a quaternion, which cannot be driven",
                       index, drive_.joint),
           "drive angles: coordinates = \"zyx\" of the joint, or other joints");
    }
  }

  void check_ends() {
    if (!drive_.from || !drive_.to || *drive_.from != *drive_.to) return;
    const Tree& to = *tree_.find("to");
    fail(to, fmt::format("to must differ from from, got {} for both", shown(to)),
         "a drive beside others rests where `to` is left out");
  }

  void check_table() {
    if (!is_known("times")) return;
    check_times(*tree_.find("times"));
    if (!is_known("positions") || drive_.times.size() == drive_.positions.size()) return;
    fail(*tree_.find("positions"),
         fmt::format("times and positions must have the same length, got {} and {}",
                     drive_.times.size(), drive_.positions.size()),
         "give one position for each time");
  }

  void check_times(const Tree& times) {
    const std::vector<double>& t = drive_.times;
    if (t.size() < 3) {
      fail(times, fmt::format("times must have at least 3 entries, got {}", t.size()),
           "with two ends only use law = \"linear\" or \"smooth\"");
    }
    if (!t.empty() && t[0] != 0.0) {
      fail(times.items[0], fmt::format("times must begin with 0, got {:.9g}", t[0]),
           "the course begins at 0 s");
    }
    for (std::size_t i = 1; i < t.size(); ++i) {
      if (t[i] > t[i - 1]) continue;
      return fail(times.items[i],
                  fmt::format("times must increase, got {:.9g} after {:.9g}", t[i], t[i - 1]),
                  "sort the table by time, each time once");
    }
  }

  const DriveCourse& drive_;
  const Tree& tree_;
  const Reading& reading_;
};

// Drives beside each other: no coordinate twice, all tables of one length.
class CourseCheck {
 public:
  CourseCheck(const KinematicsOptions& options, Tree& table, const Reading& reading)
      : options_(options), table_(table), reading_(reading) {}

  void run() {
    for (std::size_t i = 0; i < options_.drives.size(); ++i) {
      const Tree& tree = table_.find("drive")->items[i];
      if (!tree.is(Kind::table)) continue;
      check_twice(i, tree);
      if (options_.drives[i].law == MotionLaw::table) compare_tables(i, tree);
    }
    check_duration();
  }

 private:
  void check_twice(std::size_t index, const Tree& tree) {
    const DriveCourse& drive = options_.drives[index];
    if (!are_known(tree, {"coordinate"})) return;
    if (!position_unit(reading_.document, drive.joint, drive.coordinate)) return;
    for (std::size_t i = 0; i < index; ++i) {
      const DriveCourse& other = options_.drives[i];
      if (drive.joint != other.joint || drive.coordinate != other.coordinate) continue;
      return reading_.diagnostics.add(
          tree.find("joint")->at,
          fmt::format("drive {}: coordinate {} of joint '{}' is driven twice", index,
                      drive.coordinate, drive.joint),
          "give every coordinate one drive");
    }
  }

  void compare_tables(std::size_t index, const Tree& tree) {
    const DriveCourse& drive = options_.drives[index];
    if (drive.times.empty()) return;
    const double end = drive.times.back();
    if (!table_end_) {
      table_end_ = end;
      table_index_ = index;
    }
    if (is_same_time(end, *table_end_)) return;
    reading_.diagnostics.add(
        tree.find("times")->items.back().at,
        fmt::format("drive {}: times must end at {:.9g} s like those of drive {}, got {:.9g} s",
                    index, *table_end_, table_index_, end),
        "all drives share one course; give their tables the same last time");
  }

  void check_duration() {
    if (!options_.duration || !table_end_ || is_same_time(*options_.duration, *table_end_)) return;
    reading_.diagnostics.add(
        table_.find("duration")->at,
        fmt::format("kinematics.duration must be the last of the times of drive {}, {:.9g} s, got "
                    "{:.9g} s",
                    table_index_, *table_end_, *options_.duration),
        "leave duration out: the table has it");
  }

  const KinematicsOptions& options_;
  Tree& table_;
  const Reading& reading_;
  std::optional<double> table_end_;
  std::size_t table_index_ = 0;  // drive that table_end_ comes from
};

}  // namespace

void check_drive(DriveCourse& drive, Tree& table, const Reading& reading) {
  DriveCheck(drive, table, reading).run();
}

void check_course(KinematicsOptions& options, Tree& table, const Reading& reading) {
  CourseCheck(options, table, reading).run();
}

}  // namespace linkstudy

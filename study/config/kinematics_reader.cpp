#include "study/config/kinematics_reader.h"

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

bool is_known(const Tree* value) {
  return value != nullptr && value->is_valid();
}

// One [[kinematics.drive]].
class DriveReader {
 public:
  DriveReader(Tree& tree, const Tree& model, std::size_t index, Diagnostics& diagnostics)
      : tree_(tree),
        model_(model),
        diagnostics_(diagnostics),
        subject_(fmt::format("drive {}: ", index)) {}

  DriveCourse read() {
    drive_.joint = word_of(tree_, "joint");
    drive_.coordinate = static_cast<int>(integer_of(tree_, "coordinate", 0));
    const std::string law = word_of(tree_, "law");
    if (law == "smooth") drive_.law = MotionLaw::smooth;
    if (law == "polynomial_345") drive_.law = MotionLaw::polynomial_345;
    if (law == "table") drive_.law = MotionLaw::table;
    if (is_known(tree_.find("joint")) && is_known(tree_.find("coordinate"))) check_coordinate();
    read_ends();
    if (drive_.law == MotionLaw::table) read_table();
    return drive_;
  }

 private:
  void fail(const Tree& value, const std::string& message, std::string remedy) {
    diagnostics_.add(value.at, subject_ + message, std::move(remedy));
  }

  void check_coordinate() {
    const Tree* joints = model_.find("joint");
    if (joints == nullptr || !joints->is(Kind::array)) return;
    std::vector<std::string> names;
    for (const Tree& joint : joints->items) {
      const Tree* name = joint.find("name");
      if (!is_known(name)) return;
      names.push_back(name->text);
      if (name->text == drive_.joint) return check_coordinate_of(joint_kind_of(joint));
    }
    fail(*tree_.find("joint"), fmt::format("joint does not exist, got '{}'", drive_.joint),
         is_closure() ? "a closure cannot be driven; choose a joint of the tree"
                      : suggest_name(drive_.joint, names));
  }

  bool is_closure() const {
    const Tree* closures = model_.find("closure");
    return closures != nullptr && std::ranges::any_of(closures->items, [&](const Tree& closure) {
             return word_of(closure, "name") == drive_.joint;
           });
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

  // A plain number is in the coordinate's own unit.
  void require_unit(Tree* value, const char* key) {
    const std::optional<std::string> unit = position_unit(model_, drive_.joint, drive_.coordinate);
    if (!is_known(value) || value->text.empty() || !unit || *unit == "1") return;
    if (value->text != *unit) report_unit(*value, subject_ + key, *unit, diagnostics_);
  }

  std::optional<double> read_end(const char* key) {
    Tree* value = tree_.find(key);
    require_unit(value, key);
    if (!is_known(value)) return std::nullopt;
    return value->as_number();
  }

  void read_ends() {
    drive_.from = read_end("from");
    drive_.to = read_end("to");
    if (!drive_.from || !drive_.to || *drive_.from != *drive_.to) return;
    const Tree& to = *tree_.find("to");
    fail(to, fmt::format("to must differ from from, got {} for both", shown(to)),
         "a drive beside others rests where `to` is left out");
  }

  void read_table() {
    drive_.times = numbers_of(tree_, "times");
    drive_.positions = numbers_of(tree_, "positions");
    Tree* times = tree_.find("times");
    Tree* positions = tree_.find("positions");
    if (is_known(times)) check_times(*times);
    if (!is_known(positions)) return;
    for (Tree& value : positions->items) require_unit(&value, "positions");
    if (!is_known(times) || drive_.times.size() == drive_.positions.size()) return;
    fail(*positions,
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

  Tree& tree_;
  const Tree& model_;
  Diagnostics& diagnostics_;
  std::string subject_;
  DriveCourse drive_;
};

// Drives beside each other: no coordinate twice, all tables of one length.
class CourseReader {
 public:
  CourseReader(Tree& model, Tree& kinematics, Diagnostics& diagnostics)
      : model_(model), kinematics_(kinematics), diagnostics_(diagnostics) {}

  KinematicsOptions read() {
    KinematicsOptions options;
    options.positions = static_cast<int>(integer_of(kinematics_, "positions", options.positions));
    if (Tree* drives = kinematics_.find("drive"); drives != nullptr) {
      for (Tree& drive : drives->items) {
        if (drive.is(Kind::table)) add(drive, options.drives);
        ++index_;
      }
    }
    read_duration(options);
    return options;
  }

 private:
  void add(Tree& tree, std::vector<DriveCourse>& drives) {
    DriveCourse drive = DriveReader(tree, model_, index_, diagnostics_).read();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      const DriveCourse& other = drives[i];
      if (drive.joint != other.joint || drive.coordinate != other.coordinate) continue;
      if (!is_known(tree.find("coordinate"))) continue;
      if (!position_unit(model_, drive.joint, drive.coordinate)) continue;
      diagnostics_.add(tree.find("joint")->at,
                       fmt::format("drive {}: coordinate {} of joint '{}' is driven twice", index_,
                                   drive.coordinate, drive.joint),
                       "give every coordinate one drive");
      break;
    }
    if (drive.law == MotionLaw::table) compare_tables(tree, drive);
    drives.push_back(std::move(drive));
  }

  void compare_tables(const Tree& tree, const DriveCourse& drive) {
    if (drive.times.empty() || !tree.find("times")->is_valid()) return;
    const double end = drive.times.back();
    if (!table_end_) {
      table_end_ = end;
      table_ = index_;
    }
    if (is_same_time(end, *table_end_)) return;
    diagnostics_.add(tree.find("times")->items.back().at,
                     fmt::format("drive {}: times must end at {:.9g} s like those of drive {}, got "
                                 "{:.9g} s",
                                 index_, *table_end_, table_, end),
                     "all drives share one course; give their tables the same last time");
  }

  void read_duration(KinematicsOptions& options) {
    const Tree* value = kinematics_.find("duration");
    if (!is_known(value)) return;
    options.duration = value->as_number();
    if (!table_end_ || is_same_time(*options.duration, *table_end_)) return;
    diagnostics_.add(value->at,
                     fmt::format("kinematics.duration must be the last of the times of drive {}, "
                                 "{:.9g} s, got {:.9g} s",
                                 table_, *table_end_, *options.duration),
                     "leave duration out: the table has it");
  }

  Tree& model_;
  Tree& kinematics_;
  Diagnostics& diagnostics_;
  std::size_t index_ = 0;
  std::optional<double> table_end_;
  std::size_t table_ = 0;  // drive that table_end_ comes from
};

}  // namespace

KinematicsOptions read_kinematics(Tree& model, Diagnostics& diagnostics) {
  Tree* tree = model.find("kinematics");
  if (tree == nullptr || !tree->is(Kind::table)) return {};
  return CourseReader(model, *tree, diagnostics).read();
}

}  // namespace linkstudy

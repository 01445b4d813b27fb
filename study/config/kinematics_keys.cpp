// The keys of driven courses.
#include "study/config/course_check.h"
#include "study/config/joint_units.h"
#include "study/config/model_keys.h"
#include "study/config/read_value.h"

namespace linkstudy {
namespace {

using enum KeyType;

std::vector<std::string> coordinate_unit(const Tree& document, const Tree& drive) {
  const std::optional<std::string> unit =
      position_unit(document, word_of(drive, "joint"), integer_of(drive, "coordinate", 0));
  // None of a quaternion is driven: that is reported at the coordinate.
  return unit && *unit != "1" ? std::vector<std::string>{*unit} : std::vector<std::string>();
}

Fields<DriveCourse> drive_fields() {
  using enum MotionLaw;
  const Condition between = only_where("law", {linear, smooth, polynomial_345});
  const Condition in_table = only_where("law", {MotionLaw::table});
  Fields<DriveCourse> drive;
  drive.add("joint", &DriveCourse::joint,
            {.type = name, .meaning = "joint of the tree", .required = true});
  drive.add("coordinate", &DriveCourse::coordinate,
            {.meaning = "coordinate within the joint, from 0; none of a quaternion",
             .range = {.low = 0, .high = 5}});
  drive.add("law", &DriveCourse::law,
            {.meaning = "way from `from` to `to`, with s = t / duration",
             .words = {"linear", "smooth", "polynomial_345", "table"}});
  drive.add("from", &DriveCourse::from,
            {.meaning = "begin; default: where the linkage stands",
             .unit = "rad|m",
             .only = between,
             .units_by = coordinate_unit});
  drive.add("to", &DriveCourse::to,
            {.meaning = "end; default: of a single drive a full turn on, or a tenth of the "
                        "linkage's extent; of several it rests",
             .unit = "rad|m",
             .only = between,
             .units_by = coordinate_unit});
  drive.add("times", &DriveCourse::times,
            {.meaning = "at least 3, the first 0, increasing",
             .unit = "s",
             .required = true,
             .only = in_table});
  drive.add("positions", &DriveCourse::positions,
            {.meaning = "one for each of `times`",
             .unit = "rad|m",
             .required = true,
             .only = in_table,
             .units_by = coordinate_unit});
  drive.finish(check_drive);
  return drive;
}

}  // namespace

Fields<KinematicsOptions> kinematics_fields() {
  Fields<KinematicsOptions> course;
  course.add("positions", &KinematicsOptions::positions,
             {.meaning = "positions evenly spaced in time, both ends included",
              .range = {.low = 2, .high = 1000000}});
  course.add("duration", &KinematicsOptions::duration,
             {.meaning = "time of the course; default: the last of `times`, else what the longest "
                         "way takes at 1 rad/s, or at 1 m/s where no drive turns",
              .unit = "s",
              .range = kPositive});
  course.tables("drive", &KinematicsOptions::drives,
                {.meaning = "coordinates that are driven; default: one that the program chooses"},
                drive_fields());
  course.finish(check_course);
  return course;
}

}  // namespace linkstudy

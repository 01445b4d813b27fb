// The keys of driven courses.
#include "study/config/model_keys.h"

namespace linkstudy {
namespace {

using enum KeyType;
using Rows = std::vector<KeyRow>;

constexpr const char* kDrive = "kinematics.drive.*.";

void add_drive_rows(Rows& rows) {
  rows.push_back({.path = "kinematics.drive",
                  .type = tables,
                  .meaning = "coordinates that are driven; default: one that the program chooses"});
  rows.push_back({.path = std::string(kDrive) + "joint",
                  .type = name,
                  .meaning = "joint of the tree",
                  .required = true});
  rows.push_back({.path = std::string(kDrive) + "coordinate",
                  .type = integer,
                  .meaning = "coordinate within the joint, from 0; none of a quaternion",
                  .range = {.low = 0, .high = 5},
                  .standard = "0"});
  rows.push_back({.path = std::string(kDrive) + "law",
                  .type = word,
                  .meaning = "way from `from` to `to`, with s = t / duration: linear: s; smooth: "
                             "3 s^2 - 2 s^3; polynomial_345: 10 s^3 - 15 s^4 + 6 s^5; table: cubic "
                             "spline through `positions` at `times`",
                  .standard = "\"linear\"",
                  .words = {"linear", "smooth", "polynomial_345", "table"}});
}

void add_end_row(Rows& rows, const std::string& key, const std::string& meaning) {
  rows.push_back({.path = kDrive + key,
                  .type = number,
                  .meaning = meaning,
                  .unit = "rad|m",
                  .only = {"law", {"linear", "smooth", "polynomial_345"}}});
}

void add_table_row(Rows& rows, const std::string& key, const std::string& meaning,
                   const std::string& unit) {
  rows.push_back({.path = kDrive + key,
                  .type = numbers,
                  .meaning = meaning,
                  .unit = unit,
                  .required = true,
                  .only = {"law", {"table"}}});
}

}  // namespace

void add_kinematics_rows(Rows& rows) {
  rows.push_back({.path = "kinematics",
                  .type = table,
                  .meaning = "course of `linkstudy kinematics`; of no effect on runs"});
  rows.back().effects.push_back(acts_where("verb", {"kinematics"}));
  rows.push_back({.path = "kinematics.positions",
                  .type = integer,
                  .meaning = "positions evenly spaced in time, both ends included",
                  .range = {.low = 2, .high = 1000000},
                  .standard = "73"});
  rows.push_back({.path = "kinematics.duration",
                  .type = number,
                  .meaning = "time of the course; default: the last of `times`, else what the "
                             "longest way takes at 1 rad/s, or at 1 m/s where no drive turns",
                  .unit = "s",
                  .range = kPositive});
  add_drive_rows(rows);
  add_end_row(rows, "from", "begin; default: where the linkage stands");
  add_end_row(rows, "to",
              "end; default: of a single drive a full turn on, or a tenth of the "
              "linkage's extent; of several it rests");
  add_table_row(rows, "times", "at least 3, the first 0, increasing", "s");
  add_table_row(rows, "positions", "one for each of `times`", "rad|m");
}

}  // namespace linkstudy

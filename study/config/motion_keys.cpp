// The keys of [[motion]].
#include "study/config/joint_units.h"
#include "study/config/model_keys.h"
#include "study/config/read_value.h"
#include "study/config/table_files.h"

namespace linkstudy {
namespace {

using enum KeyType;

// "rad" or "m" of the coordinate that moves, when joint, type and coordinate are right.
std::optional<std::string> moved_unit(const Tree& document, const Tree& motion) {
  const std::optional<std::string> unit =
      position_unit(document, word_of(motion, "joint"), integer_of(motion, "coordinate", 0));
  return unit && *unit != "1" ? unit : std::nullopt;  // the checks report a quaternion
}

std::vector<std::string> moved_units(const Tree& document, const Tree& motion) {
  const std::optional<std::string> unit = moved_unit(document, motion);
  return unit ? std::vector<std::string>{*unit} : std::vector<std::string>();
}

std::vector<std::string> moved_speed_units(const Tree& document, const Tree& motion) {
  const std::optional<std::string> unit = moved_unit(document, motion);
  return unit ? std::vector<std::string>{*unit + "/s"} : std::vector<std::string>();
}

// What was reported is no law: a speed takes the fewest keys.
void leave_unknown_motion(Motion& motion, Tree& law, const Reading&) {
  if (are_known(law, {"shape", "from", "to", "duration", "speed", "rise", "amplitude", "frequency",
                      "phase", "times", "positions"})) {
    return;
  }
  motion.law = MotionLaw::speed;
  motion.from.reset();
  motion.speed = motion.rise = 0.0;
}

Fields<Motion> motion_law_fields() {
  using enum MotionLaw;
  const Condition between = only_where("shape", {linear, smooth, polynomial_345});
  const Condition at_speed = only_where("shape", {speed});
  const Condition swings = only_where("shape", {sine});
  const Condition in_table = only_where("shape", {MotionLaw::table});
  Fields<Motion> law;
  law.add("shape", &Motion::law,
          {.meaning = "way of the coordinate, with s = t / duration; linear goes on at the end, "
                      "smooth and polynomial_345 rest there, a table goes on straight"});
  law.add("from", &Motion::from,
          {.meaning = "position at t = 0, of a sine the middle; default: where the joint stands",
           .unit = "rad|m",
           .only = only_where("shape", {speed, linear, smooth, polynomial_345, sine}),
           .units_by = moved_units});
  law.add("to", &Motion::to,
          {.meaning = "position at `duration`",
           .unit = "rad|m",
           .required = true,
           .only = between,
           .units_by = moved_units});
  law.add("duration", &Motion::duration,
          {.meaning = "time of the way",
           .unit = "s",
           .range = kPositive,
           .required = true,
           .only = between});
  law.add("speed", &Motion::speed,
          {.meaning = "constant rate",
           .unit = "rad/s|m/s",
           .required = true,
           .only = at_speed,
           .units_by = moved_speed_units});
  law.add("rise", &Motion::rise,
          {.meaning = "time from rest to `speed`, by 3 s^2 - 2 s^3; 0: it has it from the start",
           .unit = "s",
           .range = kNotNegative,
           .only = at_speed});
  law.add("amplitude", &Motion::amplitude,
          {.meaning = "of the sine",
           .unit = "rad|m",
           .required = true,
           .only = swings,
           .units_by = moved_units});
  law.add("frequency", &Motion::frequency,
          {.meaning = "of the sine",
           .unit = "Hz",
           .range = kPositive,
           .required = true,
           .only = swings});
  law.add("phase", &Motion::phase, {.meaning = "of the sine", .unit = "rad", .only = swings});
  law.add("times", &Motion::times,
          {.meaning = "at least 3, the first 0, increasing",
           .unit = "s",
           .required = true,
           .only = in_table});
  law.add("positions", &Motion::positions,
          {.meaning = "one for each of `times`",
           .unit = "rad|m",
           .required = true,
           .only = in_table,
           .units_by = moved_units});
  add_table_file(law, in_table, {{"time", "times"}, {"position", "positions"}});
  return law;
}

}  // namespace

Fields<Motion> motion_fields() {
  Fields<Motion> motion;
  motion.add("name", &Motion::name,
             {.type = name, .meaning = "name of the motion", .required = true});
  motion.add("joint", &Motion::joint,
             {.type = name, .meaning = "joint of the tree", .required = true});
  motion.add("coordinate", &Motion::coordinate,
             {.meaning = "coordinate within the joint, from 0; none of a quaternion",
              .range = {.low = 0, .high = 5}});
  motion.table("law", {.meaning = "position over time", .required = true}, motion_law_fields(),
               leave_unknown_motion);
  return motion;
}

}  // namespace linkstudy

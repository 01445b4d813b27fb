#include "study/kinematics/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/kinematics/three_turns.h"
#include "study/kinematics/swing_tables.h"
#include "study/record/counted.h"
#include "study/record/json_number.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(SingularState state) {
  return state == SingularState::none        ? "none"
         : state == SingularState::permanent ? "permanent"
                                             : "instantaneous";
}

const char* name_of(SingularKind kind) {
  return kind == SingularKind::lock ? "lock" : kind == SingularKind::branch ? "branch" : "stop";
}

std::string position_text(const Drive& drive, double value) {
  return drive.turns ? fmt::format("{:.9g} rad ({:.6g} deg)", value, value * 180.0 / M_PI)
                     : fmt::format("{:.9g} m", value);
}

int idle_count(const MobilityReport& r) {
  int count = 0;
  for (const IdleFreedom& idle : r.idle) count += idle.count;
  return count;
}

// What the numbers mean for the designer.
std::string verdict(const KinematicsResult& result) {
  const MobilityReport& r = result.mobility;
  if (!result.assembly.closed) return "cannot be assembled: " + open_text(result.assembly);
  if (r.mobility == 0 && r.instantaneous_mobility > 0) {
    return "a structure that gives way slightly: joints can start to move but not go on";
  }
  if (r.mobility == 0) return "a structure: nothing moves";
  std::string text = counted(r.mobility, "freedom");
  if (const int idle = idle_count(r); idle > 0) text += fmt::format(", {} of them idle", idle);
  if (contradicts(result)) text += "; the drives contradict each other";
  if (r.redundant > 0) {
    text += fmt::format("; overconstrained by {}: moves only as long as its dimensions are exact",
                        r.redundant);
  }
  if (r.instantaneous_mobility > r.mobility) {
    text += fmt::format("; starts at a singular position, where {} meet",
                        counted(r.instantaneous_mobility, "freedom"));
  }
  return text;
}

std::string rank_text(const MobilityReport& r) {
  std::string text = fmt::format("{} of {} closure equations", r.rank.rank, r.rows);
  if (r.rank.rank > 0) {
    text += fmt::format(", singular values kept down to {:.3g}, dropped from {:.3g}",
                        r.rank.smallest_kept, r.rank.largest_dropped);
  }
  return text;
}

std::string redundant_text(const MobilityReport& r) {
  std::vector<std::string> parts;
  bool are_alike = static_cast<int>(r.redundant_joints.size()) == r.joints;
  for (const CarriedRedundancy& joint : r.redundant_joints) {
    parts.push_back(fmt::format("{} ({})", joint.joint, joint.count));
    are_alike = are_alike && joint.count == r.redundant_joints.front().count;
  }
  const std::string where = are_alike ? "every joint" : fmt::format("{}", fmt::join(parts, ", "));
  return fmt::format("{}, held twice at {}; single reactions there are not unique", r.redundant,
                     where);
}

std::string idle_text(const IdleFreedom& idle) {
  const std::string count = idle.count > 1 ? fmt::format(" ({} freedoms)", idle.count) : "";
  return fmt::format("{} moves alone between {}{}", fmt::join(idle.links, " with "),
                     fmt::join(idle.joints, " and "), count);
}

// All drives at a position of the course.
std::string drives_text(const std::vector<Drive>& drives, const Eigen::VectorXd& at) {
  if (drives.size() == 1) return position_text(drives.front(), at[0]);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    parts.push_back(fmt::format("{} = {}", drives[i].name,
                                position_text(drives[i], at[static_cast<Eigen::Index>(i)])));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string singular_text(const std::vector<Drive>& drives, const SingularPosition& p) {
  const char* what = p.kind == SingularKind::lock ? "locks: cannot be driven beyond"
                     : p.kind == SingularKind::branch
                         ? "branches, the drive does not decide which way:"
                         : "stops: could not be followed beyond";
  const std::string rests =
      drives.size() == 1 ? drives.front().name + " rests" : std::string("the drives rest");
  const std::string angles = singular_angles_text(p.angles);
  return fmt::format("{} {}; {} may move while {} (h = {}, h_R = {} of {}){}", what,
                     drives_text(drives, p.drive), fmt::join(p.joints, ", "), rests, p.ranks.h,
                     p.ranks.h_r, p.regular_rank, angles.empty() ? "" : "; " + angles);
}

const char* name_of(MotionLaw law) {
  switch (law) {
    case MotionLaw::smooth:
      return "smooth";
    case MotionLaw::polynomial_345:
      return "polynomial 3-4-5";
    case MotionLaw::table:
      return "table";
    case MotionLaw::speed:
      return "speed";
    case MotionLaw::sine:
      return "sine";
    default:
      return "linear";
  }
}

std::string drive_text(const Drive& drive, const DriveCourse& course, double duration) {
  const auto range = [&](double from, double to, const char* between) {
    return fmt::format("{} {} {} {} {}, {} in {:.6g} s", drive.name,
                       *between == 't' ? "from" : "between", position_text(drive, from), between,
                       position_text(drive, to), name_of(course.law), duration);
  };
  if (course.motion) {
    return fmt::format("{} by motion.{}, {} in {:.6g} s", drive.name, course.motion->name,
                       name_of(course.motion->law), duration);
  }
  if (course.law == MotionLaw::table) {
    const auto [least, most] =
        std::minmax_element(course.positions.begin(), course.positions.end());
    return range(*least, *most, "and");
  }
  if (*course.from == *course.to) {
    return fmt::format("{} rests at {}", drive.name, position_text(drive, *course.to));
  }
  return range(*course.from, *course.to, "to");
}

std::string drive_names(const std::vector<Drive>& drives) {
  std::vector<std::string> names;
  for (const Drive& drive : drives) names.push_back(drive.name);
  return fmt::format("{}", fmt::join(names, ", "));
}

std::string overdriven_text(const DrivenLinkage& driven, bool is_complete) {
  const std::string names = drive_names(driven.drives());
  if (driven.drives().size() == 1) return names + " cannot move";
  if (is_complete) return names + ": more drives than freedoms, but their courses fit each other";
  return names +
         " contradict each other or the closures: together they cannot move; leave one of them out";
}

void add_notes(const DrivenLinkage& driven, bool is_complete, std::vector<Finding>& findings) {
  if (driven.releases_holds()) {
    findings.push_back({"note", "hold = true is left aside: the drives could not move"});
  }
  if (driven.is_overdriven()) findings.push_back({"note", overdriven_text(driven, is_complete)});
  if (driven.undetermined() > 0) {
    const int count = driven.undetermined();
    findings.push_back(
        {"note", fmt::format("{} {} not determined by the drives: least motion taken",
                             counted(count, "freedom"), count == 1 ? "is" : "are")});
  }
}

void add_course(const KinematicsResult& result, std::vector<Finding>& findings) {
  const std::vector<Drive>& drives = result.course->drives;
  const DrivePath& path = result.course->path;
  const DriveCycle& cycle = result.cycle;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    findings.push_back({"drive", drive_text(drives[i], path.courses()[i], path.duration())});
  }
  add_notes(*result.driven, cycle.is_complete, findings);
  if (!cycle.is_reached) findings.push_back({"course", "its begin cannot be reached"});
  if (cycle.is_reached) {
    findings.push_back(
        {"course",
         fmt::format("{} of {} positions{}", cycle.poses.size(), result.course->options.positions,
                     cycle.is_complete ? "" : ", the rest cannot be reached")});
  }
  if (!cycle.poses.empty()) {
    const Transmission& worst = cycle.worst;
    const std::string where =
        drives.size() == 1 ? drives_text(drives, worst.drive) : fmt::format("{:.6g} s", worst.time);
    findings.push_back(
        {"transmission", fmt::format("quality at least {:.4g}, at {}", worst.quality, where)});
  }
  for (Finding& one : swing_findings(result)) findings.push_back(std::move(one));
  if (result.driven->is_overdriven()) return;
  for (const SingularPosition& p : cycle.singular) {
    findings.push_back({"singular", singular_text(drives, p)});
  }
}

std::string loop_text(const LoopResult& r) {
  return fmt::format("{}; cut at {}; proper equations {}, conditioning {:.3g}, at least {:.3g}",
                     fmt::join(r.loop.joints, ", "), cut_of(r.loop), elements_text(r.proper),
                     r.proper.conditioning, r.least_conditioning);
}

Json singular_json(const KinematicsResult& result) {
  Json all = Json::array();
  for (const SingularPosition& p : result.cycle.singular) {
    const std::vector<Drive>& drives = result.course->drives;
    Json at = Json::object();
    for (std::size_t i = 0; i < drives.size(); ++i) {
      at[drives[i].name] = p.drive[static_cast<Eigen::Index>(i)];
    }
    all.push_back({{"kind", name_of(p.kind)},
                   {"drive", drives.front().name},
                   {"position", p.drive[0]},
                   {"drives", at},
                   {"time", p.time},
                   {"quality", json_number(p.quality)},
                   {"dependent", p.ranks.dependent},
                   {"h", p.ranks.h},
                   {"h_R", p.ranks.h_r},
                   {"regular_rank", p.regular_rank},
                   {"joints", p.joints},
                   {"singular_angles", p.angles}});
  }
  return all;
}

Json loops_json(const KinematicsResult& result) {
  Json all = Json::array();
  for (const LoopResult& r : result.loops) {
    Json elements = Json::array();
    for (const int element : r.proper.elements) elements.push_back(element_name(element));
    all.push_back({{"cut", cut_of(r.loop)},
                   {"joints", r.loop.joints},
                   {"elements", elements},
                   {"conditioning", json_number(r.proper.conditioning)},
                   {"least_conditioning", json_number(r.least_conditioning)}});
  }
  return all;
}

Json drives_json(const KinematicsResult& result) {
  Json names = Json::array();
  for (const Drive& drive : result.course->drives) names.push_back(drive.name);
  return names;
}

// Distance of the last singular value kept from the first dropped; null without one of them.
Json gap_json(const NumericalRank& rank) {
  return rank.rank > 0 && rank.largest_dropped > 0.0
             ? Json(rank.smallest_kept / rank.largest_dropped)
             : Json(nullptr);
}

Json joints_json(const MobilityReport& r) {
  Json names = Json::array();
  for (const CarriedRedundancy& joint : r.redundant_joints) names.push_back(joint.joint);
  return names;
}

Json idle_json(const MobilityReport& r) {
  Json all = Json::array();
  for (const IdleFreedom& idle : r.idle) {
    all.push_back({{"links", idle.links}, {"joints", idle.joints}, {"count", idle.count}});
  }
  return all;
}

// The equations behind it all.
void add_equations(const KinematicsResult& result, std::vector<Finding>& findings) {
  const MobilityReport& r = result.mobility;
  findings.push_back({"parts", fmt::format("{} with ground, {}, {}, {}", counted(r.links, "link"),
                                           counted(r.joints, "joint"), counted(r.loops, "loop"),
                                           counted(r.coordinates, "coordinate"))});
  findings.push_back({"rank", rank_text(r)});
  if (!result.assembly.closed) return;
  const char* state =
      r.state == SingularState::none ? "regular"
      : r.state == SingularState::permanent
          ? "permanent singular state: equations are redundant everywhere"
      : r.redundant > 0      ? "instantaneous singular state: equations are redundant everywhere, "
                               "more of them here"
      : r.rank.rank < r.rows ? "instantaneous singular state: equations are redundant here only"
                             : "instantaneous singular state: joints give way to first order only";
  findings.push_back({"state", state});
  for (const LoopResult& loop : result.loops) findings.push_back({"loop", loop_text(loop)});
  if (!result.driven) return;
  const std::string branch = result.branch == 0 ? "" : fmt::format(", branch {:+d}", result.branch);
  findings.push_back(
      {"drive rank", fmt::format("h = {}, h_R = {} of {} dependent coordinates{}", result.ranks.h,
                                 result.ranks.h_r, result.ranks.dependent, branch)});
}

}  // namespace

std::vector<Finding> kinematics_findings(const KinematicsResult& result) {
  constexpr double kMoved = 1e-6;  // rad or m
  const MobilityReport& r = result.mobility;
  std::vector<Finding> findings = {
      {"verdict", verdict(result)},
      {"mobility", fmt::format("{} (Kutzbach {}, at this position {})", r.mobility, r.kutzbach,
                               r.instantaneous_mobility)}};
  if (result.assembly.closed && result.assembly.displacement > kMoved) {
    findings.push_back(
        {"start", fmt::format("moved by {:.3g} (rad, m) to close", result.assembly.displacement)});
  }
  for (const std::string& flipped : flipped_texts(result.assembly)) {
    findings.push_back({"warning", flipped});
  }
  if (result.assembly.closed && r.redundant > 0) {
    findings.push_back({"redundant", redundant_text(r)});
  }
  for (const IdleFreedom& idle : r.idle) findings.push_back({"idle", idle_text(idle)});
  if (result.driven) add_course(result, findings);
  add_equations(result, findings);
  return findings;
}

std::string kinematics_text(const std::string& file, const std::string& name,
                            const KinematicsResult& result) {
  return summary_line("model", fmt::format("{} ({})", name, file)) +
         text_of(kinematics_findings(result));
}

std::string kinematics_json(const KinematicsResult& result) {
  const MobilityReport& r = result.mobility;
  Json json = {{"status", is_followed(result) ? "done" : "failed"},
               {"mobility", r.mobility},
               {"instantaneous_mobility", r.instantaneous_mobility},
               {"kutzbach", r.kutzbach},
               {"redundant_constraints", r.redundant},
               {"redundant_joints", joints_json(r)},
               {"idle_freedoms", idle_json(r)},
               {"links", r.links},
               {"joints", r.joints},
               {"loops", r.loops},
               {"coordinates", r.coordinates},
               {"rank", r.rank.rank},
               {"rank_gap", gap_json(r.rank)},
               {"singular_state", name_of(r.state)},
               {"singular_positions", singular_json(result)},
               {"basic_loops", loops_json(result)},
               {"closed", result.assembly.closed},
               {"flipped", result.assembly.flipped},
               {"verdict", verdict(result)}};
  if (result.driven) {
    json["drive"] = result.course->drives.front().name;
    json["drives"] = drives_json(result);
    json["driven_channels"] = driven_channels(*result.driven);
    json["dependent"] = result.ranks.dependent;
    json["h"] = result.ranks.h;
    json["h_R"] = result.ranks.h_r;
    json["branch"] = result.branch;
    json["positions"] = result.cycle.poses.size();
    json["complete"] = result.cycle.is_complete;
    json["contradiction"] = contradicts(result);
    json["swings"] = swings_json(result);
    json["transmission_angles"] = transmission_json(result);
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string cut_of(const BasicLoop& loop) {
  const auto is_cut = [](const std::string& name) { return name.starts_with("closure."); };
  return *std::find_if(loop.joints.begin(), loop.joints.end(), is_cut);
}

std::string elements_text(const ProperElements& proper) {
  std::vector<std::string> names;
  for (const int element : proper.elements) names.emplace_back(element_name(element));
  return fmt::format("{}", fmt::join(names, " "));
}

}  // namespace linkstudy

#include "study/cli/kinematics_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/simulation/channels.h"
#include "study/cli/output.h"

namespace linkstudy {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(SingularState state) {
  return state == SingularState::none        ? "none"
         : state == SingularState::permanent ? "permanent"
                                             : "instantaneous";
}

const char* name_of(SingularKind kind) {
  return kind == SingularKind::lock ? "lock" : "branch";
}

std::string plural(int count, const std::string& one, const std::string& many) {
  return fmt::format("{} {}", count, count == 1 ? one : many);
}

std::string angle_or_length(const Drive& drive, double value) {
  return drive.turns ? fmt::format("{:.9g} rad ({:.6g} deg)", value, value * 180.0 / M_PI)
                     : fmt::format("{:.9g} m", value);
}

// What the numbers mean for the designer.
std::string verdict(const KinematicsResult& result) {
  const MobilityReport& r = result.mobility;
  if (!result.assembly.closed) {
    return fmt::format("cannot be assembled: closure.{} stays open by {:.3g}",
                       result.assembly.worst_closure, result.assembly.residual);
  }
  if (r.mobility == 0 && r.instantaneous_mobility > 0) {
    return "a structure that gives way slightly: joints can start to move but not go on";
  }
  if (r.mobility == 0) return "a structure: nothing moves";
  std::string text = plural(r.mobility, "freedom", "freedoms");
  if (r.redundant > 0) {
    text += fmt::format("; overconstrained by {}: moves only as long as its dimensions are exact",
                        r.redundant);
  }
  if (r.instantaneous_mobility > r.mobility) {
    text += fmt::format("; starts at a singular position, where {} meet",
                        plural(r.instantaneous_mobility, "freedom", "freedoms"));
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
  for (const CarriedRedundancy& joint : r.redundant_joints) {
    parts.push_back(fmt::format("{} ({})", joint.joint, joint.count));
  }
  return fmt::format("{}, held twice at {}; single reactions there are not unique", r.redundant,
                     fmt::join(parts, ", "));
}

std::string idle_text(const IdleFreedom& idle) {
  return fmt::format("{} moves alone between {}", fmt::join(idle.links, " with "),
                     fmt::join(idle.joints, " and "));
}

std::string singular_text(const Drive& drive, const SingularPosition& p) {
  const std::string where = angle_or_length(drive, p.drive);
  const char* what = p.kind == SingularKind::lock
                         ? "locks: cannot be driven beyond"
                         : "branches, the drive does not decide which way:";
  return fmt::format("{} {}; {} may move while {} rests", what, where, fmt::join(p.joints, ", "),
                     drive.name);
}

double worst_quality(const DriveCycle& cycle, std::size_t& at) {
  double worst = 1.0;
  for (std::size_t i = 0; i < cycle.poses.size(); ++i) {
    if (cycle.poses[i].quality > worst) continue;
    worst = cycle.poses[i].quality;
    at = i;
  }
  return worst;
}

std::string course_text(const KinematicsResult& result) {
  const DrivenLinkage& driven = *result.driven;
  const Drive& drive = driven.drive();
  const DriveCycle& cycle = result.cycle;
  std::string text = summary_line("drive", fmt::format("{} from {} to {}", drive.name,
                                                       angle_or_length(drive, result.course.from),
                                                       angle_or_length(drive, result.course.to)));
  if (driven.releases_holds()) {
    text += summary_line("note", "hold = true is left aside: the drive could not move");
  }
  if (driven.undetermined() > 0) {
    text += summary_line("note",
                         fmt::format("{} not determined by the drive: least motion taken",
                                     plural(driven.undetermined(), "freedom is", "freedoms are")));
  }
  if (!cycle.is_reached) text += summary_line("course", "its begin cannot be reached");
  if (cycle.is_reached) {
    std::size_t at = 0;
    const double worst = worst_quality(cycle, at);
    text += summary_line(
        "course", fmt::format("{} of {} positions{}", cycle.poses.size(), result.course.positions,
                              cycle.is_complete ? "" : ", the rest is locked"));
    if (!cycle.poses.empty()) {
      text += summary_line(
          "transmission",
          fmt::format("quality at least {:.4g}, at {}", worst,
                      angle_or_length(drive, driven.coordinate(cycle.poses[at].theta))));
    }
  }
  for (const SingularPosition& p : cycle.singular) {
    text += summary_line("singular", singular_text(drive, p));
  }
  return text;
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json singular_json(const KinematicsResult& result) {
  Json all = Json::array();
  for (const SingularPosition& p : result.cycle.singular) {
    all.push_back({{"kind", name_of(p.kind)},
                   {"drive", result.driven->drive().name},
                   {"position", p.drive},
                   {"quality", number(p.quality)},
                   {"joints", p.joints}});
  }
  return all;
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

std::vector<Channel> table_channels(const Mechanism& mechanism) {
  std::vector<Channel> channels;
  for (const Channel& channel : list_channels(mechanism)) {
    const bool is_wanted = channel.quantity == Quantity::q || channel.quantity == Quantity::v ||
                           channel.quantity == Quantity::a;
    if (is_wanted) channels.push_back(channel);
  }
  return channels;
}

}  // namespace

std::string kinematics_text(const std::string& file, const std::string& name,
                            const KinematicsResult& result) {
  const MobilityReport& r = result.mobility;
  std::string text = summary_line("model", fmt::format("{} ({})", name, file));
  text += summary_line("verdict", verdict(result));
  text += summary_line(
      "parts", fmt::format("{} with ground, {}, {}, {} coordinates",
                           plural(r.links, "link", "links"), plural(r.joints, "joint", "joints"),
                           plural(r.loops, "loop", "loops"), r.coordinates));
  text += summary_line("mobility", fmt::format("{} (Kutzbach {}, at this position {})", r.mobility,
                                               r.kutzbach, r.instantaneous_mobility));
  text += summary_line("rank", rank_text(r));
  if (!result.assembly.closed) return text;
  text += summary_line("state", r.state == SingularState::none
                                    ? std::string("regular")
                                    : fmt::format("singular, {}", name_of(r.state)));
  if (r.redundant > 0) text += summary_line("redundant", redundant_text(r));
  for (const IdleFreedom& idle : r.idle) text += summary_line("idle", idle_text(idle));
  return result.driven ? text + course_text(result) : text;
}

std::string kinematics_json(const KinematicsResult& result) {
  const MobilityReport& r = result.mobility;
  Json json = {{"mobility", r.mobility},
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
               {"closed", result.assembly.closed},
               {"verdict", verdict(result)}};
  if (result.driven) {
    json["drive"] = result.driven->drive().name;
    json["positions"] = result.cycle.poses.size();
    json["complete"] = result.cycle.is_complete;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Table kinematics_table(const Mechanism& mechanism, const KinematicsResult& result) {
  Table table;
  const std::vector<Channel> channels = table_channels(mechanism);
  for (const Channel& channel : channels) table.columns.push_back({channel.name, channel.unit});
  table.columns.push_back({"quality", "1"});
  table.columns.push_back({"residual", "1"});
  for (const DrivenPose& pose : result.cycle.poses) {
    const Eigen::VectorXd v = result.driven->velocity(pose, result.speed);
    const Eigen::VectorXd a = result.driven->acceleration(pose, result.speed, 0.0);
    std::vector<Cell> cells;
    for (const Channel& channel : channels) {
      if (channel.quantity == Quantity::q) {
        cells.emplace_back(pose.s.q[static_cast<std::size_t>(channel.index)]);
      } else if (pose.is_singular) {
        cells.emplace_back();
      } else {
        cells.emplace_back(channel.quantity == Quantity::v ? v[channel.index] : a[channel.index]);
      }
    }
    cells.emplace_back(pose.quality);
    cells.emplace_back(pose.residual);
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace linkstudy

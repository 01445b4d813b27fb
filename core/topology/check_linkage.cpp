#include "core/topology/check_linkage.h"

#include <algorithm>
#include <cmath>

#include "core/topology/check_motion.h"
#include "core/topology/check_spring.h"
#include "core/topology/check_values.h"
#include "core/topology/flexible_beam.h"
#include "core/topology/nearest_name.h"
#include "core/topology/record_check.h"

namespace linkstudy {
namespace {

std::string quoted(const std::string& name) {
  return "'" + name + "'";
}

// Names, references and the tree. Values of one record are judged in check_values.
class Checker {
 public:
  explicit Checker(const Linkage& linkage) : linkage_(linkage) {}

  std::vector<Problem> run() {
    if (linkage_.links.empty()) {
      report("link", "the model has no link", "describe at least one [[link]]");
    }
    check_names("link", linkage_.links);
    check_names("joint", linkage_.joints);
    check_names("closure", linkage_.closures);
    check_names("load", linkage_.loads);
    check_names("motion", linkage_.motions);
    check_names("coupling", linkage_.couplings);
    check_names("spring", linkage_.springs);
    check_names("point", linkage_.points);
    check_link_values();
    check_element_names();
    check_joints();
    check_tree();
    check_closures();
    check_loads();
    check_motions();
    check_couplings();
    check_springs();
    check_points();
    return std::move(problems_);
  }

 private:
  void report(std::string path, std::string message, std::string remedy) {
    problems_.push_back({std::move(path), std::move(message), std::move(remedy)});
  }

  // "joint.A" where that is unambiguous, else by position: "joint.2".
  template <class Record>
  static std::string path_of(const char* kind, const std::vector<Record>& records,
                             std::size_t index) {
    const std::string& name = records[index].name;
    const auto first = std::find_if(records.begin(), records.end(),
                                    [&](const Record& record) { return record.name == name; });
    const bool addressable =
        is_legal_name(name) && first == records.begin() + static_cast<std::ptrdiff_t>(index);
    return std::string(kind) + "." + (addressable ? name : std::to_string(index));
  }

  template <class Record>
  void check_names(const std::string& kind, const std::vector<Record>& records) {
    for (std::size_t i = 0; i < records.size(); ++i) {
      const std::string& name = records[i].name;
      const std::string path = kind + "." + std::to_string(i) + ".name";
      const auto earlier = std::find_if(records.begin(), records.end(),
                                        [&](const Record& other) { return other.name == name; });
      if (!is_legal_name(name)) {
        report(
            path,
            kind + ": name must be a letter followed by letters, digits or _, got '" + name + "'",
            "write a name such as " + kind + "_1");
      } else if (kind == "link" && name == kGround) {
        report(path, "link: the name 'ground' is reserved for the fixed link",
               "give the link another name; 'ground' exists without being described");
      } else if (earlier < records.begin() + static_cast<std::ptrdiff_t>(i)) {
        report(path, kind + ": the name '" + name + "' is used twice",
               "give every " + kind + " its own name");
      }
    }
  }

  bool is_link(const std::string& name) const {
    return std::any_of(linkage_.links.begin(), linkage_.links.end(),
                       [&](const Link& link) { return link.name == name; });
  }

  bool is_body(const std::string& name) const { return name == kGround || is_link(name); }

  std::vector<std::string> body_names() const {
    std::vector<std::string> names = {kGround};
    for (const Link& link : linkage_.links) names.push_back(link.name);
    return names;
  }

  const Joint* find_joint(const std::string& name) const {
    for (const Joint& joint : linkage_.joints)
      if (joint.name == name) return &joint;
    return nullptr;
  }

  void check_link_values() {
    for (std::size_t i = 0; i < linkage_.links.size(); ++i) {
      check_link(linkage_.links[i], path_of("link", linkage_.links, i), problems_);
    }
  }

  // What a flexible link becomes has names of its own.
  void check_element_names() {
    for (const Link& link : linkage_.links) {
      if (!link.flexible) continue;
      const int segments = link.flexible->segments;
      report_names_of(link.name, "link", linkage_.links, 0, segments, element_name);
      report_names_of(link.name, "joint", linkage_.joints, 1, segments, element_joint_name);
    }
  }

  template <class Record, class Naming>
  void report_names_of(const std::string& flexible, const std::string& kind,
                       const std::vector<Record>& records, int first, int last, Naming name_of) {
    for (std::size_t i = 0; i < records.size(); ++i) {
      for (int k = first; k <= last; ++k) {
        if (records[i].name != name_of(flexible, k)) continue;
        report(kind + "." + std::to_string(i) + ".name",
               kind + ": the name " + quoted(records[i].name) +
                   " is that of a part of the flexible link " + quoted(flexible),
               "give the " + kind + " another name");
      }
    }
  }

  void check_joints() {
    for (std::size_t i = 0; i < linkage_.joints.size(); ++i) {
      const Joint& joint = linkage_.joints[i];
      const std::string path = path_of("joint", linkage_.joints, i);
      check_joint(joint, path, problems_);
      const std::string who = "joint " + quoted(joint.name);
      if (!is_body(joint.parent))
        report_unknown_link(path + ".parent", who, "parent", joint.parent);
      if (joint.child == kGround) {
        report(path + ".child", who + ": the child must be a moving link, got 'ground'",
               "swap parent and child");
      } else if (!is_link(joint.child)) {
        report_unknown_link(path + ".child", who, "child", joint.child);
      } else if (joint.child == joint.parent) {
        report(path + ".child", who + ": parent and child are the same link '" + joint.child + "'",
               "a joint connects two links");
      }
    }
  }

  void report_unknown_link(const std::string& path, const std::string& who, const char* key,
                           const std::string& name) {
    report(path, who + ": " + key + " is not a link, got '" + name + "'",
           suggest_name(name, body_names()));
  }

  // Every link is the child of exactly one joint, and the parents lead to ground.
  void check_tree() {
    const std::size_t count = linkage_.links.size();
    std::vector<const Joint*> carrier(count, nullptr);
    bool child_is_broken = false;
    for (std::size_t j = 0; j < linkage_.joints.size(); ++j) {
      const Joint& joint = linkage_.joints[j];
      const std::size_t child = index_of_link(joint.child);
      if (child == count || joint.child == joint.parent) {
        child_is_broken = true;
      } else if (carrier[child] != nullptr) {
        child_is_broken = true;
        report(path_of("joint", linkage_.joints, j) + ".child",
               "joint " + quoted(joint.name) + ": link '" + joint.child +
                   "' is already the child of joint '" + carrier[child]->name + "'",
               "a link hangs on one joint; the joint that shuts the loop is a [[closure]]");
      } else {
        carrier[child] = &joint;
      }
    }
    // A joint with a wrong child explains a link without a joint.
    if (!child_is_broken) report_orphans(carrier);
    report_loops(carrier);
  }

  std::size_t index_of_link(const std::string& name) const {
    const auto found = std::find_if(linkage_.links.begin(), linkage_.links.end(),
                                    [&](const Link& link) { return link.name == name; });
    return static_cast<std::size_t>(found - linkage_.links.begin());
  }

  void report_orphans(const std::vector<const Joint*>& carrier) {
    for (std::size_t i = 0; i < carrier.size(); ++i) {
      const std::string& name = linkage_.links[i].name;
      if (carrier[i] != nullptr || index_of_link(name) != i || name == kGround) continue;
      report(path_of("link", linkage_.links, i),
             "link " + quoted(name) + " is not connected: it is the child of no joint",
             "add a [[joint]] with child = \"" + name + "\"");
    }
  }

  // Follows the parents of every link; a walk that meets itself is a loop, reported once.
  void report_loops(const std::vector<const Joint*>& carrier) {
    const std::size_t count = carrier.size();
    std::vector<std::size_t> seen_by(count, count);
    for (std::size_t start = 0; start < count; ++start) {
      std::size_t link = start;
      while (link < count && seen_by[link] == count && carrier[link] != nullptr) {
        seen_by[link] = start;
        link = index_of_link(carrier[link]->parent);
      }
      const bool met_itself = link < count && seen_by[link] == start && carrier[link] != nullptr;
      if (met_itself) report_loop(carrier, link);
    }
  }

  void report_loop(const std::vector<const Joint*>& carrier, std::size_t start) {
    const Joint* first = carrier[start];
    std::string loop = linkage_.links[start].name;
    std::size_t link = start;
    do {
      link = index_of_link(carrier[link]->parent);
      loop += " - " + linkage_.links[link].name;
      if (carrier[link] < first) first = carrier[link];
    } while (link != start);
    const auto index = static_cast<std::size_t>(first - linkage_.joints.data());
    report(path_of("joint", linkage_.joints, index),
           "joint " + quoted(first->name) + ": the links " + loop +
               " form a loop that never reaches ground",
           "joints form a tree that starts at ground; shut loops with [[closure]]");
  }

  void check_closures() {
    for (std::size_t i = 0; i < linkage_.closures.size(); ++i) {
      const Closure& closure = linkage_.closures[i];
      const std::string path = path_of("closure", linkage_.closures, i);
      const std::string who = "closure " + quoted(closure.name);
      check_closure(closure, path, problems_);
      check_ends(closure, path, who, "a closure connects two different links");
    }
  }

  void check_loads() {
    for (std::size_t i = 0; i < linkage_.loads.size(); ++i) {
      const Load& load = linkage_.loads[i];
      const std::string path = path_of("load", linkage_.loads, i);
      check_load(load, path, problems_);
      const bool on_joint = load.type == LoadType::drive || load.type == LoadType::resistance;
      if (on_joint) {
        check_coordinate(load.joint, load.coordinate, path, "load " + quoted(load.name),
                         "carry a load");
      } else if (load.link == kGround || !is_link(load.link)) {
        std::vector<std::string> names = body_names();
        names.erase(names.begin());
        report(path + ".link",
               "load " + quoted(load.name) + ": link is not a moving link, got '" + load.link + "'",
               suggest_name(load.link, names));
      }
      check_over(load.course, path, "load " + quoted(load.name));
    }
  }

  void check_over(const Course& course, const std::string& path, const std::string& who) {
    if (!course.over) return;
    const auto& [name, coordinate] = *course.over;
    const std::string at = path + ".course.over";
    const Joint* joint = check_coordinate(name, coordinate, at, who, "be gone over");
    if (joint != nullptr) check_angles(*joint, coordinate, at, who);
  }

  // The joint, or nothing where it or its coordinate does not exist.
  const Joint* check_coordinate(const std::string& name, int coordinate, const std::string& path,
                                const std::string& who, const std::string& purpose) {
    const Joint* joint = find_joint(name);
    if (joint == nullptr) {
      std::vector<std::string> names;
      for (const Joint& known : linkage_.joints) names.push_back(known.name);
      report(path + ".joint", who + ": joint does not exist, got '" + name + "'",
             suggest_name(name, names));
      return nullptr;
    }
    const int count = velocity_count(joint->type);
    if (coordinate >= 0 && coordinate < count) return joint;
    report(path + ".coordinate",
           who + ": joint '" + joint->name + "' has " + std::to_string(count) +
               " coordinates, counted from 0, got " + std::to_string(coordinate),
           count == 0 ? "a fixed joint cannot " + purpose + "; choose another joint"
                      : "choose a coordinate from 0 to " + std::to_string(count - 1));
    return nullptr;
  }

  void check_angles(const Joint& joint, int coordinate, const std::string& path,
                    const std::string& who) {
    const int nv = velocity_count(joint.type);
    const bool has_quaternion = position_count(joint.type, joint.coordinates) != nv;
    if (!has_quaternion || coordinate < nv - 3) return;
    report(path + ".coordinate",
           who + ": coordinate " + std::to_string(coordinate) + " of joint " + quoted(joint.name) +
               " is of a quaternion, which has no law of its own",
           "use coordinates = \"zyx\" of the joint");
  }

  void check_couplings() {
    for (std::size_t i = 0; i < linkage_.couplings.size(); ++i) {
      const Coupling& coupling = linkage_.couplings[i];
      const std::string path = path_of("coupling", linkage_.couplings, i);
      const std::string who = "coupling " + quoted(coupling.name);
      RecordCheck record{path, who, problems_};
      if (coupling.offset) record.require_finite("offset", std::isfinite(*coupling.offset));
      if (coupling.terms.size() < 2) {
        report(path + ".terms",
               who + ": terms must be two or more, got " + std::to_string(coupling.terms.size()),
               "a single coordinate that stays is a motion with speed = 0.0");
      }
      for (std::size_t k = 0; k < coupling.terms.size(); ++k) {
        check_term(coupling, k, path + ".terms." + std::to_string(k), who);
      }
    }
  }

  void check_term(const Coupling& coupling, std::size_t k, const std::string& path,
                  const std::string& who) {
    const CouplingTerm& term = coupling.terms[k];
    if (!std::isfinite(term.factor) || term.factor == 0.0) {
      report(path + ".factor",
             who + ": factor must be finite and not zero, got " + text_of(term.factor),
             "leave the term out");
    }
    const Joint* joint = check_coordinate(term.joint, term.coordinate, path, who, "be coupled");
    if (joint == nullptr) return;
    check_angles(*joint, term.coordinate, path, who);
    const auto end = coupling.terms.begin() + static_cast<std::ptrdiff_t>(k);
    const bool again = std::any_of(coupling.terms.begin(), end, [&](const CouplingTerm& other) {
      return other.joint == term.joint && other.coordinate == term.coordinate;
    });
    if (!again) return;
    report(path + ".joint", who + ": the coordinate is in the terms twice",
           "give it one term with the sum of the factors");
  }

  void check_motions() {
    const std::vector<Motion>& all = linkage_.motions;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Motion& motion = all[i];
      const std::string path = path_of("motion", all, i);
      const std::string who = "motion " + quoted(motion.name);
      check_motion(motion, path, problems_);
      const Joint* joint = check_coordinate(motion.joint, motion.coordinate, path, who, "be moved");
      if (joint == nullptr) continue;
      check_angles(*joint, motion.coordinate, path, who);
      const auto same = std::find_if(all.begin(), all.end(), [&](const Motion& other) {
        return other.joint == motion.joint && other.coordinate == motion.coordinate;
      });
      if (&*same == &motion) continue;
      report(path + ".joint", who + ": motion " + quoted(same->name) + " moves the same coordinate",
             "leave one of them out");
    }
  }

  void check_springs() {
    for (std::size_t i = 0; i < linkage_.springs.size(); ++i) {
      const PointSpring& spring = linkage_.springs[i];
      const std::string path = path_of("spring", linkage_.springs, i);
      const std::string who = "spring " + quoted(spring.name);
      check_point_spring(spring, path, problems_);
      check_ends(spring, path, who, "a spring acts between points of two different links");
      if (spring.course) check_over(*spring.course, path, who);
    }
  }

  // Of a closure or spring: two links that exist.
  template <class Record>
  void check_ends(const Record& record, const std::string& path, const std::string& who,
                  const char* remedy) {
    const bool first_is_known = is_body(record.first.link);
    const bool second_is_known = is_body(record.second.link);
    if (!first_is_known) {
      report_unknown_link(path + ".first.link", who, "first.link", record.first.link);
    }
    if (!second_is_known) {
      report_unknown_link(path + ".second.link", who, "second.link", record.second.link);
    }
    if (first_is_known && second_is_known && record.first.link == record.second.link) {
      report(path + ".second.link",
             who + ": both ends are on the same link '" + record.second.link + "'", remedy);
    }
  }

  void check_points() {
    for (std::size_t i = 0; i < linkage_.points.size(); ++i) {
      const ChosenPoint& point = linkage_.points[i];
      const std::string path = path_of("point", linkage_.points, i);
      check_point(point, path, problems_);
      if (is_body(point.link)) continue;
      report_unknown_link(path + ".link", "point " + quoted(point.name), "link", point.link);
    }
  }

  const Linkage& linkage_;
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> check(const Linkage& linkage) {
  return Checker(linkage).run();
}

}  // namespace linkstudy

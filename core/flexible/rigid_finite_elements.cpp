#include "core/flexible/rigid_finite_elements.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/topology/flexible_beam.h"

namespace linkstudy {
namespace {

// Rounding of a point that lies where two spans meet, relative to a segment.
constexpr double kMeeting = 1.0e-9;

// A beam divided: positions along it are counted from `begin`.
class DividedBeam {
 public:
  explicit DividedBeam(const Link& link)
      : link_(link),
        beam_(*link.flexible),
        axes_(beam_axes(beam_)),
        length_((beam_.end - beam_.begin).norm()),
        segment_(length_ / beam_.segments) {}

  int last() const { return beam_.segments; }

  // Element whose span holds the projection of a point of the link frame.
  int element_at(const Eigen::Vector3d& point) const {
    const double along = axes_.col(0).dot(point - beam_.begin) / segment_;
    const double clamped = std::clamp(along, 0.0, static_cast<double>(last()));
    return static_cast<int>(std::floor(clamped + 0.5 + kMeeting));
  }

  Link element(int k) const {
    const double from = k == 0 ? 0.0 : joint_at(k);
    const double to = k == last() ? length_ : joint_at(k + 1);
    const double share = (to - from) / length_;
    const double middle = 0.5 * (from + to) - 0.5 * length_;
    Link element;
    element.name = element_name(link_.name, k);
    element.mass = share * link_.mass;
    element.center_of_mass = link_.center_of_mass + middle * axes_.col(0);
    element.inertia = rod_inertia(element.mass, to - from) +
                      share * (link_.inertia - rod_inertia(link_.mass, length_));
    return element;
  }

  // Between elements k - 1 and k.
  Joint joint(int k, bool towards_end) const {
    Joint joint;
    joint.name = element_joint_name(link_.name, k);
    joint.type = JointType::spherical;
    joint.parent = element_name(link_.name, towards_end ? k - 1 : k);
    joint.child = element_name(link_.name, towards_end ? k : k - 1);
    joint.frame = {axes_, beam_.begin + joint_at(k) * axes_.col(0)};
    joint.child_frame = joint.frame;
    joint.stiffness = {beam_.young * beam_.second_moment_z / segment_,
                       beam_.young * beam_.second_moment_y / segment_,
                       beam_.shear * beam_.torsion_constant / segment_};
    joint.rest.assign(3, 0.0);
    joint.elastic = true;
    joint.position = of_joint(beam_.position, k);
    joint.velocity = of_joint(beam_.velocity, k);
    joint.hold = true;  // a start is closed by the joints, not by bending links
    for (const double c : joint.stiffness) joint.damping.push_back(beam_.retardation * c);
    return joint;
  }

 private:
  static std::vector<double> of_joint(const std::vector<double>& all, int k) {
    if (all.empty()) return {};
    return {all.begin() + 3 * (k - 1), all.begin() + 3 * k};
  }

  double joint_at(int k) const { return (k - 0.5) * segment_; }

  Eigen::Matrix3d rod_inertia(double mass, double length) const {
    const Eigen::Vector3d x = axes_.col(0);
    return mass * length * length / 12.0 * (Eigen::Matrix3d::Identity() - x * x.transpose());
  }

  const Link& link_;
  const FlexibleBeam& beam_;
  Eigen::Matrix3d axes_;
  double length_;   // m
  double segment_;  // D, m
};

// Replaces one link of a linkage by its elements.
class Expansion {
 public:
  Expansion(const Link& link, Linkage& linkage)
      : name_(link.name), shape_(link.shape), beam_(link), to_(linkage) {}

  void run() {
    replace_link();
    for (Joint& joint : to_.joints) {
      if (joint.parent == name_) joint.parent = element_of(joint.frame.position);
    }
    for (Closure& closure : to_.closures) {
      for (ClosureEnd* end : {&closure.first, &closure.second}) {
        if (end->link == name_) end->link = element_of(end->frame.position);
      }
    }
    for (Load& load : to_.loads)
      if (load.link == name_) load.link = element_of(load.point);
    for (PointSpring& spring : to_.springs) {
      for (SpringEnd* end : {&spring.first, &spring.second}) {
        if (end->link == name_) end->link = element_of(end->position);
      }
    }
    for (ChosenPoint& point : to_.points) {
      if (point.link == name_) point.link = element_of(point.position);
    }
    grow_tree();
  }

 private:
  std::string element_of(const Eigen::Vector3d& point) const {
    return element_name(name_, beam_.element_at(point));
  }

  void replace_link() {
    const auto place = std::find_if(to_.links.begin(), to_.links.end(),
                                    [&](const Link& link) { return link.name == name_; });
    std::vector<Link> elements;
    for (int k = 0; k <= beam_.last(); ++k) elements.push_back(beam_.element(k));
    const auto behind = to_.links.erase(place);
    to_.links.insert(behind, elements.begin(), elements.end());
  }

  void grow_tree() {
    const auto own = std::find_if(to_.joints.begin(), to_.joints.end(),
                                  [&](const Joint& joint) { return joint.child == name_; });
    const int root = beam_.element_at(own->child_frame.position);
    own->child = element_name(name_, root);
    std::ranges::find(to_.links, own->child, &Link::name)->shape = shape_;
    std::vector<Joint> joints;
    for (int k = root + 1; k <= beam_.last(); ++k) joints.push_back(beam_.joint(k, true));
    for (int k = root; k >= 1; --k) joints.push_back(beam_.joint(k, false));
    to_.joints.insert(std::next(own), joints.begin(), joints.end());
  }

  const std::string name_;
  const std::vector<Solid> shape_;
  const DividedBeam beam_;
  Linkage& to_;
};

}  // namespace

Linkage expand_flexible_links(const Linkage& linkage) {
  Linkage expanded = linkage;
  for (const Link& link : linkage.links)
    if (link.flexible) Expansion(link, expanded).run();
  return expanded;
}

}  // namespace linkstudy

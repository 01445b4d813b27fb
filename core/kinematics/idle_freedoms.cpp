#include "core/kinematics/idle_freedoms.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "core/kinematics/closure_jacobian.h"
#include "core/numerics/dense.h"
#include "core/numerics/rank.h"

namespace linkstudy {
namespace {

using Eigen::MatrixXd;

// Singular values of the motions of resting links, relative to unit motions of the null space.
constexpr double kRests = 1e-7;

struct Connection {
  BodyIndex first, second;
  std::string name;
};

std::vector<Connection> connections_of(const Mechanism& m) {
  std::vector<Connection> all;
  for (const BodyIndex b : bodies_outwards(m)) {
    all.push_back({m.bodies[b].parent, b, "joint." + m.joint_names[b]});
  }
  for (const ClosureIndex i : indices_of(m.closures)) {
    all.push_back({m.closures[i].first, m.closures[i].second, "closure." + m.closure_names[i]});
  }
  return all;
}

// Twist of every body by every scaled velocity, about the ground's origin: rows 6 b .. 6 b + 5.
MatrixXd twists_of(const Model& closed, const ClosureScale& scale, const State<double>& pose) {
  const Mechanism& m = closed.mechanism;
  Workspace<double> w = make_workspace<double>(m);
  update_kinematics(m, closed.parameters, pose.q.data(), pose.v.data(), w);
  MatrixXd s = MatrixXd::Zero(6 * m.body_count(), m.nv);
  for (const BodyIndex b : bodies_outwards(m)) {
    const Body& body = m.bodies[b];
    s.middleRows<6>(6 * b.value()) = s.middleRows<6>(6 * body.parent.value());
    for (const VelocityIndex k : velocities_of(body)) {
      const Eigen::Vector3d origin = Eigen::Vector3d::Zero();
      auto twist = s.block<6, 1>(6 * b.value(), k.value());
      twist = scale.velocity[k.value()] * twist_of(m, closed.parameters, w, k, origin);
      twist.tail<3>() /= scale.extent;
    }
  }
  return s;
}

class IdleSearch {
 public:
  IdleSearch(const Model& closed, const ClosureScale& scale, const State<double>& pose)
      : mechanism_(closed.mechanism),
        connections_(connections_of(closed.mechanism)),
        motions_(twists_of(closed, scale, pose) *
                 null_space(compute_scaled_closures(closed, scale, pose).jacobian,
                            kMobilityTolerance, kLeastRowSize)) {}

  std::vector<IdleFreedom> run() const {
    std::vector<IdleFreedom> found;
    if (motions_.cols() == 0) return found;
    std::vector<std::vector<BodyIndex>> idle;  // groups found
    std::vector<std::vector<BodyIndex>> groups;
    for (const BodyIndex b : bodies_outwards(mechanism_)) groups.push_back({b});
    for (; !groups.empty(); groups = longer_groups(groups)) {
      std::erase_if(groups, [&](const auto& group) { return holds_one_of(group, idle); });
      for (const std::vector<BodyIndex>& group : groups) {
        const int count = is_inside(group) ? count_motions(group) : 0;
        if (count == 0) continue;
        found.push_back(describe(group, count));
        idle.push_back(group);
      }
    }
    return found;
  }

 private:
  static bool contains(const std::vector<BodyIndex>& group, BodyIndex body) {
    return std::find(group.begin(), group.end(), body) != group.end();
  }

  // Joints between the group and the rest.
  std::vector<Connection> boundary_of(const std::vector<BodyIndex>& group) const {
    std::vector<Connection> boundary;
    for (const Connection& c : connections_) {
      if (contains(group, c.first) != contains(group, c.second)) boundary.push_back(c);
    }
    return boundary;
  }

  static bool holds_one_of(const std::vector<BodyIndex>& group,
                           const std::vector<std::vector<BodyIndex>>& smaller) {
    return std::any_of(smaller.begin(), smaller.end(), [&](const std::vector<BodyIndex>& inner) {
      return std::all_of(inner.begin(), inner.end(),
                         [&](BodyIndex b) { return contains(group, b); });
    });
  }

  int connection_count(BodyIndex body) const {
    return static_cast<int>(
        std::count_if(connections_.begin(), connections_.end(),
                      [&](const Connection& c) { return c.first == body || c.second == body; }));
  }

  // Pairs of all joined links; beyond, rows of links that are joined to two others each.
  bool may_grow(const std::vector<BodyIndex>& group, BodyIndex body) const {
    const auto is_in_a_row = [&](BodyIndex b) { return connection_count(b) == 2; };
    return group.size() == 1 ||
           (is_in_a_row(body) && std::all_of(group.begin(), group.end(), is_in_a_row));
  }

  // Each group with one more link that is joined to it.
  std::vector<std::vector<BodyIndex>> longer_groups(
      const std::vector<std::vector<BodyIndex>>& groups) const {
    std::vector<std::vector<BodyIndex>> longer;
    for (const std::vector<BodyIndex>& group : groups) {
      for (const Connection& c : boundary_of(group)) {
        const BodyIndex next = contains(group, c.first) ? c.second : c.first;
        if (next == kGroundBody || !may_grow(group, next)) continue;
        std::vector<BodyIndex> larger = group;
        larger.push_back(next);
        std::sort(larger.begin(), larger.end());
        if (std::find(longer.begin(), longer.end(), larger) == longer.end()) {
          longer.push_back(std::move(larger));
        }
      }
    }
    return longer;
  }

  // Held at two joints or more, on both sides by others, of which ground is one at most: a link
  // between ground and ground is the linkage itself. Links welded to ground are ground.
  bool is_inside(const std::vector<BodyIndex>& group) const {
    const std::vector<Connection> boundary = boundary_of(group);
    return boundary.size() > 1 &&
           std::any_of(boundary.begin(), boundary.end(), [&](const Connection& c) {
             return !is_ground(contains(group, c.first) ? c.second : c.first);
           });
  }

  bool is_ground(BodyIndex body) const {
    while (body != kGroundBody && mechanism_.bodies[body].v_count == 0) {
      body = mechanism_.bodies[body].parent;
    }
    return body == kGroundBody;
  }

  // Dimension of the null motions in which the group moves as one body and all others rest.
  int count_motions(const std::vector<BodyIndex>& group) const {
    MatrixXd rest = motions_;
    for (const BodyIndex b : group) {
      rest.middleRows<6>(6 * b.value()) -= motions_.middleRows<6>(6 * group.front().value());
    }
    const Eigen::VectorXd sizes = singular_values(rest);
    return static_cast<int>(
        std::count_if(sizes.begin(), sizes.end(), [](double s) { return s < kRests; }));
  }

  IdleFreedom describe(const std::vector<BodyIndex>& group, int count) const {
    IdleFreedom idle;
    idle.count = count;
    for (const BodyIndex b : group) idle.links.push_back(mechanism_.link_names[b]);
    for (const Connection& c : boundary_of(group)) idle.joints.push_back(c.name);
    return idle;
  }

  const Mechanism& mechanism_;
  std::vector<Connection> connections_;
  MatrixXd motions_;  // twists of all bodies by the null motions
};

}  // namespace

std::vector<IdleFreedom> find_idle_freedoms(const Model& closed, const ClosureScale& scale,
                                            const State<double>& pose) {
  return IdleSearch(closed, scale, pose).run();
}

}  // namespace linkstudy

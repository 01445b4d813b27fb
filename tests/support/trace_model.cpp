#include "tests/support/trace_model.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "tests/support/trace_closures.h"

namespace linkstudy::testing {
namespace {

const Link& find_link(const Linkage& linkage, const std::string& name) {
  for (const Link& link : linkage.links)
    if (link.name == name) return link;
  throw std::invalid_argument(fmt::format("oracle: no link '{}'", name));
}

Transform pseudo_inertia(const Link& link) {
  const Eigen::Vector3d& r = link.center_of_mass;
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d J = link.inertia + link.mass * (r.dot(r) * I - r * r.transpose());
  Transform H(4, 4);
  H.topLeftCorner(3, 3) = 0.5 * J.trace() * I - J;
  H.topRightCorner(3, 1) = link.mass * r;
  H.bottomLeftCorner(1, 3) = link.mass * r.transpose();
  H(3, 3) = link.mass;
  return H;
}

Vector homogeneous(const Eigen::Vector3d& point) {
  Vector r(4);
  r << point, 1.0;
  return r;
}

TraceLink make_link(const TraceModel& model, const Joint& joint) {
  const Link& body = find_link(model.linkage, joint.child);
  TraceLink link;
  link.name = joint.child;
  link.joint = joint.name;
  link.parent = link_index(model, joint.parent);
  link.first_coordinate = model.dof;
  link.motions = basic_motions(joint);
  for (const BasicMotion& motion : link.motions) {
    link.operators.push_back(derivative_operator(motion));
  }
  link.before = transform(joint.frame);
  link.after = inverse_transform(transform(joint.child_frame));
  link.child_frame_is_identity = link.after.isIdentity(0.0);
  if (link.parent != kGroundIndex) link.path = model.links[link.parent].path;
  for (std::size_t k = 0; k < link.motions.size(); ++k) {
    link.path.push_back(model.dof + static_cast<int>(k));
  }
  link.H = pseudo_inertia(body);
  link.mass = body.mass;
  link.r_C = homogeneous(body.center_of_mass);
  return link;
}

void add_start(TraceModel& model, const Joint& joint, std::size_t count) {
  const auto copy = [&](const std::vector<double>& from, Vector& to) {
    to.conservativeResize(model.dof + static_cast<int>(count));
    for (std::size_t k = 0; k < count; ++k) {
      to[model.dof + static_cast<int>(k)] = from.empty() ? 0.0 : from.at(k);
    }
  };
  copy(joint.position, model.q0);
  copy(joint.velocity, model.v0);
}

bool is_placed(const Linkage& linkage, const std::vector<int>& order, const std::string& link) {
  return link == kGround || std::any_of(order.begin(), order.end(), [&](int placed) {
           return linkage.joints[placed].child == link;
         });
}

void add_joints(TraceModel& model) {
  for (const int j : tree_order(model.linkage)) {
    const Joint& joint = model.linkage.joints[j];
    const bool ball = joint.type == JointType::spherical || joint.type == JointType::free;
    if (ball && joint.coordinates == RotationCoordinates::quaternion) {
      throw std::invalid_argument(
          fmt::format("oracle: map quaternion joint '{}' to zyx", joint.name));
    }
    TraceLink link = make_link(model, joint);
    add_start(model, joint, link.motions.size());
    model.dof += static_cast<int>(link.motions.size());
    model.links.push_back(std::move(link));
  }
}

void add_closures(TraceModel& model) {
  for (const Closure& closure : model.linkage.closures) {
    if (closure.model == ClosureModel::clearance &&
        closure.clearance.kind != ClearanceKind::planar) {
      throw std::invalid_argument(fmt::format("oracle: closure '{}' is not planar", closure.name));
    }
    TraceClosure traced;
    traced.closure = closure;
    traced.first = {link_index(model, closure.first.link), transform(closure.first.frame)};
    traced.second = {link_index(model, closure.second.link), transform(closure.second.frame)};
    traced.damping = closure.sde.damping;
    if (closure.model == ClosureModel::sde && closure.sde.damping_ratio) {
      traced.damping = damping_of_ratio(model, traced, model.q0);
    }
    model.closures.push_back(traced);
  }
}

void add_loads(TraceModel& model) {
  for (const Load& load : model.linkage.loads) {
    TraceLoad traced;
    traced.load = load;
    if (load.type == LoadType::drive || load.type == LoadType::resistance) {
      traced.coordinate = coordinate_index(model, load.joint) + load.coordinate;
    } else {
      traced.link = link_index(model, load.link);
    }
    model.loads.push_back(traced);
  }
}

}  // namespace

std::vector<int> tree_order(const Linkage& linkage) {
  const int count = static_cast<int>(linkage.joints.size());
  std::vector<int> order;
  while (static_cast<int>(order.size()) < count) {
    int next = -1;
    for (int j = 0; j < count && next < 0; ++j) {
      const bool taken = std::find(order.begin(), order.end(), j) != order.end();
      if (!taken && is_placed(linkage, order, linkage.joints[j].parent)) next = j;
    }
    if (next < 0) throw std::invalid_argument("oracle: the joints do not form a tree");
    order.push_back(next);
  }
  return order;
}

TraceModel make_trace_model(const Linkage& linkage) {
  TraceModel model;
  model.linkage = linkage;
  add_joints(model);
  add_closures(model);
  add_loads(model);
  return model;
}

int link_index(const TraceModel& model, const std::string& link) {
  if (link == kGround) return kGroundIndex;
  for (std::size_t p = 0; p < model.links.size(); ++p) {
    if (model.links[p].name == link) return static_cast<int>(p);
  }
  throw std::invalid_argument(fmt::format("oracle: link '{}' is not in the tree", link));
}

int coordinate_index(const TraceModel& model, const std::string& joint) {
  for (const TraceLink& link : model.links)
    if (link.joint == joint) return link.first_coordinate;
  throw std::invalid_argument(fmt::format("oracle: no joint '{}'", joint));
}

}  // namespace linkstudy::testing

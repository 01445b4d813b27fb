#include "tests/mechanisms/random_linkages.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <random>

#include "tests/mechanisms/frames.h"
#include "tests/support/trace_formulas.h"

namespace linkstudy::testing {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Numbers straight from the generator: the standard's distributions differ between libraries.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double within(double size) {
    return size * (2.0 * static_cast<double>(engine_() >> 11) * 0x1p-53 - 1.0);
  }
  int below(int count) { return static_cast<int>(engine_() % static_cast<unsigned>(count)); }
  Vector3d vector(double size) {
    const double x = within(size), y = within(size), z = within(size);
    return {x, y, z};
  }
  Matrix3d rotation(double angle) {
    const Vector3d axis = (vector(1.0) + Vector3d(0.0, 0.0, 1e-3)).normalized();
    return Eigen::AngleAxisd(within(angle), axis).toRotationMatrix();
  }
  Frame frame() {
    const Vector3d position = vector(0.5);
    return {rotation(3.0), position};
  }
  template <typename T>
  void shuffle(std::vector<T>& items) {
    for (int k = static_cast<int>(items.size()) - 1; k > 0; --k) {
      std::swap(items[k], items[below(k + 1)]);
    }
  }

 private:
  std::mt19937_64 engine_;
};

// Mass, centre and inertia of six point masses.
Link cloud(Draw& draw, const std::string& name) {
  Link link;
  link.name = name;
  std::vector<std::pair<double, Vector3d>> points;
  Vector3d moment = Vector3d::Zero();
  for (int k = 0; k < 6; ++k) {
    const double mass = 0.3 + draw.within(0.2);
    points.emplace_back(mass, draw.vector(0.4));
    link.mass += mass;
    moment += mass * points.back().second;
  }
  link.center_of_mass = moment / link.mass;
  for (const auto& [mass, point] : points) {
    const Vector3d r = point - link.center_of_mass;
    link.inertia += mass * (r.squaredNorm() * Matrix3d::Identity() - r * r.transpose());
  }
  return link;
}

Joint random_joint(Draw& draw, JointType type, const std::string& parent, int index) {
  Joint joint;
  joint.name = fmt::format("joint{}", index);
  joint.type = type;
  joint.parent = parent;
  joint.child = fmt::format("link{}", index);
  joint.frame = draw.frame();
  joint.child_frame = draw.frame();
  joint.pitch = type == JointType::screw ? draw.within(0.3) : 0.0;
  for (int k = 0; k < velocity_count(type); ++k) {
    joint.position.push_back(draw.within(0.6));
    joint.velocity.push_back(draw.within(1.0));
  }
  return joint;
}

std::vector<JointType> all_types() {
  return {JointType::revolute,  JointType::prismatic, JointType::cylindrical,
          JointType::universal, JointType::spherical, JointType::planar,
          JointType::free,      JointType::fixed,     JointType::screw};
}

Course random_course(Draw& draw) {
  Course course;
  course.shape = static_cast<CourseShape>(draw.below(4));
  course.value = draw.within(5.0);
  course.duration = 1.0;
  course.times = {0.0, 0.4, 1.0};
  course.values = {draw.within(5.0), draw.within(5.0), draw.within(5.0)};
  return course;
}

std::vector<Load> random_loads(Draw& draw, const Linkage& linkage) {
  std::vector<Load> loads;
  for (int k = 0; k < 8; ++k) {
    Load load;
    load.name = fmt::format("load{}", k);
    load.type = static_cast<LoadType>(k % 4);
    const Joint& joint = linkage.joints[draw.below(static_cast<int>(linkage.joints.size()))];
    const int freedoms = velocity_count(joint.type);
    load.joint = joint.name;
    load.link = joint.child;
    load.point = draw.vector(0.5);
    load.direction = (draw.vector(1.0) + Vector3d(0, 0, 1e-3)).normalized();
    load.follows_link = k >= 4;
    load.course = random_course(draw);
    load.law = {k >= 4 ? ResistanceShape::quadratic : ResistanceShape::linear, 2.0, 1.5};
    const bool at_joint = load.type == LoadType::drive || load.type == LoadType::resistance;
    if (at_joint && freedoms == 0) continue;
    if (at_joint) load.coordinate = draw.below(freedoms);
    loads.push_back(load);
  }
  return loads;
}

// A displacement of {2,e} from {1,e} that the closure leaves free.
Frame free_displacement(Draw& draw, JointType type) {
  const Vector3d t = draw.vector(0.3);
  const double a = draw.within(0.8), b = draw.within(0.8);
  switch (type) {
    case JointType::spherical:
      return {draw.rotation(1.0), Vector3d::Zero()};
    case JointType::revolute:
      return {rotation_about(0, a), Vector3d::Zero()};
    case JointType::universal:
      return {rotation_about(0, a) * rotation_about(1, b), Vector3d::Zero()};
    case JointType::prismatic:
      return {Matrix3d::Identity(), Vector3d(t.x(), 0, 0)};
    case JointType::cylindrical:
      return {rotation_about(0, a), Vector3d(t.x(), 0, 0)};
    case JointType::planar:
      return {rotation_about(0, a), Vector3d(0, t.y(), t.z())};
    default:
      return {};
  }
}

Frame pose_in(const Matrix& T_link, const Matrix& T) {
  const Matrix X = inverse_transform(T_link) * T;
  return {X.topLeftCorner(3, 3), X.topRightCorner(3, 1)};
}

void write_start(Linkage& linkage, const TraceModel& model, const OracleState& state) {
  for (Joint& joint : linkage.joints) {
    const int first = coordinate_index(model, joint.name);
    for (int k = 0; k < velocity_count(joint.type); ++k) {
      joint.position[k] = state.q[first + k];
      joint.velocity[k] = state.v[first + k];
    }
  }
}

Closure random_closure(Draw& draw, const TraceModel& tree, JointType type) {
  const auto transforms = link_transforms(tree, tree.q0);
  const int count = static_cast<int>(tree.links.size());
  const int first = count - 1;
  const int second = draw.below(count - 1);
  Closure closure;
  closure.name = "loop";
  closure.type = type;
  closure.first = {tree.links[first].name, draw.frame()};
  const Matrix T1 = transforms[first].T * transform(closure.first.frame);
  const Matrix T2 = T1 * transform(free_displacement(draw, type));
  closure.second = {tree.links[second].name, pose_in(transforms[second].T, T2)};
  const double c = 2e3, b = 10.0;
  const unsigned blocked = blocked_directions(type);
  for (int d = 0; d < kDirections; ++d) {
    if ((blocked >> d & 1u) == 0) continue;
    closure.sde.stiffness[d] = c * (1.0 + 0.5 * draw.within(1.0));
    closure.sde.damping[d] = b * (1.0 + 0.5 * draw.within(1.0));
  }
  return closure;
}

bool has_independent_rows(const TraceModel& model) {
  const Matrix J = cut_constraints(model, model.q0, model.v0).jacobian;
  if (J.cols() < J.rows() + 2) return false;
  return J.jacobiSvd().singularValues().minCoeff() > 0.05;
}

}  // namespace

Linkage random_tree(std::uint64_t seed, const RandomTree& options) {
  Draw draw(seed);
  const std::vector<JointType> types = options.types.empty() ? all_types() : options.types;
  Linkage linkage;
  linkage.name = fmt::format("random_tree_{}", seed);
  linkage.gravity = draw.vector(9.81);
  for (int k = 0; k < options.links; ++k) {
    const int parent = draw.below(k + 1) - 1;
    const JointType type = types[draw.below(static_cast<int>(types.size()))];
    linkage.links.push_back(cloud(draw, fmt::format("link{}", k)));
    linkage.joints.push_back(
        random_joint(draw, type, parent < 0 ? kGround : fmt::format("link{}", parent), k));
  }
  if (options.loads) linkage.loads = random_loads(draw, linkage);
  if (options.shuffled) {
    draw.shuffle(linkage.links);
    draw.shuffle(linkage.joints);
  }
  return linkage;
}

Linkage random_closed_linkage(std::uint64_t seed, JointType type, ClosureModel model) {
  RandomTree options;
  options.types = {JointType::revolute,  JointType::prismatic, JointType::cylindrical,
                   JointType::universal, JointType::spherical, JointType::planar};
  for (std::uint64_t attempt = 0;; ++attempt) {
    Draw draw(seed + 1000003 * (attempt + 1));
    Linkage linkage = random_tree(seed + 7919 * attempt, options);
    linkage.name = fmt::format("random_closed_linkage_{}", seed);
    linkage.closures = {random_closure(draw, make_trace_model(linkage), type)};
    linkage.closures[0].model = ClosureModel::cut;
    const TraceModel cut = make_trace_model(linkage);
    if (!has_independent_rows(cut)) continue;
    write_start(linkage, cut, closed_state(cut, start_state(cut)));
    linkage.closures[0].model = model;
    return linkage;
  }
}

Linkage sde_pair(std::uint64_t seed, JointType closure, const Sde& sde, double spread) {
  Draw draw(seed);
  Linkage linkage;
  linkage.name = fmt::format("sde_pair_{}", seed);
  for (int k = 0; k < 2; ++k) {
    linkage.links.push_back(cloud(draw, fmt::format("link{}", k)));
    linkage.joints.push_back(random_joint(draw, JointType::free, kGround, k));
  }
  const TraceModel free = make_trace_model(linkage);
  const auto transforms = link_transforms(free, free.q0);
  Closure E;
  E.name = "E";
  E.type = closure;
  E.model = ClosureModel::sde;
  E.sde = sde;
  E.first = {"link0", draw.frame()};
  const Matrix T1 = transforms[0].T * transform(E.first.frame);
  const Vector3d apart = draw.vector(spread);
  const Matrix T2 = T1 * transform(Frame{draw.rotation(spread), apart});
  E.second = {"link1", pose_in(transforms[1].T, T2)};
  linkage.closures = {E};
  return linkage;
}

}  // namespace linkstudy::testing

#include "core/model/compile.h"

#include <algorithm>
#include <map>

#include "core/model/closure_rows.h"
#include "core/model/compile_friction.h"
#include "core/model/compile_loads.h"
#include "core/model/compile_motion.h"
#include "core/model/compile_springs.h"
#include "core/model/piecewise.h"
#include "core/model/shapes.h"
#include "core/model/walk.h"

namespace linkstudy {
namespace {

Vec3<double> to_vec3(const Eigen::Vector3d& a) {
  return {a.x(), a.y(), a.z()};
}

Mat3<double> to_mat3(const Eigen::Matrix3d& m) {
  return {to_vec3(m.col(0)), to_vec3(m.col(1)), to_vec3(m.col(2))};
}

Sym3<double> to_sym3(const Eigen::Matrix3d& m) {
  return {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
}

Frame operator*(const Frame& a, const Frame& b) {
  return {a.rotation * b.rotation, a.rotation * b.position + a.position};
}

Frame inverse(const Frame& a) {
  return {a.rotation.transpose(), -(a.rotation.transpose() * a.position)};
}

std::vector<BasicMotion> motions_of(const Joint& joint) {
  using enum BasicMotion;
  const bool ball_joint = joint.coordinates == RotationCoordinates::quaternion;
  switch (joint.type) {
    case JointType::revolute:
      return {rz};
    case JointType::prismatic:
      return {tz};
    case JointType::cylindrical:
      return {rz, tz};
    case JointType::screw:
      return {screw};
    case JointType::universal:
      return {rz, ry};
    case JointType::planar:
      return {tx, ty, rz};
    case JointType::spherical:
      return ball_joint ? std::vector{ball} : std::vector{rz, ry, rx};
    case JointType::free:
      return ball_joint ? std::vector{tx, ty, tz, ball} : std::vector{tx, ty, tz, rz, ry, rx};
    case JointType::fixed:
    case JointType::pin_in_slot:
    case JointType::rod:
      return {};
  }
  return {};
}

// Joints in body order: repeatedly the first listed joint whose parent is placed.
std::vector<const Joint*> tree_order(const Linkage& linkage,
                                     std::map<std::string, BodyIndex>& body_of) {
  std::vector<const Joint*> order;
  std::vector<bool> placed(linkage.joints.size(), false);
  body_of[kGround] = kGroundBody;
  for (bool progress = true; progress;) {
    progress = false;
    for (std::size_t i = 0; i < linkage.joints.size() && !progress; ++i) {
      const Joint& joint = linkage.joints[i];
      if (placed[i] || !body_of.contains(joint.parent)) continue;
      placed[i] = progress = true;
      order.push_back(&joint);
      body_of[joint.child] = BodyIndex(order.size());
    }
  }
  return order;
}

const Link& find_link(const Linkage& linkage, const std::string& name) {
  return *std::find_if(linkage.links.begin(), linkage.links.end(),
                       [&](const Link& link) { return link.name == name; });
}

bool is_rotation(BasicMotion motion) {
  return motion >= BasicMotion::rx;
}
bool is_translation(BasicMotion motion) {
  return motion <= BasicMotion::tz || motion == BasicMotion::screw;
}

VelocityKind velocity_kind(BasicMotion motion) {
  if (motion == BasicMotion::screw) return VelocityKind::screw;
  return is_rotation(motion) ? VelocityKind::rotation : VelocityKind::translation;
}

double contact_stiffness(const Clearance& c) {
  if (c.stiffness) return *c.stiffness;
  return hertz_stiffness({c.bearing.young, c.bearing.poisson, c.bearing_radius},
                         {c.journal.young, c.journal.poisson, c.bearing_radius - c.radial});
}

bool starts_with_ground_axes(const IndexedVector<RowIndex, Row>& rows, const ClosureStructure& c) {
  if (c.row_end - c.row_begin < 3) return false;
  for (int i = 0; i < 3; ++i) {
    const Row& row = rows[c.row_begin + i];
    if (row.kind != RowKind::translation_ground || row.axis != i) return false;
  }
  return true;
}

class Compiler {
 public:
  Compiler(const Linkage& linkage, const std::vector<unsigned>& idle, bool shuts_sdes = false)
      : linkage_(linkage), idle_(idle), shuts_sdes_(shuts_sdes) {}

  Model run() {
    parameters().gravity = to_vec3(linkage_.gravity);
    add_ground();
    for (const Joint* joint : tree_order(linkage_, body_of_)) add_body(*joint);
    for (const Closure& closure : linkage_.closures) add_closure(closure);
    for (const Joint& joint : linkage_.joints) {
      if (joint.stop) add_stops(*joint.stop, body_of_.at(joint.child), model_);
    }
    for (const Load& load : linkage_.loads) place_load(load);
    for (const Motion& motion : linkage_.motions) {
      compile_motion(motion, body_on(motion.joint), model_);
    }
    for (const Coupling& coupling : linkage_.couplings) add_coupling(coupling);
    for (const PointSpring& spring : linkage_.springs) add_spring(spring);
    for (const ChosenPoint& point : linkage_.points) add_point(point);
    return std::move(model_);
  }

 private:
  Mechanism& mechanism() { return model_.mechanism; }
  Parameters<double>& parameters() { return model_.parameters; }

  void add_ground() {
    Body ground;
    ground.shifted = ground.rotates = ground.gyrates = false;
    mechanism().bodies.push_back(ground);
    parameters().bodies.emplace_back();
    mechanism().link_names.emplace_back(kGround);
    mechanism().joint_names.emplace_back();
    link_frames_.emplace_back();
  }

  void add_body(const Joint& joint) {
    Mechanism& m = mechanism();
    const Link& link = find_link(linkage_, joint.child);
    const Frame link_frame = link_in_body(joint);
    const BodyIndex index = m.bodies.end_index();
    Body body;
    body.parent = body_of_.at(joint.parent);
    const Frame frame = link_frames_[body.parent] * joint.frame;
    body.frame = shape_of(frame.rotation, body.quarter);
    body.offset = shape_of(frame.position);
    add_stages(joint, index, body);
    add_joint_springs(joint, body);
    if (joint.friction) add_joint_friction(joint, index, body, model_);
    find_motion(body);

    const Eigen::Vector3d center = link_frame.rotation * link.center_of_mass + link_frame.position;
    const Eigen::Matrix3d about_center =
        link_frame.rotation * link.inertia * link_frame.rotation.transpose();
    const Eigen::Matrix3d inertia =
        about_center + link.mass * (center.squaredNorm() * Eigen::Matrix3d::Identity() -
                                    center * center.transpose());
    body.center = shape_of(center);
    body.inertia = shape_of_inertia(inertia);
    m.bodies[body.parent].carries = true;
    m.bodies.push_back(body);
    m.link_names.push_back(link.name);
    m.joint_names.push_back(joint.name);
    link_frames_.push_back(link_frame);
    parameters().bodies.push_back({to_mat3(frame.rotation), to_vec3(frame.position), link.mass,
                                   to_vec3(link.mass * center), to_sym3(inertia)});
  }

  void add_stages(const Joint& joint, BodyIndex index, Body& body) {
    Mechanism& m = mechanism();
    body.stage_begin = m.stages.end_index();
    body.q_begin = PositionIndex(m.nq);
    body.v_begin = VelocityIndex(m.nv);
    for (BasicMotion motion : motions_of(joint)) {
      const StageIndex stage = m.stages.end_index();
      const PositionIndex q(m.nq);
      m.stages.push_back({motion, q, VelocityIndex(m.nv)});
      parameters().pitch.push_back(joint.pitch);
      if (motion == BasicMotion::ball) m.ball_q.push_back(q);
      const int count = motion == BasicMotion::ball ? 3 : 1;
      for (int k = 0; k < count; ++k) {
        m.velocities.push_back({index, velocity_kind(motion), stage,
                                find_motion_of(joint, m.velocities.end_index() - body.v_begin)});
      }
      m.nq += motion == BasicMotion::ball ? 4 : 1;
      m.nv += count;
    }
    body.stage_end = m.stages.end_index();
    body.q_count = m.nq - body.q_begin.value();
    body.v_count = m.nv - body.v_begin.value();
    for (const VelocityIndex k : velocities_of(body)) {
      m.v_parent.push_back(k > body.v_begin ? k - 1 : last_velocity(body.parent));
      if (joint.hold && (shuts_sdes_ || !joint.elastic)) model_.held.push_back(k);
    }
    add_start(joint, body);
  }

  // The prescribed motion of a coordinate, or none.
  MotionIndex find_motion_of(const Joint& joint, int coordinate) const {
    const auto& motions = linkage_.motions;
    const auto found = std::find_if(motions.begin(), motions.end(), [&](const Motion& motion) {
      return motion.joint == joint.name && motion.coordinate == coordinate;
    });
    if (found == motions.end()) return {};
    return MotionIndex(found - motions.begin());
  }

  void add_joint_springs(const Joint& joint, const Body& body) {
    const auto value = [](const std::vector<double>& list, std::size_t i) {
      return i < list.size() ? list[i] : 0.0;
    };
    for (int i = 0; i < body.v_count; ++i) {
      const auto n = static_cast<std::size_t>(i);
      const double stiffness = value(joint.stiffness, n), damping = value(joint.damping, n);
      const bool bends = joint.spring_curve && joint.spring_curve->coordinate == i;
      if (stiffness == 0.0 && damping == 0.0 && !bends) continue;
      JointSpring s{body.q_begin + i, body.v_begin + i};
      JointSpringParameters<double> p{stiffness, damping, value(joint.rest, n), {}};
      if (bends) {
        p.curve = add_curve(joint.spring_curve->curve, SpringActs::both, s.curve, mechanism(),
                            parameters());
        s.bend = BendIndex(mechanism().bent_springs++);
      }
      mechanism().joint_springs.push_back(s);
      parameters().joint_springs.push_back(p);
    }
  }

  // What can move at all; the rules are those of joint_kinematics `spin` and `shift`.
  void find_motion(Body& body) const {
    const Mechanism& m = model_.mechanism;
    const Body& parent = m.bodies[body.parent];
    body.rotates = parent.rotates;
    body.gyrates = parent.gyrates;
    body.shifted = body.parent != kGroundBody && body.offset != VectorShape::zero;
    for (const StageIndex i : stages_of(body)) {
      const BasicMotion motion = m.stages[i].motion;
      if (is_rotation(motion)) {
        const bool is_driven = m.velocities[m.stages[i].v].motion.exists();
        body.gyrates = body.gyrates || body.rotates || is_driven;
        body.rotates = true;
      }
      body.shifted = body.shifted || (body.parent != kGroundBody && is_translation(motion));
    }
  }

  // Last velocity on the path from a body to ground, itself included, or none.
  VelocityIndex last_velocity(BodyIndex body) const {
    for (const BodyIndex b : bodies_to_ground(model_.mechanism, body)) {
      const Body& on_path = model_.mechanism.bodies[b];
      if (on_path.v_count > 0) return on_path.v_begin + (on_path.v_count - 1);
    }
    return {};
  }

  void add_start(const Joint& joint, const Body& body) {
    State<double>& s = model_.start;
    std::vector<double> q = joint.position;
    std::vector<double> v = joint.velocity;
    if (q.empty()) {
      q.assign(static_cast<std::size_t>(body.q_count), 0.0);
      if (body.q_count != body.v_count) q[q.size() - 4] = 1.0;
    }
    if (v.empty()) v.assign(static_cast<std::size_t>(body.v_count), 0.0);
    s.q.insert(s.q.end(), q.begin(), q.end());
    s.v.insert(s.v.end(), v.begin(), v.end());
  }

  void add_closure(const Closure& closure) {
    Mechanism& m = mechanism();
    const ClosureIndex index = m.closures.end_index();
    ClosureStructure c;
    c.first = body_of_.at(closure.first.link);
    c.second = body_of_.at(closure.second.link);
    const bool cut = closure.model != ClosureModel::sde || shuts_sdes_;
    c.model = cut && closure.model == ClosureModel::sde ? ClosureModel::cut : closure.model;
    c.stabilization = closure.stabilization;
    c.is_rod = closure.type == JointType::rod;
    auto& rows = cut ? m.cut_rows : m.sde_rows;
    c.row_begin = rows.end_index();
    add_rows(closure, index, cut);
    c.row_end = rows.end_index();
    c.last_1 = last_velocity(c.first);
    c.last_2 = last_velocity(c.second);
    add_support({c.last_1, c.last_2}, c);
    for (const RowIndex r : rows_of(c)) {
      const RowKind kind = rows[r].kind;
      c.has_line = c.has_line || kind == RowKind::line_of_centres;
      c.needs_frames = c.needs_frames || measures_turn(kind) ||
                       kind == RowKind::translation_first || kind == RowKind::spring_first;
    }
    c.point_rows = starts_with_ground_axes(rows, c);
    if (c.model == ClosureModel::clearance) {
      c.needs_frames = true;
      add_clearance(closure.clearance, index);
    }
    m.closure_names.push_back(closure.name);

    const Frame f1 = link_frames_[c.first] * closure.first.frame;
    const Frame f2 = link_frames_[c.second] * closure.second.frame;
    c.point_1 = shape_of(f1.position);
    c.point_2 = shape_of(f2.position);
    m.closures.push_back(c);
    const bool baumgarte = closure.stabilization == Stabilization::baumgarte;
    parameters().closures.push_back(
        {to_mat3(f1.rotation), to_vec3(f1.position), to_mat3(f2.rotation), to_vec3(f2.position),
         to_mat3(closure.sde.directions.transpose()), baumgarte ? 2.0 * closure.alpha : 0.0,
         baumgarte ? closure.beta * closure.beta : 0.0, closure.length});
  }

  void add_clearance(const Clearance& c, ClosureIndex closure) {
    Mechanism& m = mechanism();
    const ClearanceIndex index = m.clearances.end_index();
    const ContactIndex first = m.contacts.end_index();
    const bool spatial = c.kind == ClearanceKind::spatial;
    for (double side : spatial ? std::vector{-0.5, 0.5} : std::vector{0.0}) {
      m.contacts.push_back({index, side, c.friction ? add_bristles(1, model_) : BristleIndex()});
    }
    m.clearances.push_back({closure, c.bearing_is_first, c.exponent == 1.5, c.approach, c.points,
                            c.free_bristle, first, m.contacts.end_index()});
    const double stiffness = contact_stiffness(c) * (spatial ? 0.5 : 1.0);
    const Friction friction = c.friction.value_or(Friction{});
    const double relaxation = c.friction && c.free_bristle == FreeBristle::relax
                                  ? friction.sigma0 / friction.sigma1
                                  : 0.0;
    parameters().clearances.push_back(
        {c.radial,
         c.bearing_radius,
         c.length,
         {stiffness, c.exponent, contact_damping(c.law, c.restitution), c.least_speed},
         lugre_parameters(friction),
         relaxation});
  }

  // Rows of a closure held by multipliers, or by a spring-damping element.
  void add_rows(const Closure& closure, ClosureIndex index, bool cut) {
    Mechanism& m = mechanism();
    if (cut) {
      const auto i = static_cast<std::size_t>(index.value());
      const auto rows = make_cut_rows(closure, index, i < idle_.size() ? idle_[i] : 0u);
      m.cut_rows.insert(m.cut_rows.end(), rows.begin(), rows.end());
      m.projects |= closure.stabilization == Stabilization::projection;
      return;
    }
    const Sde& sde = closure.sde;
    for (const Row& row : make_sde_rows(closure, index)) {
      const auto d = static_cast<std::size_t>(row.direction);
      m.sde_rows.push_back(row);
      parameters().springs.push_back({sde.stiffness[d], sde.damping_ratio ? 0.0 : sde.damping[d]});
    }
  }

  // `ends`: last velocities of the paths.
  template <class Structure>
  void add_support(const std::vector<VelocityIndex>& ends, Structure& c) {
    Mechanism& m = mechanism();
    std::vector<VelocityIndex> support;
    for (const VelocityIndex last : ends) {
      for (const VelocityIndex k : path(m, last)) support.push_back(k);
    }
    std::ranges::sort(support, std::greater<>());
    support.erase(std::unique(support.begin(), support.end()), support.end());
    c.support_begin = static_cast<int>(m.support.size());
    m.support.insert(m.support.end(), support.begin(), support.end());
    c.support_end = static_cast<int>(m.support.size());
  }

  void add_coupling(const Coupling& coupling) {
    Mechanism& m = mechanism();
    CouplingStructure c{.row = m.cut_rows.end_index(), .term_begin = m.coupling_terms.end_index()};
    const CouplingIndex index = m.couplings.end_index();
    std::vector<VelocityIndex> ends;
    double sum = 0.0;
    for (const CouplingTerm& term : coupling.terms) {
      const Body& body = body_on(term.joint);
      const PositionIndex q = body.q_begin + term.coordinate;
      const VelocityIndex v = body.v_begin + term.coordinate;
      m.coupling_terms.push_back({q, v});
      parameters().coupling_factors.push_back(term.factor);
      sum += term.factor * model_.start.q[q];
      ends.push_back(v);
    }
    c.term_end = m.coupling_terms.end_index();
    add_support(ends, c);
    const auto& first = m.velocities[ends.front()];
    const bool shifts = first.kind == VelocityKind::translation;
    m.cut_rows.push_back(
        {shifts ? RowKind::coupling_shift : RowKind::coupling_turn, {}, 0, 0, 1.0, 0, index});
    parameters().coupling_offsets.push_back(coupling.offset.value_or(sum));
    m.couplings.push_back(c);
    m.coupling_names.push_back(coupling.name);
  }

  const Body& body_on(const std::string& joint) const {
    const auto& names = model_.mechanism.joint_names;
    const auto at = std::find(names.begin() + 1, names.end(), joint);
    return model_.mechanism.bodies[BodyIndex(at - names.begin())];
  }

  void place_load(const Load& load) {
    PlacedLoad placed{.over = coordinate_of(load.course)};
    if (load.type == LoadType::drive || load.type == LoadType::resistance) {
      placed.v = body_on(load.joint).v_begin + load.coordinate;
    } else {
      placed.body = body_of_.at(load.link);
      const Frame& f = link_frames_[placed.body];
      const Eigen::Vector3d e = load.direction.normalized();
      placed.point = point_in_body(placed.body, load.point);
      placed.direction = to_vec3(load.follows_link ? Eigen::Vector3d(f.rotation * e) : e);
    }
    add_load(load, placed, model_);
  }

  Vec3<double> point_in_body(BodyIndex body, const Eigen::Vector3d& position) const {
    const Frame& f = link_frames_[body];
    return to_vec3(f.rotation * position + f.position);
  }

  void add_spring(const PointSpring& spring) {
    const BodyIndex first = body_of_.at(spring.first.link);
    const BodyIndex second = body_of_.at(spring.second.link);
    add_point_spring(spring, {first, point_in_body(first, spring.first.position)},
                     {second, point_in_body(second, spring.second.position)},
                     spring.course ? coordinate_of(*spring.course) : PositionIndex(), model_);
  }

  // The coordinate that a course goes over, or none.
  PositionIndex coordinate_of(const Course& course) const {
    if (!course.over) return {};
    return body_on(course.over->joint).q_begin + course.over->coordinate;
  }

  void add_point(const ChosenPoint& point) {
    const BodyIndex body = body_of_.at(point.link);
    mechanism().point_bodies.push_back(body);
    mechanism().point_names.push_back(point.name);
    parameters().points.push_back(point_in_body(body, point.position));
  }

  const Linkage& linkage_;
  const std::vector<unsigned>& idle_;
  bool shuts_sdes_;
  Model model_;
  std::map<std::string, BodyIndex> body_of_;
  IndexedVector<BodyIndex, Frame> link_frames_;  // frame of the link in its body's internal frame
};

}  // namespace

Frame link_in_body(const Joint& joint) {
  return inverse(joint.child_frame);
}

Model compile(const Linkage& linkage, const std::vector<unsigned>& idle) {
  return Compiler(linkage, idle).run();
}

Model compile_start(const Linkage& linkage, const std::vector<unsigned>& idle) {
  return Compiler(linkage, idle, true).run();
}

}  // namespace linkstudy

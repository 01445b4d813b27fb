#include "core/model/compile.h"

#include <algorithm>
#include <map>

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
      return {};
  }
  return {};
}

// Joints in body order: repeatedly the first listed joint whose parent is placed.
std::vector<const Joint*> tree_order(const Linkage& linkage, std::map<std::string, int>& body_of) {
  std::vector<const Joint*> order;
  std::vector<bool> placed(linkage.joints.size(), false);
  body_of[kGround] = 0;
  for (bool progress = true; progress;) {
    progress = false;
    for (std::size_t i = 0; i < linkage.joints.size() && !progress; ++i) {
      const Joint& joint = linkage.joints[i];
      if (placed[i] || !body_of.contains(joint.parent)) continue;
      placed[i] = progress = true;
      order.push_back(&joint);
      body_of[joint.child] = static_cast<int>(order.size());
    }
  }
  return order;
}

const Link& find_link(const Linkage& linkage, const std::string& name) {
  return *std::find_if(linkage.links.begin(), linkage.links.end(),
                       [&](const Link& link) { return link.name == name; });
}

class Compiler {
 public:
  explicit Compiler(const Linkage& linkage) : linkage_(linkage) {}

  Model run() {
    parameters().gravity = to_vec3(linkage_.gravity);
    add_ground();
    for (const Joint* joint : tree_order(linkage_, body_of_)) add_body(*joint);
    for (const Closure& closure : linkage_.closures) add_closure(closure);
    for (const Load& load : linkage_.loads) add_load(load);
    return std::move(model_);
  }

 private:
  Mechanism& mechanism() { return model_.mechanism; }
  Parameters<double>& parameters() { return model_.parameters; }

  void add_ground() {
    mechanism().bodies.emplace_back();
    parameters().bodies.emplace_back();
    mechanism().link_names.emplace_back(kGround);
    mechanism().joint_names.emplace_back();
    link_frames_.emplace_back();
  }

  void add_body(const Joint& joint) {
    Mechanism& m = mechanism();
    const Link& link = find_link(linkage_, joint.child);
    const Frame link_frame = link_in_body(joint);
    const int index = m.body_count();
    Body body;
    body.parent = body_of_.at(joint.parent);
    const Frame frame = link_frames_[static_cast<std::size_t>(body.parent)] * joint.frame;
    body.rotated_frame = !frame.rotation.isApprox(Eigen::Matrix3d::Identity(), 0.0);
    body.offset_frame = frame.position.squaredNorm() != 0.0;
    add_stages(joint, index, body);

    const Eigen::Vector3d center = link_frame.rotation * link.center_of_mass + link_frame.position;
    Eigen::Matrix3d inertia = link_frame.rotation * link.inertia * link_frame.rotation.transpose();
    const double off =
        std::max({std::abs(inertia(0, 1)), std::abs(inertia(0, 2)), std::abs(inertia(1, 2))});
    body.diagonal_inertia = off <= 1e-16 * inertia.trace();
    body.offset_mass = center.squaredNorm() != 0.0;
    m.bodies.push_back(body);
    m.link_names.push_back(link.name);
    m.joint_names.push_back(joint.name);
    link_frames_.push_back(link_frame);
    parameters().bodies.push_back({to_mat3(frame.rotation), to_vec3(frame.position), link.mass,
                                   to_vec3(center), to_sym3(inertia)});
  }

  void add_stages(const Joint& joint, int index, Body& body) {
    Mechanism& m = mechanism();
    body.stage_begin = static_cast<int>(m.stages.size());
    body.q_begin = m.nq;
    body.v_begin = m.nv;
    for (BasicMotion motion : motions_of(joint)) {
      m.stages.push_back({motion, m.nq, m.nv});
      parameters().pitch.push_back(joint.pitch);
      if (motion == BasicMotion::ball) m.ball_q.push_back(m.nq);
      m.nq += motion == BasicMotion::ball ? 4 : 1;
      m.nv += motion == BasicMotion::ball ? 3 : 1;
    }
    body.stage_end = static_cast<int>(m.stages.size());
    body.q_count = m.nq - body.q_begin;
    body.v_count = m.nv - body.v_begin;
    for (int k = body.v_begin; k < m.nv; ++k) {
      m.v_parent.push_back(k > body.v_begin ? k - 1 : last_velocity(body.parent));
      m.v_body.push_back(index);
      if (joint.hold) model_.held.push_back(k);
    }
    add_start(joint, body);
  }

  // Last velocity on the path from a body to ground, itself included.
  int last_velocity(int body) const {
    while (body > 0) {
      const Body& b = model_.mechanism.bodies[static_cast<std::size_t>(body)];
      if (b.v_count > 0) return b.v_begin + b.v_count - 1;
      body = b.parent;
    }
    return -1;
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
    const int index = static_cast<int>(m.closures.size());
    ClosureStructure c;
    c.first = body_of_.at(closure.first.link);
    c.second = body_of_.at(closure.second.link);
    c.model = closure.model;
    c.stabilization = closure.stabilization;
    const bool cut = closure.model == ClosureModel::cut;
    std::vector<Row>& rows = cut ? m.cut_rows : m.sde_rows;
    c.row_begin = static_cast<int>(rows.size());
    if (cut) {
      add_cut_rows(closure, index);
      m.projects |= closure.stabilization == Stabilization::projection;
    } else {
      add_sde_rows(closure, index);
    }
    c.row_end = static_cast<int>(rows.size());
    c.last_1 = last_velocity(c.first);
    c.last_2 = last_velocity(c.second);
    c.support = support_of(c);
    m.closures.push_back(c);
    m.closure_names.push_back(closure.name);

    const Frame f1 = link_frames_[static_cast<std::size_t>(c.first)] * closure.first.frame;
    const Frame f2 = link_frames_[static_cast<std::size_t>(c.second)] * closure.second.frame;
    const bool baumgarte = closure.stabilization == Stabilization::baumgarte;
    parameters().closures.push_back(
        {to_mat3(f1.rotation), to_vec3(f1.position), to_mat3(f2.rotation), to_vec3(f2.position),
         to_mat3(closure.sde.directions.transpose()), baumgarte ? 2.0 * closure.alpha : 0.0,
         baumgarte ? closure.beta * closure.beta : 0.0});
  }

  void add_cut_rows(const Closure& closure, int index) {
    const unsigned blocked = blocked_directions(closure.type);
    const unsigned translations = blocked & 7u;
    const RowKind kind =
        translations == 7u ? RowKind::translation_ground : RowKind::translation_first;
    for (int d = kX; d <= kZ; ++d) {
      if (blocked >> d & 1u) mechanism().cut_rows.push_back({kind, index, d, 0, 1.0, d});
    }
    for (int d = kPhi; d <= kPsi; ++d) {
      if (blocked >> d & 1u) {
        mechanism().cut_rows.push_back(rotation_row(closure, TiltMeasure::axis, index, d));
      }
    }
  }

  // Measures of small rotations: axis (tilt of the second x axis seen in {1,e}) or linearized
  // ([Urbas16] eq. (12)); a universal joint turns about x of the first and y of the second.
  static Row rotation_row(const Closure& closure, TiltMeasure tilt, int index, int d) {
    constexpr auto kind = RowKind::rotation;
    if (d == kPhi) return {kind, index, 2, 1, 1.0, d};
    if (d == kTheta) {
      return tilt == TiltMeasure::axis ? Row{kind, index, 2, 0, -1.0, d}
                                       : Row{kind, index, 0, 2, 1.0, d};
    }
    const bool universal = closure.type == JointType::universal && tilt == TiltMeasure::axis;
    return universal ? Row{kind, index, 0, 1, -1.0, d} : Row{kind, index, 1, 0, 1.0, d};
  }

  void add_sde_rows(const Closure& closure, int index) {
    const Sde& sde = closure.sde;
    const bool ground = sde.axes == SdeAxes::ground;
    const bool line = sde.form == SdeForm::line_of_centres;
    const bool springs = sde.form == SdeForm::three_springs;
    for (int d = kX; d < kDirections; ++d) {
      const auto i = static_cast<std::size_t>(d);
      const bool rotation = d >= kPhi;
      if (line && d != kX && !rotation) continue;  // one element, coefficients of x
      if (sde.stiffness[i] == 0.0 && sde.damping[i] == 0.0) continue;
      Row row =
          rotation ? rotation_row(closure, sde.tilt, index, d)
          : line   ? Row{RowKind::line_of_centres, index, 0, 0, 1.0, d}
          : springs
              ? Row{ground ? RowKind::spring_ground : RowKind::spring_first, index, d, 0, 1.0, d}
              : Row{ground ? RowKind::translation_ground : RowKind::translation_first,
                    index,
                    d,
                    0,
                    1.0,
                    d};
      mechanism().sde_rows.push_back(row);
      parameters().springs.push_back({sde.stiffness[i], sde.damping_ratio ? 0.0 : sde.damping[i]});
    }
  }

  std::vector<int> support_of(const ClosureStructure& c) const {
    const Mechanism& m = model_.mechanism;
    std::vector<int> support;
    for (int last : {c.last_1, c.last_2}) {
      for (int k = last; k >= 0; k = m.v_parent[static_cast<std::size_t>(k)]) {
        support.push_back(k);
      }
    }
    std::sort(support.begin(), support.end(), std::greater<>());
    support.erase(std::unique(support.begin(), support.end()), support.end());
    return support;
  }

  int velocity_of(const Load& load) const {
    const auto& names = model_.mechanism.joint_names;
    const auto at = std::find(names.begin() + 1, names.end(), load.joint);
    const auto body = static_cast<std::size_t>(at - names.begin());
    return model_.mechanism.bodies[body].v_begin + load.coordinate;
  }

  void add_load(const Load& load) {
    Mechanism& m = mechanism();
    LoadStructure s{.type = load.type,
                    .follows_link = load.follows_link,
                    .course = load.course.shape,
                    .law = load.law.shape};
    LoadParameters<double> p{load.course.value, 0.0, {}, {}};
    if (load.course.duration > 0.0) p.rate = 1.0 / load.course.duration;
    if (load.type == LoadType::drive || load.type == LoadType::resistance) s.v = velocity_of(load);
    if (load.type == LoadType::resistance) {
      const bool linear = load.law.shape == ResistanceShape::linear;
      p.value = load.law.value / (load.law.at_speed * (linear ? 1.0 : load.law.at_speed));
    }
    if (load.type == LoadType::link_force || load.type == LoadType::link_torque) {
      s.body = body_of_.at(load.link);
      const Frame& f = link_frames_[static_cast<std::size_t>(s.body)];
      p.point = to_vec3(f.rotation * load.point + f.position);
      const Eigen::Vector3d e = load.direction.normalized();
      p.direction = to_vec3(load.follows_link ? Eigen::Vector3d(f.rotation * e) : e);
    }
    if (s.course == CourseShape::table) add_table(load.course, s, p);
    m.loads.push_back(s);
    parameters().loads.push_back(p);
  }

  // value * table(t) as a start value and one segment for each interval.
  void add_table(const Course& course, LoadStructure& s, LoadParameters<double>& p) {
    const double scale = course.value == 0.0 ? 1.0 : course.value;
    s.table_begin = mechanism().table_segments;
    for (std::size_t i = 1; i < course.times.size(); ++i) {
      const double length = course.times[i] - course.times[i - 1];
      const double rise = scale * (course.values[i] - course.values[i - 1]);
      parameters().segments.push_back({course.times[i - 1], length, rise / length});
      ++mechanism().table_segments;
    }
    s.table_end = mechanism().table_segments;
    p.value = scale * course.values.front();
  }

  const Linkage& linkage_;
  Model model_;
  std::map<std::string, int> body_of_;
  std::vector<Frame> link_frames_;  // frame of the link in its body's internal frame
};

}  // namespace

Frame link_in_body(const Joint& joint) {
  return inverse(joint.child_frame);
}

Model compile(const Linkage& linkage) {
  return Compiler(linkage).run();
}

namespace {

auto key(const Body& b) {
  return std::tuple(b.parent, b.stage_begin, b.stage_end, b.q_begin, b.v_begin, b.rotated_frame,
                    b.offset_frame, b.diagonal_inertia, b.offset_mass);
}
auto key(const Stage& s) {
  return std::tuple(s.motion, s.q, s.v);
}
auto key(const Row& r) {
  return std::tuple(r.kind, r.closure, r.axis, r.other, r.sign, r.direction);
}
auto key(const ClosureStructure& c) {
  return std::tuple(c.first, c.second, c.model, c.stabilization, c.row_begin, c.row_end);
}
auto key(const LoadStructure& l) {
  return std::tuple(l.type, l.v, l.body, l.follows_link, l.course, l.law, l.table_begin,
                    l.table_end);
}

template <class T>
bool same(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return key(x) == key(y); });
}

}  // namespace

bool same_structure(const Mechanism& a, const Mechanism& b) {
  return same(a.bodies, b.bodies) && same(a.stages, b.stages) && same(a.closures, b.closures) &&
         same(a.cut_rows, b.cut_rows) && same(a.sde_rows, b.sde_rows) && same(a.loads, b.loads);
}

}  // namespace linkstudy

#include "core/model/fixed_structure.h"

#include <sstream>

namespace linkstudy {
namespace {

// Members in the order of their declaration: what aggregate initialisation takes.
class Writer {
 public:
  std::string run(const Mechanism& m, const std::string& name) {
    out_ << "struct " << name << " {\n  static constexpr int nq = " << m.nq << ", nv = " << m.nv
         << ", nz = " << m.nz << ";\n";
    list("Body", "bodies", m.bodies);
    list("Stage", "stages", m.stages);
    list("int", "v_parent", m.v_parent);
    list("Velocity", "velocities", m.velocities);
    list("int", "ball_q", m.ball_q);
    list("ClosureStructure", "closures", m.closures);
    list("Row", "cut_rows", m.cut_rows);
    list("Row", "sde_rows", m.sde_rows);
    list("int", "support", m.support);
    list("LoadStructure", "loads", m.loads);
    list("JointSpring", "joint_springs", m.joint_springs);
    list("ClearanceStructure", "clearances", m.clearances);
    list("ContactStructure", "contacts", m.contacts);
    list("JointFrictionStructure", "frictions", m.frictions);
    out_ << "  static constexpr bool projects = " << (m.projects ? "true" : "false") << ";\n};\n";
    return out_.str();
  }

 private:
  template <class T>
  void list(const char* type, const char* name, const std::vector<T>& items) {
    out_ << "  static constexpr std::array<" << type << ", " << items.size() << "> " << name
         << "{{\n";
    for (const T& item : items) {
      out_ << "      ";
      write(item);
      out_ << ",\n";
    }
    out_ << "  }};\n";
  }

  template <class... T>
  void braced(const T&... members) {
    out_ << "{";
    const char* comma = "";
    ((out_ << comma, write(members), comma = ", "), ...);
    out_ << "}";
  }

  template <class E>
  void enumerator(const char* type, E value) {
    out_ << type << "(" << static_cast<int>(value) << ")";
  }

  void write(int x) { out_ << x; }
  void write(std::int8_t x) { out_ << static_cast<int>(x); }
  void write(double x) { out_ << x; }
  void write(bool x) { out_ << (x ? "true" : "false"); }
  void write(BasicMotion x) { enumerator("BasicMotion", x); }
  void write(VelocityKind x) { enumerator("VelocityKind", x); }
  void write(VectorShape x) { enumerator("VectorShape", x); }
  void write(RotationShape x) { enumerator("RotationShape", x); }
  void write(InertiaShape x) { enumerator("InertiaShape", x); }
  void write(RowKind x) { enumerator("RowKind", x); }
  void write(ClosureModel x) { enumerator("ClosureModel", x); }
  void write(Stabilization x) { enumerator("Stabilization", x); }
  void write(LoadType x) { enumerator("LoadType", x); }
  void write(CourseShape x) { enumerator("CourseShape", x); }
  void write(ResistanceShape x) { enumerator("ResistanceShape", x); }
  void write(FreeBristle x) { enumerator("FreeBristle", x); }
  void write(ApproachSpeed x) { enumerator("ApproachSpeed", x); }
  void write(ContactPoints x) { enumerator("ContactPoints", x); }
  template <class T>
  void write(const std::array<T, 3>& a) {
    out_ << "{";
    braced(a[0], a[1], a[2]);
    out_ << "}";
  }
  void write(const QuarterTurn& t) { braced(t.axis, t.sign); }
  void write(const Body& b) {
    braced(b.parent, b.stage_begin, b.stage_end, b.q_begin, b.q_count, b.v_begin, b.v_count,
           b.frame, b.quarter, b.offset, b.center, b.inertia, b.carries, b.shifted, b.rotates,
           b.gyrates);
  }
  void write(const Stage& s) { braced(s.motion, s.q, s.v); }
  void write(const Velocity& v) { braced(v.body, v.kind, v.stage); }
  void write(const Row& r) { braced(r.kind, r.closure, r.axis, r.other, r.sign, r.direction); }
  void write(const ClosureStructure& c) {
    braced(c.first, c.second, c.model, c.stabilization, c.row_begin, c.row_end, c.last_1, c.last_2,
           c.support_begin, c.support_end, c.needs_frames, c.has_line, c.point_rows, c.point_1,
           c.point_2);
  }
  void write(const LoadStructure& l) {
    braced(l.type, l.v, l.body, l.follows_link, l.course, l.law, l.table_begin, l.table_end);
  }

  void write(const JointSpring& s) { braced(s.q, s.v); }
  void write(const ClearanceStructure& c) {
    braced(c.closure, c.bearing_first, c.hertz, c.approach, c.points, c.free_bristle,
           c.contact_begin, c.contact_end);
  }
  void write(const ContactStructure& c) { braced(c.clearance, c.side, c.z); }
  void write(const JointFrictionStructure& f) { braced(f.body, f.turn, f.slide, f.z); }

  std::ostringstream out_;
};

}  // namespace

std::string write_fixed_structure(const Mechanism& mechanism, const std::string& name) {
  return Writer().run(mechanism, name);
}

}  // namespace linkstudy

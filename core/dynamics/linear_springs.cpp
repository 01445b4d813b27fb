#include "core/dynamics/linear_springs.h"

#include "core/dynamics/motion.h"
#include "core/forces/applied_forces.h"

namespace linkstudy {
namespace {

// A table over a coordinate as its tangent: one segment, a unit to either side of the state.
void make_course_linear(const State<double>& s, CourseStructure& c, CourseParameters<double>& n,
                        Model& near) {
  if (!c.bend.exists()) return;
  Segments<double>& segments = near.parameters.segments;
  const double x = course_argument(c, n, s.t, s.q.data());
  const double value = course_value(c, n, segments, x);
  const double slope = curve_slope(CurveStructure{c.begin, c.end}, segments, x);
  const SegmentIndex index = segments.end_index();
  segments.push_back({s.q[c.q] - 1.0, 2.0, slope});
  n = {value - slope, 0.0, 0.0, 0.0};
  c = {.shape = CourseShape::table, .q = c.q, .begin = index, .end = index + 1};
}

// An actuator as one that knows no time.
void hold_course(double t, const Segments<double>& segments, PointSpringStructure& s,
                 PointSpringParameters<double>& n) {
  if (s.is_driven && s.course.q.exists()) return;
  double value = 0.0;
  if (s.is_driven) {
    const double x = course_argument<double>(s.course, n.course, t, nullptr);
    value = course_value(s.course, n.course, segments, x);
  }
  s.course = {};
  n.course = {value, 0.0, 0.0, 0.0};
}

// f = slope (l - length) + force there, the force as that of an actuator.
void make_linear(const PointSpringState<double>& x, const Segments<double>& segments, double t,
                 PointSpringStructure& s, PointSpringParameters<double>& n) {
  const double stretch = spring_stretch(s, n, segments, x.length);
  const double slope = spring_slope(s, n, segments, x.length, stretch);
  hold_course(t, segments, s, n);
  if (!is_acting(s.acts, stretch)) n.damping = 0.0;
  n.stiffness = slope;
  n.free_length = x.length;
  n.course.value += x.elastic;
  s.acts = SpringActs::both;
  s.curve = {};
  s.bend = {};
  s.is_driven = true;
}

// A generalised force on one coordinate, force - slope (q - there).
struct LinearForce {
  PositionIndex q;
  VelocityIndex v;
  double force, slope;
};

void add_linear_force(const LinearForce& f, const State<double>& s, Model& model) {
  model.mechanism.joint_springs.push_back({f.q, f.v});
  model.parameters.joint_springs.push_back({f.slope, 0.0, s.q[f.q], {}});
  model.mechanism.loads.push_back({.type = LoadType::drive, .v = f.v});
  model.parameters.loads.push_back({{f.force, 0.0, 0.0, 0.0}, 0.0, {}, {}});
}

void make_curves_linear(const State<double>& s, Model& model) {
  for (const JointSpringIndex i : indices_of(model.mechanism.joint_springs)) {
    const JointSpring spring = model.mechanism.joint_springs[i];
    if (!spring.bend.exists()) continue;
    const double q = s.q[spring.q];
    const Segments<double>& segments = model.parameters.segments;
    const CurveParameters<double> n = model.parameters.joint_springs[i].curve;
    model.mechanism.joint_springs[i] = {spring.q, spring.v};
    add_linear_force({spring.q, spring.v, -curve_force(spring.curve, n, segments, q),
                      curve_slope(spring.curve, segments, q)},
                     s, model);
  }
}

// d (K d^n) / d d = n K d^n / d.
void make_stops_linear(const State<double>& s, const Workspace<double>& w, Model& model) {
  for (const StopIndex i : indices_of(model.mechanism.stops)) {
    const StopStructure& stop = model.mechanism.stops[i];
    const ContactState<double>& x = w.contacts[stop.contact];
    if (!(x.elastic > 0.0)) continue;
    const double exponent = model.parameters.stops[i].contact.exponent;
    add_linear_force(
        {stop.q, stop.v, -towards_stop(stop, x.elastic), exponent * x.elastic / x.depth}, s, model);
  }
  model.mechanism.stops.clear();
}

Model make_springs_linear(const Model& model, const State<double>& s, const Workspace<double>& w) {
  Model near = model;
  Mechanism& m = near.mechanism;
  Parameters<double>& p = near.parameters;
  for (const LoadIndex i : indices_of(m.loads)) {
    make_course_linear(s, m.loads[i].course, p.loads[i].course, near);
  }
  for (const PointSpringIndex i : indices_of(m.point_springs)) {
    PointSpringStructure& spring = m.point_springs[i];
    PointSpringParameters<double>& n = p.point_springs[i];
    make_course_linear(s, spring.course, n.course, near);
    if (spring.bend.exists()) make_linear(w.point_springs[i], p.segments, s.t, spring, n);
  }
  make_curves_linear(s, near);
  near.mechanism.bent_springs = 0;
  return near;
}

}  // namespace

std::optional<Model> with_linear_springs(const Model& model, const State<double>& s,
                                         Workspace<double>& w) {
  if (model.mechanism.bent_springs == 0) return std::nullopt;
  compute_motion(model.mechanism, model.parameters, s, w);
  return make_springs_linear(model, s, w);
}

std::optional<Model> with_linear_forces(const Model& model, const State<double>& s,
                                        Workspace<double>& w) {
  if (model.mechanism.bent_springs == 0 && model.mechanism.stops.empty()) return std::nullopt;
  compute_motion(model.mechanism, model.parameters, s, w);
  Model near = make_springs_linear(model, s, w);
  make_stops_linear(s, w, near);
  return near;
}

}  // namespace linkstudy

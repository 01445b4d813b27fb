#include "core/dynamics/linear_springs.h"

#include "core/dynamics/motion.h"
#include "core/forces/applied_forces.h"

namespace linkstudy {
namespace {

// f = slope (l - length) + force there, the force as that of an actuator.
void make_linear(const PointSpringState<double>& x, const SegmentParameters<double>* segments,
                 double t, PointSpringStructure& s, PointSpringParameters<double>& n) {
  const double stretch = spring_stretch(s, n, segments, x.length);
  const double slope = spring_slope(s, n, segments, x.length, stretch);
  const double actuator = s.is_driven ? course_value(s, n, segments, t) : 0.0;
  if (!is_acting(s.acts, stretch)) n.damping = 0.0;
  n.stiffness = slope;
  n.free_length = x.length;
  n.value = x.elastic + actuator;
  n.rate = 0.0;
  s.acts = SpringActs::both;
  s.curve = {};
  s.bend = -1;
  s.is_driven = true;
  s.course = CourseShape::constant;
}

// A generalised force on one coordinate, force - slope (q - there).
struct LinearForce {
  int q, v;
  double force, slope;
};

void add_linear_force(const LinearForce& f, const State<double>& s, Model& model) {
  model.mechanism.joint_springs.push_back({f.q, f.v});
  model.parameters.joint_springs.push_back({f.slope, 0.0, s.q[static_cast<std::size_t>(f.q)], {}});
  model.mechanism.loads.push_back({.type = LoadType::drive, .v = f.v});
  model.parameters.loads.push_back({f.force, 0.0, {}, {}});
}

void make_curves_linear(const State<double>& s, Model& model) {
  const std::size_t count = model.mechanism.joint_springs.size();
  for (std::size_t i = 0; i < count; ++i) {
    const JointSpring spring = model.mechanism.joint_springs[i];
    if (spring.bend < 0) continue;
    const double q = s.q[static_cast<std::size_t>(spring.q)];
    const auto* segments = model.parameters.segments.data();
    const CurveParameters<double> n = model.parameters.joint_springs[i].curve;
    model.mechanism.joint_springs[i] = {spring.q, spring.v};
    add_linear_force({spring.q, spring.v, -curve_force(spring.curve, n, segments, q),
                      curve_slope(spring.curve, segments, q)},
                     s, model);
  }
}

// d (K d^n) / d d = n K d^n / d.
void make_stops_linear(const State<double>& s, const Workspace<double>& w, Model& model) {
  for (std::size_t i = 0; i < model.mechanism.stops.size(); ++i) {
    const StopStructure& stop = model.mechanism.stops[i];
    const ContactState<double>& x = w.contacts[static_cast<std::size_t>(stop.contact)];
    if (!(x.elastic > 0.0)) continue;
    const double exponent = model.parameters.stops[i].contact.exponent;
    add_linear_force(
        {stop.q, stop.v, -towards_stop(stop, x.elastic), exponent * x.elastic / x.depth}, s, model);
  }
  model.mechanism.stops.clear();
}

Model make_springs_linear(const Model& model, const State<double>& s, const Workspace<double>& w) {
  Model near = model;
  for (std::size_t i = 0; i < model.mechanism.point_springs.size(); ++i) {
    if (model.mechanism.point_springs[i].bend < 0) continue;
    make_linear(w.point_springs[i], model.parameters.segments.data(), s.t,
                near.mechanism.point_springs[i], near.parameters.point_springs[i]);
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

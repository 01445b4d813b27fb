#include "core/dynamics/linear_springs.h"

#include <algorithm>

#include "core/dynamics/motion.h"
#include "core/forces/point_springs.h"

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
  s.is_driven = true;
  s.course = CourseShape::constant;
}

}  // namespace

std::optional<Model> with_linear_springs(const Model& model, const State<double>& s,
                                         Workspace<double>& w) {
  const auto& springs = model.mechanism.point_springs;
  const auto is_linear = [](const PointSpringStructure& spring) { return spring.is_linear(); };
  if (std::all_of(springs.begin(), springs.end(), is_linear)) return std::nullopt;
  compute_motion(model.mechanism, model.parameters, s, w);
  std::optional<Model> near = model;
  for (std::size_t i = 0; i < springs.size(); ++i) {
    if (springs[i].is_linear()) continue;
    make_linear(w.point_springs[i], model.parameters.segments.data(), s.t,
                near->mechanism.point_springs[i], near->parameters.point_springs[i]);
  }
  return near;
}

}  // namespace linkstudy

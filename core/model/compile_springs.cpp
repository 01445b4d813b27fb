#include "core/model/compile_springs.h"

#include "core/model/piecewise.h"

namespace linkstudy {
namespace {

void add_stop(const JointStops& stops, const Body& body, int coordinate, bool is_high,
              Model& model) {
  Mechanism& m = model.mechanism;
  const auto n = static_cast<std::size_t>(coordinate);
  const bool is_viscous = !stops.damping.empty();
  StopStructure s{.q = body.q_begin + coordinate,
                  .v = body.v_begin + coordinate,
                  .is_high = is_high,
                  .hertz = stops.exponent == 1.5,
                  .is_viscous = is_viscous,
                  .approach = stops.approach,
                  .contact = m.contacts.end_index()};
  m.contacts.push_back({{}, 0.0, {}, m.stops.end_index()});
  m.stops.push_back(s);
  const double loss = is_viscous ? 0.0 : contact_damping(stops.law, stops.restitution);
  model.parameters.stops.push_back({is_high ? stops.high[n] : stops.low[n],
                                    {stops.stiffness[n], stops.exponent, loss, stops.least_speed},
                                    is_viscous ? stops.damping[n] : 0.0});
}

}  // namespace

void add_point_spring(const PointSpring& spring, const PlacedPoint& first,
                      const PlacedPoint& second, PositionIndex over, Model& model) {
  Mechanism& m = model.mechanism;
  PointSpringStructure s{.first = first.body,
                         .second = second.body,
                         .acts = spring.acts,
                         .curve = {},
                         .is_driven = spring.course.has_value(),
                         .course = {}};
  PointSpringParameters<double> p{};
  p.point_1 = first.position;
  p.point_2 = second.position;
  p.stiffness = spring.stiffness;
  p.damping = spring.damping;
  p.free_length = spring.free_length.value_or(0.0);
  if (spring.force) p.curve = add_curve(*spring.force, spring.acts, s.curve, m, model.parameters);
  if (spring.force || spring.acts != SpringActs::both) s.bend = BendIndex(m.bent_springs++);
  if (spring.course) p.course = add_course(*spring.course, over, s.course, m, model.parameters);
  m.point_springs.push_back(s);
  m.spring_names.push_back(spring.name);
  model.parameters.point_springs.push_back(p);
}

void add_stops(const JointStops& stops, BodyIndex body, Model& model) {
  const Body joint = model.mechanism.bodies[body];
  for (int i = 0; i < joint.v_count; ++i) {
    if (stops.stiffness[static_cast<std::size_t>(i)] == 0.0) continue;
    if (!stops.low.empty()) add_stop(stops, joint, i, false, model);
    if (!stops.high.empty()) add_stop(stops, joint, i, true, model);
  }
}

}  // namespace linkstudy

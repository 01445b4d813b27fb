#include "core/model/compile_springs.h"

#include "core/model/piecewise.h"

namespace linkstudy {

void add_point_spring(const PointSpring& spring, const PlacedPoint& first,
                      const PlacedPoint& second, Model& model) {
  Mechanism& m = model.mechanism;
  PointSpringStructure s{.first = first.body,
                         .second = second.body,
                         .acts = spring.acts,
                         .curve = {},
                         .is_driven = spring.course.has_value()};
  PointSpringParameters<double> p{};
  p.point_1 = first.position;
  p.point_2 = second.position;
  p.stiffness = spring.stiffness;
  p.damping = spring.damping;
  p.free_length = spring.free_length.value_or(0.0);
  if (spring.force) p.curve = add_curve(*spring.force, spring.acts, s.curve, m, model.parameters);
  if (spring.course) {
    const CourseNumbers course = add_course(*spring.course, s, m, model.parameters);
    p.value = course.value;
    p.rate = course.rate;
  }
  m.point_springs.push_back(s);
  m.spring_names.push_back(spring.name);
  model.parameters.point_springs.push_back(p);
}

}  // namespace linkstudy

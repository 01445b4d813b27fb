// Springs between points and end stops as the step loop has them, appended to a model.
#pragma once

#include "core/model/compile.h"

namespace linkstudy {

struct PlacedPoint {
  BodyIndex body;
  Vec3<double> position;  // internal frame, m
};

// over: coordinate that an actuator goes by, or none.
void add_point_spring(const PointSpring& spring, const PlacedPoint& first,
                      const PlacedPoint& second, PositionIndex over, Model& model);

// Of the coordinates of a body's joint; their contacts come behind those of clearances.
void add_stops(const JointStops& stops, BodyIndex body, Model& model);

}  // namespace linkstudy

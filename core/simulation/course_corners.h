// Where courses bend or jump: tables, and what repeats. Adaptive steps end there, so that none
// passes over a pulse that its stages did not meet.
#pragma once

#include <vector>

#include "core/model/mechanism.h"
#include "core/model/parameters.h"

namespace linkstudy {

class CourseCorners {
 public:
  CourseCorners(const Mechanism& m, const Parameters<double>& p);

  // The next corner of a course over time after t, or infinity.
  double next(double t) const;
  // An instant before a corner that every course takes for one before it; infinite ones are none.
  static double before(double corner);

  bool any_over_coordinates() const { return !over_coordinates_.empty(); }
  // Time in which no coordinate with a table reaches the next of its corners, at these rates (nv)
  // and accelerations, or infinity. Corners nearer than a thousandth of the table are passed.
  double way_ahead(Positions<const double> q, Velocities<const double> v,
                   Velocities<const double> a) const;

 private:
  struct Corners {
    std::vector<double> at;  // of the first period, increasing: s, rad or m
    double period = 0.0;     // 0: none
    PositionIndex q{};       // of a coordinate
    VelocityIndex v{};
  };

  void add(const Mechanism& m, const Parameters<double>& p, const CourseStructure& s,
           const CourseParameters<double>& n);
  static double distance(const Corners& c, double x, int direction, double least);

  std::vector<Corners> in_time_, over_coordinates_;
};

}  // namespace linkstudy

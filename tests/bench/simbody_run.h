// A linkage in Simbody, built from the same description as the engine's: revolute and prismatic
// joints, ramp drives and linear resistances, one spherical closure, which is a constraint (cut) or
// a spring-damper along the ground axes (sde). Classical Runge-Kutta with constant step, no
// projection. What is not among these throws. The headers of Simbody are not C++20: this header
// shows none of them, and keeps to what both languages have.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/topology/linkage.h"

namespace linkstudy::testing {

class SimbodyRun {
 public:
  explicit SimbodyRun(const Linkage& linkage);
  ~SimbodyRun();

  // To Joint::position, at rest, t = 0.
  void restart();
  // Four right-hand sides a step.
  void advance(double h, long steps);
  // In the order of Linkage::joints, m and rad.
  std::vector<double> positions();

 private:
  class System;
  std::unique_ptr<System> system_;
};

// Of the library in use, MAJOR.MINOR.
std::string simbody_version();

}  // namespace linkstudy::testing

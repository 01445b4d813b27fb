// Newton and Euler link by link over the samples of a run: from sampled motions and wrenches of
// closures follow the reactions of all joints (free_bodies.h), and what these do along the
// coordinates of the joints must be drives, resistances, springs, dampers and friction, no more.
// Joints: revolute, prismatic, cylindrical, spherical (zyx), free (zyx), fixed.
#pragma once

#include "tests/support/engine_probe.h"
#include "tests/support/free_bodies.h"

namespace linkstudy::testing {

class NewtonEulerCheck {
 public:
  explicit NewtonEulerCheck(const Linkage& linkage);

  // Channels that a run must sample, in this order and before any others.
  const std::vector<std::string>& signals() const { return signals_; }

  struct Residual {
    double generalised = 0.0;  // along the coordinates of all joints, N or N m
    double load = 0.0;         // normal load of joints with friction, N
    double reaction = 0.0;     // for comparison: reaction force, N
  };
  // The largest at instant t, of one row of samples.
  Residual at(double t, const Vector& sample) const;

  std::vector<LinkMotion> motions(const Vector& sample) const;

 private:
  struct Place {
    int joint;          // in Linkage::joints
    int q, v;           // first of the stacked coordinates
    int friction = -1;  // column of the normal load, friction behind it
  };
  const Joint& joint_at(const Place& place) const;
  std::vector<ExternalWrench> closure_wrenches(const std::vector<LinkMotion>& motions,
                                               const Vector& sample) const;
  double applied(const Place& place, int k, double t, const Vector& sample) const;

  Linkage linkage_;
  std::vector<std::string> signals_;
  std::vector<Place> places_;
  int nq_ = 0, nv_ = 0;
};

}  // namespace linkstudy::testing

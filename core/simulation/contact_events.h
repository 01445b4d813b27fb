// Where contacts begin and end within a step whose solution is known throughout. A contact that is
// not touching begins where its depth rises through zero, one that touches ends where it falls
// through zero. A step is divided until the cubic through depths and rates at both ends describes
// each part, so that a contact that comes and goes within one step is not lost and the first of
// several is found; its place is found to rounding of the time.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "core/model/indices.h"
#include "core/simulation/nearness.h"

namespace linkstudy {

struct ContactPhase {
  bool touching = false;
  bool fresh = false;  // begun where the step begins: its depth there is zero but for rounding
};

struct ContactEvent {
  ContactIndex contact;
  double t;
};

class ContactEvents {
 public:
  // Writes the nearness of all contacts at an instant.
  using Look = std::function<void(double t, Nearness* contacts)>;
  ContactEvents(Look look, int contacts);

  // The first event in t0 < t <= t1, or at t0 of a fresh contact that leaves its phase at once.
  // begin, end: nearness of all contacts at t0 and t1; quarters: the same at the three quarters
  // between, or nothing.
  std::optional<ContactEvent> find(double t0, double t1, const std::vector<Nearness>& begin,
                                   const std::vector<Nearness>& end,
                                   const std::vector<ContactPhase>& phases,
                                   std::span<const Nearness> quarters = {});

 private:
  // Of one contact; value: what is below zero in its phase, depth or its negative while touching.
  struct Sample {
    double t, value, rate;
  };
  Sample sample(double t, const Nearness& n) const;
  Sample look(double t);
  // part: 1 the step, 2 n and 2 n + 1 the halves of part n.
  std::optional<double> first_crossing(const Sample& a, const Sample& b, bool fresh, int part);
  Sample middle_of(const Sample& a, const Sample& b, int part);
  std::optional<double> crossing(const Sample& a, const Sample& b, bool fresh);
  double root_of_value(const Sample& a, const Sample& b);
  Sample root_of_rate(const Sample& a, const Sample& b);

  Look look_;
  std::span<const Nearness> quarters_;
  std::vector<Nearness> seen_;
  std::size_t contact_ = 0;  // the one that is searched
  bool touching_ = false;
};

}  // namespace linkstudy

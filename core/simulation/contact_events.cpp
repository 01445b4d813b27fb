#include "core/simulation/contact_events.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/numerics/bracketed_root.h"

namespace linkstudy {
namespace {

constexpr int kLeastLevel = 2;         // halvings of a step where something may happen
constexpr int kMostLevel = 12;         // and where its course is not that of a cubic
constexpr double kCubic = 0.02;        // of the change of depth in a part
constexpr double kSafeGap = 0.5;       // the same
constexpr double kDepthNoise = 1e-15;  // m

// The cubic through values and rates at both ends lies between its control points.
template <class Sample>
struct Cubic {
  double begin, second, third, end;
  Cubic(const Sample& a, const Sample& b)
      : begin(a.value),
        second(a.value + (b.t - a.t) / 3.0 * a.rate),
        third(b.value - (b.t - a.t) / 3.0 * b.rate),
        end(b.value) {}
  double low() const { return std::min({begin, second, third, end}); }
  double high() const { return std::max({begin, second, third, end}); }
  double span() const { return high() - low(); }
  double middle() const { return 0.125 * (begin + 3.0 * second + 3.0 * third + end); }
  bool rises_or_falls() const {
    return (begin <= second && second <= third && third <= end) ||
           (begin >= second && second >= third && third >= end);
  }
  // By half of what it spans; where the part begins at zero it must fall.
  bool stays_below_zero(bool fresh) const {
    const double gap = -kSafeGap * span();
    const double near = fresh ? std::max(third, end) : high();
    return near < gap && (!fresh || second < 0.0);
  }
};

}  // namespace

ContactEvents::ContactEvents(Look look, int contacts)
    : look_(std::move(look)), seen_(static_cast<std::size_t>(contacts)) {}

ContactEvents::Sample ContactEvents::sample(double t, const Nearness& n) const {
  return touching_ ? Sample{t, -n.depth, -n.rate} : Sample{t, n.depth, n.rate};
}

ContactEvents::Sample ContactEvents::look(double t) {
  look_(t, seen_.data());
  return sample(t, seen_[contact_]);
}

std::optional<ContactEvent> ContactEvents::find(double t0, double t1,
                                                const std::vector<Nearness>& begin,
                                                const std::vector<Nearness>& end,
                                                const std::vector<ContactPhase>& phases,
                                                std::span<const Nearness> quarters) {
  quarters_ = quarters;
  std::optional<ContactEvent> first;
  for (contact_ = 0; contact_ < phases.size(); ++contact_) {
    touching_ = phases[contact_].touching;
    const std::optional<double> t = first_crossing(
        sample(t0, begin[contact_]), sample(t1, end[contact_]), phases[contact_].fresh, 1);
    if (t && (!first || *t < first->t)) first = ContactEvent{ContactIndex(contact_), *t};
  }
  return first;
}

std::optional<double> ContactEvents::first_crossing(const Sample& a, const Sample& b, bool fresh,
                                                    int part) {
  const int level = std::bit_width(static_cast<unsigned>(part)) - 1;
  const Cubic<Sample> cubic(a, b);
  if (cubic.stays_below_zero(fresh)) return std::nullopt;
  if (level == kMostLevel || !(b.t > a.t)) return crossing(a, b, fresh);
  const Sample middle = middle_of(a, b, part);
  const bool known = std::fabs(middle.value - cubic.middle()) <= kCubic * cubic.span();
  if (level >= kLeastLevel && known && cubic.rises_or_falls()) return crossing(a, b, fresh);
  const auto t = first_crossing(a, middle, fresh, 2 * part);
  return t ? t : first_crossing(middle, b, false, 2 * part + 1);
}

ContactEvents::Sample ContactEvents::middle_of(const Sample& a, const Sample& b, int part) {
  const double t = 0.5 * (a.t + b.t);
  if (quarters_.empty() || part > 3) return look(t);
  const std::size_t quarter = part == 1 ? 1 : part == 2 ? 0 : 2;
  return sample(t, quarters_[quarter * seen_.size() + contact_]);
}

std::optional<double> ContactEvents::crossing(const Sample& a, const Sample& b, bool fresh) {
  const bool out = b.value > 0.0 || (b.value == 0.0 && b.rate > 0.0);
  if (out && !fresh) return root_of_value(a, b);
  if (out) {  // in, and out again; or never in
    return a.rate < 0.0 && b.rate > 0.0 ? root_of_value(root_of_rate(a, b), b) : a.t;
  }
  if (!(a.rate > 0.0 && b.rate < 0.0)) return std::nullopt;
  const Sample peak = root_of_rate(a, b);
  if (fresh) return peak.value > kDepthNoise ? std::optional(a.t) : std::nullopt;
  return peak.value > 0.0 ? std::optional(root_of_value(a, peak)) : std::nullopt;
}

double ContactEvents::root_of_value(const Sample& a, const Sample& b) {
  if (!(a.value < 0.0)) return a.t;
  const auto value = [this](double t) { return look(t).value; };
  return bracket_root(value, a.t, b.t, a.value, b.value).second;
}

ContactEvents::Sample ContactEvents::root_of_rate(const Sample& a, const Sample& b) {
  const auto rate = [this](double t) { return look(t).rate; };
  return look(bracket_root(rate, a.t, b.t, a.rate, b.rate).first);
}

}  // namespace linkstudy

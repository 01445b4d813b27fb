// How near a contact is: its depth of penetration and the rate of that, and the cubic that these
// give between two instants.
//   depth(s) = d0 h00 + h r0 h10 + d1 h01 + h r1 h11,   s = (t - t0) / h,   h = t1 - t0
// (Hermite's; its error is h^4 / 384 of the fourth derivative.)
#pragma once

namespace linkstudy {

struct Nearness {
  double depth;  // of penetration, negative: gap left, m or rad
  double rate;   // m/s or rad/s
};

// A contact between two instants.
struct NearnessSpan {
  double t0, t1;
  Nearness begin, end;

  double time_at(double s) const { return t0 + s * (t1 - t0); }
  // At t0 + s (t1 - t0).
  Nearness at(double s) const {
    const double h = t1 - t0, r = 1.0 - s;
    const double depth = begin.depth * r * r * (1.0 + 2.0 * s) +
                         end.depth * s * s * (1.0 + 2.0 * r) +
                         h * s * r * (begin.rate * r - end.rate * s);
    const double slope = 6.0 * s * r * (end.depth - begin.depth);
    const double rates = begin.rate * r * (1.0 - 3.0 * s) + end.rate * s * (1.0 - 3.0 * r);
    return {depth, h > 0.0 ? slope / h + rates : end.rate};
  }
};

}  // namespace linkstudy

// Included by one source for each instruction set.
#pragma once

#include "core/base/elementary.h"
#include "core/base/pack.h"
#include "core/laws/lugre_friction.h"
#include "core/laws/normal_contact.h"
#include "tests/pack/pack_probe.h"

namespace linkstudy::testing {

template <class Isa, int Lanes>
void apply_pack(const PackOperands* operands, PackResults* results, unsigned* mask_bits) {
  using Real = Pack<Lanes, Isa>;
  Real a(0.0), b(0.0), c(0.0);
  for (int i = 0; i < Lanes; ++i) {
    set_lane(a, i, operands[i].a);
    set_lane(b, i, operands[i].b);
    set_lane(c, i, operands[i].c);
  }
  *mask_bits = lane_bits(a < b);
  const unsigned equal = lane_bits(a == b), finite = lane_bits(is_finite(a));
  const SinCos<Real> t = sincos(c);
  const Real values[] = {a + b,
                         a - b,
                         a * b,
                         a / b,
                         -a,
                         sqrt(abs(a)),
                         abs(a),
                         min(a, b),
                         max(a, b),
                         madd(a, b, c),
                         msub(a, b, c),
                         nmadd(a, b, c),
                         select(a < b, a, c),
                         t.sin,
                         t.cos,
                         Real(0.1),
                         exp(c),
                         binary_exponent(a),
                         binary_fraction(a),
                         log(a),
                         power(a, c)};
  for (int i = 0; i < Lanes; ++i) {
    double* out = &results[i].sum;
    for (const Real& x : values) *out++ = lane(x, i);
    results[i].below = (*mask_bits >> i & 1u) != 0;
    results[i].equal = (equal >> i & 1u) != 0;
    results[i].finite = (finite >> i & 1u) != 0;
  }
}

template <class Real>
struct LawValues {
  Real normal, mu, z_rate, crossing;
};

template <class Real>
LawValues<Real> law_values(Real a, Real b, Real c) {
  const NormalContact<Real> contact{Real(1e9), Real(1.7), Real(0.6), Real(1e-3)};
  const LugreParameters<Real> friction{Real(0.3),  Real(0.2), Real(0.5), Real(60.0),
                                       Real(24.0), Real(0.1), Real(0.4)};
  const LugreState<Real> bristle = lugre_friction(friction, a, c);
  return {normal_contact_force(contact, false, a, b, abs(c)).normal, bristle.mu, bristle.z_rate,
          crossing_speed(-abs(a), abs(b), c, b)};
}

template <class Isa, int Lanes>
void apply_laws(const PackOperands* operands, LawResults* results) {
  using Real = Pack<Lanes, Isa>;
  Real a(0.0), b(0.0), c(0.0);
  for (int i = 0; i < Lanes; ++i) {
    set_lane(a, i, operands[i].a);
    set_lane(b, i, operands[i].b);
    set_lane(c, i, operands[i].c);
  }
  const LawValues<Real> x = law_values(a, b, c);
  for (int i = 0; i < Lanes; ++i) {
    results[i] = {lane(x.normal, i), lane(x.mu, i), lane(x.z_rate, i), lane(x.crossing, i)};
  }
}

}  // namespace linkstudy::testing

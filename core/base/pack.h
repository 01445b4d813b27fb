// SIMD lanes: N doubles of one instruction set. A Pack takes the place of `double` in the step
// loop, each lane another case; lanes never mix, so the bits of a lane do not depend on its
// neighbours. Isa is part of the type, so that code compiled for one instruction set has names of
// its own and is never linked in the place of another's. A translation unit may use only packs of
// the instruction set that it is compiled for; N = 1 is the scalar of that set.
//   Avx512, Avx2: madd, msub and nmadd round once (fused); Baseline: they round twice.
#pragma once

#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/base/real.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace linkstudy {

struct Baseline {
  static constexpr int lanes = 2;
};
struct Avx2 {
  static constexpr int lanes = 4;
};
struct Avx512 {
  static constexpr int lanes = 8;
};

namespace detail {

template <int N>
struct PackStorage {
  using Vector [[gnu::vector_size(8 * N)]] = double;
  using Mask [[gnu::vector_size(8 * N)]] = std::int64_t;
  using Unsigned [[gnu::vector_size(8 * N)]] = std::uint64_t;
};
template <>
struct PackStorage<1> {
  using Vector = double;
  using Mask = bool;
};

}  // namespace detail

// Result of a comparison, lane by lane.
template <int N, class Isa>
struct PackMask {
  using Bits = typename detail::PackStorage<N>::Mask;
  Bits bits;

  friend PackMask operator&&(PackMask a, PackMask b) { return {Bits(a.bits & b.bits)}; }
  friend PackMask operator||(PackMask a, PackMask b) { return {Bits(a.bits | b.bits)}; }
  friend PackMask operator!(PackMask a) {
    if constexpr (N == 1) {
      return {!a.bits};
    } else {
      return {~a.bits};
    }
  }
};

template <int N, class Isa>
struct Pack {
  using Vector = typename detail::PackStorage<N>::Vector;
  using Mask = PackMask<N, Isa>;
  Vector v;

  Pack() = default;
  explicit Pack(double a) : v(a - Vector{}) {}
  explicit constexpr Pack(Vector a) requires(N > 1) : v(a) {}

  friend Pack operator+(Pack a, Pack b) { return Pack(a.v + b.v); }
  friend Pack operator-(Pack a, Pack b) { return Pack(a.v - b.v); }
  friend Pack operator*(Pack a, Pack b) { return Pack(a.v * b.v); }
  friend Pack operator/(Pack a, Pack b) { return Pack(a.v / b.v); }
  friend Pack operator-(Pack a) { return Pack(-a.v); }
  friend Mask operator<(Pack a, Pack b) { return {a.v < b.v}; }
  friend Mask operator>(Pack a, Pack b) { return {a.v > b.v}; }
  friend Mask operator<=(Pack a, Pack b) { return {a.v <= b.v}; }
  friend Mask operator>=(Pack a, Pack b) { return {a.v >= b.v}; }
  friend Mask operator==(Pack a, Pack b) { return {a.v == b.v}; }
};

template <int N, class Isa>
struct RealTraits<Pack<N, Isa>> {
  using Mask = PackMask<N, Isa>;
  static constexpr int lanes = N;
};

template <int N, class Isa>
inline Pack<N, Isa> select(PackMask<N, Isa> m, Pack<N, Isa> a, Pack<N, Isa> b) {
  return Pack<N, Isa>(m.bits ? a.v : b.v);
}
template <int N, class Isa>
inline Pack<N, Isa> min(Pack<N, Isa> a, Pack<N, Isa> b) {
  return select(a < b, a, b);
}
template <int N, class Isa>
inline Pack<N, Isa> max(Pack<N, Isa> a, Pack<N, Isa> b) {
  return select(a > b, a, b);
}

// Bit i is set where lane i is true.
template <int N, class Isa>
inline unsigned lane_bits(PackMask<N, Isa> m) {
  if constexpr (N == 1) {
    return m.bits ? 1u : 0u;
  } else {
#if defined(__AVX512DQ__)
    if constexpr (N == 8) return _mm512_movepi64_mask(reinterpret_cast<__m512i>(m.bits));
#elif defined(__AVX2__)
    if constexpr (N == 4) {
      return static_cast<unsigned>(_mm256_movemask_pd(reinterpret_cast<__m256d>(m.bits)));
    }
#endif
    unsigned bits = 0;
    for (int i = 0; i < N; ++i) bits |= static_cast<unsigned>(m.bits[i] & 1) << i;
    return bits;
  }
}
template <int N, class Isa>
inline bool any(PackMask<N, Isa> m) {
  return lane_bits(m) != 0;
}
template <int N, class Isa>
inline bool all(PackMask<N, Isa> m) {
  return lane_bits(m) == (1u << N) - 1u;
}

template <int N, class Isa>
inline double lane(const Pack<N, Isa>& a, int i) {
  if constexpr (N == 1) {
    return a.v;
  } else {
    return a.v[i];
  }
}
template <int N, class Isa>
inline void set_lane(Pack<N, Isa>& a, int i, double x) {
  if constexpr (N == 1) {
    a.v = x;
  } else {
    a.v[i] = x;
  }
}

template <class Isa>
inline Pack<1, Isa> sqrt(Pack<1, Isa> a) {
  return Pack<1, Isa>(__builtin_sqrt(a.v));
}
template <class Isa>
inline Pack<1, Isa> abs(Pack<1, Isa> a) {
  return Pack<1, Isa>(__builtin_fabs(a.v));
}
template <int N, class Isa>
inline Pack<N, Isa> abs(Pack<N, Isa> a) {
  using P = Pack<N, Isa>;
  using Bits = typename PackMask<N, Isa>::Bits;
  return P(typename P::Vector(Bits(a.v) & (Bits{} + INT64_MAX)));
}

// As in real.h.
template <int k, int N, class Isa>
inline Pack<N, Isa> sign_from_bit(Pack<N, Isa> sum) {
  using P = Pack<N, Isa>;
  if constexpr (N == 1) {
    return P(sign_from_bit<k>(sum.v));
  } else {
    using Bits = typename detail::PackStorage<N>::Unsigned;
    return P(typename P::Vector(Bits(sum.v) << (63 - k) & (Bits{} + (std::uint64_t{1} << 63))));
  }
}
template <int N, class Isa>
inline Pack<N, Isa> turned(Pack<N, Isa> a, Pack<N, Isa> sign) {
  using P = Pack<N, Isa>;
  if constexpr (N == 1) {
    return P(turned(a.v, sign.v));
  } else {
    using Bits = typename PackMask<N, Isa>::Bits;
    return P(typename P::Vector(Bits(a.v) ^ Bits(sign.v)));
  }
}
template <int N, class Isa>
inline PackMask<N, Isa> has_sign(Pack<N, Isa> a) {
  if constexpr (N == 1) {
    return {has_sign(a.v)};
  } else {
    using Bits = typename PackMask<N, Isa>::Bits;
    return {Bits(a.v) < 0};
  }
}

// Adding 1.5 2^52 leaves n in the low bits of the significand.
template <int N, class Isa>
inline Pack<N, Isa> power_of_two(Pack<N, Isa> n) {
  using P = Pack<N, Isa>;
  constexpr double shift = 6755399441055744.0 + 1023.0;
  if constexpr (N == 1) {
    return P(std::bit_cast<double>(std::bit_cast<std::int64_t>(n.v + shift) << 52));
  } else {
    using Bits = typename PackMask<N, Isa>::Bits;
    return P(typename P::Vector(Bits(n.v + shift) << 52));
  }
}

// As in real.h. The exponent becomes a number as the low bits of 2^52's significand.
template <int N, class Isa>
inline Pack<N, Isa> binary_exponent(Pack<N, Isa> a) {
  using P = Pack<N, Isa>;
  if constexpr (N == 1) {
    return P(binary_exponent(a.v));
  } else {
    using Bits = typename detail::PackStorage<N>::Unsigned;
    const Bits number = (Bits(a.v) >> 52) | (Bits{} + 0x4330000000000000u);
    return P(typename P::Vector(number)) - P(4503599627370496.0 + 1023.0);
  }
}
template <int N, class Isa>
inline Pack<N, Isa> binary_fraction(Pack<N, Isa> a) {
  using P = Pack<N, Isa>;
  if constexpr (N == 1) {
    return P(binary_fraction(a.v));
  } else {
    using Bits = typename detail::PackStorage<N>::Unsigned;
    const Bits digits = Bits(a.v) & (Bits{} + 0x000fffffffffffffu);
    return P(typename P::Vector(digits | (Bits{} + 0x3ff0000000000000u)));
  }
}

template <int N, class Isa>
inline PackMask<N, Isa> is_finite(Pack<N, Isa> a) {
  return abs(a) <= Pack<N, Isa>(1.7976931348623157e308);
}

// Without fused instructions: two roundings, as in real.h.
template <int N>
inline Pack<N, Baseline> madd(Pack<N, Baseline> a, Pack<N, Baseline> b, Pack<N, Baseline> c) {
  return a * b + c;
}
template <int N>
inline Pack<N, Baseline> msub(Pack<N, Baseline> a, Pack<N, Baseline> b, Pack<N, Baseline> c) {
  return a * b - c;
}
template <int N>
inline Pack<N, Baseline> nmadd(Pack<N, Baseline> a, Pack<N, Baseline> b, Pack<N, Baseline> c) {
  return c - a * b;
}

#if defined(__FMA__)
template <class Isa>
requires(!std::is_same_v<Isa, Baseline>) inline Pack<1, Isa> madd(Pack<1, Isa> a, Pack<1, Isa> b,
                                                                  Pack<1, Isa> c) {
  return Pack<1, Isa>(__builtin_fma(a.v, b.v, c.v));
}
template <class Isa>
requires(!std::is_same_v<Isa, Baseline>) inline Pack<1, Isa> msub(Pack<1, Isa> a, Pack<1, Isa> b,
                                                                  Pack<1, Isa> c) {
  return Pack<1, Isa>(__builtin_fma(a.v, b.v, -c.v));
}
template <class Isa>
requires(!std::is_same_v<Isa, Baseline>) inline Pack<1, Isa> nmadd(Pack<1, Isa> a, Pack<1, Isa> b,
                                                                   Pack<1, Isa> c) {
  return Pack<1, Isa>(__builtin_fma(-a.v, b.v, c.v));
}
inline Pack<4, Avx2> madd(Pack<4, Avx2> a, Pack<4, Avx2> b, Pack<4, Avx2> c) {
  return Pack<4, Avx2>(_mm256_fmadd_pd(a.v, b.v, c.v));
}
inline Pack<4, Avx2> msub(Pack<4, Avx2> a, Pack<4, Avx2> b, Pack<4, Avx2> c) {
  return Pack<4, Avx2>(_mm256_fmsub_pd(a.v, b.v, c.v));
}
inline Pack<4, Avx2> nmadd(Pack<4, Avx2> a, Pack<4, Avx2> b, Pack<4, Avx2> c) {
  return Pack<4, Avx2>(_mm256_fnmadd_pd(a.v, b.v, c.v));
}
inline Pack<4, Avx2> sqrt(Pack<4, Avx2> a) {
  return Pack<4, Avx2>(_mm256_sqrt_pd(a.v));
}
#endif

#if defined(__AVX512F__)
inline Pack<8, Avx512> madd(Pack<8, Avx512> a, Pack<8, Avx512> b, Pack<8, Avx512> c) {
  return Pack<8, Avx512>(_mm512_fmadd_pd(a.v, b.v, c.v));
}
inline Pack<8, Avx512> msub(Pack<8, Avx512> a, Pack<8, Avx512> b, Pack<8, Avx512> c) {
  return Pack<8, Avx512>(_mm512_fmsub_pd(a.v, b.v, c.v));
}
inline Pack<8, Avx512> nmadd(Pack<8, Avx512> a, Pack<8, Avx512> b, Pack<8, Avx512> c) {
  return Pack<8, Avx512>(_mm512_fnmadd_pd(a.v, b.v, c.v));
}
inline Pack<8, Avx512> sqrt(Pack<8, Avx512> a) {
  return Pack<8, Avx512>(_mm512_maskz_sqrt_pd(0xff, a.v));
}
#endif

#if defined(__x86_64__)
inline Pack<2, Baseline> sqrt(Pack<2, Baseline> a) {
  return Pack<2, Baseline>(_mm_sqrt_pd(a.v));
}
#else
inline Pack<2, Baseline> sqrt(Pack<2, Baseline> a) {
  return Pack<2, Baseline>(
      Pack<2, Baseline>::Vector{__builtin_sqrt(a.v[0]), __builtin_sqrt(a.v[1])});
}
#endif

}  // namespace linkstudy

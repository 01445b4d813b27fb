// A scalar that remembers what is done to it: run with it, the step loop leaves the graph of its
// arithmetic in the graph that the thread is tracing into. It takes the place of `double` or of a
// pack (core/base/real.h), as one lane without a value.
//
// A trace is for all lanes and all values to come, so what would look at them is answered so:
//   any(mask)  true, unless no value can make it so: what it guards is masked, as lanes are that go
//              along with a neighbour
//   all(mask)  false, unless every value makes it so: searches go on, RealTraits::blind_passes
//   times lane_bits  all true, and the mask becomes a requirement of the graph: where it fails for
//   a lane,
//              what was written from the graph has not said anything about this lane
// Numbers of single lanes cannot be taken out or put in: Untraceable.
#pragma once

#include <stdexcept>

#include "core/base/real.h"
#include "core/codegen/graph.h"

namespace linkstudy {

struct Untraceable : std::runtime_error {
  using std::runtime_error::runtime_error;
};

namespace codegen {

// The graph of this thread's trace.
inline thread_local Graph* traced_graph = nullptr;

// Tracing into a graph while alive.
class Trace {
 public:
  explicit Trace(Graph& graph) : before_(traced_graph) { traced_graph = &graph; }
  ~Trace() { traced_graph = before_; }
  Trace(const Trace&) = delete;
  Trace& operator=(const Trace&) = delete;

 private:
  Graph* before_;
};

}  // namespace codegen

struct TracedMask {
  codegen::Value value = 0;

  static TracedMask of(codegen::Op op, codegen::Value a, codegen::Value b) {
    return {codegen::traced_graph->make(op, a, b)};
  }
  friend TracedMask operator&&(TracedMask a, TracedMask b) {
    return of(codegen::Op::bit_and, a.value, b.value);
  }
  friend TracedMask operator||(TracedMask a, TracedMask b) {
    return of(codegen::Op::bit_or, a.value, b.value);
  }
  friend TracedMask operator!(TracedMask a) {
    return of(codegen::Op::bit_xor, a.value, codegen::traced_graph->bits(codegen::Graph::kTrue));
  }
};

struct Traced {
  codegen::Value value = 0;  // as a new pack in a container: zero

  Traced() = default;
  explicit Traced(double x) : value(codegen::traced_graph->constant(x)) {}

  static Traced of(codegen::Op op, Traced a) {
    return from(codegen::traced_graph->make(op, a.value));
  }
  static Traced of(codegen::Op op, Traced a, Traced b) {
    return from(codegen::traced_graph->make(op, a.value, b.value));
  }
  static Traced of(codegen::Op op, Traced a, Traced b, Traced c) {
    return from(codegen::traced_graph->make(op, a.value, b.value, c.value));
  }
  static Traced from(codegen::Value value) {
    Traced x;
    x.value = value;
    return x;
  }

  friend Traced operator+(Traced a, Traced b) { return of(codegen::Op::add, a, b); }
  friend Traced operator-(Traced a, Traced b) { return of(codegen::Op::subtract, a, b); }
  friend Traced operator*(Traced a, Traced b) { return of(codegen::Op::multiply, a, b); }
  friend Traced operator/(Traced a, Traced b) { return of(codegen::Op::divide, a, b); }
  friend Traced operator-(Traced a) { return of(codegen::Op::negate, a); }
  friend TracedMask operator<(Traced a, Traced b) {
    return TracedMask::of(codegen::Op::less, a.value, b.value);
  }
  friend TracedMask operator>(Traced a, Traced b) { return b < a; }
  friend TracedMask operator<=(Traced a, Traced b) {
    return TracedMask::of(codegen::Op::less_equal, a.value, b.value);
  }
  friend TracedMask operator>=(Traced a, Traced b) { return b <= a; }
  friend TracedMask operator==(Traced a, Traced b) {
    return TracedMask::of(codegen::Op::equal, a.value, b.value);
  }
};

template <>
struct RealTraits<Traced> {
  using Mask = TracedMask;
  static constexpr int lanes = 1;
  // Of a search whose end it cannot see; where that was not enough, a requirement fails.
  static constexpr int blind_passes = 4;
};

inline Traced madd(Traced a, Traced b, Traced c) {
  return Traced::of(codegen::Op::madd, a, b, c);
}
inline Traced msub(Traced a, Traced b, Traced c) {
  return Traced::of(codegen::Op::msub, a, b, c);
}
inline Traced nmadd(Traced a, Traced b, Traced c) {
  return Traced::of(codegen::Op::nmadd, a, b, c);
}
inline Traced select(TracedMask mask, Traced a, Traced b) {
  return Traced::from(
      codegen::traced_graph->make(codegen::Op::select, mask.value, a.value, b.value));
}
inline Traced sqrt(Traced a) {
  return Traced::of(codegen::Op::square_root, a);
}
inline Traced min(Traced a, Traced b) {
  return Traced::of(codegen::Op::minimum, a, b);
}
inline Traced max(Traced a, Traced b) {
  return Traced::of(codegen::Op::maximum, a, b);
}

namespace codegen {

inline Traced with_bits(Op op, Traced a, std::uint64_t bits) {
  return Traced::of(op, a, Traced::from(traced_graph->bits(bits)));
}

}  // namespace codegen

inline Traced abs(Traced a) {
  return codegen::with_bits(codegen::Op::bit_and, a, ~(std::uint64_t{1} << 63));
}
inline TracedMask is_finite(Traced a) {
  return abs(a) <= Traced(1.7976931348623157e308);
}
template <int k>
inline Traced sign_from_bit(Traced sum) {
  const Traced bit = codegen::with_bits(codegen::Op::shift_left, sum, 63 - k);
  return k == 0 ? bit : codegen::with_bits(codegen::Op::bit_and, bit, codegen::Graph::kSign);
}
inline Traced turned(Traced a, Traced sign) {
  return Traced::of(codegen::Op::bit_xor, a, sign);
}
inline TracedMask has_sign(Traced a) {
  return {codegen::traced_graph->make(codegen::Op::sign_mask, a.value)};
}
inline Traced power_of_two(Traced n) {
  return codegen::with_bits(codegen::Op::shift_left, n + Traced(6755399441055744.0 + 1023.0), 52);
}
inline Traced binary_exponent(Traced a) {
  const Traced number =
      codegen::with_bits(codegen::Op::bit_or, codegen::with_bits(codegen::Op::shift_right, a, 52),
                         0x4330000000000000u);
  return number - Traced(4503599627370496.0 + 1023.0);
}
inline Traced binary_fraction(Traced a) {
  const Traced digits = codegen::with_bits(codegen::Op::bit_and, a, 0x000fffffffffffffu);
  return codegen::with_bits(codegen::Op::bit_or, digits, 0x3ff0000000000000u);
}

inline bool any(TracedMask mask) {
  return mask.value != codegen::traced_graph->bits(0);
}
inline bool all(TracedMask mask) {
  return mask.value == codegen::traced_graph->bits(codegen::Graph::kTrue);
}
inline unsigned lane_bits(TracedMask mask) {
  codegen::traced_graph->require(mask.value);
  return 1;
}
inline double lane(Traced, int) {
  throw Untraceable("a number of one lane was asked for");
}
inline void set_lane(Traced&, int, double) {
  throw Untraceable("a number of one lane was set");
}

}  // namespace linkstudy

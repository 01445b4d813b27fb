#include "core/codegen/graph.h"

#include <bit>
#include <cmath>
#include <utility>

namespace linkstudy::codegen {
namespace {

double mask_of(bool x) {
  return std::bit_cast<double>(x ? Graph::kTrue : std::uint64_t{0});
}

template <class F>
double on_bits(double a, double b, F&& f) {
  return std::bit_cast<double>(f(std::bit_cast<std::uint64_t>(a), std::bit_cast<std::uint64_t>(b)));
}

// 1 / x is exact: x is a power of two, and so is its inverse, not too small to be exact.
bool has_exact_inverse(double x) {
  int exponent = 0;
  return std::isnormal(x) && std::abs(std::frexp(x, &exponent)) == 0.5 && std::isnormal(1.0 / x);
}

bool is_exact_product(double a, double b) {
  const double product = a * b;
  return std::isnormal(product) && std::abs(product) > 1e-250 && std::fma(a, b, -product) == 0.0;
}

}  // namespace

double apply(Op op, double a, double b, double c) {
  switch (op) {
    case Op::add:
      return a + b;
    case Op::subtract:
      return a - b;
    case Op::multiply:
      return a * b;
    case Op::divide:
      return a / b;
    case Op::madd:
      return std::fma(a, b, c);
    case Op::msub:
      return std::fma(a, b, -c);
    case Op::nmadd:
      return std::fma(-a, b, c);
    case Op::nmsub:
      return std::fma(-a, b, -c);
    case Op::negate:
      return -a;
    case Op::square_root:
      return std::sqrt(a);
    case Op::minimum:
      return a < b ? a : b;
    case Op::maximum:
      return a > b ? a : b;
    case Op::bit_and:
      return on_bits(a, b, [](auto x, auto y) { return x & y; });
    case Op::bit_or:
      return on_bits(a, b, [](auto x, auto y) { return x | y; });
    case Op::bit_xor:
      return on_bits(a, b, [](auto x, auto y) { return x ^ y; });
    case Op::shift_left:
      return on_bits(a, b, [](auto x, auto y) { return y < 64 ? x << y : 0; });
    case Op::shift_right:
      return on_bits(a, b, [](auto x, auto y) { return y < 64 ? x >> y : 0; });
    case Op::sign_mask:
      return mask_of(std::signbit(a));
    case Op::less:
      return mask_of(a < b);
    case Op::less_equal:
      return mask_of(a <= b);
    case Op::equal:
      return mask_of(a == b);
    case Op::select:
      return std::bit_cast<std::uint64_t>(a) != 0 ? b : c;
    case Op::constant:
    case Op::input:
      break;
  }
  return a;
}

std::size_t Graph::Hash::operator()(const Node& n) const {
  std::uint64_t h = static_cast<std::uint64_t>(n.op) + n.bits;
  for (const Value v : {n.a, n.b, n.c}) {
    h = (h ^ static_cast<std::uint64_t>(v)) * 0x9e3779b97f4a7c15u;
    h ^= h >> 29;
  }
  return h;
}

double Graph::number(Value v) const {
  return std::bit_cast<double>(node(v).bits);
}

bool Graph::is(Value v, double x) const {
  return is_constant(v) && number(v) == x;
}

Value Graph::take(const Node& n) {
  const auto [place, is_new] = known_nodes_.try_emplace(n, static_cast<Value>(nodes_.size()));
  if (is_new) nodes_.push_back(n);
  return place->second;
}

Value Graph::constant(double x) {
  return bits(std::bit_cast<std::uint64_t>(x));
}

Value Graph::bits(std::uint64_t x) {
  return take({Op::constant, -1, -1, -1, x});
}

Value Graph::input(int slot) {
  return take({Op::input, -1, -1, -1, static_cast<std::uint64_t>(slot)});
}

// Folded if all operands are constants, else a node.
Value Graph::known(Op op, Value a, Value b, Value c) {
  const auto is_known = [this](Value v) { return v < 0 || is_constant(v); };
  if (!is_known(a) || !is_known(b) || !is_known(c)) return take({op, a, b, c, 0});
  const auto number_of = [this](Value v) { return v < 0 ? 0.0 : number(v); };
  return constant(apply(op, number_of(a), number_of(b), number_of(c)));
}

Value Graph::make(Op op, Value a, Value b, Value c) {
  switch (op) {
    case Op::add:
      return add(a, b);
    case Op::subtract:
      return subtract(a, b);
    case Op::multiply:
      return multiply(a, b);
    case Op::divide:
      return divide(a, b);
    case Op::madd:
      return fused(false, a, b, false, c);
    case Op::msub:
      return fused(false, a, b, true, c);
    case Op::nmadd:
      return fused(true, a, b, false, c);
    case Op::nmsub:
      return fused(true, a, b, true, c);
    case Op::negate:
      return node(a).op == Op::negate ? node(a).a : known(op, a, -1, -1);
    case Op::bit_xor:
      return b == true_ && node(a).op == op && node(a).b == true_ ? node(a).a : known(op, a, b, c);
    case Op::bit_and:
    case Op::bit_or:
      return logic(op, a, b);
    case Op::select:
      return choose(a, b, c);
    default:
      return known(op, a, b, c);
  }
}

// True, and v without it, if v is something negated.
bool Graph::strip_sign(Value& v) const {
  if (node(v).op != Op::negate) return false;
  v = node(v).a;
  return true;
}

Value Graph::add(Value a, Value b) {
  if (strip_sign(b)) return subtract(a, b);
  if (strip_sign(a)) return subtract(b, a);
  const bool is_folded = is_constant(a) && is_constant(b);
  if (!is_folded && is(a, 0.0)) return b;
  if (!is_folded && is(b, 0.0)) return a;
  if (a > b) std::swap(a, b);
  return known(Op::add, a, b, -1);
}

Value Graph::subtract(Value a, Value b) {
  if (strip_sign(b)) return add(a, b);
  if (is(b, 0.0) && !is_constant(a)) return a;
  return known(Op::subtract, a, b, -1);
}

// +-a +- b
Value Graph::sum(bool minus_a, Value a, bool minus_b, Value b) {
  if (minus_a && minus_b) return subtract(make(Op::negate, a), b);
  return minus_a ? subtract(b, a) : minus_b ? subtract(a, b) : add(a, b);
}

Value Graph::multiply(Value a, Value b) {
  const bool minus = strip_sign(a) != strip_sign(b);
  if (is_constant(b)) std::swap(a, b);
  if (is_constant(a) && is_constant(b)) return negated(minus, known(Op::multiply, a, b, -1));
  if (is(a, 0.0)) return zero_;
  if (is(a, 1.0)) return negated(minus, b);
  if (is(a, -1.0)) return negated(!minus, b);
  if (a > b) std::swap(a, b);
  return negated(minus, known(Op::multiply, a, b, -1));
}

Value Graph::divide(Value a, Value b) {
  const bool minus = strip_sign(a) != strip_sign(b);
  if (is_constant(b) && has_exact_inverse(number(b))) {
    return negated(minus, multiply(a, constant(1.0 / number(b))));
  }
  return negated(minus, known(Op::divide, a, b, -1));
}

// +-(a b) +- c, rounded once
Value Graph::fused(bool minus_product, Value a, Value b, bool minus_term, Value c) {
  minus_product = minus_product != (strip_sign(a) != strip_sign(b));
  minus_term = minus_term != strip_sign(c);
  if (is_constant(b)) std::swap(a, b);
  const bool all_known = is_constant(a) && is_constant(b) && is_constant(c);
  if (!all_known) {
    if (is(a, 0.0)) return is(c, 0.0) ? zero_ : negated(minus_term, c);
    if (is(a, 1.0)) return sum(minus_product, b, minus_term, c);
    if (is(a, -1.0)) return sum(!minus_product, b, minus_term, c);
    if (is(c, 0.0)) return negated(minus_product, multiply(a, b));
    if (is_constant(a) && is_constant(b) && is_exact_product(number(a), number(b))) {
      return sum(minus_product, constant(number(a) * number(b)), minus_term, c);
    }
  }
  if (a > b) std::swap(a, b);
  const Op plus = minus_term ? Op::msub : Op::madd, minus = minus_term ? Op::nmsub : Op::nmadd;
  return known(minus_product ? minus : plus, a, b, c);
}

Value Graph::logic(Op op, Value a, Value b) {
  if (is_constant(a)) std::swap(a, b);
  if (is_constant(b) && !is_constant(a)) {
    const std::uint64_t x = node(b).bits;
    if (op == Op::bit_and && x == kTrue) return a;
    if (op == Op::bit_or && x == 0) return a;
    if (op == Op::bit_and ? x == 0 : x == kTrue) return b;
    if (op == Op::bit_and && x == ~kSign) strip_sign(a);
  }
  if (a == b) return a;
  if (a > b) std::swap(a, b);
  return known(op, a, b, -1);
}

Value Graph::choose(Value mask, Value a, Value b) {
  if (is_constant(mask)) return node(mask).bits != 0 ? a : b;
  if (a == b) return a;
  const Node m = node(mask);  // a node of nodes_ may move
  if (m.op == Op::bit_xor && m.a == true_) return choose(m.b, b, a);
  if (m.op == Op::bit_xor && m.b == true_) return choose(m.a, b, a);
  return known(Op::select, mask, a, b);
}

void interpret(const Graph& graph, std::vector<double>& slots) {
  std::vector<double> x(graph.nodes().size());
  const auto at = [&x](Value v) { return v < 0 ? 0.0 : x[static_cast<std::size_t>(v)]; };
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Node& n = graph.nodes()[i];
    x[i] = n.op == Op::constant ? std::bit_cast<double>(n.bits)
           : n.op == Op::input  ? slots[static_cast<std::size_t>(n.bits)]
                                : apply(n.op, at(n.a), at(n.b), at(n.c));
  }
  for (const Output& o : graph.outputs()) slots[static_cast<std::size_t>(o.slot)] = at(o.value);
}

}  // namespace linkstudy::codegen

// Expressions as a graph: what a piece of straight-line arithmetic computes, every value once.
// A value is a node; equal nodes are one (hash-consing), and what can be known beforehand is folded
// as the operation itself would round it. Masks are values whose bits are all ones or all zeros.
//
// Folds keep every bit of every number, but for these, which the engine's sums need and which can
// change the sign of a zero, or what becomes of a factor that is no number or infinite:
//   x + 0 = x    x * 0 = 0    a * b + 0 = a * b
// Left alone: -(a - b), 0 - x, and a product of two constants that is not exact in a sum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace linkstudy::codegen {

enum class Op : std::uint8_t {
  constant,
  input,
  add,
  subtract,
  multiply,
  divide,
  madd,   // a b + c, rounded once, as are the next three
  msub,   // a b - c
  nmadd,  // c - a b
  nmsub,  // -(a b) - c
  negate,
  square_root,
  minimum,  // a < b ? a : b
  maximum,  // a > b ? a : b
  bit_and,
  bit_or,
  bit_xor,
  shift_left,  // bits of a by the whole number that the bits of b are; none is left from 64 on
  shift_right,
  sign_mask,  // true where a has a sign
  less,
  less_equal,
  equal,
  select  // a ? b : c
};

constexpr bool is_fused(Op op) {
  return op >= Op::madd && op <= Op::nmsub;
}

// How many operands it has.
constexpr int operand_count(Op op) {
  switch (op) {
    case Op::constant:
    case Op::input:
      return 0;
    case Op::negate:
    case Op::square_root:
    case Op::sign_mask:
      return 1;
    case Op::madd:
    case Op::msub:
    case Op::nmadd:
    case Op::nmsub:
    case Op::select:
      return 3;
    default:
      return 2;
  }
}

// What an operation gives, masks as bits of a double.
double apply(Op op, double a, double b, double c);

using Value = int;  // index of a node

struct Node {
  Op op;
  Value a = -1, b = -1, c = -1;  // operands, as many as the operation has
  std::uint64_t bits = 0;        // of a constant; the slot of an input
  bool operator==(const Node&) const = default;
};

struct Output {
  Value value;
  int slot;
};

class Graph {
 public:
  static constexpr std::uint64_t kTrue = ~std::uint64_t{0};
  static constexpr std::uint64_t kSign = std::uint64_t{1} << 63;

  Value constant(double x);
  Value bits(std::uint64_t x);
  Value input(int slot);
  Value make(Op op, Value a, Value b = -1, Value c = -1);

  void write(Value value, int slot) { outputs_.push_back({value, slot}); }
  // The code is right only where this mask is true.
  void require(Value mask) { required_ = make(Op::bit_and, required_, mask); }
  Value required() const { return required_; }
  Value sign() const { return sign_; }  // what turns the sign of a number by bit_xor

  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Output>& outputs() const { return outputs_; }
  bool is_constant(Value v) const { return node(v).op == Op::constant; }
  double number(Value v) const;  // of a constant

 private:
  const Node& node(Value v) const { return nodes_[static_cast<std::size_t>(v)]; }
  bool is(Value v, double x) const;  // a constant equal to x: zeros of both signs are
  Value take(const Node& n);
  Value known(Op op, Value a, Value b, Value c);
  Value add(Value a, Value b);
  Value subtract(Value a, Value b);
  Value multiply(Value a, Value b);
  Value divide(Value a, Value b);
  Value fused(bool minus_product, Value a, Value b, bool minus_term, Value c);
  Value sum(bool minus_a, Value a, bool minus_b, Value b);
  Value negated(bool minus, Value a) { return minus ? make(Op::negate, a) : a; }
  Value logic(Op op, Value a, Value b);
  Value choose(Value mask, Value a, Value b);
  bool strip_sign(Value& v) const;

  struct Hash {
    std::size_t operator()(const Node& n) const;
  };
  std::vector<Node> nodes_;
  std::unordered_map<Node, Value, Hash> known_nodes_;
  std::vector<Output> outputs_;
  Value zero_ = bits(0);  // node 0: what a value is that nobody has set
  Value true_ = bits(kTrue);
  Value sign_ = bits(kSign);
  Value required_ = true_;
};

// Runs a graph on numbers: the meaning of everything written from it. `slots` holds the inputs and
// receives the outputs.
void interpret(const Graph& graph, std::vector<double>& slots);

}  // namespace linkstudy::codegen

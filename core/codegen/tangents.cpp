#include "core/codegen/tangents.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace linkstudy::codegen {
namespace {

constexpr std::uint64_t kDigits = 0x000fffffffffffffu;
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

using Partials = std::array<double, 3>;

std::uint64_t bits_of(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

// Adding such a number leaves no digits behind the point.
bool rounds(const Graph& graph, Value v) {
  if (v < 0 || !graph.is_constant(v)) return false;
  const double size = std::fabs(graph.number(v));
  return size >= 0x1p52 && size < 0x1p53;
}

bool is_sum(Op op) {
  return op == Op::add || op == Op::subtract || is_fused(op);
}

// Bits, or whole numbers.
bool is_stepwise(Op op) {
  return op == Op::less || op == Op::less_equal || op == Op::equal || op == Op::shift_left ||
         op == Op::shift_right || op == Op::sign_mask;
}

// What is left of a by bit_and with b.
double part_kept(double a, std::uint64_t b) {
  if (b == Graph::kTrue) return 1.0;
  if (b == 0 || b == Graph::kSign) return 0.0;
  if (b == ~Graph::kSign) return a > 0.0 ? 1.0 : a < 0.0 ? -1.0 : 0.0;
  // The digits, to which an exponent is given later: a scaled by a power of two. Zero and what is
  // no number have none; a branch that asks for them is not the one taken.
  if (b == kDigits) return a != 0.0 && std::isfinite(a) ? std::ldexp(1.0, -std::ilogb(a)) : 0.0;
  return kUnknown;
}

double part_turned(std::uint64_t b) {
  return b == 0 ? 1.0 : b == Graph::kSign ? -1.0 : kUnknown;
}

Partials partials_of(Op op, double a, double b, double value) {
  switch (op) {
    case Op::add:
      return {1.0, 1.0, 0.0};
    case Op::subtract:
      return {1.0, -1.0, 0.0};
    case Op::multiply:
      return {b, a, 0.0};
    case Op::divide:
      return {1.0 / b, -value / b, 0.0};
    case Op::madd:
      return {b, a, 1.0};
    case Op::msub:
      return {b, a, -1.0};
    case Op::nmadd:
      return {-b, -a, 1.0};
    case Op::nmsub:
      return {-b, -a, -1.0};
    case Op::negate:
      return {-1.0, 0.0, 0.0};
    case Op::square_root:
      return {value > 0.0 ? 0.5 / value : 0.0, 0.0, 0.0};
    case Op::minimum:
      return a < b ? Partials{1.0, 0.0, 0.0} : Partials{0.0, 1.0, 0.0};
    case Op::maximum:
      return a > b ? Partials{1.0, 0.0, 0.0} : Partials{0.0, 1.0, 0.0};
    case Op::select:
      return bits_of(a) != 0 ? Partials{0.0, 1.0, 0.0} : Partials{0.0, 0.0, 1.0};
    case Op::bit_and:
      return {part_kept(a, bits_of(b)), part_kept(b, bits_of(a)), 0.0};
    case Op::bit_xor:
      return {part_turned(bits_of(b)), part_turned(bits_of(a)), 0.0};
    case Op::bit_or:  // of digits and an exponent
      return {1.0, 1.0, 0.0};
    default:
      return {0.0, 0.0, 0.0};
  }
}

// Operands before the operations that take them, and nothing that no output needs.
std::vector<char> find_needed(const Graph& graph) {
  const std::vector<Node>& nodes = graph.nodes();
  std::vector<char> needed(nodes.size(), 0);
  const auto need = [&needed](Value v) {
    if (v >= 0) needed[static_cast<std::size_t>(v)] = 1;
  };
  need(graph.required());
  for (const Output& o : graph.outputs()) need(o.value);
  for (std::size_t i = nodes.size(); i-- > 0;) {
    if (needed[i] == 0) continue;
    for (const Value v : {nodes[i].a, nodes[i].b, nodes[i].c}) need(v);
  }
  return needed;
}

}  // namespace

Tangents::Tangents(const Graph& graph, const std::vector<int>& varied)
    : columns_(static_cast<int>(varied.size())), inputs_(varied.size(), -1) {
  const std::vector<Node>& nodes = graph.nodes();
  const std::vector<char> needed = find_needed(graph);
  std::vector<int> place(nodes.size(), -1);
  // Of each operation the columns that it varies with.
  std::vector<std::vector<char>> varies_with;
  const auto placed = [&place](Value v) { return v < 0 ? -1 : place[static_cast<std::size_t>(v)]; };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (needed[i] == 0) continue;
    const Node& n = nodes[i];
    place[i] = static_cast<int>(operations_.size());
    Operation one{{n.op, placed(n.a), placed(n.b), placed(n.c), n.bits}, false, false};
    one.rounds = is_sum(n.op) && (rounds(graph, n.a) || rounds(graph, n.b) || rounds(graph, n.c));
    std::vector<char> columns(varied.size(), 0);
    if (n.op == Op::input) {
      for (std::size_t k = 0; k < varied.size(); ++k) {
        if (static_cast<std::uint64_t>(varied[k]) != n.bits) continue;
        columns[k] = 1;
        inputs_[k] = place[i];
      }
    } else if (!one.rounds && !is_stepwise(n.op)) {
      for (const int operand : {one.node.a, one.node.b, one.node.c}) {
        if (operand < 0) continue;
        const std::vector<char>& of = varies_with[static_cast<std::size_t>(operand)];
        for (std::size_t k = 0; k < columns.size(); ++k) columns[k] |= of[k];
      }
    }
    one.varies = std::ranges::count(columns, 1) > 0;
    operations_.push_back(one);
    varies_with.push_back(std::move(columns));
  }
  for (const Output& o : graph.outputs()) outputs_.push_back(placed(o.value));
  required_ = placed(graph.required());
  for (int begin = 0; begin < columns_; begin += kWidth) {
    const auto first = static_cast<std::ptrdiff_t>(begin);
    const auto varies_here = [&](int operation) {
      if (operation < 0) return false;
      const std::vector<char>& of = varies_with[static_cast<std::size_t>(operation)];
      return std::any_of(of.begin() + first, of.begin() + std::min(begin + kWidth, columns_),
                         [](char x) { return x != 0; });
    };
    const auto row = [&](int operation) { return varies_here(operation) ? operation + 1 : 0; };
    std::vector<Term> block;
    for (std::size_t i = 0; i < operations_.size(); ++i) {
      const Node& n = operations_[i].node;
      if (n.op == Op::input || !varies_here(static_cast<int>(i))) continue;
      block.push_back({static_cast<int>(i), {row(n.a), row(n.b), row(n.c)}});
    }
    blocks_.push_back(std::move(block));
  }
  values_.resize(operations_.size());
  partials_.resize(operations_.size());
  tangents_.assign(operations_.size() + 1, Row{});
  derivatives_.resize(outputs_.size() * varied.size());
}

double Tangents::value(int row) const {
  return values_[static_cast<std::size_t>(outputs_[static_cast<std::size_t>(row)])];
}

void Tangents::compute_values(const std::vector<double>& slots) {
  const auto at = [this](Value v) { return v < 0 ? 0.0 : values_[static_cast<std::size_t>(v)]; };
  for (std::size_t i = 0; i < operations_.size(); ++i) {
    const Operation& one = operations_[i];
    const Node& n = one.node;
    if (n.op == Op::constant) {
      values_[i] = std::bit_cast<double>(n.bits);
    } else if (n.op == Op::input) {
      values_[i] = slots[static_cast<std::size_t>(n.bits)];
    } else {
      values_[i] = apply(n.op, at(n.a), at(n.b), at(n.c));
      if (one.varies) partials_[i] = partials_of(n.op, at(n.a), at(n.b), values_[i]);
    }
  }
}

void Tangents::carry(const std::vector<Term>& block) {
  for (const Term& term : block) {
    const Partials& partial = partials_[static_cast<std::size_t>(term.operation)];
    Row sum{};
    for (std::size_t k = 0; k < 3; ++k) {
      // What is not chosen may be no number.
      if (term.operands[k] == 0 || partial[k] == 0.0) continue;
      const Row& of = tangents_[static_cast<std::size_t>(term.operands[k])];
      for (std::size_t c = 0; c < kWidth; ++c) sum[c] += partial[k] * of[c];
    }
    tangents_[static_cast<std::size_t>(term.operation) + 1] = sum;
  }
}

bool Tangents::update(const std::vector<double>& slots) {
  compute_values(slots);
  if (bits_of(values_[static_cast<std::size_t>(required_)]) != Graph::kTrue) return false;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    const std::size_t first = b * kWidth;
    const std::size_t count = std::min<std::size_t>(kWidth, inputs_.size() - first);
    for (std::size_t k = 0; k < count; ++k) {
      const int input = inputs_[first + k];
      if (input >= 0) tangents_[static_cast<std::size_t>(input) + 1][k] = 1.0;
    }
    carry(blocks_[b]);
    for (std::size_t r = 0; r < outputs_.size(); ++r) {
      const Row& of = tangents_[static_cast<std::size_t>(outputs_[r]) + 1];
      std::copy_n(of.begin(), count,
                  derivatives_.begin() + static_cast<std::ptrdiff_t>(r * inputs_.size() + first));
    }
    // Rows of this block are no rows of the next.
    for (const Term& term : blocks_[b]) {
      tangents_[static_cast<std::size_t>(term.operation) + 1].fill(0.0);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const int input = inputs_[first + k];
      if (input >= 0) tangents_[static_cast<std::size_t>(input) + 1].fill(0.0);
    }
  }
  return true;
}

}  // namespace linkstudy::codegen

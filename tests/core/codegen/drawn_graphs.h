// Graphs and numbers of all kinds, drawn at random.
#pragma once

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "core/codegen/allocation.h"
#include "core/codegen/frame_code.h"
#include "core/codegen/written_code.h"
#include "tests/support/same_bits.h"

namespace linkstudy::testing {

// Which not-a-number results is left open by the standard and by processors alike.
inline bool same_number(double a, double b) {
  return same_bits(a, b) || (std::isnan(a) && std::isnan(b));
}

inline double draw_number(std::mt19937_64& random) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  static constexpr double odd[] = {0.0,   -0.0,   1.0,    -1.0,   inf,      -inf,
                                   1e300, -1e300, 1e-300, 5e-324, 2.2e-308, 0.5};
  std::uniform_real_distribution<double> uniform(-4.0, 4.0);
  switch (random() % 8) {
    case 0:
      return odd[random() % std::size(odd)];
    case 1:
      return std::nan("");
    default:
      return std::ldexp(uniform(random), static_cast<int>(random() % 40) - 20);
  }
}

inline codegen::Op any_op(std::span<const codegen::Op> list, std::mt19937_64& random) {
  return list[random() % list.size()];
}

// `breadth`: how far back operands are taken from; what is beyond stays alive to the end.
inline void draw_graph(codegen::Graph& graph, std::mt19937_64& random, int inputs, int operations,
                       int outputs, std::size_t breadth) {
  using codegen::Op, codegen::Value;
  static constexpr Op on_numbers[] = {Op::add,    Op::subtract, Op::multiply,    Op::divide,
                                      Op::madd,   Op::msub,     Op::nmadd,       Op::nmsub,
                                      Op::negate, Op::minimum,  Op::square_root, Op::maximum};
  static constexpr Op comparisons[] = {Op::less, Op::less_equal, Op::equal};
  static constexpr Op shifts[] = {Op::shift_left, Op::shift_right};
  static constexpr Op on_masks[] = {Op::bit_and, Op::bit_or, Op::bit_xor};
  std::vector<Value> numbers, masks;
  for (int i = 0; i < inputs; ++i) numbers.push_back(graph.input(i));
  for (const double x : {0.0, -0.0, 1.0, -1.0, 2.0, 0.3}) numbers.push_back(graph.constant(x));
  masks.push_back(graph.make(Op::less, numbers[0], numbers[1]));
  const auto any_of = [&](const std::vector<Value>& list) {
    return list[list.size() - 1 - random() % std::min(breadth, list.size())];
  };
  for (int i = 0; i < operations; ++i) {
    const auto kind = random() % 11;
    if (kind < 7) {
      const Op op = any_op(on_numbers, random);
      const int n = codegen::operand_count(op);
      const Value a = any_of(numbers), b = any_of(numbers), c = any_of(numbers);
      numbers.push_back(graph.make(op, a, n > 1 ? b : -1, n > 2 ? c : -1));
    } else if (kind == 7) {
      masks.push_back(graph.make(any_op(comparisons, random), any_of(numbers), any_of(numbers)));
    } else if (kind == 8) {
      masks.push_back(graph.make(any_op(on_masks, random), any_of(masks), any_of(masks)));
    } else if (kind == 9) {
      numbers.push_back(graph.make(Op::select, any_of(masks), any_of(numbers), any_of(numbers)));
    } else {
      // Bits of masks: those of a number that is none are left open.
      const Value bits =
          graph.make(any_op(shifts, random), any_of(masks), graph.bits(random() % 80));
      const Value sign = graph.make(Op::bit_and, bits, graph.sign());
      numbers.push_back(graph.make(Op::bit_xor, any_of(numbers), sign));
      masks.push_back(graph.make(Op::sign_mask, bits));
    }
  }
  for (int i = 0; i < outputs; ++i) graph.write(any_of(numbers), inputs + i);
}

// A graph of its own for every seed: some of few values at a time, some of many.
struct DrawnGraph {
  explicit DrawnGraph(std::uint64_t seed, std::uint64_t most_operations = 300) : random(seed) {
    inputs = 2 + static_cast<int>(random() % 12);
    const int outputs = 1 + static_cast<int>(random() % 8);
    slots = inputs + outputs;
    draw_graph(graph, random, inputs, static_cast<int>(random() % most_operations), outputs,
               seed % 2 == 0 ? 10 : 1000);
  }
  std::mt19937_64 random;
  codegen::Graph graph;
  int inputs, slots;
};

// Code on a frame of `slot_numbers` a slot, or on several behind each other.
struct Target {
  InstructionSet isa;
  int slot_numbers;
  int frames = 1;

  std::string name() const { return fmt::format("{}_{}x{}", name_of(isa), frames, slot_numbers); }
  codegen::Program allocate(const codegen::Graph& graph, int slots) const {
    return codegen::allocate(graph, slots, codegen::program_registers(isa, frames));
  }
  std::vector<std::uint8_t> assemble(const codegen::Program& program) const {
    return codegen::assemble(program, isa, {slot_numbers, program.slots, frames});
  }
};

// Frames for a program with drawn inputs, and what interpretation of the graph makes of them.
class DrawnFrames {
 public:
  DrawnFrames(const codegen::Graph& graph, const codegen::Program& program, int inputs, int slots,
              const Target& target, std::mt19937_64& random)
      : slot_numbers_(target.slot_numbers),
        lanes_(target.frames * slot_numbers_),
        slots_(slots),
        frame_slots_(program.slots),
        frames_(program.slots * lanes_) {
    std::fill_n(frames_.data(), program.slots * lanes_, std::nan(""));
    for (int k = 0; k < lanes_; ++k) {
      for (const auto& c : program.constants) number(c.slot, k) = std::bit_cast<double>(c.bits);
      std::vector<double>& lane = expected_.emplace_back(static_cast<std::size_t>(slots));
      for (int i = 0; i < inputs; ++i) {
        number(i, k) = lane[static_cast<std::size_t>(i)] = draw_number(random);
      }
      interpret(graph, lane);
    }
  }

  std::span<double> numbers() {
    return {frames_.data(), static_cast<std::size_t>(frame_slots_ * lanes_)};
  }

  ::testing::AssertionResult are_as_expected() {
    for (int k = 0; k < lanes_; ++k) {
      for (int i = 0; i < slots_; ++i) {
        const double expected = expected_[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
        if (same_number(number(i, k), expected)) continue;
        return ::testing::AssertionFailure()
               << "slot " << i << " lane " << k << ": " << number(i, k) << " for " << expected;
      }
    }
    return ::testing::AssertionSuccess();
  }

 private:
  double& number(int slot, int k) {
    const int frame = k / slot_numbers_;
    return frames_.data()[(frame * frame_slots_ + slot) * slot_numbers_ + k % slot_numbers_];
  }

  int slot_numbers_, lanes_, slots_, frame_slots_;
  codegen::FrameNumbers frames_;
  std::vector<std::vector<double>> expected_;  // by lane
};

}  // namespace linkstudy::testing

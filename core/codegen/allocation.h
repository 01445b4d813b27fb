// From a graph to instructions on a number of vector registers and a frame in memory: what the
// graph needs, in one of two orders; each value in a register while it is used soon, else in a slot
// of the frame. When registers run out, the value whose next use is farthest gives way (Belady
// 1966), and is stored once at most. An operand that would not stay is read from memory.
#pragma once

#include <vector>

#include "core/codegen/graph.h"

namespace linkstudy::codegen {

// Where the operands of a fused operation x, y, z stand: x is the register that is overwritten, z
// may be in memory.
//   x_y_plus_z   x := x y + z     x_z_plus_y   x := x z + y     y_z_plus_x   x := y z + x
enum class FusedForm : std::uint8_t { x_y_plus_z, x_z_plus_y, y_z_plus_x };

// A register, or a slot of the frame where `reg` is below 0.
struct Operand {
  int reg = -1;
  int slot = -1;
};

enum class Action : std::uint8_t { operate, load, store, copy };

//   load   to := slot        store   slot := to        copy   to := first
//   operate   to := op(first, second, third); of a fused one: x = to, y = first, z = second;
//             of select: to := first ? second : third, with first and third in registers
struct Instruction {
  Action action;
  Op op = Op::constant;
  FusedForm form = FusedForm::x_y_plus_z;
  int to = -1;
  Operand first{}, second{}, third{};
};

struct SlotValue {
  int slot;
  std::uint64_t bits;
};

// Instructions on a frame whose first slots are those of the graph; then come its constants, to be
// filled in once, then the places of values that had to leave their registers.
struct Program {
  std::vector<Instruction> instructions;
  std::vector<SlotValue> constants;
  int slots = 0;
  int stores = 0;  // of values that had to leave
};

// As the graph was made: what does not depend on each other stands near, and short code waits less.
// Depth first, what needs most registers before the rest (Sethi and Ullman 1970): of long code less
// has to leave the registers.
enum class Order { as_made, depth_first };

// `slots`: of inputs and outputs. Outputs overwrite no input. Programs of a graph, for any number
// of registers and in any order, have the same constants in the same slots.
Program allocate(const Graph& graph, int slots, int registers, Order order = Order::as_made);

}  // namespace linkstudy::codegen

// Machine code for vectors of doubles as objdump reads it, carried out instruction by instruction
// in plain C++: what the bytes mean, by another hand than the one that encoded them and on any
// machine. Knows the instructions that steps are written with, for AVX2 and AVX-512, as the Intel
// manual (volume 2) defines them, and throws at any other.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace linkstudy::testing {

bool has_disassembler();

// A function of one frame: its numbers stand from the address in rdi on.
class Disassembled {
 public:
  // A register of 4 or 8 doubles, a register of one bit a lane, one of an address, a place in
  // memory, a number.
  struct Operand {
    enum class Kind { vector, mask, address, memory, immediate } kind;
    std::uint64_t number;  // of the register; offset in memory in bytes, modulo 2^64
    int lanes = 0;         // of a vector register
    std::size_t base = 0;  // register that the offset counts from
  };
  struct Instruction {
    std::string mnemonic;
    std::vector<Operand> operands;
    int lanes = 0;
  };

  // Functions, each to its `ret`.
  static std::vector<Disassembled> read(std::span<const std::vector<std::uint8_t>> functions);

  const std::vector<Instruction>& instructions() const { return instructions_; }
  void run(std::span<double> frame) const;

 private:
  std::vector<Instruction> instructions_;
};

}  // namespace linkstudy::testing

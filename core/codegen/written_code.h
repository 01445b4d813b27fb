// Machine code that the program has written, in memory that is either writable or executable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/base/isa.h"
#include "core/codegen/allocation.h"

namespace linkstudy::codegen {

// Pages with code in them.
class WrittenCode {
 public:
  using Function = void (*)(double* frame);
  // Maps fresh pages, copies, and takes the right to write. Null where the machine refuses.
  // `protect` is mprotect, but for tests.
  using Protect = int (*)(void* address, std::size_t size, int rights);
  static std::unique_ptr<WrittenCode> place(std::span<const std::uint8_t> code,
                                            Protect protect = nullptr);

  WrittenCode(const WrittenCode&) = delete;
  WrittenCode& operator=(const WrittenCode&) = delete;
  ~WrittenCode();

  Function function() const;
  std::size_t size() const { return size_; }

 private:
  WrittenCode(void* pages, std::size_t size) : pages_(pages), size_(size) {}
  void* pages_;
  std::size_t size_;
};

// Vectors of a slot that a call does side by side, so that one is computed while the other waits.
// They share the registers.
constexpr int vectors_at_once(InstructionSet isa, int slot_numbers) {
  return isa == InstructionSet::avx512 && slot_numbers == 2 * native_lanes(isa) ? 2 : 1;
}

// Registers that a program may use.
constexpr int program_registers(InstructionSet isa, int slot_numbers) {
  return vector_registers(isa) / vectors_at_once(isa, slot_numbers);
}

// The program for AVX2 with fused multiply-add or for AVX-512 (F and DQ), on frames of
// `slot_numbers` doubles a slot, aligned to vectors: a call does the first vectors_at_once() of
// each. Empty for the baseline and on other processors than x86-64.
std::vector<std::uint8_t> assemble(const Program& program, InstructionSet isa, int slot_numbers);

}  // namespace linkstudy::codegen

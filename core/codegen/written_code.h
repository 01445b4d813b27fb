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

  // The same where it runs fastest, of a few places: in some pages, whatever the numbers and their
  // frame, the same bytes take up to three times as long (on Zen 5 in one of ten for 50 KB, in one
  // of two hundred for 10 KB). Runs on a frame of ones, of so many numbers.
  static std::unique_ptr<WrittenCode> place_well(std::span<const std::uint8_t> code,
                                                 int frame_numbers);

  WrittenCode(const WrittenCode&) = delete;
  WrittenCode& operator=(const WrittenCode&) = delete;
  ~WrittenCode();

  Function function() const;
  std::size_t size() const { return size_; }
  double call_s() const { return call_s_; }  // of code placed well: seconds of a call

 private:
  WrittenCode(void* pages, std::size_t size) : pages_(pages), size_(size) {}
  void* pages_;
  std::size_t size_;
  double call_s_ = 0.0;
};

// Frames that a call does side by side, so that one is computed while the other waits; they share
// the registers, and the second stands behind the first.
struct FrameLayout {
  int slot_numbers = 0;  // doubles a slot
  int slots = 0;         // of a frame
  int frames = 1;        // of code for AVX-512 two, else one
};

// Registers that a program may use.
constexpr int program_registers(InstructionSet isa, int frames) {
  return vector_registers(isa) / frames;
}

// The program for AVX2 with fused multiply-add or for AVX-512 (F and DQ): a call does the first
// native_lanes(isa) numbers of each slot, aligned to as many. Empty for the baseline and on other
// processors than x86-64.
std::vector<std::uint8_t> assemble(const Program& program, InstructionSet isa,
                                   const FrameLayout& layout);

}  // namespace linkstudy::codegen

// Machine code that the program has written, in memory that is either writable or executable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/codegen/allocation.h"

namespace linkstudy::codegen {

// Numbers of a slot of a frame, side by side: an AVX2 register.
inline constexpr int kSlotNumbers = 4;

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

// The program on frames of kSlotNumbers doubles a slot, 32 bytes aligned, for AVX2 with fused
// multiply-add; empty on other processors than x86-64.
std::vector<std::uint8_t> assemble_avx2(const Program& program);

}  // namespace linkstudy::codegen

// A program as machine code, and which code is trusted with it. A slot of its frame holds several
// numbers side by side: narrow code (AVX2) does them in parts, wide code (AVX-512) all at once.
// Wide code has to earn it: what it writes is compared with what the narrow code makes of the same
// frame, to the bit, in the first run that can decide. The code is straight, every run executes all
// of it, so that one run finds an instruction that is wrong. Where they differ the narrow code
// serves for good.
#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

namespace linkstudy::codegen {

// In the wide code: not compared yet, found the same, found to differ or not there.
enum class Trust { untried, earned, none };

// How many wide codes of this process were found to differ.
int distrusted_count();

// Zeros, aligned for all registers.
class FrameNumbers {
 public:
  FrameNumbers() = default;
  explicit FrameNumbers(int count) : lines_(static_cast<std::size_t>(count) / kLine + 1) {}
  double* data() { return lines_.front().numbers; }

 private:
  static constexpr std::size_t kLine = 8;
  struct alignas(kLine * sizeof(double)) Line {
    double numbers[kLine] = {};
  };
  std::vector<Line> lines_;
};

class FrameCode {
 public:
  using Function = void (*)(double* frame);

  struct Frame {
    int slot_numbers = 0;  // side by side in a slot
    int slots = 0;
    int compared = 0;  // so many slots have the same meaning for both codes
    int fine = 0;    // slot of a mask: the code has something to say about a lane where it is true
    int frames = 1;  // alike, one behind the other
  };

  // `narrow` does the first native_lanes(avx2) numbers of each slot of a frame, `wide` all of all.
  // Without wide code all is narrow's.
  FrameCode(const Frame& frame, Function narrow, Function wide = nullptr)
      : frame_(frame), narrow_(narrow), wide_(wide) {
    if (wide == nullptr) trust_ = Trust::none;
  }

  // `frame`: the first, aligned to its slots. May be called by several threads, each with a frame
  // of its own.
  void run(double* frame);

  Trust trust() const { return trust_.load(std::memory_order_relaxed); }

 private:
  void run_narrow(double* frame) const;
  void compare(double* frame);

  Frame frame_;
  Function narrow_, wide_;
  std::atomic<Trust> trust_{Trust::untried};
};

}  // namespace linkstudy::codegen

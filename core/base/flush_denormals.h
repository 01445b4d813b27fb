// While alive, results and operands below 2.2e-308 count as zero: a decaying state would otherwise
// reach them, where every operation takes some hundred cycles. The same for every instruction set
// and lane count, so that bits agree.
#pragma once

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace linkstudy {

class FlushDenormals {
 public:
#if defined(__x86_64__)
  FlushDenormals() : before_(_mm_getcsr()) {
    _mm_setcsr(before_ | 0x8040u);
  }
  ~FlushDenormals() {
    _mm_setcsr(before_);
  }
#else
  FlushDenormals() = default;
  ~FlushDenormals() = default;
#endif
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned before_ = 0;
};

}  // namespace linkstudy

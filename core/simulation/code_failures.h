// When written code that fails is left: it did in more than one of four runs, or in 64 in a row.
// Always inline: kernels of several instruction sets count.
#pragma once

namespace linkstudy {

class CodeFailures {
 public:
  // One more run. True if the code is better left.
  [[gnu::always_inline]] bool note(bool is_fine) {
    ++runs_;
    if (is_fine) {
      in_a_row_ = 0;
      return false;
    }
    ++failed_;
    ++in_a_row_;
    return in_a_row_ >= kTrial || (runs_ >= kTrial && kMostFailures * failed_ > runs_);
  }

 private:
  static constexpr long kTrial = 64;        // runs before code may be left
  static constexpr long kMostFailures = 4;  // one in so many is too much
  long runs_ = 0, failed_ = 0, in_a_row_ = 0;
};

}  // namespace linkstudy

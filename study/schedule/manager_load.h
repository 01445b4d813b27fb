// How busy rank 0's main thread is with handing out, and whether its rank still has time to compute
// itself: not from a fifth on, and again below a twentieth.
#pragma once

#include <chrono>

namespace linkstudy {

class ManagerLoad {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // From the thread itself, now and then: what it has computed since the last call counts.
  void measure(Time now);
  // For tests: CPU time of the thread so far, s.
  void measure(Time now, double cpu_s);

  bool leaves_time() const { return leaves_time_; }

 private:
  Time measured_{};
  double cpu_s_ = -1.0;
  bool leaves_time_ = true;
};

}  // namespace linkstudy

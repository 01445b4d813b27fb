// How far one run is in model time, for people: a bar that is redrawn on a terminal, or in a batch
// log a line when a further 10 % are done or 30 s have passed, and none within 3 s of the last.
// Everything goes to standard error.
//   [#########---------------] 6.2 of 15 s   41%  12s left
//   6.2 of 15 s (41%), 12s left
// Time left: elapsed (end - reached) / reached, since steps are equal.
#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

#include "study/schedule/progress.h"

namespace linkstudy {

struct RunProgressState {
  double end = 0.0;        // s, model time of the whole run
  double reached = 0.0;    // s, model time
  double elapsed_s = 0.0;  // wall time
};

std::string run_progress_bar(const RunProgressState& state, std::size_t width);
std::string run_progress_line(const RunProgressState& state);

// Writes; decides only when.
class RunProgress {
 public:
  using Time = Progress::Time;

  // mode must not be automatic.
  RunProgress(ProgressMode mode, double end, Time start, std::ostream& stream, std::size_t width);

  void update(double reached, Time now);
  // Leaves the line of a bar; a log has had its lines.
  void finish(double reached, Time now);

 private:
  bool is_due(Time now) const;
  void write(Time now);

  ProgressMode mode_;
  RunProgressState state_;
  Time start_;
  Time written_;
  int tenths_ = 0;  // of the run, as last written
  bool is_drawn_ = false;
  std::ostream& stream_;
  std::size_t width_;
};

// Shows `reached` from a thread of its own for as long as it lives.
class RunWatch {
 public:
  RunWatch(ProgressMode mode, double end, const std::atomic<double>& reached);
  RunWatch(const RunWatch&) = delete;
  RunWatch& operator=(const RunWatch&) = delete;
  ~RunWatch();

 private:
  void watch(const std::stop_token& stop);

  const std::atomic<double>& reached_;
  RunProgress progress_;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: it uses the others
};

}  // namespace linkstudy

// How far a study is, for people: a bar that is redrawn on a terminal, or in a batch log one short
// line at most every 10 s and a last one. Everything goes to standard error.
//   [#########-----------]  412/1000   41%  3 failed  15 running  210/s  2m48s left
//   412 of 1000 (41%), 3 failed, 15 running, 210/s, 2m48s left
// A search may end long before its budget, so that nobody knows what is left: the time is that
// spent.
//   134 of at most 600, 5 failed, 13.4/s, 10s
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <ostream>
#include <string>
#include <string_view>

#include "core/base/words.h"

namespace linkstudy {

enum class ProgressMode { automatic, bar, line, none };

template <>
inline constexpr auto kWords<ProgressMode> =
    make_words<ProgressMode>({{ProgressMode::automatic, "auto"},
                              {ProgressMode::bar, "bar"},
                              {ProgressMode::line, "line"},
                              {ProgressMode::none, "none"}});

// Automatic becomes a bar where standard error is a terminal, and lines elsewhere.
ProgressMode choose_progress_mode(ProgressMode mode);

// Of standard error; 80 where it is no terminal.
std::size_t find_terminal_width();

// A bar is redrawn at most this often, and has this many cells.
inline constexpr std::chrono::milliseconds kBarInterval{100};
inline constexpr std::size_t kBarCells = 24;

struct ProgressState {
  std::size_t total = 0;
  std::size_t done = 0;  // failed ones and those of earlier starts included
  std::size_t failed = 0;
  std::size_t earlier = 0;  // done before this start: no part of the rate
  double elapsed_s = 0.0;   // since this start
  std::size_t running = 0;  // handed out and not answered
  bool is_budget = false;   // the total is never exceeded, and rarely reached
};

// "0.4s", "12s", "2m48s", "3h05m", "2d04h".
std::string duration_text(double seconds);

std::string progress_bar(const ProgressState& state, std::size_t width);
std::string progress_line(const ProgressState& state);

// Writes; decides only when. A bar is redrawn at most ten times a second.
class Progress {
 public:
  using Time = std::chrono::steady_clock::time_point;

  Progress(ProgressMode mode, std::size_t total, std::size_t earlier, Time start);
  // For tests and other streams: mode must not be automatic.
  Progress(ProgressMode mode, std::size_t total, std::size_t earlier, Time start,
           std::ostream& stream, std::size_t width);

  // Counts of this and earlier starts, or nothing new, so that the clock runs on.
  void update(std::size_t done, std::size_t failed, Time now);
  void set_running(std::size_t running) { state_.running = running; }
  void set_budget(bool is_budget) { state_.is_budget = is_budget; }
  void tick(Time now);
  // Makes room for other lines: takes the bar away until it is drawn next.
  void clear();
  // The last line, whatever the time.
  void finish(Time now);

 private:
  void write(Time now, bool last);

  ProgressMode mode_;
  ProgressState state_;
  Time start_;
  Time written_;
  bool ever_written_ = false;
  std::ostream& stream_;
  std::size_t width_;
};

}  // namespace linkstudy

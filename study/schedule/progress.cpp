#include "study/schedule/progress.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace linkstudy {
namespace {

constexpr std::chrono::seconds kLineInterval{10};

// Rounded down: 100 % means all.
std::size_t percent(const ProgressState& state) {
  if (state.total == 0) return 100;
  return static_cast<std::size_t>(100.0 * static_cast<double>(state.done) /
                                  static_cast<double>(state.total));
}

// Evaluations per second of this start, 0 while unknown.
double find_rate(const ProgressState& state) {
  if (state.done <= state.earlier || state.elapsed_s <= 0.0) return 0.0;
  return static_cast<double>(state.done - state.earlier) / state.elapsed_s;
}

std::string rate_text(double rate) {
  if (rate >= 0.1) return fmt::format("{:.3g}/s", rate >= 100.0 ? std::round(rate) : rate);
  return fmt::format("{:.3g}/h", rate * 3600.0);
}

std::string tail(const ProgressState& state, const char* separator) {
  std::string text;
  if (state.failed > 0) text += fmt::format("{}{} failed", separator, state.failed);
  if (state.running > 0) text += fmt::format("{}{} running", separator, state.running);
  const double rate = find_rate(state);
  if (rate > 0.0) text += separator + rate_text(rate);
  if (state.done >= state.total || state.is_budget)
    text += separator + duration_text(state.elapsed_s);
  else if (rate > 0.0)
    text += fmt::format("{}{} left", separator,
                        duration_text(static_cast<double>(state.total - state.done) / rate));
  return text;
}

}  // namespace

ProgressMode choose_progress_mode(ProgressMode mode) {
  if (mode != ProgressMode::automatic) return mode;
  return isatty(STDERR_FILENO) ? ProgressMode::bar : ProgressMode::line;
}

std::size_t find_terminal_width() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col < 20) return 80;
  return size.ws_col;
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0.0) || seconds > 1e11) return "?";
  if (seconds < 9.95) return fmt::format("{:.1f}s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{}s", whole);
  if (whole < 3600) return fmt::format("{}m{:02}s", whole / 60, whole % 60);
  if (whole < 86400) return fmt::format("{}h{:02}m", whole / 3600, whole % 3600 / 60);
  return fmt::format("{}d{:02}h", whole / 86400, whole % 86400 / 3600);
}

std::string progress_bar(const ProgressState& state, std::size_t width) {
  if (state.is_budget) {
    return fmt::format("{} of at most {}{}", state.done, state.total, tail(state, "  "))
        .substr(0, width);
  }
  const double part =
      state.total == 0 ? 1.0 : static_cast<double>(state.done) / static_cast<double>(state.total);
  const auto filled =
      static_cast<std::size_t>(static_cast<double>(kBarCells) * std::min(part, 1.0));
  const std::string text = fmt::format("[{}{}] {:>{}}/{} {:>3}%{}", std::string(filled, '#'),
                                       std::string(kBarCells - filled, '-'), state.done,
                                       std::to_string(state.total).size(), state.total,
                                       percent(state), tail(state, "  "));
  return text.substr(0, width);
}

std::string progress_line(const ProgressState& state) {
  if (state.is_budget) {
    return fmt::format("{} of at most {}{}", state.done, state.total, tail(state, ", "));
  }
  return fmt::format("{} of {} ({}%){}", state.done, state.total, percent(state),
                     tail(state, ", "));
}

Progress::Progress(ProgressMode mode, std::size_t total, std::size_t earlier, Time start)
    : Progress(choose_progress_mode(mode), total, earlier, start, std::cerr,
               find_terminal_width()) {}

Progress::Progress(ProgressMode mode, std::size_t total, std::size_t earlier, Time start,
                   std::ostream& stream, std::size_t width)
    : mode_(mode), start_(start), written_(start), stream_(stream), width_(width) {
  state_.total = total;
  state_.done = earlier;
  state_.earlier = earlier;
}

void Progress::update(std::size_t done, std::size_t failed, Time now) {
  state_.done = done;
  state_.failed = failed;
  tick(now);
}

void Progress::tick(Time now) {
  const bool bar = mode_ == ProgressMode::bar;
  const bool due = bar ? now - written_ >= kBarInterval : now - written_ >= kLineInterval;
  if (due || (bar && !ever_written_)) write(now, false);
}

void Progress::clear() {
  if (mode_ != ProgressMode::bar || !ever_written_) return;
  stream_ << "\r\x1b[K";
  stream_.flush();
}

void Progress::finish(Time now) {
  state_.running = 0;
  write(now, true);
}

void Progress::write(Time now, bool last) {
  if (mode_ == ProgressMode::none) return;
  state_.elapsed_s = std::chrono::duration<double>(now - start_).count();
  written_ = now;
  ever_written_ = true;
  if (mode_ == ProgressMode::bar)
    // Back to the first column; what a longer text left behind is erased. The last column stays
    // free, because a terminal would wrap there.
    stream_ << '\r' << progress_bar(state_, width_ - 1) << "\x1b[K" << (last ? "\n" : "");
  else
    stream_ << progress_line(state_) << '\n';
  stream_.flush();
}

}  // namespace linkstudy

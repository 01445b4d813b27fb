#include "study/schedule/run_progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds kShortestLineInterval{3};
constexpr std::chrono::seconds kLongestLineInterval{30};

double part_of(const RunProgressState& state) {
  return state.end > 0.0 ? std::clamp(state.reached / state.end, 0.0, 1.0) : 0.0;
}

// Rounded down: 100 % means the end, but for the rounding of a time that is a sum of steps.
int percent_of(const RunProgressState& state) {
  return static_cast<int>(100.0 * part_of(state) + 1e-6);
}

std::string time_left(const RunProgressState& state, const char* separator) {
  const double part = part_of(state);
  if (part <= 0.0) return "";
  if (percent_of(state) == 100) return separator + duration_text(state.elapsed_s);
  return fmt::format("{}{} left", separator, duration_text(state.elapsed_s * (1.0 / part - 1.0)));
}

}  // namespace

std::string run_progress_bar(const RunProgressState& state, std::size_t width) {
  const auto filled = static_cast<std::size_t>(static_cast<double>(kBarCells) * part_of(state));
  return fmt::format("[{}{}] {:.3g} of {:.3g} s  {:>3}%{}", std::string(filled, '#'),
                     std::string(kBarCells - filled, '-'), state.reached, state.end,
                     percent_of(state), time_left(state, "  "))
      .substr(0, width);
}

std::string run_progress_line(const RunProgressState& state) {
  return fmt::format("{:.3g} of {:.3g} s ({}%){}", state.reached, state.end, percent_of(state),
                     time_left(state, ", "));
}

RunProgress::RunProgress(ProgressMode mode, double end, Time start, std::ostream& stream,
                         std::size_t width)
    : mode_(mode), start_(start), written_(start), stream_(stream), width_(width) {
  state_.end = end;
}

void RunProgress::update(double reached, Time now) {
  state_.reached = reached;
  if (is_due(now)) write(now);
}

void RunProgress::finish(double reached, Time now) {
  if (!is_drawn_ || mode_ != ProgressMode::bar) return;
  state_.reached = reached;
  write(now);
  stream_ << '\n' << std::flush;
}

bool RunProgress::is_due(Time now) const {
  const auto since = now - written_;
  if (mode_ == ProgressMode::bar) return since >= kBarInterval;
  if (mode_ != ProgressMode::line || since < kShortestLineInterval) return false;
  return percent_of(state_) / 10 > tenths_ || since >= kLongestLineInterval;
}

void RunProgress::write(Time now) {
  state_.elapsed_s = std::chrono::duration<double>(now - start_).count();
  written_ = now;
  tenths_ = percent_of(state_) / 10;
  is_drawn_ = true;
  if (mode_ == ProgressMode::bar) {
    stream_ << '\r' << run_progress_bar(state_, width_ - 1) << "\x1b[K";
  } else {
    stream_ << run_progress_line(state_) << '\n';
  }
  stream_.flush();
}

RunWatch::RunWatch(ProgressMode mode, double end, const std::atomic<double>& reached)
    : reached_(reached),
      progress_(choose_progress_mode(mode), end, Clock::now(), std::cerr, find_terminal_width()) {
  if (mode == ProgressMode::none) return;
  thread_ = std::jthread([this](const std::stop_token& stop) { watch(stop); });
}

RunWatch::~RunWatch() {
  if (!thread_.joinable()) return;
  thread_.request_stop();
  thread_.join();
  progress_.finish(reached_.load(std::memory_order_relaxed), Clock::now());
}

void RunWatch::watch(const std::stop_token& stop) {
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, stop, kBarInterval, [&stop] { return stop.stop_requested(); })) {
    progress_.update(reached_.load(std::memory_order_relaxed), Clock::now());
  }
}

}  // namespace linkstudy

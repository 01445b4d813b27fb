// The ranks that serve.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "study/schedule/pool.h"
#include "study/schedule/stop_signals.h"

namespace linkstudy {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::microseconds;
using std::chrono::milliseconds;

// While it computes, the main thread only looks after signals and large messages.
constexpr microseconds kPauseComputing{2000};
constexpr microseconds kPauseIdle{100};
// Between the runs of a tuner rank 0 may think for long.
constexpr microseconds kPauseLongIdle{1000};
constexpr milliseconds kLongIdleAfter{100};

}  // namespace

void Pool::serve() {
  if (transport_.rank() == 0) throw std::logic_error("rank 0 runs tasks; the others serve");
  bool stopped = false;
  auto last_active = Clock::now();
  while (!stopped || !thread_.idle()) {
    bool active = false;
    take_orders(stopped, active);
    send_results();
    forward_signals();
    if (active) last_active = Clock::now();
    if (!thread_.idle())
      thread_.wait_for_result(kPauseComputing);
    else
      std::this_thread::sleep_for(Clock::now() - last_active > kLongIdleAfter ? kPauseLongIdle
                                                                              : kPauseIdle);
  }
  say_bye();
}

void Pool::take_orders(bool& stopped, bool& active) {
  while (auto message = transport_.receive()) {
    active = true;
    switch (message->tag) {
      case Tag::task:
        thread_.push(unpack_task(std::move(message->bytes)));
        break;
      case Tag::call:
        transport_.send(0, goes_on() ? Tag::going : Tag::stuck, "");
        break;
      case Tag::cancel:
        if (options_.cancel_work) options_.cancel_work();
        break;
      case Tag::abandon:
        leave_worker(std::stoi(message->bytes));
      case Tag::stop:
        stopped = true;
        thread_.drop_queued();
        break;
      default:
        break;
    }
  }
}

void Pool::send_results() {
  while (auto result = thread_.pop()) {
    TaskResult head{result->run, result->index, {}, true, result->seconds, result->rank};
    try {
      transport_.send(0, Tag::result, pack_result(std::move(*result)));
    } catch (const std::length_error& error) {
      head.bytes = error.what();
      transport_.send(0, Tag::result, pack_result(std::move(head)));
    }
  }
}

// A rank does not stop by itself: rank 0 hears of the signal and coordinates. But what runs here is
// cancelled here, in case rank 0 is no longer there to say so.
void Pool::forward_signals() {
  const int level = std::min(stop_level(), kStopCancel);
  if (level <= forwarded_level_) return;
  if (level == kStopCancel && options_.cancel_work) options_.cancel_work();
  forwarded_level_ = level;
  transport_.send(0, Tag::signal, std::to_string(level));
}

void Pool::say_bye() {
  transport_.send(0, Tag::bye, "");
  while (!transport_.all_sent()) std::this_thread::sleep_for(kPauseIdle);
}

void Pool::leave_worker(int code) {
  say_bye();
  transport_.leave_now(code);
}

}  // namespace linkstudy

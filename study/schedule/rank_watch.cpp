#include "study/schedule/rank_watch.h"

#include <algorithm>

namespace linkstudy {
namespace {

using Seconds = std::chrono::duration<double>;

constexpr double kLongestSilenceS = 60.0;
constexpr double kLeastSilenceS = 5.0;

constexpr double kStuckPerSilence = 10.0;
constexpr double kStuckPerTask = 20.0;

// What one look counts at most: longer between two looks, rank 0 stood still.
constexpr double kLongestLookS = 1.0;
constexpr Seconds kCallInterval{1.0};

double find_silent_limit(double task_limit_s) {
  if (task_limit_s <= 0.0) return kLongestSilenceS;
  return std::min(kLongestSilenceS, kLeastSilenceS + task_limit_s);
}

}  // namespace

RankWatch::RankWatch(int ranks, double task_limit_s, Time now)
    : states_(static_cast<std::size_t>(ranks)),
      silent_limit_s_(find_silent_limit(task_limit_s)),
      counted_(now),
      called_(now) {}

void RankWatch::hear(int rank, bool goes_on) {
  State& state = states_[static_cast<std::size_t>(rank)];
  state.silent_s = 0.0;
  if (goes_on) state.stuck_s = 0.0;
}

void RankWatch::note_task(double seconds) {
  longest_task_s_ = std::max(longest_task_s_, seconds);
}

double RankWatch::stuck_limit_s() const {
  return std::max(kStuckPerSilence * silent_limit_s_, kStuckPerTask * longest_task_s_);
}

void RankWatch::restart(Time now) {
  for (State& state : states_) {
    if (!state.lost) state = {};
  }
  counted_ = now;
}

std::vector<int> RankWatch::find_lost(Time now) {
  const double passed = std::min(Seconds(now - counted_).count(), kLongestLookS);
  counted_ = now;
  std::vector<int> lost;
  for (std::size_t rank = 0; rank < states_.size(); ++rank) {
    State& state = states_[rank];
    if (state.lost) continue;
    state.silent_s += passed;
    state.stuck_s += passed;
    if (state.silent_s <= silent_limit_s_ && state.stuck_s <= stuck_limit_s()) continue;
    state.lost = true;
    ++lost_count_;
    lost.push_back(static_cast<int>(rank));
  }
  return lost;
}

bool RankWatch::is_time_to_call(Time now) {
  if (now - called_ < kCallInterval) return false;
  called_ = now;
  return true;
}

bool RankWatch::answers(int rank) const {
  return states_[static_cast<std::size_t>(rank)].silent_s <= silent_limit_s_;
}

double RankWatch::silence_s(int rank) const {
  const State& state = states_[static_cast<std::size_t>(rank)];
  return answers(rank) ? state.stuck_s : state.silent_s;
}

}  // namespace linkstudy
